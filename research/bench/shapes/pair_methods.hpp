// Ways to find the first contact of two bodies that fly and turn steadily.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "research/bench/shapes/turning_pair.hpp"

namespace kinesphere::program {

struct PairMethod {
  std::string name;
  /// Returns the time of the first contact in [0, 1].
  std::function<std::optional<double>(const TurningPair& pair)> first_contact;
};

/// A world for each pair, and worlds into which the pairs come one after the other.
std::vector<PairMethod> world_methods();
/// Continuous collision of FCL. Empty if this program was built without FCL.
std::vector<PairMethod> fcl_methods();

}  // namespace kinesphere::program
