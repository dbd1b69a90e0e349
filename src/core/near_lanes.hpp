// The two inner loops of the core, compiled for each vector width: which neighbours a ball may meet within a
// span, and which safe regions come within reach of one. All widths give the same answers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/ball.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere::core {

/// Fetches a cache line that will be read soon. Nothing else depends on it.
inline void prefetch_line(const void* address) {
#if defined(__GNUC__)
  __builtin_prefetch(address);
#else
  (void)address;
#endif
}

/// Periods of the axes that repeat, and their inverses; 0 on the others. Where images slide, the next row of
/// them, up y, is displaced along x by `slide` (length) at present, and moves at `slide_speed`
/// (space/space.hpp).
struct Periods {
  Vec3 length{};
  Vec3 inverse{};
  double slide = 0.0, slide_speed = 0.0;
  bool any = false;
  bool slides = false;
};

/// Returns the number of whole periods nearest to `way`. Adding and subtracting 3/2 2^52 rounds.
[[gnu::always_inline]] inline double nearest_count(double way, double inverse) {
  constexpr double rounder = 0x1.8p52;
  return (way * inverse + rounder) - rounder;
}
/// Returns `way` as the nearest image has it.
[[gnu::always_inline]] inline double nearest_image(double way, double period, double inverse) {
  return way - period * nearest_count(way, inverse);
}

/// What concerns all pairs at the present.
struct PairQuery {
  double now;
  double margin;        ///< for rounding (length)
  double near;          ///< two whose gap is less than the margin and this (length) are near each other
  bool grows;           ///< any bound grows
  const Drift* drifts;  ///< of all balls; nullptr if there are none
  const Periods* periods;
};
/// A ball at the present, and a span of time.
struct NearQuery {
  PairQuery pairs;
  double duration;
  Vec3 position, velocity;
  double radius;  ///< with growth and margin
  double speed;   ///< at which the bound grows
  double growth;  ///< acceleration with which it grows
  Vec3 plan;      ///< planned acceleration
};
/// Most neighbours in one call, for which `apart` has room.
inline constexpr std::size_t most_lanes = 32;
/// Returns a bit for each of `count` neighbours that the ball may meet within the span. Conservative: that of
/// a neighbour that it certainly does not meet may be set (QuickReject::stay_apart). Writes to `apart` how
/// long it certainly does not meet each of these; 0 if that is unknown, or if the two are near each other.
/// What is written of others means nothing.
std::uint32_t may_meet(const Ball* balls, const std::uint32_t* neighbours, std::size_t count,
                       const NearQuery& query, double* apart);

/// Numbers are taken in groups of so many: an array of numbers, and that of the results, has room for whole
/// groups, with the number of any ball in the rest.
inline constexpr std::size_t group_lanes = 4;
/// Writes to `apart` of each pair how long the two certainly do not meet: infinity if not before the own time
/// of the first one, and otherwise what may_meet() gives.
void pairs_stay_apart(const Ball* balls, const std::uint32_t* first, const std::uint32_t* second,
                      std::size_t count, const PairQuery& query, double* apart);

struct StayQuery {
  double now;
  double unit;    ///< of regions (length)
  Vec3 origin;    ///< of region units
  double margin;  ///< for rounding (length)
};
/// Writes to `stays` how long each ball stays in its safe region, as Core::stays_inside() does, but a
/// negative number if that is not known at once. Precondition: no ball has a drift.
void stays_in_flight(const Ball* balls, const std::uint32_t* numbers, std::size_t count,
                     const StayQuery& query, double* stays);

/// Eight safe regions: what a search reads of all that it looks at.
struct alignas(64) RegionBlock {
  static constexpr std::uint32_t lanes = 8;
  float x[lanes], y[lanes], z[lanes];
  float reach[lanes];  ///< NaN where there is no region: nothing is within reach of it

  RegionBlock() {
    for (float& each : reach) each = std::numeric_limits<float>::quiet_NaN();
  }
};
/// The balls of eight safe regions.
struct alignas(32) BallBlock {
  std::uint32_t balls[RegionBlock::lanes];
};
struct RegionQuery {
  float x, y, z, reach;
};
struct FloatPeriods {
  float length[3]{}, inverse[3]{};
  bool any = false;
};
/// Writes to `found` the balls of these blocks whose regions come within reach. Returns their number. There
/// must be room for eight in each block.
std::size_t regions_within_reach(const RegionBlock* blocks, const BallBlock* balls,
                                 const std::uint32_t* places, std::size_t count, const RegionQuery& query,
                                 const FloatPeriods& periods, std::uint32_t* found);

/// Most numbers in a list that is compared with another.
inline constexpr std::size_t most_compared = 64;
/// So many numbers behind those of a list are read.
inline constexpr std::size_t most_list_lanes = 8;
/// Bits of the numbers of each of two lists that are not in the other one.
struct ListMatches {
  std::uint64_t unmatched_of_list, unmatched_of_present;
};
/// Compares two lists of at most `most_compared` numbers. Behind `list` there are `most_list_lanes` numbers
/// to read, of any value.
ListMatches compare_lists(const std::uint32_t* list, std::size_t length, const std::uint32_t* present,
                          std::size_t count);

}  // namespace kinesphere::core
