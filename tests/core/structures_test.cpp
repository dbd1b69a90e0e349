// The structures below the core, each compared with a plain one.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "bound/quick_reject.hpp"
#include "core/balls.hpp"
#include "core/due_queue.hpp"
#include "core/near_lanes.hpp"
#include "core/neighbour_lists.hpp"
#include "core/region_cells.hpp"
#include "kinesphere/random.hpp"
#include "number/infinity.hpp"

namespace kinesphere::core_structures_test {
namespace {

using core::Ball;
using core::Balls;
using core::DueQueue;
using core::NeighbourLists;
using core::Periods;
using core::RegionCells;

constexpr std::uint64_t seed = 6802;

double log_uniform(Random& random, double least, double most) {
  return std::exp(random.uniform(std::log(least), std::log(most)));
}

TEST(NeighbourLists, HoldWhatWasInserted) {
  NeighbourLists lists;
  std::vector<std::uint32_t> handles(20);
  std::vector<std::set<std::uint32_t>> expected(handles.size());
  for (std::uint32_t& handle : handles) handle = lists.add();
  Random random(seed);
  for (int step = 0; step < 20000; ++step) {
    const auto k = random.bits() % handles.size();
    const auto number = static_cast<std::uint32_t>(random.bits() % 200);
    if (random.bits() % 500 == 0) {
      lists.remove(handles[k]);
      handles[k] = lists.add();
      expected[k].clear();
    } else if (random.bits() % 100 == 0) {
      expected[k].clear();
      for (std::uint32_t n = 0; n < 200; n += 1 + static_cast<std::uint32_t>(random.bits() % 20))
        expected[k].insert(n);
      lists.assign(handles[k], std::vector<std::uint32_t>(expected[k].begin(), expected[k].end()));
    } else if (expected[k].insert(number).second) {
      lists.add_to(handles[k], number);
    } else {
      expected[k].erase(number);
      lists.erase(handles[k], number);
    }
    std::vector<std::uint32_t> list(lists.at(handles[k]).begin(), lists.at(handles[k]).end());
    std::sort(list.begin(), list.end());
    ASSERT_TRUE(std::equal(list.begin(), list.end(), expected[k].begin(), expected[k].end()))
        << "step " << step;
  }
}

/// Of a list and those present, who is gone and who is new is told right, whatever the lengths and repeats.
TEST(NeighbourLists, TellWhoIsGoneAndWhoIsNew) {
  Random random(seed + 1);
  NeighbourLists lists;
  std::uint32_t handle = lists.add();
  for (int step = 0; step < 5000; ++step) {
    const std::uint32_t names = step % 2 == 0 ? 30 : 200;
    const auto any = [&] { return static_cast<std::uint32_t>(random.bits() % names); };
    const auto length = static_cast<std::size_t>(random.bits() % (step % 2 == 0 ? 20 : 150));
    std::set<std::uint32_t> former, after;
    std::vector<std::uint32_t> present;
    for (std::size_t k = 0; k < length; ++k) former.insert(any());
    for (std::size_t k = random.bits() % 100; k > 0; --k) present.push_back(any());
    after.insert(present.begin(), present.end());
    std::vector<std::uint32_t> list(former.begin(), former.end()), gone, fresh, expected;
    for (std::size_t k = list.size(); k > 1; --k) std::swap(list[k - 1], list[random.bits() % k]);
    lists.assign(handle, list);
    core::find_changes(lists.at(handle), present, gone, fresh);
    std::sort(gone.begin(), gone.end());
    std::set_difference(former.begin(), former.end(), after.begin(), after.end(),
                        std::back_inserter(expected));
    ASSERT_EQ(gone, expected) << "step " << step;
    expected.clear();
    std::set_difference(after.begin(), after.end(), former.begin(), former.end(),
                        std::back_inserter(expected));
    ASSERT_EQ(fresh, expected) << "step " << step;
  }
}

TEST(DueQueue, ForgetsAllUntilItIsFilledAnew) {
  std::vector<Ball> balls(100);
  for (std::uint32_t number = 0; number < 100; ++number) {
    balls[number].due = 1.0 + number;
    balls[number].slot = number;
  }
  DueQueue queue;
  queue.refill(balls, 0.0);
  queue.forget();
  balls[7].due = 0.5;
  queue.push(balls, 7);
  queue.refill(balls, 0.0);
  EXPECT_EQ(queue.first(balls, 200.0).ball, 7u);
  for (std::uint32_t taken = 0; taken < 100; ++taken) {
    ASSERT_LT(queue.first(balls, 200.0).time, 200.0);
    balls[queue.take_first()].due = infinity;
  }
  EXPECT_EQ(queue.first(balls, 200.0).time, infinity) << "each once";
}

/// Balls that come to be due much more often than when buckets got their width: these become narrower, since
/// each entry is put amid those of the present bucket.
TEST(DueQueue, KeepsFewEntriesInOrder) {
  constexpr std::uint32_t count = 4096;
  Random random(seed);
  std::vector<Ball> balls(count);
  for (Ball& ball : balls) {
    ball.due = random.uniform(0.0, 1000.0);
    ball.slot = 0;
  }
  DueQueue queue;
  queue.refill(balls, 0.0);
  const auto turn = [&](double now) {
    const std::uint32_t ball = queue.take_first();
    balls[ball].due = now + random.uniform(0.5, 1.0);
    queue.push(balls, ball);
  };
  const auto in_order = [&] {
    std::size_t entries = 0;
    while (queue.coming(entries) != core::none) ++entries;
    return entries;
  };
  for (std::uint32_t ball = 0; ball < count; ++ball) {
    balls[ball].due = 0.01 + 1e-6 * ball;
    queue.push(balls, ball);
  }
  for (std::uint32_t k = 0; k < 20 * count; ++k) turn(queue.first(balls, infinity).time);
  std::size_t most = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    turn(queue.first(balls, infinity).time);
    most = std::max(most, in_order());
  }
  EXPECT_LE(most, 200u) << "seed " << seed;
}

/// Balls are due in order of time and number, also where many are due at one time, or only far away.
TEST(DueQueue, GivesBallsInOrder) {
  for (const double spread : {1e-9, 1.0, 1e6}) {
    for (const std::uint32_t count : {1u, 10u, 3000u}) {
      SCOPED_TRACE(testing::Message() << "spread " << spread << ", " << count << " balls, seed " << seed);
      Random random(seed);
      std::vector<Ball> balls(count);
      std::set<std::pair<double, std::uint32_t>> expected;
      double now = 0.0;
      DueQueue queue;
      const auto enter = [&](std::uint32_t number) {
        Ball& ball = balls[number];
        if (expected.erase({ball.due, number}) > 0 && random.bits() % 20 == 0) {
          ball.due = infinity;
          return;
        }
        switch (random.bits() % 4) {
          case 0:
            ball.due = now + spread * random.uniform();
            break;
          case 1:
            ball.due = now + spread * static_cast<double>(random.bits() % 3);
            break;
          case 2:
            ball.due = now + log_uniform(random, 1e-9, 1e3) * spread;
            break;
          default:
            ball.due = now;
        }
        expected.insert({ball.due, number});
        queue.push(balls, number);
      };
      for (std::uint32_t number = 0; number < count; ++number) {
        balls[number].slot = 0;
        balls[number].due = infinity;
      }
      queue.refill(balls, now);
      for (std::uint32_t number = 0; number < count; ++number) enter(number);
      for (int step = 0; step < 20000; ++step) {
        const double until = now + spread * random.uniform(0.0, 0.1);
        const DueQueue::Entry first = queue.first(balls, until);
        if (expected.empty() || expected.begin()->first > until) {
          ASSERT_EQ(first.ball, core::none) << "step " << step;
          now = until;
        } else {
          ASSERT_EQ(first.ball, expected.begin()->second) << "step " << step;
          ASSERT_EQ(first.time, expected.begin()->first) << "step " << step;
          queue.take_first();
          now = first.time;
          enter(first.ball);
        }
        for (int k = 0; k < 2; ++k) enter(static_cast<std::uint32_t>(random.bits() % count));
      }
    }
  }
}

/// A search finds all regions within reach, and none that are clearly beyond, for reaches of all sizes.
TEST(RegionCells, FindAllWithinReach) {
  struct Case {
    double period, least, most, spread;
    int dimensions;
  };
  for (const auto& [period, least, most, spread, dimensions] :
       {Case{0, 0.5, 1, 10, 3}, Case{0, 1e-3, 1e3, 100, 3}, Case{0, 0.5, 1, 1e5, 3}, Case{10, 0.1, 1, 10, 3},
        Case{10, 0.4, 0.8, 10, 2}, Case{0, 1e-6, 1, 3, 2}, Case{3, 0.5, 0.7, 3, 3}}) {
    SCOPED_TRACE(testing::Message() << "period " << period << ", reaches " << least << " to " << most
                                    << ", seed " << seed);
    const double length = dimensions == 2 ? 0.0 : period;
    RegionCells cells({period, period, length}, dimensions);
    Balls balls(Periods{}, 0.0);
    std::vector<float> reaches;
    Random random(seed);
    const auto place = [&, period = period, least = least, most = most, spread = spread,
                        dimensions = dimensions](std::uint32_t number) {
      Ball& ball = balls[number];
      for (int axis = 0; axis < 3; ++axis)
        ball.centre[axis] =
            static_cast<float>(random.uniform(0.0, spread) - (period > 0.0 ? 0.0 : 0.5 * spread));
      if (dimensions == 2) ball.centre[2] = 0.0F;
      reaches[number] = static_cast<float>(log_uniform(random, least, most));
      cells.enter(balls, number, core::RegionCells::raised(reaches[number]));
    };
    constexpr std::uint32_t count = 400;
    for (std::uint32_t number = 0; number < count; ++number) {
      balls.grow(number + 1);
      reaches.push_back(0.0F);
      place(number);
    }
    core::RegionSearch search;
    for (int step = 0; step < 2000; ++step) {
      const auto number = static_cast<std::uint32_t>(random.bits() % count);
      cells.leave(balls, number);
      place(number);
      if (step % 100 == 0) cells.rebuild(balls);
      cells.search(balls[number], core::RegionCells::raised(reaches[number]), search);
      std::vector<std::uint32_t> found(search.found.begin(), search.found.end());
      std::sort(found.begin(), found.end());
      ASSERT_TRUE(search.may_repeat || std::adjacent_find(found.begin(), found.end()) == found.end())
          << "step " << step;
      for (std::uint32_t other = 0; other < count; ++other) {
        double square = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
          double way = double{balls[number].centre[axis]} - double{balls[other].centre[axis]};
          const double around = axis == 2 ? length : period;
          if (around > 0.0) way -= around * std::round(way / around);
          square += way * way;
        }
        const double reach = double{reaches[number]} + double{reaches[other]};
        const bool is_found = std::binary_search(found.begin(), found.end(), other);
        // Just beyond, both will do.
        if (square > reach * reach && square < 1.0001 * reach * reach) continue;
        ASSERT_EQ(is_found, square <= reach * reach) << "step " << step << ", " << other;
      }
    }
  }
}

/// Regions beside a row of regions lie beyond the cells that have chains of their own, and share chains with
/// cells of the row. A search that finds one of them twice says so.
TEST(RegionCells, TellThatARegionMayBeFoundTwice) {
  constexpr std::uint32_t count = 400;
  RegionCells cells({}, 2);
  Balls balls(Periods{}, 0.0);
  balls.grow(count + 1);
  const float reach = RegionCells::raised(1.0F);
  for (std::uint32_t number = 0; number < count; ++number) {
    balls[number].centre[0] = 0.25F;
    balls[number].centre[1] = 0.05F * static_cast<float>(number);
    cells.enter(balls, number, reach);
  }
  cells.rebuild(balls);
  core::RegionSearch search;
  std::size_t repeats = 0;
  for (int step = 0; step < 20; ++step) {
    balls[count].centre[0] = 0.25F + 0.1F * static_cast<float>(step);
    balls[count].centre[1] = 10.0F;
    cells.enter(balls, count, reach);
    cells.search(balls[count], reach, search);
    const std::set<std::uint32_t> expected(search.found.begin(), search.found.end());
    repeats += search.found.size() - expected.size();
    search.drop_repeats();
    EXPECT_EQ(search.found.size(), expected.size()) << "step " << step;
    cells.leave(balls, count);
  }
  EXPECT_GT(repeats, 0U);
}

/// In a small world, too, each cell has a chain of its own, although those around the filled ones are most of
/// all: the regions of other cells are not looked at.
TEST(RegionCells, DoNotShareChainsInASmallWorld) {
  constexpr std::uint32_t count = 1000;
  RegionCells cells({}, 3);
  Balls balls(Periods{}, 0.0);
  balls.grow(count);
  Random random(15);
  for (std::uint32_t number = 0; number < count; ++number) {
    for (int axis = 0; axis < 3; ++axis)
      balls[number].centre[axis] = static_cast<float>(random.uniform(0.0, axis == 0 ? 200.0 : 6.0));
    cells.enter(balls, number, RegionCells::raised(1.0F));
  }
  cells.rebuild(balls);
  core::RegionSearch search;
  std::size_t blocks = 0;
  for (std::uint32_t number = 0; number < count; ++number) {
    cells.search(balls[number], RegionCells::raised(1.0F), search);
    EXPECT_FALSE(search.may_repeat) << "ball " << number;
    blocks += search.count;
  }
  EXPECT_LT(blocks, 30 * count);
}

/// The lanes say what QuickReject says, with vectors of every width that this machine has.
TEST(NearLanes, RejectWhatQuickRejectRejects) {
  const auto numbers = [](Random& random, int kind) {
    if (kind == 0) return random.uniform(-2.0, 2.0);
    if (kind == 1) return static_cast<double>(random.bits() % 5) - 2.0;
    const double sign = random.bits() % 2 == 0 ? 1.0 : -1.0;
    return kind == 2 ? sign * log_uniform(random, 1e-200, 1e100) : sign * log_uniform(random, 0.1, 10.0);
  };
  for (std::int64_t targets = hwy::SupportedTargets(); targets != 0; targets &= targets - 1) {
    hwy::SetSupportedTargetsForTest(targets & -targets);
    for (const bool drifts : {false, true})
      for (const bool grows : {false, true})
        for (const double period : {0.0, 8.0})
          for (int kind = 0; kind < 4; ++kind) {
            SCOPED_TRACE(testing::Message()
                         << hwy::TargetName(targets & -targets) << ", kind " << kind << ", seed " << seed);
            Random random = Random::at(seed, static_cast<std::uint64_t>(kind), grows);
            Periods periods;
            periods.any = period > 0.0;
            if (periods.any)
              periods.length = {period, period, period}, periods.inverse = Vec3{1, 1, 1} / period;
            Balls balls(periods, 0.0);
            const auto vector = [&] {
              return Vec3{numbers(random, kind), numbers(random, kind), numbers(random, kind)};
            };
            const std::array<Vec3, 3> plans{Vec3{}, vector(), vector()};
            for (std::uint32_t number = 0; number < 100; ++number) {
              balls.grow(number + 1);
              balls.set_bound(number,
                              {.position = vector() * 2.0,
                               .velocity = vector(),
                               .planned_acceleration = drifts && number % 3 > 0 ? plans[number % 3] : Vec3{},
                               .radius = std::abs(numbers(random, kind)) * 0.3,
                               .growth_speed = drifts && grows ? 0.01 * static_cast<double>(number % 5) : 0.0,
                               .acceleration_limit = grows ? std::abs(numbers(random, kind)) : 0.0});
            }
            balls.set_time(0.25);
            std::array<int, 2> certified{};
            for (int step = 0; step < 500; ++step) {
              std::vector<std::uint32_t> list(random.bits() % 33);
              for (std::uint32_t& number : list) number = static_cast<std::uint32_t>(random.bits() % 100);
              const auto self = static_cast<std::uint32_t>(random.bits() % 100);
              const double duration = std::abs(numbers(random, kind)), margin = 1e-7;
              const core::NearQuery query{{0.25, margin, 15.0 * margin, grows, balls.drifts(), &periods},
                                          duration,
                                          balls.position(self),
                                          balls.velocity(self),
                                          balls[self].radius + balls.growth(self) + margin,
                                          balls.growth_speed(self),
                                          balls[self].acceleration_limit,
                                          balls.plan(self)};
              std::array<double, core::most_lanes> apart;
              const std::uint32_t found =
                  core::may_meet(balls.all().data(), list.data(), list.size(), query, apart.data());
              for (std::size_t k = 0; k < list.size(); ++k) {
                const BoundAt own = balls.bound_now(self);
                BoundAt other = balls.bound_now(list[k]);
                // Rounding may differ in the last bits, so a slightly larger margin has to be apart, too.
                other.centre = own.centre + balls.between(self, list[k]);
                const QuickReject pair(own, other);
                const bool may_meet = (found >> k & 1) != 0;
                const double more = margin + 1e-12 * (1.0 + norm(own.centre) + norm(other.centre) +
                                                      own.radius + other.radius);
                const bool is_apart = !may_meet;
                // Where a ball is among its images means nothing beyond 2^51 periods.
                const bool has_image = period == 0.0 || norm(balls.position(list[k])) < 0x1p50 * period;
                EXPECT_TRUE(is_apart || !has_image || !pair.stay_apart(duration, 2.0 * more))
                    << step << " " << k;
                // Among numbers of all sizes, roundings are larger than the margin.
                EXPECT_TRUE(may_meet || kind == 2 || pair.stay_apart(duration, 0.5 * margin))
                    << step << " " << k;
                if (!may_meet) continue;
                EXPECT_GE(apart[k], 0.0);
                EXPECT_TRUE(apart[k] == 0.0 || kind == 2 || pair.stay_apart(apart[k], 0.5 * margin))
                    << step << " " << k;
                // Those that are near are left to reports; of others that meet, most are certified.
                EXPECT_TRUE(apart[k] == 0.0 || !pair.is_near(14.0 * margin) || kind == 2) << step << " " << k;
                if (kind == 3 && !pair.is_near(17.0 * margin)) certified[apart[k] > 0.0] += 1;
              }
              EXPECT_EQ(list.size() == 32 ? 0u : found >> list.size(), 0u);
              // The same of pairs, to the last bit.
              balls[self].own = 0.25 + duration;
              if (list.empty() || balls[self].own - 0.25 != duration) continue;
              const std::size_t count = list.size();
              list.resize((count + core::group_lanes - 1) / core::group_lanes * core::group_lanes, self);
              const std::vector<std::uint32_t> firsts(list.size(), self);
              std::vector<double> of_pairs(list.size());
              core::pairs_stay_apart(balls.all().data(), firsts.data(), list.data(), list.size(), query.pairs,
                                     of_pairs.data());
              for (std::size_t k = 0; k < count; ++k)
                EXPECT_EQ(of_pairs[k], (found >> k & 1) != 0 ? apart[k] : infinity) << step << " " << k;
            }
            EXPECT_LE(certified[0], certified[1] / 20) << "of " << certified[1];
          }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace kinesphere::core_structures_test
