// Bodies of many parts: their gaps, nearest parts and meetings are those of all pairs of parts asked one by
// one, whichever of them are left out.
#include <gtest/gtest.h>

#include <tuple>
#include <vector>

#include "bound/nearest_parts.hpp"
#include "bound/rigid_certificates.hpp"
#include "bound/rigid_thing.hpp"
#include "number/infinity.hpp"

namespace kinesphere::part_pairs_test {
namespace {

constexpr double now = rigid_thing_now;
constexpr double until = 5.0;

/// A partner of a thing: another one, or a wall.
std::size_t parts_in(const Thing& thing) { return thing.parts.size(); }
std::size_t parts_in(const HalfSpace&) { return 1; }
RigidExtent with(const Thing& thing, std::size_t part) { return thing.with(part); }
HalfSpace with(const HalfSpace& wall, std::size_t) { return wall; }
RigidExtent whole(const Thing& thing) { return thing.extent; }
HalfSpace whole(const HalfSpace& wall) { return wall; }

template <class Partner>
void expect_those_of_all_pairs(const Thing& thing, const Partner& partner, Random& random) {
  // clang++ 14 does not deduce the arguments of aggregates.
  using Pair = RigidPair<decltype(whole(partner))>;
  const Pair pair{thing.extent, whole(partner)};
  const double distance = random.uniform() < 0.5 ? 0.0 : random.uniform(-0.2, 0.2);
  GapLimits gap{infinity, infinity};
  double first = infinity;
  for (std::size_t k = 0; k < thing.parts.size(); ++k)
    for (std::size_t m = 0; m < parts_in(partner); ++m) {
      const Pair alone{thing.with(k), with(partner, m)};
      const GapLimits own = gap_limits(alone.body.bound, alone, now);
      gap = {std::min(gap.lower, own.lower), std::min(gap.upper, own.upper)};
      first = std::min(first, earliest_meeting(alone.body.bound, alone, now, until, distance));
    }
  EXPECT_EQ(gap_limits(pair.body.bound, pair, now), gap);
  EXPECT_GE(is_beyond(pair, now, distance), gap.lower > distance);
  EXPECT_FALSE(is_beyond(pair, now, gap.upper));
  const double found = earliest_meeting(pair.body.bound, pair, now, until, distance);
  // Exact bodies are asked in several steps, which are longer for single parts.
  EXPECT_TRUE(pair.is_exact() || found >= first) << found << " and " << first;
  if (!pair.is_exact() || found <= now) return;
  for (int step = 0; step < 40; ++step) {
    const double t = now + (std::min(found, until) - now) * step / 40.0;
    EXPECT_GT(gap_limits(pair.body.bound, pair.at(t), t).upper, distance - 1e-9) << t << " of " << found;
  }
}

TEST(PartPairs, OfTwoBodiesAreThoseOfAll) {
  Random random(11);
  for (int run = 0; run < 3000 && !HasFailure(); ++run) {
    const bool is_exact = run % 2 == 0;
    const Thing one(random, is_exact);
    const Thing other(random, is_exact);
    expect_those_of_all_pairs(one, other, random);
  }
}

TEST(PartPairs, OfABodyAndAWallAreThoseOfAll) {
  Random random(12);
  for (int run = 0; run < 3000 && !HasFailure(); ++run) {
    const Thing thing(random, run % 2 == 0);
    expect_those_of_all_pairs(thing, HalfSpace{random.unit_vector(), random.uniform(-3.0, 0.0)}, random);
  }
}

TEST(PartPairs, NearestPartsAreThoseOfAll) {
  Random random(13);
  const auto order = [](const NearestParts& parts) {
    return std::tuple(parts.gap, parts.first_part, parts.second_part);
  };
  for (int run = 0; run < 3000 && !HasFailure(); ++run) {
    const Thing one(random, true);
    const Thing other(random, true);
    NearestParts nearest{.gap = infinity, .normal = {}, .point = {}, .arm = 0.0};
    for (std::uint32_t k = 0; k < one.parts.size(); ++k)
      for (std::uint32_t m = 0; m < other.parts.size(); ++m) {
        NearestParts alone = nearest_parts(one.pose(k, 1), other.pose(m, 1));
        alone.first_part = k;
        alone.second_part = m;
        if (order(alone) < order(nearest)) nearest = alone;
      }
    const NearestParts found =
        nearest_parts(one.pose(0, one.parts.size()), other.pose(0, other.parts.size()));
    EXPECT_EQ(order(found), order(nearest));
    EXPECT_EQ(found.point, nearest.point);
  }
}

}  // namespace
}  // namespace kinesphere::part_pairs_test
