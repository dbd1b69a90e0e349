// Which window a body gets, and when a report is worth its cost.
#include "processor/window_choice.hpp"

#include <gtest/gtest.h>

#include "kinesphere/random.hpp"
#include "number/powers.hpp"
#include "support/small_world.hpp"

namespace kinesphere::window_choice_test {
namespace {

constexpr std::uint64_t seed = 5212;

TEST(WindowChoice, GivesFasterBodiesNoLongerWindows) {
  SmallWorld world;
  int last = 1000;
  for (const double speed : {0.0, 0.1, 1.0, 10.0, 100.0, 1e4}) {
    const std::uint32_t number = world.add({.velocity = {speed, 0, 0}});
    const Window window = WindowChoice(world.state, 0.0).window_for(number);
    EXPECT_LE(window.rung, last);
    EXPECT_LE(speed * power_of_two(window.rung), 16.0) << "some times the way of the main windows";
    last = window.rung;
  }
  EXPECT_LT(last, -5);
}

TEST(WindowChoice, IsAmongTheNextMainWindowsOnceTheseAreEntered) {
  SmallWorld world;
  const std::uint32_t slow = world.add({.velocity = {1, 0, 0}});
  const std::uint32_t fast = world.add({.velocity = {1000, 0, 0}});
  BroadPhase& windows = world.state.broad_phase;
  PoolLease alone;
  BroadPhase next = windows.successor(8.0, 4.0, 0);
  next.finish_start(alone);
  windows.take_over(std::move(next));
  const WindowChoice choice(world.state, 4.5);
  const int main_rung = world.state.window_policy.main_rung();
  const Window main = choice.window_for(slow), own = choice.window_for(fast);
  EXPECT_GE(main.rung, main_rung);
  EXPECT_EQ(main, Window::at(8.0, main.rung));
  EXPECT_LT(own.rung, main_rung);
  EXPECT_EQ(own, Window::at(4.5, own.rung));
}

TEST(WindowChoice, HasNoEndForWhatStandsStill) {
  SmallWorld world;
  const std::uint32_t still = world.add({});
  const std::uint32_t moving = world.add({.velocity = {1, 0, 0}});
  const WindowChoice choice(world.state, 0.0);
  EXPECT_EQ(choice.next_window(still, std::nullopt), Window::endless());
  EXPECT_LT(choice.next_window(moving, std::nullopt).end, infinity);
}

TEST(WindowChoice, KeepsAWindowThatSuits) {
  SmallWorld world;
  const std::uint32_t number = world.add({.velocity = {1, 0, 0}});
  world.state.bodies[number].relocated = false;
  const WindowChoice choice(world.state, 0.25);
  const Window suits = choice.window_for(number);
  EXPECT_EQ(choice.next_window(number, suits), suits);
  const Window shorter = Window::at(0.25, suits.rung - 3);
  EXPECT_EQ(choice.next_window(number, shorter), shorter) << "not much shorter";
  const Window much_shorter = Window::at(0.25, suits.rung - 9);
  EXPECT_EQ(choice.next_window(number, much_shorter), suits);
  const Window longer = Window::at(0.25, suits.rung + 3);
  EXPECT_EQ(choice.next_window(number, longer), suits);
  world.state.bodies[number].relocated = true;
  EXPECT_EQ(choice.next_window(number, shorter), suits) << "a new place, a new window";
}

TEST(WindowChoice, GrowsAsABodyRenewsItsOwn) {
  SmallWorld world;
  const std::uint32_t number = world.add({.velocity = {64, 0, 0}});
  const WindowChoice choice(world.state, 0.0);
  const Window first = choice.window_for(number);
  EXPECT_EQ(choice.longer_window(number, first).rung, first.rung + 1);
  const Window brief = Window::at(0.0, first.rung - 6);
  EXPECT_EQ(choice.longer_window(number, brief).rung, first.rung) << "at least what suits it";
}

TEST(WindowChoice, InPeriodicSpaceBoxesAreNarrowerThanHalfAPeriod) {
  SCOPED_TRACE(seed);
  const double period = 10.0;
  SmallWorld world({.box = Box{{0, 0, 0}, {period, period, period}}, .periodic = {.x = true, .z = true}});
  world.state.window_policy.choose(1e6, {.speed = 1.0, .acceleration = 0.0});
  Random random(seed);
  const double release = world.state.contacts.rule().release_gap();
  for (int k = 0; k < 500; ++k) {
    const std::uint32_t number = world.add({.radius = 1.5 * random.uniform(),
                                            .acceleration_limit = 5.0 * random.uniform(),
                                            .position_error = 0.01 * random.uniform(),
                                            .position = {5, 5, 5},
                                            .velocity = 20.0 * random.point_in_ball()});
    const Window window = WindowChoice(world.state, 0.0).window_for(number);
    const Box box = inflated_bound(world.state.bodies, number, 0.0).box_of_way(power_of_two(window.rung));
    const double widest = 0.5 * period - release - 4.0 * world.state.bodies[number].position_error;
    for (const int axis : {0, 2}) EXPECT_LT(box.upper[axis] - box.lower[axis], widest) << k;
  }
}

TEST(WindowChoice, NeedsNoReportOfWhatIsKnown) {
  SmallWorld world;
  const std::uint32_t fresh = world.add({.acceleration_limit = 1e3, .velocity = {1, 0, 0}});
  EXPECT_FALSE(WindowChoice(world.state, 0.0).needs_report(fresh));
  const std::uint32_t exact = world.add({.velocity = {1, 0, 0}});
  EXPECT_FALSE(WindowChoice(world.state, 50.0).needs_report(exact)) << "its bound does not grow";
}

TEST(WindowChoice, NeedsAReportBeforePositionsAreInaccurate) {
  SmallWorld world({.contact_tolerance = 1e-9});
  const std::uint32_t number = world.add({.velocity = {1, 0, 0}});
  const double far = 0x1p40 * 1e-9;
  EXPECT_FALSE(WindowChoice(world.state, 0.25 * far).needs_report(number));
  EXPECT_TRUE(WindowChoice(world.state, 4.0 * far).needs_report(number));
}

}  // namespace
}  // namespace kinesphere::window_choice_test
