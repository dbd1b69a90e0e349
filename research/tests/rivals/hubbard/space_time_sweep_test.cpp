// Three sweeps in step, compared with all pairs of space-time bounds.
#include "research/rivals/hubbard/space_time_sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "kinesphere/random.hpp"
#include "number/infinity.hpp"

namespace kinesphere::space_time_sweep_test {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;
using Meeting = SpaceTimeSweep::Meeting;

constexpr Box box{{-20, -20, -20}, {20, 20, 20}};

struct Times {
  double first, last;
};

/// Returns the times s of `within` at which the difference of the two lines, start + speed s, is >= 0.
Times positive(const Line& upper, const Line& lower, Times within) {
  const double gap = upper.start - lower.start;
  const double opening = upper.speed - lower.speed;
  if (opening > 0.0) within.first = std::max(within.first, -gap / opening);
  if (opening < 0.0) within.last = std::min(within.last, -gap / opening);
  if (opening == 0.0 && gap < 0.0) within.first = infinity;
  return within;
}

Times overlap_of(const Hypertrapezoid& a, const Hypertrapezoid& b, double duration) {
  Times times{0.0, duration};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    times = positive(a.upper[axis], b.lower[axis], times);
    times = positive(b.upper[axis], a.lower[axis], times);
  }
  return times;
}

/// Bodies under test, and their space-time bounds as set in the sweep.
class Crowd {
 public:
  explicit Crowd(std::uint64_t seed) : random_(Random::at(1995, 4, seed)), sweep_(box, 0.0) {
    for (std::uint32_t body = 0; body < 30; ++body) sweep_.insert(body);
  }

  SpaceTimeSweep& sweep() { return sweep_; }

  void erase_one() { sweep_.erase(static_cast<std::uint32_t>(random_.bits() % 30)); }
  void insert_all() {
    for (std::uint32_t body = 0; body < 30; ++body)
      if (!sweep_.contains(body)) sweep_.insert(body);
  }

  void begin(double duration) {
    duration_ = duration;
    bounds_.assign(30, {});
    for (std::uint32_t body = 0; body < 30; ++body) {
      if (!sweep_.contains(body)) continue;
      const Bound bound{.position = random_.point_in_ball() * 20.0,
                        .velocity = random_.point_in_ball() * 10.0,
                        .radius = random_.uniform(0.0, 3.0),
                        .acceleration_limit = random_.uniform(0.0, 4.0)};
      bounds_[body] = enclose(bound, duration, 0.0);
      sweep_.set(body, bounds_[body]);
    }
    sweep_.begin(duration);
  }

  std::set<Pair> overlapping() const {
    std::set<Pair> pairs;
    for_each_pair([&](std::uint32_t a, std::uint32_t b) {
      const Times times = overlap_of(bounds_[a], bounds_[b], duration_);
      if (times.first == 0.0 && times.last >= 0.0) pairs.insert({a, b});
    });
    return pairs;
  }

  std::vector<Meeting> meetings() const {
    std::vector<Meeting> meetings;
    for_each_pair([&](std::uint32_t a, std::uint32_t b) {
      const Times times = overlap_of(bounds_[a], bounds_[b], duration_);
      if (times.first > 0.0 && times.first <= times.last) meetings.push_back({times.first, a, b});
    });
    sort_by_time(meetings);
    return meetings;
  }

  /// Returns the times at which a face passes a wall outward.
  std::vector<Meeting> wall_meetings() const {
    std::vector<Meeting> meetings;
    const auto add = [&](std::uint32_t body, double gap, double closing) {
      if (gap > 0.0 && closing * duration_ > gap) meetings.push_back({gap / closing, body, body});
    };
    for (std::uint32_t body = 0; body < 30; ++body)
      for (int axis = 0; axis < 3 && sweep_.contains(body); ++axis) {
        const Line& lower = bounds_[body].lower[static_cast<std::size_t>(axis)];
        const Line& upper = bounds_[body].upper[static_cast<std::size_t>(axis)];
        add(body, lower.start - box.lower[axis], -lower.speed);
        add(body, box.upper[axis] - upper.start, upper.speed);
      }
    sort_by_time(meetings);
    return meetings;
  }

  bool reaches_wall(std::uint32_t body) const {
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      if (bounds_[body].lower[k].start < box.lower[axis] || bounds_[body].upper[k].start > box.upper[axis])
        return true;
    }
    return false;
  }

 private:
  template <class Visit>
  void for_each_pair(Visit visit) const {
    for (std::uint32_t b = 0; b < 30; ++b)
      for (std::uint32_t a = 0; a < b; ++a)
        if (sweep_.contains(a) && sweep_.contains(b)) visit(a, b);
  }
  static void sort_by_time(std::vector<Meeting>& meetings) {
    std::sort(meetings.begin(), meetings.end(),
              [](const Meeting& x, const Meeting& y) { return x.time < y.time; });
  }

  Random random_;
  SpaceTimeSweep sweep_;
  double duration_ = 0.0;
  std::vector<Hypertrapezoid> bounds_;
};

void expect_same(const std::vector<Meeting>& found, const std::vector<Meeting>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_NEAR(found[k].time, expected[k].time, 1e-9);
    // Bounds are widened, so no meeting is late.
    EXPECT_LT(found[k].time, expected[k].time);
    EXPECT_EQ(found[k].a, expected[k].a);
    EXPECT_EQ(found[k].b, expected[k].b);
  }
}

TEST(SpaceTimeSweep, meets_what_all_pairs_meet) {
  std::size_t total = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Crowd crowd(seed);
    for (int round = 0; round < 6; ++round) {
      SCOPED_TRACE(round);
      if (round % 3 == 1) crowd.erase_one();
      if (round % 3 == 2) crowd.insert_all();
      crowd.begin(round % 2 == 0 ? 2.0 : 0.05);
      std::set<Pair> overlapping;
      crowd.sweep().for_each_overlap([&](auto a, auto b) { overlapping.insert({a, b}); });
      ASSERT_EQ(overlapping, crowd.overlapping());
      for (std::uint32_t body = 0; body < 30; ++body)
        if (crowd.sweep().contains(body)) {
          EXPECT_EQ(crowd.sweep().reaches_wall(body), crowd.reaches_wall(body));
        }
      std::vector<Meeting> pairs, walls;
      while (const auto meeting = crowd.sweep().next_meeting())
        (meeting->a == meeting->b ? walls : pairs).push_back(*meeting);
      expect_same(pairs, crowd.meetings());
      expect_same(walls, crowd.wall_meetings());
      total += pairs.size();
    }
  }
  EXPECT_GT(total, 1000u);
}

TEST(SpaceTimeSweep, faces_that_meet_on_all_axes_at_once_count) {
  SpaceTimeSweep sweep(std::nullopt, 0.0);
  const auto cube = [](double place, double speed) {
    return enclose({.position = {place, place, place}, .velocity = {speed, speed, speed}, .radius = 1.0}, 4.0,
                   0.0);
  };
  for (std::uint32_t body = 0; body < 8; ++body) sweep.insert(body);
  // All faces of four pairs meet at equal times on equal lines.
  for (std::uint32_t body = 0; body < 8; ++body)
    sweep.set(body, body % 2 == 0 ? cube(-2.0, 1.0) : cube(2.0, -1.0));
  sweep.begin(4.0);
  std::set<Pair> met;
  while (const auto meeting = sweep.next_meeting()) {
    EXPECT_NEAR(meeting->time, 1.0, 1e-9);
    EXPECT_TRUE(met.insert({meeting->a, meeting->b}).second);
  }
  EXPECT_EQ(met.size(), 16u);
}

}  // namespace
}  // namespace kinesphere::space_time_sweep_test
