// Pairs of bodies that fly and turn steadily for one unit of time, and their true first contact by brute
// force.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "kinesphere/rigid_body.hpp"

namespace kinesphere::program {

/// A body with constant velocity and constant angular velocity, at time 0.
struct TurningBody {
  std::vector<RigidPart> parts{};
  State start{};
  Rotation rotation{};
};

/// Returns half of the edges of a box_part() around the position.
Vec3 half_edges(const RigidPart& box);

/// Returns the radius of the ball around the position that contains all parts.
double reach(const TurningBody& body);

/// The first contact in [0, 1], if there is one: it is certainly in [from, to].
struct FirstContact {
  bool exists = false;
  double from = 0.0, to = 0.0;
};

struct TurningPair {
  TurningBody first{}, second{};
  FirstContact truth{};
};

/// Finds the first contact by intervals of time in which the gap certainly is above 0, without regard to
/// `pair.truth`. Returns nothing where rounding errors leave open whether there is one.
std::optional<FirstContact> true_contact(const TurningPair& pair);

/// Returns the least gap in [0, 1], as far as a thousand samples find it.
double least_gap(const TurningPair& pair);

/// A cluster has 8 balls. A capsule, along z, and a sharp box have their middle at the position.
enum class PairShape { capsule, cluster, box };
struct PairKind {
  std::string_view name;
  PairShape shape;
  bool turns_fast;  ///< by 2 to 8 turns; else by at most a quarter
};
inline constexpr PairKind pair_kinds[] = {
    {"capsules", PairShape::capsule, false}, {"capsules-fast", PairShape::capsule, true},
    {"clusters", PairShape::cluster, false}, {"clusters-fast", PairShape::cluster, true},
    {"boxes", PairShape::box, false},        {"boxes-fast", PairShape::box, true}};

/// Returns `count` random pairs that are apart at time 0. Every third one comes as near as 1e-6 to 1e-3 to a
/// grazing contact, from either side. Of the capsules and boxes a quarter are 1000 times as long as wide.
std::vector<TurningPair> draw_pairs(const PairKind& kind, std::size_t count, std::uint64_t seed);

}  // namespace kinesphere::program
