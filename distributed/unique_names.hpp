// UniqueNames checks that the names of bodies are unique over all ranks.
#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "distributed/communicator.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

/// Rank r compares the names whose remainder modulo the number of ranks is r.
class UniqueNames {
 public:
  /// Records the name of a body that was added or restored on this rank.
  void add(std::uint32_t name) { new_.insert(name); }
  /// Returns true if this rank knows that there is such a name; check() finds the others.
  bool contains(std::uint32_t name) const { return new_.contains(name) || compared_.contains(name); }
  /// Collective. Compares the names added since the last call with each other and with all earlier ones.
  /// Errors: out_of_range (index) for a duplicate, returned only on the rank that compares the name.
  Result<void> check(Communicator& communicator);

 private:
  std::unordered_set<std::uint32_t> new_;       ///< names of this rank that are not compared yet
  std::unordered_set<std::uint32_t> compared_;  ///< names of all ranks that this rank has compared
};

}  // namespace kinesphere
