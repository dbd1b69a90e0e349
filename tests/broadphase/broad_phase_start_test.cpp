// Windows end and start in bulk: which bodies, in which levels, and what a successor takes over.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "broadphase/broad_phase.hpp"
#include "number/infinity.hpp"
#include "parallel/thread_pool.hpp"
#include "support/bound_cases.hpp"

namespace kinesphere::broad_phase_start_test {
namespace {

using Numbers = std::vector<std::uint32_t>;

/// Balls in a row that stand still, but are registered as if they moved.
class BroadPhaseStart : public testing::Test {
 protected:
  static InflatedBound bound_of(std::uint32_t number) {
    return {BoundAt(Bound{.position = {3.0 * number, 0, 0}, .radius = 0.5}, 0.0), 0.0};
  }
  static BroadPhase::Starter starter(std::uint32_t number, const Window& window) {
    return {number, SizeClasses::size_class_of(bound_of(number), window), window};
  }
  void start(BroadPhase& phase, const Numbers& numbers, const Window& window, double now) {
    std::vector<BroadPhase::Starter> starters;
    for (const std::uint32_t number : numbers) starters.push_back(starter(number, window));
    phase.add_starters(starters, now, bound_of, alone);
  }
  void enter(std::uint32_t number, const Window& window, double now) {
    windows.enter(number, bound_of(number), now, window);
  }

  PoolLease alone;
  BroadPhase windows{Space{}};
  const Window brief = Window::at(0.0, -1);
  const Window main = Window::at(0.0, 0);
};

TEST_F(BroadPhaseStart, EndsWindowsInTheOrderOfNumbers) {
  for (const std::uint32_t number : {5u, 1u, 3u}) enter(number, brief, 0.0);
  for (const std::uint32_t number : {4u, 0u}) enter(number, main, 0.0);
  enter(2, Window::endless(), 0.0);
  EXPECT_EQ(windows.next_end(), 0.5);
  EXPECT_EQ(windows.moving(), 5u);
  EXPECT_EQ(windows.size_of(brief), 3u);
  EXPECT_EQ(windows.ended(0.25, false), Numbers{});
  EXPECT_EQ(windows.ended(0.5, false), (Numbers{1, 3, 5}));
  EXPECT_EQ(windows.ended(0.5, true), (Numbers{0, 1, 3, 4, 5})) << "all but the endless ones";
  windows.end_windows(0.5, false);
  EXPECT_FALSE(windows.contains(3));
  EXPECT_TRUE(windows.contains(4) && windows.contains(2));
  EXPECT_EQ(windows.next_end(), 1.0);
  const std::vector<int> held = windows.held_rungs();
  EXPECT_EQ(std::count(held.begin(), held.end(), main.rung), 1);
  EXPECT_EQ(std::count(held.begin(), held.end(), brief.rung), 0);
}

TEST_F(BroadPhaseStart, RegistersStartersAndSortsThem) {
  start(windows, {4, 2, 7}, main, 0.0);
  EXPECT_TRUE(windows.is_starter(2));
  EXPECT_EQ(windows.started_slots(), 0u) << "not sorted yet";
  windows.remove_starter(4);
  EXPECT_FALSE(windows.contains(4));
  windows.finish_start(alone);
  EXPECT_FALSE(windows.has_starters());
  EXPECT_EQ(windows.size(), 2u);
  EXPECT_GE(windows.started_slots(), 2u);
  for (const std::uint32_t number : {2u, 7u}) {
    EXPECT_FALSE(windows.is_starter(number));
    EXPECT_EQ(windows.end_of(number), 1.0);
    EXPECT_EQ(windows.check(number), std::nullopt);
    const Box box = windows.box_of(number, 0.0);
    EXPECT_LE(box.lower.x, 3.0 * number - 0.5);
    EXPECT_GE(box.upper.x, 3.0 * number + 0.5);
  }
  EXPECT_TRUE(windows.is_valid(8));
  EXPECT_FALSE(windows.is_valid(7)) << "a body that is not there";
}

TEST_F(BroadPhaseStart, StepsOneByOneGiveWhatTheyGiveTogether) {
  start(windows, {0, 1, 2, 3}, main, 0.0);
  BroadPhase stepwise = windows;
  windows.finish_start(alone);
  stepwise.survey(alone);
  stepwise.choose_cells(alone);
  stepwise.finish_start(alone);
  for (std::uint32_t number = 0; number < 4; ++number)
    EXPECT_EQ(stepwise.swept_sphere_of(number), windows.swept_sphere_of(number));
  EXPECT_EQ(stepwise.started_slots(), windows.started_slots());
}

TEST_F(BroadPhaseStart, RecordsEachChangedBodyOnce) {
  enter(3, main, 0.0);
  windows.record_changes(true);
  for (const std::uint32_t number : {5u, 3u, 5u}) enter(number, main, 0.0);
  windows.leave(3);
  EXPECT_EQ(windows.changes().size(), 4u);
  EXPECT_EQ(windows.take_changes(), (Numbers{3, 5}));
  EXPECT_EQ(windows.take_changes(), Numbers{});
  windows.record_changes(false);
  enter(3, main, 0.0);
  EXPECT_EQ(windows.take_changes(), Numbers{});
}

TEST_F(BroadPhaseStart, ASuccessorTakesOverItsStartersAndLeavesTheOthers) {
  for (std::uint32_t number = 0; number < 3; ++number) enter(number, main, 0.0);
  enter(3, Window::endless(), 0.0);
  enter(4, brief, 0.0);
  BroadPhase next = windows.successor(main.end, 0.4, 0);
  const Window later = Window::at(main.end, 0);
  start(next, {0, 2}, later, 0.4);
  next.finish_start(alone);
  const BroadPhase searched = windows.take_over(std::move(next));
  EXPECT_EQ(windows.search_begin(), main.end);
  EXPECT_EQ(windows.end_of(0), later.end);
  EXPECT_EQ(windows.end_of(1), main.end) << "no starter";
  EXPECT_TRUE(windows.awaits_search(0) && windows.awaits_search(2));
  EXPECT_FALSE(windows.awaits_search(3)) << "found by others, but does not start";
  EXPECT_TRUE(windows.pair_awaits_search(0, 3));
  EXPECT_FALSE(windows.pair_awaits_search(0, 1)) << "its window ends before the search";
  EXPECT_FALSE(windows.pair_awaits_search(3, 4));
  EXPECT_EQ(searched.started_slots(), 2u);
  EXPECT_TRUE(searched.is_valid_copy(5));
  enter(0, later, 0.5);
  EXPECT_FALSE(windows.awaits_search(0)) << "changed since, and certified at once";
  EXPECT_TRUE(windows.is_valid(5));
  windows.end_search();
  EXPECT_FALSE(windows.awaits_search(2));
  EXPECT_EQ(windows.search_begin(), -infinity);
}

}  // namespace
}  // namespace kinesphere::broad_phase_start_test
