// Updated bodies that may meet are found, whatever other updates there are, with any number of threads.
#include "speculation/conflicts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "kinesphere/random.hpp"
#include "kinesphere/workers.hpp"

namespace kinesphere::conflicts_test {
namespace {

constexpr std::uint64_t seed = 4912;
constexpr double begin = 1.0;

using Pair = std::pair<std::uint32_t, std::uint32_t>;
/// Maps a pair to the time until which the two do not meet, and whether the earlier update was stale.
using Meetings = std::map<Pair, std::pair<double, bool>>;

Meetings by_pair(const std::vector<Conflict>& meetings) {
  Meetings all;
  for (const auto& [first, second, until, is_void] : meetings)
    EXPECT_TRUE(all.emplace(std::minmax(first, second), std::pair(until, is_void)).second);
  return all;
}

/// Bodies that change velocity at some time in a box, a few of them twice, with others of their cluster.
struct Kicked {
  explicit Kicked(Random& random) : tables(WorldDefinition{.start_time = begin}) {
    const auto bodies = 1 + static_cast<std::uint32_t>(random.uniform() * 700.0);
    const double edge = 3.0 + 9.0 * random.uniform();
    for (std::uint32_t number = 0; number < bodies; ++number) {
      const double radius = random.uniform() < 0.05 ? 1.0 : 0.1;
      tables.bodies.add({.radius = radius}, 0.0);
      const auto group = static_cast<std::uint32_t>(random.uniform() * bodies);
      for (int update = random.uniform() < 0.2 ? 2 : 1; update > 0; --update) {
        const double time = begin + random.uniform() * 0.2;
        const Window window = Window::at(begin, random.uniform() < 0.7 ? -1 : -4);
        if (!(time < window.end)) continue;
        Bound bound{.time = time, .velocity = 4.0 * random.point_in_ball()};
        for (int axis = 0; axis < 3; ++axis) bound.position[axis] = edge * random.uniform();
        bound.radius = radius;
        bound.acceleration_limit = 5.0 * random.uniform();
        FirstChange since;
        if (random.uniform() < 0.3) since.changed = time + random.uniform() * 0.2;
        if (random.uniform() < 0.5) since.invalidated = since.changed;
        all.push_back({number, 0, time, window, bound, {}, since});
        groups.push_back(group);
      }
    }
    for (std::size_t k = 0; k < all.size(); ++k) velocity_changes.push_back({groups[k], &all[k]});
  }

  WorldState tables;
  std::vector<SweptSphereUpdate> all;
  std::vector<std::uint32_t> groups;
  std::vector<ClusterUpdate> velocity_changes;
};

/// True if the bounds touch somewhere before this time.
bool may_meet_before(double last, const SweptSphereUpdate& a, const SweptSphereUpdate& b) {
  const double from = std::max(a.time, b.time);
  const double end = std::min({a.window.end, b.window.end, last});
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

TEST(Conflicts, AreThoseOfEachPairAlone) {
  SCOPED_TRACE(seed);
  Workers workers = Workers::create(3).value();
  std::size_t known = 0;
  std::size_t unknown = 0;
  std::size_t void_ones = 0;
  for (std::uint64_t part = 0; part < 12; ++part) {
    SCOPED_TRACE(part);
    Random random = Random::at(seed, part, 0);
    const Kicked redirected(random);
    const auto size = static_cast<std::uint32_t>(redirected.velocity_changes.size());
    const auto fresh = static_cast<std::uint32_t>((part % 3 == 0 ? 1.0 : random.uniform()) * size);
    PoolLease alone;
    const Meetings found =
        by_pair(find_conflicts(redirected.tables, redirected.velocity_changes, fresh, begin, alone));
    {
      PoolLease shift(&workers);
      ASSERT_EQ(by_pair(find_conflicts(redirected.tables, redirected.velocity_changes, fresh, begin, shift)),
                found);
    }
    for (std::uint32_t b = 0; b < size; ++b) {
      for (std::uint32_t a = 0; a < std::min(b, fresh); ++a) {
        const ClusterUpdate two[] = {redirected.velocity_changes[a], redirected.velocity_changes[b]};
        const std::vector<Conflict> meeting = find_conflicts(redirected.tables, two, 2, begin, alone);
        if (redirected.groups[a] == redirected.groups[b]) {
          ASSERT_TRUE(meeting.empty());
        } else if (may_meet_before(infinity, *two[0].update, *two[1].update)) {
          ASSERT_FALSE(meeting.empty()) << a << ' ' << b;
        }
        ASSERT_EQ(found.contains({a, b}), !meeting.empty()) << a << ' ' << b;
        if (meeting.empty()) continue;
        ASSERT_EQ(found.at({a, b}), std::pair(meeting[0].until, meeting[0].is_stale)) << a << ' ' << b;
      }
    }
    for (const auto& [pair, meeting] : found) {
      const auto& [a, b] = pair;
      const auto& [until, is_void] = meeting;
      ASSERT_TRUE(a < fresh || b < fresh);
      ASSERT_TRUE(until == Conflict::unknown ||
                  !may_meet_before(until, redirected.all[a], redirected.all[b]));
      const auto [earlier, later] = std::minmax(
          redirected.all[a], redirected.all[b],
          [](const SweptSphereUpdate& one, const SweptSphereUpdate& other) { return one.time < other.time; });
      ASSERT_EQ(is_void, earlier.first_change.invalidated < later.time);
      // The time is unknown if the earlier body was reported in between, and not needed if that body was
      // updated again.
      ASSERT_EQ(until == Conflict::unknown, earlier.first_change.changed < later.time && !is_void);
      (is_void ? void_ones : until == Conflict::unknown ? unknown : known) += 1;
    }
  }
  EXPECT_GT(known, 1000u);
  EXPECT_GT(unknown, 20u);
  EXPECT_GT(void_ones, 20u);
}

TEST(Conflicts, AreUnknownOfKicksAtOneInstantAndInEndlessWindows) {
  WorldState tables(WorldDefinition{.start_time = begin});
  for (int body = 0; body < 2; ++body) tables.bodies.add({.radius = 1.0}, 0.0);
  PoolLease alone;
  const auto meeting_of = [&](double second_time, const Window& window) {
    SweptSphereUpdate updates[2];
    for (std::uint32_t k = 0; k < 2; ++k) {
      updates[k] = {.number = k, .revision = 1, .time = k == 0 ? begin : second_time, .window = window};
      const bool ends = window.end < infinity;
      updates[k].bound = {.time = updates[k].time, .position = {(ends ? 5.0 : 1.0) * k, 0, 0}, .radius = 1.0};
      updates[k].bound.acceleration_limit = ends ? 40.0 : 0.0;
    }
    const ClusterUpdate of_groups[] = {{0, &updates[0]}, {1, &updates[1]}};
    return find_conflicts(tables, of_groups, 2, begin, alone);
  };
  const Window window = Window::at(begin, 0);
  ASSERT_EQ(meeting_of(begin + 0.1, window).size(), 1u);
  EXPECT_GT(meeting_of(begin + 0.1, window)[0].until, begin + 0.1);
  ASSERT_EQ(meeting_of(begin, window).size(), 1u);
  EXPECT_EQ(meeting_of(begin, window)[0].until, Conflict::unknown);
  ASSERT_EQ(meeting_of(begin + 0.1, Window::endless()).size(), 1u);
  EXPECT_EQ(meeting_of(begin + 0.1, Window::endless())[0].until, Conflict::unknown);
}

TEST(Conflicts, NobodyMeetsWhereNobodyIsKicked) {
  const WorldState tables(WorldDefinition{});
  PoolLease alone;
  EXPECT_TRUE(find_conflicts(tables, {}, 0, 0.0, alone).empty());
}

}  // namespace
}  // namespace kinesphere::conflicts_test
