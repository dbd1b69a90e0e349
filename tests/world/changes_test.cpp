// Changes at run time: teleports, radii, limits, disabled bodies, batches, user data; and wrong calls of
// each.
#include <gtest/gtest.h>

#include "number/infinity.hpp"
#include "support/playground.hpp"

namespace kinesphere::changes_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Two bodies in contact, after delivery of their begin.
struct Touching : Playground {
  BodyId a = add({.radius = 1});
  BodyId b = add({.radius = 1, .position = {1.5, 0, 0}});
  Touching() {
    EXPECT_EQ(run(0.0).size(), 1u);
    EXPECT_TRUE(run(1.0).empty());
  }
  /// Expects the end of the contact, with the states before a change at time 1.
  void expect_end(const std::vector<Event>& events) {
    ASSERT_EQ(events.size(), 1u) << events;
    EXPECT_EQ(events[0].kind, EventKind::contact_end);
    EXPECT_EQ(events[0].time, 1.0);
    EXPECT_EQ(events[0].gap, -0.5) << "the states before the change";
    EXPECT_EQ(events[0].second_state.position, (Vec3{1.5, 0, 0}));
    EXPECT_TRUE(is_clean(world));
  }
};

TEST(Change, TeleportAwayEndsAContact) {
  Touching p;
  p.teleport(p.b, {{50, 0, 0}, {}});
  p.expect_end(p.run(2.0));
}

TEST(Change, TeleportWithinAContactIsSilent) {
  Touching p;
  p.teleport(p.b, {{0, 1.25, 0}, {}});
  EXPECT_TRUE(p.run(2.0).empty());
}

TEST(Change, TeleportAwayAndBackEndsAndBegins) {
  Touching p;
  p.teleport(p.b, {{50, 0, 0}, {}});
  p.teleport(p.b, {{1.5, 0, 0}, {}});
  const auto events = p.run(2.0);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[0].kind, EventKind::contact_end);
  EXPECT_EQ(events[1].kind, EventKind::contact_begin);
}

TEST(Change, TeleportIntoAnOverlapBeginsAtOnce) {
  Playground p;
  p.add({.radius = 1});
  const BodyId b = p.add({.radius = 1, .position = {50, 0, 0}});
  p.run(1.0);
  p.teleport(b, {{0, 1, 0}, {}});
  const auto events = p.run(2.0);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].time, 1.0);
  EXPECT_EQ(p.world.counters().count(EventKind::bound_violation), 0u);
}

TEST(Change, TeleportAwayAtAnotherEventOfTheInstantTakesItsBeginBack) {
  Playground p;
  p.add({.radius = 1});
  p.add({.radius = 1, .position = {1, 0, 0}});
  p.add({.radius = 1, .position = {50, 0, 0}});
  const BodyId d = p.add({.radius = 1, .position = {51, 0, 0}});
  ASSERT_TRUE(p.advance(1.0));
  p.teleport(d, {{100, 0, 0}, {}});
  EXPECT_TRUE(p.run(1.0).empty());
}

/// Two pairs that separate at one instant; the first end has been delivered, the second is pending.
struct Parting : Playground {
  BodyId c, d;
  Parting() {
    for (const double y : {-64.0, 64.0}) {
      c = add({.radius = 1, .position = {0, y, 0}});
      d = add({.radius = 1, .position = {1.5, y, 0}, .velocity = {1, 0, 0}});
    }
    EXPECT_EQ(run(0.25).size(), 2u);
    const auto end = advance(1.0);
    EXPECT_TRUE(end && end->kind == EventKind::contact_end && end->first == (BodyId{0, 0}));
  }
  /// Expects the end with the states before a change that makes the two overlap, and a new begin.
  void expect_end_and_begin(double gap) {
    const auto events = run(world.time());
    ASSERT_EQ(events.size(), 2u) << events;
    EXPECT_EQ(events[0].kind, EventKind::contact_end);
    EXPECT_EQ(events[0].first, c);
    EXPECT_GE(events[0].gap, 4e-6);
    EXPECT_LE(events[0].gap, 5e-6);
    EXPECT_EQ(events[1].kind, EventKind::contact_begin);
    EXPECT_NEAR(events[1].gap, gap, 1e-5);
    EXPECT_TRUE(is_clean(world));
  }
};

TEST(Change, OfABodyDoesNotTakeBackAnEndThatWasOnItsWay) {
  Parting p;
  p.world.change(p.d, {.radius = 1.5}).value();
  p.expect_end_and_begin(-0.5);
}

TEST(Change, TeleportDoesNotTakeBackAnEndThatWasOnItsWay) {
  Parting p;
  p.teleport(p.d, {{1.25, 64, 0}, {1, 0, 0}});
  p.expect_end_and_begin(-0.75);
}

TEST(Change, OfABodyDoesNotTakeBackAnEndAtAWallThatWasOnItsWay) {
  Playground p({.box = Box{{0, -64, -64}, {128, 64, 64}}});
  BodyId last;
  for (const double y : {-16.0, 16.0})
    last = p.add({.radius = 1, .position = {0.5, y, 0}, .velocity = {1, 0, 0}});
  EXPECT_EQ(p.run(0.25).size(), 2u);
  const auto end = p.advance(1.0);
  ASSERT_TRUE(end && end->kind == EventKind::wall_end && end->first != last);
  p.world.change(last, {.radius = 1.5}).value();
  const auto events = p.run(p.world.time());
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[0].kind, EventKind::wall_end);
  EXPECT_EQ(events[0].first, last);
  EXPECT_GE(events[0].gap, 4e-6);
  EXPECT_EQ(events[1].kind, EventKind::wall_begin);
}

TEST(Change, SmallerRadiusEndsAndLargerBegins) {
  Touching p;
  p.world.change(p.b, {.radius = 0.25}).value();
  p.expect_end(p.run(2.0));
  p.world.change(p.b, {.radius = 0.75}).value();
  const auto events = p.run(3.0);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].kind, EventKind::contact_begin);
  EXPECT_EQ(events[0].time, 2.0);
}

TEST(Change, RadiusOfABodyOnAWallCounts) {
  Playground p({.box = Box{{0, 0, 0}, {10, 10, 10}}});
  const BodyId a = p.add({.radius = 1, .position = {0.5, 5, 5}});
  EXPECT_EQ(p.run(1.0).size(), 1u);
  p.world.change(a, {.radius = 0.25}).value();
  const auto events = p.run(2.0);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].kind, EventKind::wall_end);
  EXPECT_EQ(events[0].gap, -0.5);
}

TEST(Change, PromiseHoldsFromNowOnAndTheOldOneUntilNow) {
  Playground p;
  const BodyId a = p.add({.radius = 1, .acceleration_limit = 2, .position = {0, 0, 0}}, Vec3{1.9, 0, 0});
  const BodyId b = p.add({.radius = 1, .position = {20, 0, 0}});
  p.run(1.0);
  p.world.change(a, {.motion_limits = MotionLimits{.planned_acceleration = {-1, 0, 0}}}).value();
  p.steer(a, {-1, 0, 0});
  EXPECT_TRUE(p.run(2.0).empty());
  p.world.change(a, {.motion_limits = MotionLimits{.acceleration_limit = 10}}).value();
  p.steer(a, {9.9, 0, 0});
  const auto event = p.advance(20.0);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::contact_begin);
  EXPECT_LE(std::abs(p.gap(a, b)), 1e-6);
}

TEST(Change, BrokenNewPromiseIsTold) {
  Playground p;
  const BodyId a = p.add({.radius = 1, .acceleration_limit = 2}, Vec3{1.9, 0, 0});
  p.run(1.0);
  p.world.change(a, {.motion_limits = MotionLimits{}}).value();
  p.add({.radius = 1, .position = {6, 0, 0}});
  EXPECT_GE(of_kind(p.run(3.0), EventKind::bound_violation).size(), 1u);
}

TEST(Change, DisabledBodyTouchesNobodyAndIsNotProbed) {
  Touching p;
  p.world.disable(p.b).value();
  p.distort = [&](BodyId id, double, State&) { EXPECT_NE(id, p.b); };
  p.expect_end(p.run(2.0));
  EXPECT_TRUE(p.world.contains(p.b));
  EXPECT_FALSE(p.world.body(p.b).value().enabled);
  EXPECT_EQ(p.world.size(), 2u);
  p.add({.radius = 1, .position = {1.5, 2.2, 0}});
  EXPECT_TRUE(p.run(3.0).empty());
  p.world.change(p.b, {.radius = 1.25}).value();
  p.distort = {};
  p.world.enable(p.b, {{1.5, 0, 0}, {}}).value();
  EXPECT_EQ(of_kind(p.run(4.0), EventKind::contact_begin).size(), 2u);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(Change, DisabledBodyMayBeRemoved) {
  Touching p;
  p.world.disable(p.b).value();
  p.world.remove(p.b).value();
  p.expect_end(p.run(2.0));
  EXPECT_FALSE(p.world.contains(p.b));
}

TEST(Change, RemoveAllEndsEachContactOnce) {
  Touching p;
  p.world.remove(std::vector<BodyId>{p.a, p.b}).value();
  EXPECT_EQ(p.world.size(), 0u);
  p.expect_end(p.run(2.0));
}

TEST(Change, UserDataIsKept) {
  Playground p;
  const BodyId a = p.add({.user_data = 7});
  EXPECT_EQ(p.world.user_data(a).value(), 7u);
  p.world.change(a, {.user_data = ~std::uint64_t{0}}).value();
  EXPECT_EQ(p.world.user_data(a).value(), ~std::uint64_t{0});
}

template <class T>
void expect_error(const Result<T>& result, ErrorCode code, const std::string& call) {
  ASSERT_FALSE(result) << call;
  EXPECT_EQ(result.error().code, code) << result.error().message;
  EXPECT_EQ(result.error().message.rfind(call, 0), 0u) << result.error().message;
}

/// Expects that every change of body `id` is refused.
void expect_all_refused(World& world, BodyId id, ErrorCode code) {
  expect_error(world.teleport(id, {}), code, "teleport");
  expect_error(world.change(id, {.radius = 1}), code, "change");
  expect_error(world.change(id, {.motion_limits = MotionLimits{}}), code, "change");
  expect_error(world.disable(id), code, "disable");
  expect_error(world.enable(id, {}), code, "enable");
  expect_error(world.change(id, {.filter = Filter{}}), code, "change");
  expect_error(world.refresh_filter(id), code, "refresh_filter");
  expect_error(world.change(id, {.user_data = 1}), code, "change");
  expect_error(world.user_data(id), code, "user_data");
  expect_error(world.remove(std::span(&id, 1)), code, "remove");
}

TEST(WrongChange, IsRefusedAndLeavesNoTrace) {
  Playground p({.box = Box{{0, 0, 0}, {10, 10, 10}}, .allow_overlap = false});
  const BodyId gone = p.add({.radius = 1, .position = {5, 5, 5}});
  p.world.remove(gone).value();
  const BodyId a = p.add({.radius = 1, .position = {5, 5, 5}});
  const BodyId b = p.add({.radius = 1, .position = {8, 5, 5}});
  expect_all_refused(p.world, gone, ErrorCode::stale_body);
  expect_all_refused(p.world, {77, 0}, ErrorCode::unknown_body);
  expect_error(p.world.teleport(a, {{nan, 0, 0}, {}}), ErrorCode::not_finite, "teleport");
  expect_error(p.world.teleport(a, {{5, 5, 5}, {0, nan, 0}}), ErrorCode::not_finite, "teleport");
  expect_error(p.world.teleport(a, {{0.5, 5, 5}, {}}), ErrorCode::outside_domain, "teleport");
  expect_error(p.world.teleport(a, {{7, 5, 5}, {}}), ErrorCode::overlapping, "teleport");
  expect_error(p.world.change(a, {.radius = -1}), ErrorCode::out_of_range, "change");
  expect_error(p.world.change(a, {.radius = nan}), ErrorCode::not_finite, "change");
  expect_error(p.world.change(a, {.radius = 2.5}), ErrorCode::overlapping, "change");
  expect_error(p.world.change(b, {.radius = 2.5}), ErrorCode::outside_domain, "change");
  expect_error(p.world.change(a, {.motion_limits = MotionLimits{.acceleration_limit = -1}}),
               ErrorCode::out_of_range, "change");
  expect_error(p.world.change(a, {.motion_limits = MotionLimits{.planned_acceleration = {nan, 0, 0}}}),
               ErrorCode::not_finite, "change");
  expect_error(p.world.change(a, {.motion_limits = MotionLimits{.position_error = 1.5}}),
               ErrorCode::overlapping, "change");
  expect_error(p.world.change(a, {.motion_limits = MotionLimits{.velocity_error = nan}}),
               ErrorCode::not_finite, "change");
  expect_error(p.world.enable(a, {{5, 5, 5}, {}}), ErrorCode::enabled_body, "enable");
  expect_error(p.world.remove(std::vector<BodyId>{a, b, a}), ErrorCode::stale_body, "remove: bodies[2]");
  EXPECT_EQ(p.world.size(), 2u);
  EXPECT_TRUE(p.run(1.0).empty());
  p.world.disable(a).value();
  expect_error(p.world.disable(a), ErrorCode::disabled_body, "disable");
  expect_error(p.world.teleport(a, {{5, 5, 5}, {}}), ErrorCode::disabled_body, "teleport");
  expect_error(p.world.set_velocity(a, {}), ErrorCode::disabled_body, "set_velocity");
  expect_error(p.world.enable(a, {{7, 5, 5}, {}}), ErrorCode::overlapping, "enable");
  EXPECT_TRUE(p.run(2.0).empty());
  EXPECT_TRUE(is_clean(p.world));
}

TEST(WrongChange, TwoTeleportsToOnePlaceAtOneStop) {
  Playground p({.allow_overlap = false});
  const BodyId a = p.add({.radius = 1});
  const BodyId b = p.add({.radius = 1, .position = {8, 0, 0}});
  p.world.teleport(a, {{50, 0, 0}, {}}).value();
  expect_error(p.world.teleport(b, {{50, 1, 0}, {}}), ErrorCode::overlapping, "teleport");
  EXPECT_TRUE(p.world.teleport(b, {{0, 0, 0}, {}})) << "the place is free again";
}

TEST(WrongChange, NamesEachNumberThatIsWrong) {
  Playground p({.box = Box{{0, 0, 0}, {10, 10, 10}}});
  const BodyId a = p.add({.radius = 1, .position = {5, 5, 5}});
  const BodyId off = p.add({.radius = 1, .position = {2, 2, 2}});
  p.world.disable(off).value();
  const auto refused = [](const auto& result, ErrorCode code, const std::string& argument, BodyId body,
                          const std::string& call) {
    expect_error(result, code, call);
    EXPECT_EQ(result.error().argument, argument);
    EXPECT_EQ(result.error().body, body);
  };
  const auto check = [&](double bad, ErrorCode code) {
    const Vec3 v{0, bad, 0};
    refused(p.world.teleport(a, {v, {}}), code, "position", a, "teleport");
    refused(p.world.teleport(a, {{5, 5, 5}, v}), code, "velocity", a, "teleport");
    refused(p.world.enable(off, {v, {}}), code, "position", off, "enable");
    refused(p.world.enable(off, {{5, 5, 5}, v}), code, "velocity", off, "enable");
    refused(p.world.change(a, {.radius = bad}), code, "radius", a, "change");
    refused(p.world.change(a, {.motion_limits = MotionLimits{.acceleration_limit = bad}}), code,
            "acceleration_limit", a, "change");
    refused(p.world.change(a, {.motion_limits = MotionLimits{.planned_acceleration = v}}), code,
            "planned_acceleration", a, "change");
    refused(p.world.change(a, {.motion_limits = MotionLimits{.position_error = bad}}), code, "position_error",
            a, "change");
    refused(p.world.change(a, {.motion_limits = MotionLimits{.velocity_error = bad}}), code, "velocity_error",
            a, "change");
  };
  for (const double bad : {nan, infinity, -infinity}) check(bad, ErrorCode::not_finite);
  check(1e200, ErrorCode::out_of_range);
  for (const MotionLimits& bad : {MotionLimits{.acceleration_limit = -1}, MotionLimits{.position_error = -1},
                                  MotionLimits{.velocity_error = -1}})
    expect_error(p.world.change(a, {.motion_limits = bad}), ErrorCode::out_of_range, "change");
  refused(p.world.teleport(a, {{5, 5, 11}, {}}), ErrorCode::outside_domain, "position", a, "teleport");
  refused(p.world.enable(off, {{5, -1, 5}, {}}), ErrorCode::outside_domain, "position", off, "enable");
  EXPECT_FALSE(p.world.body(off).value().enabled);
  EXPECT_TRUE(p.run(1.0).empty());
}

}  // namespace
}  // namespace kinesphere::changes_test
