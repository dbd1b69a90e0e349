// Groups of tracks that stand at one place, against a plain count.
#include "watch/monitor/track_groups.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/random.hpp"
#include "support/read_back.hpp"

namespace kinesphere::program::track_groups_test {
namespace {

constexpr TrackGroups::Cutting cutting{.edge = 10.0, .height = 5.0, .slow = 0.5};

TEST(TrackGroups, BeginWithTwentyAndEndWithNine) {
  TrackGroups groups(cutting);
  for (TrackId id = 1; id < 20; ++id) EXPECT_FALSE(groups.take(id, {1, 2, 3}, 0.0, 0.0).group);
  EXPECT_FALSE(groups.take(20, {1, 2, 3}, 0.6, 0.0).group) << "it moves";
  const auto founded = groups.take(20, {9, 9, 4.9}, 0.5, 1.0);
  ASSERT_TRUE(founded.group);
  EXPECT_TRUE(founded.is_new);
  EXPECT_EQ(founded.joined.size(), 20u);
  EXPECT_EQ(groups.centre_of(*founded.group), (Vec3{5, 5, 2.5}));
  EXPECT_EQ(groups.take(21, {1, 1, 1}, 0.0, 2.0).joined, std::vector<TrackId>{21});
  EXPECT_TRUE(groups.take(21, {1, 1, 1}, 0.0, 2.0).joined.empty());
  for (TrackId id = 1; id <= 11; ++id) {
    const auto left = groups.take(id, {30, 0, 0}, 2.0, 3.0);
    EXPECT_FALSE(left.group || left.dissolved) << id;
  }
  // Nine are left.
  EXPECT_EQ(groups.take(12, {1, 1, 1}, 2.0, 3.0).dissolved, founded.group);
  EXPECT_EQ(groups.size(), 0u);
  EXPECT_FALSE(groups.take(13, {1, 1, 1}, 0.0, 3.0).group);
}

TEST(TrackGroups, WithoutASpeedTheSamePlaceStands) {
  TrackGroups groups(cutting);
  for (TrackId id = 1; id <= 19; ++id) EXPECT_FALSE(groups.take(id, {0, 0, 0}, std::nullopt, 0.0).group);
  EXPECT_TRUE(groups.take(20, {0, 0, 0}, std::nullopt, 0.0).group);
  // Tracks that pass through the cell of another one do not stand in it.
  TrackGroups others(cutting);
  for (TrackId id = 1; id <= 60; ++id)
    EXPECT_FALSE(others.take(id, {0.1 * static_cast<double>(id), 0, 0}, std::nullopt, 0.0).group);
}

TEST(TrackGroups, SilentMembersAreForgotten) {
  TrackGroups groups(cutting);
  for (TrackId id = 1; id <= 25; ++id) groups.take(id, {1, 1, 1}, 0.0, id <= 8 ? 100.0 : 0.0);
  EXPECT_TRUE(groups.forget_before(0.0).empty());
  EXPECT_EQ(groups.forget_before(50.0).size(), 1u);
  EXPECT_EQ(groups.size(), 0u);
}

TEST(TrackGroups, RandomTracksAndSnapshots) {
  constexpr std::uint64_t seed = 5;
  Random random(seed);
  TrackGroups groups(cutting);
  for (int step = 0; step < 20000; ++step) {
    if (step % 500 == 0) {
      TrackGroups restored(cutting);
      ASSERT_TRUE(read_back(groups, restored));
      ByteWriter before, after;
      before(groups);
      after(restored);
      ASSERT_EQ(after.take(), before.take()) << "seed " << seed << ", step " << step;
      groups = restored;
    }
    const auto id = static_cast<TrackId>(random.uniform(0.0, 90.0));
    const Vec3 position{random.uniform(-15.0, 15.0), 1.0, 1.0};
    const auto outcome = groups.take(id, position, random.uniform(), step);
    if (!outcome.group) continue;
    const Vec3 off = position - groups.centre_of(*outcome.group);
    ASSERT_LE(std::abs(off.x), 5.0);
    ASSERT_LE(std::abs(off.y), 5.0);
    ASSERT_LE(std::abs(off.z), 2.5);
    ASSERT_TRUE(!outcome.is_new || outcome.joined.size() >= TrackGroups::least_members);
  }
  for (const double far : {1e300, -1e300, std::nan("")})
    EXPECT_FALSE(groups.take(1, {far, 0, 0}, 0.0, 3e4).group);
}

}  // namespace
}  // namespace kinesphere::program::track_groups_test
