// Wrong use that no other test file is about: it gets an error that names the cause, and none crashes.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "kinesphere/kinesphere.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::wrong_use_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A world with two balls.
class WrongUse : public testing::Test {
 protected:
  Ballistic motion = Ballistic::create({.start = {{{0, 0, 0}, {1, 0, 0}}, {{10, 0, 0}, {}}}}).value();
  World world = World::create({.box = Box{{-100, -100, -100}, {100, 100, 100}}}).value();
  BodyId ball = world.add(motion.definition(0, 0.0)).value();
  BodyId other = world.add(motion.definition(1, 0.0)).value();
};

TEST_F(WrongUse, ALoopOverATemporaryAnswer) {
  std::size_t count = 0;
  for (const OverlapHit& found : *world.queries().overlapping({0, 0, 0}, 200.0))
    count += world.contains(found.body) ? 1u : 0u;
  EXPECT_EQ(count, 2u);
}

TEST_F(WrongUse, AProbeMadeOfATemporary) {
  Probe probe = motion.probe();
  EXPECT_TRUE(world.advance(1.0, probe));
}

TEST_F(WrongUse, AnInfiniteVelocity) {
  expect_error(world.set_velocity(ball, {infinity, 0, 0}), ErrorCode::not_finite, "velocity",
               "set_velocity:", ball);
}

TEST_F(WrongUse, AMassOfZero) {
  const Event event{.first = ball, .second = other, .normal = {1, 0, 0}, .approach_speed = 1.0};
  for (const double mass : {0.0, -1.0, 1e308}) {
    EXPECT_TRUE(is_finite(bounce(event, mass, mass, 0.5).first_velocity)) << mass;
    EXPECT_TRUE(is_finite(settle(event, 0.0, mass, 0.5, 0.1).second_velocity)) << mass;
  }
}

TEST_F(WrongUse, ANaNAsMassIsRefusedWhereItGoes) {
  const Event event{.first = ball, .second = other, .normal = {1, 0, 0}, .approach_speed = 1.0};
  expect_error(world.set_velocity(ball, bounce(event, nan, 1.0, 1.0).first_velocity), ErrorCode::not_finite,
               "velocity", "set_velocity:", ball);
}

TEST_F(WrongUse, NoTimeAtAll) {
  expect_error(world.advance(nan, motion.probe()), ErrorCode::not_finite, "until", "advance:");
}

TEST_F(WrongUse, ANullProbe) {
  static_assert(!std::is_invocable_v<decltype(&World::advance), World&, double, std::nullptr_t>);
  expect_error(world.advance(1.0, Probe::Function{nullptr}), ErrorCode::null_probe, "probe", "advance:");
}

TEST_F(WrongUse, AnEmptyFunctionAsProbe) {
  const std::function<void(std::span<const BodyId>, double, std::span<State>)> unset;
  expect_error(world.advance(1.0, unset), ErrorCode::null_probe, "probe", "advance:");
}

TEST_F(WrongUse, AMotionAskedAboutABodyThatItDoesNotHave) {
  world.add({.position = {0, 0, 5}, .velocity = {0, 0, 1}}).value();
  world.add({.position = {0, 5, 5}, .velocity = {0, -1, 1}}).value();
  expect_error(motion.set_velocity(1000000, 0.0, {}), ErrorCode::unknown_body, "body",
               "set_velocity:", BodyId{1000000, 0});
  try {
    (void)world.advance(20.0, motion.probe());
    ADD_FAILURE() << "nothing was thrown";
  } catch (const BadResult& thrown) {
    EXPECT_EQ(thrown.error().code, ErrorCode::unknown_body) << thrown.what();
  }
}

TEST_F(WrongUse, ATriangleThatIsALine) {
  expect_error(world.add_zone(Triangle{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), ErrorCode::out_of_range, "shape",
               "add_zone:");
}

TEST_F(WrongUse, ContactEventsThatAreNone) {
  WorldDefinition definition;
  definition.contacts = ContactEvents{};
  expect_error(World::create(definition), ErrorCode::out_of_range, "contacts", "World::create:");
  expect_error(world.add({.contacts = static_cast<ContactEvents>(7)}), ErrorCode::out_of_range, "contacts",
               "add: contacts must be impacts, begin_and_end or all");
}

}  // namespace
}  // namespace kinesphere::wrong_use_test
