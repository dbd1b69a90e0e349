// Ball is what the core knows of one body: its bound since the last report, its safe region, and when it is
// due. Neighbours of a ball read its first cache line only, unless bounds grow.
#pragma once

#include <cstdint>
#include <limits>

#include "kinesphere/vec3.hpp"

namespace kinesphere::core {

/// Marks the absence of a ball or of a place.
inline constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

struct alignas(64) Ball {
  // Its bound. What bounds seldom have is in Drift.
  Vec3 position{};
  double time = 0.0;  ///< of the last report
  Vec3 velocity{};
  double radius = 0.0;

  double due = 0.0;     ///< earliest time at which anything can happen to it, as far as it is to find out
  double second = 0.0;  ///< the same without the neighbour that `due` is about
  double own = 0.0;     ///< earliest time at which it can leave its safe region or touch a wall
  double acceleration_limit = 0.0;
  float centre[3]{};           ///< of its safe region (region units)
  float region = 0.0F;         ///< radius of its safe region (region units)
  std::uint32_t about = none;  ///< what `due` is about: a neighbour; itself, for `second`; none, for `own`
  std::uint32_t list = none;   ///< its list of neighbours
  std::uint32_t slot = none;   ///< where its safe region is in the cells; none if it has none
  std::uint8_t walls = 0;      ///< bits of the walls that it may touch in its safe region; `at_walls`
  std::uint8_t flags = 0;      ///< of those below
  std::uint8_t scans = 0;      ///< times that its list was scanned since it has this safe region
  std::uint8_t scans_by_region = 8;  ///< mean number of scans in its last safe regions, in eighths

  static constexpr std::uint8_t meets_walls = 1;  ///< walls concern it
  static constexpr std::uint8_t passive = 2;      ///< it never moves, and has no list: others look out for it
  static constexpr std::uint8_t linked = 4;       ///< it touches or senses something
  static constexpr std::uint8_t at_wall = 8;      ///< `own` is about a wall
  /// It has no neighbours yet, and its safe region is a point, if it has one.
  static constexpr std::uint8_t arriving = 16;
  static constexpr std::uint8_t present = 32;  ///< the record is that of a ball
  static constexpr std::uint8_t crowded = 64;  ///< it may have been in touch with neighbours of late
  /// It touches others just where its bound does, has no sensor, and does not sleep.
  static constexpr std::uint8_t plain = 128;

  /// A bit of `walls`: the contact of the ball with some wall has not ended, though it may be out of reach.
  static constexpr std::uint8_t at_walls = 64;

  bool is(std::uint8_t flag) const { return (flags & flag) != 0; }
  void set(std::uint8_t flag, bool on) {
    flags = static_cast<std::uint8_t>(on ? flags | flag : flags & ~flag);
  }
  bool has_region() const { return slot != none; }
  bool is_present() const { return is(present); }

  /// Serializes all but where its list and its safe region are.
  static void serialize(auto& self, auto& archive) {
    archive(self.position, self.time, self.velocity, self.radius, self.due, self.second, self.own,
            self.acceleration_limit, self.centre[0], self.centre[1], self.centre[2], self.region, self.about,
            self.walls, self.flags, self.scans, self.scans_by_region);
  }
};
static_assert(sizeof(Ball) == 128);

/// Terms of a bound that few worlds have.
struct Drift {
  Vec3 planned_acceleration{};
  double growth_speed = 0.0;

  friend constexpr bool operator==(const Drift&, const Drift&) = default;
};
static_assert(sizeof(Drift) == 4 * sizeof(double));

}  // namespace kinesphere::core
