// Kicked bodies that may meet are found, whoever else is kicked, by however many threads.
#include "engine/meetings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "kinesphere/random.hpp"
#include "kinesphere/workers.hpp"

namespace kinesphere {
namespace {

constexpr std::uint64_t seed = 4912;
constexpr double begin = 1.0;

using Places = std::set<std::pair<std::uint32_t, std::uint32_t>>;

Places as_set(const std::vector<Meeting>& meetings) {
  Places places;
  for (const Meeting& meeting : meetings)
    places.emplace(std::min(meeting.first, meeting.second), std::max(meeting.first, meeting.second));
  return places;
}

/// Bodies that are kicked at some time in a box, a few of them twice, with others of their group.
struct Kicked {
  explicit Kicked(Random& random) : tables(WorldDefinition{.start_time = begin}) {
    const auto bodies = 1 + static_cast<std::uint32_t>(random.uniform() * 700.0);
    const double edge = 3.0 + 9.0 * random.uniform();
    for (std::uint32_t number = 0; number < bodies; ++number) {
      const double radius = random.uniform() < 0.05 ? 1.0 : 0.1;
      tables.bodies.add({.radius = radius});
      const auto group = static_cast<std::uint32_t>(random.uniform() * bodies);
      for (int kick = random.uniform() < 0.2 ? 2 : 1; kick > 0; --kick) {
        const double time = begin + random.uniform() * 0.2;
        const Window window = Windows::window_at(begin, random.uniform() < 0.7 ? -1 : -4);
        if (!(time < window.end)) continue;
        Bound bound{.time = time, .velocity = 4.0 * random.point_in_ball()};
        for (int axis = 0; axis < 3; ++axis) bound.position[axis] = edge * random.uniform();
        bound.radius = radius;
        bound.growth_acceleration = 5.0 * random.uniform();
        all.push_back({number, 0, time, window, bound, {}});
        groups.push_back(group);
      }
    }
    for (std::size_t k = 0; k < all.size(); ++k) kicks.push_back({groups[k], &all[k]});
  }

  Tables tables;
  std::vector<BodyKick> all;
  std::vector<std::uint32_t> groups;
  std::vector<GroupKick> kicks;
};

/// Somewhere on the ways straight on, in their own largest sizes, they touch.
bool surely_may_meet(const BodyKick& a, const BodyKick& b) {
  const double from = std::max(a.time, b.time);
  const double end = std::min(a.window.end, b.window.end);
  constexpr int looks = 40;
  for (int look = 0; look < looks; ++look) {
    const double time = from + (end - from) * look / looks;
    if (!(time < end)) continue;
    const double gap = norm(a.bound.centre_at(time) - b.bound.centre_at(time)) - a.bound.radius_at(time) -
                       b.bound.radius_at(time);
    if (gap < 0.0) return true;
  }
  return false;
}

TEST(Meetings, AreThoseOfEachPairAlone) {
  SCOPED_TRACE(seed);
  Workers workers = Workers::create(3).value();
  std::size_t met = 0;
  for (std::uint64_t part = 0; part < 12; ++part) {
    SCOPED_TRACE(part);
    Random random = Random::at(seed, part, 0);
    const Kicked kicked(random);
    const auto size = static_cast<std::uint32_t>(kicked.kicks.size());
    const auto fresh = static_cast<std::uint32_t>((part % 3 == 0 ? 1.0 : random.uniform()) * size);
    Shift alone;
    const Places found = as_set(meetings(kicked.tables, kicked.kicks, fresh, begin, alone));
    {
      Shift shift(&workers);
      ASSERT_EQ(as_set(meetings(kicked.tables, kicked.kicks, fresh, begin, shift)), found);
    }
    for (std::uint32_t b = 0; b < size; ++b) {
      for (std::uint32_t a = 0; a < std::min(b, fresh); ++a) {
        const GroupKick two[] = {kicked.kicks[a], kicked.kicks[b]};
        const bool meet = !meetings(kicked.tables, two, 2, begin, alone).empty();
        if (kicked.groups[a] == kicked.groups[b]) {
          ASSERT_FALSE(meet);
        } else if (surely_may_meet(*two[0].kick, *two[1].kick)) {
          ASSERT_TRUE(meet) << a << ' ' << b;
        }
        ASSERT_EQ(found.contains({a, b}), meet) << a << ' ' << b;
      }
    }
    for (const auto& [a, b] : found) ASSERT_TRUE(a < fresh || b < fresh);
    met += found.size();
  }
  EXPECT_GT(met, 1000u);
}

TEST(Meetings, NobodyMeetsWhereNobodyIsKicked) {
  const Tables tables(WorldDefinition{});
  Shift alone;
  EXPECT_TRUE(meetings(tables, {}, 0, 0.0, alone).empty());
}

}  // namespace
}  // namespace kinesphere
