// What a world is made with: its walls, and what counts as a contact. Which numbers it takes: limits.hpp.
#pragma once

#include <limits>
#include <optional>

#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// Which contacts are reported.
enum class ContactMode {
  /// Each contact has a begin and an end.
  begin_and_end,
  /// For bodies that bounce: a begin whenever two bodies touch and approach, and no ends. Once
  /// set_velocity() has turned them apart, the next approach is a new contact, however small the gap was in
  /// between.
  impacts,
};

/// Some of the three axes.
struct Axes {
  bool x = false;
  bool y = false;
  bool z = false;

  constexpr bool operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr bool any() const { return x || y || z; }
  friend constexpr bool operator==(const Axes&, const Axes&) = default;
};

struct WorldDefinition {
  /// The walls. Without a box the world is unbounded.
  std::optional<Box> box{};
  /// On these axes the box has no walls: space repeats with the box's size, and what leaves on one side comes
  /// in on the other. States that come from the caller may be in any image. States that the world tells lie
  /// in the box (lower <= position < upper), but the second of an event where it touches the first. A body
  /// has to fit: on each of these axes 2 radius + 6 position_error + separation_distance + contact_tolerance
  /// may be at most 3/8 of the box, which a diameter of a third is.
  /// Cost: a body is asked at least once while it crosses half of the box.
  Axes periodic{};
  /// 2: bodies are discs in the plane z = 0. The z of every position, velocity and plan must be 0, and
  /// that of the box does not matter.
  int dimensions = 3;
  /// eps > 0 (length): a contact begins at a time when the true gap is at most eps, and no gap
  /// ever falls below -eps unreported.
  double contact_tolerance = 1e-6;
  /// > contact_tolerance (length): a contact ends at a time when the gap is between this and this plus
  /// eps. Default (NaN): 4 eps. Where reported positions have errors e0, choose it larger than
  /// the sum of 2 e0 of both bodies, or contacts end and begin with the noise.
  double separation_distance = std::numeric_limits<double>::quiet_NaN();
  ContactMode contacts = ContactMode::begin_and_end;
  /// When false, add() refuses a body that certainly overlaps another or a wall.
  bool allow_overlap = true;
  /// >= 0 (time): a contact that comes less than this after the previous one of the same body is
  /// marked as repeated. So is one that comes within 4 sqrt(eps / (A + |g|)): a hop within the tolerance
  /// takes no longer.
  double zeno_interval = 0.0;
  double start_time = 0.0;
};

}  // namespace kinesphere
