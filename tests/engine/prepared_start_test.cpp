// A start that is prepared in slices leaves each body in its next window, certified with all others.
#include "engine/prepared_start.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "archive/archive.hpp"
#include "archive/fields.hpp"
#include "kinesphere/random.hpp"
#include "processor/window_start.hpp"
#include "support/small_world.hpp"
#include "support/true_balls.hpp"

namespace kinesphere::prepared_start_test {
namespace {

constexpr std::uint64_t seed = 5209;
constexpr std::uint32_t count = 60;

/// Bodies whose windows have just started, all at 0.
class PreparedStartTest : public testing::Test {
 protected:
  PreparedStartTest() {
    Random random(seed);
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t k = 0; k < count; ++k) {
      numbers.push_back(world.add({.radius = 0.05,
                                   .acceleration_limit = 0.05,
                                   .position = 2.0 * random.point_in_ball(),
                                   .velocity = 0.5 * random.point_in_ball()}));
      world.state.bodies[k].mark_visited();
    }
    world.main.dirty().clear();
    present = Window::at(0.0, world.state.window_policy.main_rung());
    WindowStart starting(world.state, world.main, alone, found);
    world.state.window_policy.start_main(0.0, {});
    WindowPolicy::Sample sample(world.state.window_policy, true);
    const auto starters = starting.choose_windows(numbers, {}, sample);
    world.state.window_policy.finish_start(sample, starting.start(starters), count);
    world.main.begin_epoch(world.state.broad_phase.next_end());
    prepared.emplace(world.state.bodies.space(), world.state.window_policy, present, 0.0, count);
  }
  /// Goes on to a time, and does the slices that are due on the way.
  void go_on(double until) {
    while (!prepared->is_done() && prepared->next_slice() <= until) {
      world.main.set_next_slice(prepared->next_slice());
      world.advance_all(std::nextafter(prepared->next_slice(), -infinity));
      world.main.advance_clock(prepared->next_slice());
      ASSERT_TRUE(prepared->prepare_slice({world.state, world.main, alone, found}));
      if (prepared->is_done()) break;
      ASSERT_TRUE(prepared->is_valid(world.state)) << world.main.time();
    }
  }

  SmallWorld world;
  PoolLease alone;
  std::vector<SearchResults> found;
  Window present;
  std::optional<PreparedStart> prepared;
};

TEST_F(PreparedStartTest, HasSlicesInOrderUntilTheWindowsEnd) {
  double last = 0.0;
  int slices = 0;
  while (!prepared->is_done()) {
    const double next = prepared->next_slice();
    EXPECT_GE(next, last);
    EXPECT_LE(next, present.end);
    last = next;
    ++slices;
    go_on(next);
    if (HasFailure()) return;
  }
  EXPECT_EQ(last, present.end) << "the last one is the end";
  EXPECT_GE(slices, 8);
  EXPECT_EQ(prepared->next_slice(), infinity);
}

TEST_F(PreparedStartTest, DoesTheStepsOfTheSortFarFromEachOther) {
  // The survey, the choice of cells, the sort and the entry take longer than other slices.
  std::vector<double> times;
  for (; !prepared->is_done(); go_on(times.back())) {
    if (HasFailure()) return;
    times.push_back(prepared->next_slice());
  }
  const auto in_sort = [this](double time) { return time > 0.3 * present.end && time < 0.47 * present.end; };
  std::erase_if(times, [&](double time) { return !in_sort(time); });
  ASSERT_EQ(times.size(), 4u);
  for (std::size_t k = 1; k < times.size(); ++k) EXPECT_GE(times[k] - times[k - 1], 0.04 * present.end);
}

TEST_F(PreparedStartTest, LeavesAllInTheirNextWindows) {
  go_on(present.end);
  ASSERT_TRUE(prepared->is_done());
  const BroadPhase& windows = world.state.broad_phase;
  EXPECT_EQ(windows.search_begin(), -infinity);
  for (std::uint32_t number = 0; number < count; ++number) {
    ASSERT_TRUE(windows.contains(number));
    EXPECT_GT(windows.end_of(number), present.end);
    const Box box = windows.box_of(number, world.main.time());
    const Vec3 place = world.state_of(number, world.main.time()).position;
    EXPECT_LE(box.lower.x, place.x);
    EXPECT_GE(box.upper.x, place.x);
  }
}

TEST_F(PreparedStartTest, CertifiesEachPairFromTheEndOn) {
  go_on(present.end);
  ASSERT_TRUE(prepared->is_done());
  std::vector<PairCertificate> pairs;
  world.main.certifier().for_each_certificate(world.main.queue(),
                                              [&](const PairCertificate& pair) { pairs.push_back(pair); });
  const CertificateTimes times(pairs);
  const Bodies& bodies = world.state.bodies;
  const double now = world.main.time();
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a + 1; b < count; ++b) {
      if (world.state.contacts.touch(a, b)) continue;
      const double end = std::min(world.state.broad_phase.end_of(a), world.state.broad_phase.end_of(b));
      const double until = std::min(times.of(a, b), end);
      if (until > now) {
        EXPECT_GE(least_true_gap(bodies[a].bound, bodies[b].bound, now, until), -2e-6) << a << ' ' << b;
      }
    }
}

TEST_F(PreparedStartTest, TakesThoseThatChangeOnTheWay) {
  // Amid the swept spheres, between the sort and the entry, and amid the searches.
  const std::pair<double, std::uint32_t> changes[] = {{0.2, 3}, {0.42, 4}, {0.7, 5}};
  for (const auto& [part, number] : changes) {
    go_on(part * present.end);
    world.main.advance_clock(std::max(world.main.time(), part * present.end));
    world.set_velocity(number, {0, 0.5, 0});
    ASSERT_TRUE(world.main.recertify());
  }
  go_on(present.end);
  ASSERT_TRUE(prepared->is_done());
  for (const auto& [part, number] : changes)
    EXPECT_GT(world.state.broad_phase.end_of(number), present.end) << part;
}

TEST_F(PreparedStartTest, GoesOnAsBeforeAfterItWasBytes) {
  go_on(0.6 * present.end);
  ByteWriter bytes;
  bytes(*prepared);
  PreparedStart back(world.state.bodies.space(), world.state.window_policy);
  ByteReader reader(bytes.bytes());
  reader(back);
  ASSERT_FALSE(reader.failed());
  EXPECT_EQ(back.next_slice(), prepared->next_slice());
  EXPECT_TRUE(back.is_valid(world.state));
  prepared = back;
  go_on(present.end);
  EXPECT_TRUE(prepared->is_done());
}

TEST(PreparedStart, PaysForSomeBodies) {
  EXPECT_FALSE(PreparedStart::pays(3));
  EXPECT_TRUE(PreparedStart::pays(1000));
}

}  // namespace
}  // namespace kinesphere::prepared_start_test
