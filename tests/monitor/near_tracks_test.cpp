// NearTracks finds all tracks whose regions touch, of all sizes, and all whose zones may meet.
#include "monitor/near_tracks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "archive/archive.hpp"
#include "archive/fields.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::near_tracks_test {
namespace {

constexpr double tolerance = 1e-3;
using Regions = std::vector<Region>;
using Numbers = std::set<std::uint32_t>;

Region random_region(Random& random, double box, double octaves) {
  return {{random.uniform(-box, box), random.uniform(-box, box), random.uniform(-box, box)},
          std::exp2(random.uniform(-octaves, octaves))};
}

/// True if regions touch that are larger by this part.
bool touch(const Regions& a, const Regions& b, double more) {
  for (const Region& one : a)
    for (const Region& other : b) {
      const double sizes = norm_one(one.centre) + norm_one(other.centre) + one.radius + other.radius;
      if (norm(one.centre - other.centre) <= one.radius + other.radius + more * sizes) return true;
    }
  return false;
}

Numbers near(const NearTracks& tracks, std::uint32_t track) {
  const auto numbers = tracks.near(track);
  const Numbers all(numbers.begin(), numbers.end());
  EXPECT_EQ(all.size(), numbers.size()) << "each once";
  return all;
}

class RandomRegions : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(RandomRegions, AreNearWhereTheyTouch) {
  const auto [octaves, box] = GetParam();
  Random random(43);
  NearTracks tracks(tolerance, 3);
  std::map<std::uint32_t, Regions> all;
  for (int step = 0; step < 2'000; ++step) {
    const auto number = static_cast<std::uint32_t>(random.bits() % 200);
    if (all.contains(number) && random.uniform() < 0.3) {
      tracks.remove(number);
      all.erase(number);
      ASSERT_TRUE(near(tracks, number).empty());
      continue;
    }
    Regions& regions = all[number];
    regions.assign(1 + (random.uniform() < 0.1 ? random.bits() % 3 : 0), {});
    for (Region& region : regions) region = random_region(random, box, octaves);
    const Numbers before = near(tracks, number);
    const std::size_t touching = tracks.place(number, regions, {});
    const std::vector<std::uint32_t> gone = tracks.gone();
    for (const std::uint32_t other : gone) tracks.part(number, other);
    const Numbers now = near(tracks, number);
    ASSERT_EQ(now.size(), touching);
    for (const std::uint32_t other : tracks.fresh())
      ASSERT_TRUE(now.contains(other) && !before.contains(other)) << step;
    for (const std::uint32_t other : gone)
      ASSERT_TRUE(!now.contains(other) && before.contains(other)) << step;
    for (const auto& [other, its_regions] : all) {
      if (other == number) continue;
      const bool is_near = now.contains(other);
      ASSERT_TRUE(is_near || !touch(regions, its_regions, 0.0)) << step << ": " << other << " is missed";
      ASSERT_TRUE(!is_near || touch(regions, its_regions, 1e-5)) << step << ": " << other << " is far";
      ASSERT_EQ(near(tracks, other).contains(number), is_near);
      ASSERT_EQ(tracks.touch(number, other), is_near);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfSizesInABox, RandomRegions,
                         testing::Values(std::pair(0.0, 0.0), std::pair(0.0, 8.0), std::pair(3.0, 8.0),
                                         std::pair(3.0, 1e4), std::pair(12.0, 1e4)));

TEST(NearTracks, AreNearOfAllSizes) {
  NearTracks tracks(tolerance, 3);
  tracks.place(0, Regions{{{1e3, 0, 0}, 1.0}}, {});
  for (const Region& everywhere :
       {Region{{}, 1e30}, Region{{1e200, 0, 0}, 1e250}, Region{{-1e170, 0, 0}, 1.0}})
    for (const std::uint32_t number : {1u, 2u}) {
      tracks.place(number, Regions{everywhere}, {});
      EXPECT_TRUE(near(tracks, number).contains(0)) << everywhere.radius;
      EXPECT_EQ(near(tracks, number).contains(3 - number), number == 2) << everywhere.radius;
      if (number == 2) tracks.remove(1);
      if (number == 2) tracks.remove(2);
    }
}

TEST(NearTracks, LeavesOutThoseThatDoNotMatter) {
  NearTracks tracks(tolerance, 2);
  const auto matter = [](std::uint32_t a, std::uint32_t b) { return (a + b) % 2 == 1; };
  for (std::uint32_t number = 0; number < 6; ++number)
    EXPECT_EQ(tracks.place(number, Regions{{{0.1 * number, 0, 0}, 1.0}}, matter), number);
  EXPECT_EQ(near(tracks, 2), (Numbers{1, 3, 5}));
}

/// A zone that moves through its region, as a bound of an aircraft would.
Bound random_zone(Random& random, const Region& region) {
  return {.time = 0.0,
          .position = region.centre,
          .velocity = 3.0 * random.point_in_ball(),
          .planned_acceleration = 0.3 * random.point_in_ball(),
          .radius = 0.3 * random.uniform(),
          .growth_speed = 0.2 * random.uniform(),
          .acceleration_limit = 0.2 * random.uniform()};
}

TEST(NearTracks, MeetingsAreAllThatMayCome) {
  constexpr std::uint32_t count = 60;
  constexpr double now = 1.0, duration = 2.0;
  Random random(44);
  NearTracks tracks(tolerance, 3);
  std::vector<Bound> zones;
  for (std::uint32_t number = 0; number < count; ++number) {
    const Region region{6.0 * random.point_in_ball(), 20.0};
    tracks.place(number, Regions{region}, {});
    zones.push_back(random_zone(random, region));
    tracks.set_zone(number, 0, zones.back(), now + duration);
  }
  std::size_t meetings = 0, apart = 0;
  for (std::uint32_t number = 0; number < count; ++number) {
    std::map<std::uint32_t, double> found;
    for (const auto& [other, time] : tracks.meetings(number, now, duration)) found[other] = time;
    meetings += found.size();
    for (std::uint32_t other = 0; other < count; ++other) {
      if (other == number) continue;
      const auto at = found.find(other);
      const double until = at == found.end() ? duration : at->second;
      apart += until > 0.0 ? 1 : 0;
      for (double after = 0.0; after < until; after += 0.01) {
        const double t = now + after;
        ASSERT_GT(norm(zones[number].centre_at(t) - zones[other].centre_at(t)),
                  zones[number].radius_at(t) + zones[other].radius_at(t))
            << number << " and " << other << " after " << after << " of " << until;
      }
    }
  }
  EXPECT_GT(meetings, 150u);
  EXPECT_LT(meetings, count * (count - 1) * 3 / 4);
  EXPECT_GT(apart, 1000u);
}

TEST(NearTracks, AZoneTooLargeToCompareMeetsAll) {
  NearTracks tracks(tolerance, 3);
  for (std::uint32_t number = 0; number < 3; ++number)
    tracks.place(number, Regions{{{100.0 * number, 0, 0}, 1e6}}, {});
  tracks.set_zone(0, 0, {.position = {0, 0, 0}, .velocity = {1e90, 0, 0}, .radius = 1.0}, 1.0);
  tracks.set_zone(1, 0, {.position = {100, 0, 0}, .radius = 1.0}, 1.0);
  tracks.set_zone(2, 0, {.position = {200, 0, 0}, .radius = 1e300}, 1.0);
  for (std::uint32_t number = 0; number < 3; ++number) {
    Numbers others;
    for (const auto& [other, apart] : tracks.meetings(number, 0.0, 1.0)) {
      others.insert(other);
      EXPECT_EQ(apart, 0.0);
    }
    EXPECT_EQ(others.size(), 2u) << number;
  }
}

TEST(NearTracks, AreSavedAndFoundAnew) {
  Random random(45);
  NearTracks tracks(tolerance, 3);
  std::vector<std::size_t> counts(40);
  for (std::uint32_t number = 0; number < counts.size(); ++number) {
    if (number % 5 == 3) continue;
    Regions regions(counts[number] = 1 + number % 2);
    for (Region& region : regions) region = random_region(random, 4.0, 1.0);
    tracks.place(number, regions, {});
    tracks.set_zone(number, 0, random_zone(random, regions.front()), 9.0);
  }
  const auto count_of = [&](std::uint32_t number) { return counts[number]; };
  ByteWriter written;
  written(tracks);
  NearTracks again(tolerance, 3);
  ByteReader reader(written.bytes());
  reader(again);
  ASSERT_FALSE(reader.failed());
  ASSERT_TRUE(again.rebuild(counts.size(), count_of, {}));
  ByteWriter rewritten;
  rewritten(again);
  EXPECT_TRUE(std::ranges::equal(rewritten.bytes(), written.bytes()));
  for (std::uint32_t number = 0; number < counts.size(); ++number) {
    EXPECT_EQ(near(again, number), near(tracks, number));
    if (counts[number] == 0) continue;
    const auto meetings = tracks.meetings(number, 0.0, 5.0).size();
    EXPECT_EQ(again.meetings(number, 0.0, 5.0).size(), meetings);
  }
  for (const std::uint32_t other : {3u, 4u}) {
    std::vector<std::size_t> wrong = counts;
    wrong[other] = wrong[other] == 0 ? 1 : 0;
    ByteReader same(written.bytes());
    NearTracks refused(tolerance, 3);
    same(refused);
    EXPECT_FALSE(refused.rebuild(wrong.size(), [&](std::uint32_t number) { return wrong[number]; }, {}));
  }
}

}  // namespace
}  // namespace kinesphere::near_tracks_test
