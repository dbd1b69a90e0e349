// Wrong use in 50 ways, each in a line or three: every one gets an error that names the cause, and none
// crashes. Wrong ids, moved worlds and temporary probes in every call have test files of their own.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "kinesphere/kinesphere.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::wrong_use_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A world with a ball, a wall, and one removed body.
class WrongUse : public testing::Test {
 protected:
  Ballistic motion =
      Ballistic::create({.start = {{{0, 0, 0}, {1, 0, 0}}, {{10, 0, 0}, {}}, {{0, 30, 0}, {}}}}).value();
  World world = World::create({.box = Box{{-100, -100, -100}, {100, 100, 100}}}).value();
  BodyId ball = world.add(motion.definition(0, 0.0)).value();
  BodyId other = world.add(motion.definition(1, 0.0)).value();
  BodyId gone = world.add(motion.definition(2, 0.0)).value();
  BodyId post = world.add_static({.shape = Ball{{50, 0, 0}, 1.0}}).value();

  WrongUse() { world.remove(gone).value(); }

  /// Calls `question` inside a probe.
  template <class Question>
  auto asked_in_probe(Question question) {
    using Answer = decltype(question());
    std::optional<Answer> answer;
    const auto event = world.advance(20.0, [&](auto ids, double time, std::span<State> states) {
      if (!answer) answer.emplace(question());
      motion.probe()(ids, time, states);
    });
    EXPECT_TRUE(event);
    EXPECT_TRUE(answer);
    return *answer;
  }
};

// Values and temporaries.

TEST_F(WrongUse, 01_AForgottenCheckThrowsTheError) {
  EXPECT_THROW((void)world.add({.radius = -1}).value(), BadResult);
  EXPECT_THROW((void)world.body(gone)->enabled, BadResult);
}

TEST_F(WrongUse, 02_TheErrorOfASuccess) { EXPECT_THROW((void)world.reserve(5).error(), std::logic_error); }

TEST_F(WrongUse, 03_ALoopOverATemporaryAnswer) {
  std::size_t count = 0;
  for (const OverlapHit& found : *world.queries().overlapping({0, 0, 0}, 200.0))
    count += world.contains(found.body) ? 1u : 0u;
  EXPECT_EQ(count, 3u);
}

TEST_F(WrongUse, 04_AProbeMadeOfATemporary) {
  Probe probe = motion.probe();
  EXPECT_TRUE(world.advance(1.0, probe));
}

TEST_F(WrongUse, 05_AWorldThatHasBeenMovedFrom) {
  const World taken = std::move(world);
  // NOLINTNEXTLINE(bugprone-use-after-move): that is what is tested.
  expect_error(world.remove(ball), ErrorCode::moved_from, "world", "remove:");
  EXPECT_THROW((void)world.time(), BadResult);  // NOLINT(bugprone-use-after-move)
}

// Ids.

TEST_F(WrongUse, 06_AnIdOfABodyThatNeverWas) {
  expect_error(world.remove(BodyId{77, 0}), ErrorCode::unknown_body, "body", "remove: body 77", {77, 0});
}

TEST_F(WrongUse, 07_NoBody) {
  expect_error(world.set_velocity(no_body, {}), ErrorCode::unknown_body, "body", "set_velocity: no_body");
}

TEST_F(WrongUse, 08_AnIdOfABodyThatHasGone) {
  expect_error(world.change(gone, {.radius = 1.0}), ErrorCode::stale_body, "body", "change: body 2", gone);
}

TEST_F(WrongUse, 09_AnIdOfAnotherWorld) {
  const BodyId foreign = World::create({}).value().add({}).value();
  expect_error(world.teleport(foreign, {}), ErrorCode::foreign_body, "body", "teleport: body 0", foreign);
}

TEST_F(WrongUse, 10_RemovingTwice) {
  expect_error(world.remove(std::vector{ball, ball}), ErrorCode::stale_body, "body", "remove: bodies[1]",
               ball);
  EXPECT_TRUE(world.contains(ball)) << "then none is removed";
}

TEST_F(WrongUse, 11_TheSameBodyAsBothOfAPair) {
  expect_error(world.certificates().safe_until(ball, ball), ErrorCode::out_of_range, "second",
               "safe_until:", ball);
}

// Numbers.

TEST_F(WrongUse, 12_ANaNInADefinition) {
  expect_error(world.add({.velocity = {0, nan, 0}}), ErrorCode::not_finite, "velocity", "add:");
}

TEST_F(WrongUse, 13_ANegativeRadius) {
  expect_error(world.add({.radius = -0.5}), ErrorCode::out_of_range, "radius", "add:");
  expect_error(world.change(ball, {.radius = -0.5}), ErrorCode::out_of_range, "radius", "change:", ball);
}

TEST_F(WrongUse, 14_ANegativeLimit) {
  expect_error(world.change(ball, {.motion_limits = MotionLimits{.acceleration_limit = -1}}),
               ErrorCode::out_of_range, "acceleration_limit", "change:", ball);
}

TEST_F(WrongUse, 15_AnInfiniteVelocity) {
  expect_error(world.set_velocity(ball, {infinity, 0, 0}), ErrorCode::not_finite, "velocity",
               "set_velocity:", ball);
}

TEST_F(WrongUse, 16_APlaceOutsideTheBox) {
  expect_error(world.add({.position = {500, 0, 0}}), ErrorCode::outside_domain, "position", "add:");
  expect_error(world.teleport(ball, {{0, 0, -101}, {}}), ErrorCode::outside_domain, "position",
               "teleport:", ball);
}

TEST_F(WrongUse, 17_APlaceThatDoublesCannotHold) {
  World open = World::create({}).value();
  expect_error(open.add({.position = {1e9, 0, 0}}), ErrorCode::out_of_range, "position", "add:");
}

TEST_F(WrongUse, 18_AMassOfZero) {
  const Event event{.first = ball, .second = other, .normal = {1, 0, 0}, .approach_speed = 1.0};
  for (const double mass : {0.0, -1.0, 1e308}) {
    EXPECT_TRUE(is_finite(bounce(event, mass, mass, 0.5).first_velocity)) << mass;
    EXPECT_TRUE(is_finite(settle(event, 0.0, mass, 0.5, 0.1).second_velocity)) << mass;
  }
}

TEST_F(WrongUse, 19_ANaNAsMassIsRefusedWhereItGoes) {
  const Event event{.first = ball, .second = other, .normal = {1, 0, 0}, .approach_speed = 1.0};
  expect_error(world.set_velocity(ball, bounce(event, nan, 1.0, 1.0).first_velocity), ErrorCode::not_finite,
               "velocity", "set_velocity:", ball);
}

TEST_F(WrongUse, 20_AToleranceOfZero) {
  expect_error(World::create({.contact_tolerance = 0}), ErrorCode::out_of_range, "contact_tolerance",
               "World::create:");
}

TEST_F(WrongUse, 21_AnEmptyBox) {
  expect_error(World::create({.box = Box{{0, 0, 0}, {1, 0, 1}}}), ErrorCode::out_of_range, "box",
               "World::create:");
}

TEST_F(WrongUse, 22_ASpaceThatRepeatsWithoutABox) {
  expect_error(World::create({.periodic = {true, false, false}}), ErrorCode::out_of_range, "periodic",
               "World::create:");
}

TEST_F(WrongUse, 23_AHeightInThePlane) {
  World plane = World::create({.dimensions = 2}).value();
  expect_error(plane.add({.position = {0, 0, 1}}), ErrorCode::out_of_range, "position", "add:");
}

// Time and probes.

TEST_F(WrongUse, 24_TimeBackwards) {
  EXPECT_TRUE(world.advance(1.0, motion.probe()));
  expect_error(world.advance(0.5, motion.probe()), ErrorCode::time_backwards, "until", "advance:");
}

TEST_F(WrongUse, 25_NoTimeAtAll) {
  expect_error(world.advance(nan, motion.probe()), ErrorCode::not_finite, "until", "advance:");
}

TEST_F(WrongUse, 26_ANullProbe) {
  static_assert(!std::is_invocable_v<decltype(&World::advance), World&, double, std::nullptr_t>);
  expect_error(world.advance(1.0, Probe::Function{nullptr}), ErrorCode::null_probe, "probe", "advance:");
}

TEST_F(WrongUse, 27_AnEmptyFunctionAsProbe) {
  const std::function<void(std::span<const BodyId>, double, std::span<State>)> unset;
  expect_error(world.advance(1.0, unset), ErrorCode::null_probe, "probe", "advance:");
}

TEST_F(WrongUse, 28_AProbeThatForgetsToAnswer) {
  expect_error(world.advance(20.0, [](auto, double, auto) {}), ErrorCode::not_finite, "position",
               "advance:", ball);
}

TEST_F(WrongUse, 29_AProbeThatAnswersNaN) {
  const auto wild = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    motion.probe()(ids, time, states);
    states[0].velocity.y = nan;
  };
  expect_error(world.advance(20.0, wild), ErrorCode::not_finite, "velocity", "advance:", ball);
  EXPECT_TRUE(world.advance(20.0, motion.probe())) << "and the call may be repeated";
}

TEST_F(WrongUse, 30_AdvancingInsideAProbe) {
  expect_error(asked_in_probe([&] { return world.advance(2.0, motion.probe()); }),
               ErrorCode::probe_in_progress, "probe", "advance:");
}

TEST_F(WrongUse, 31_ChangingABodyInsideAProbe) {
  expect_error(asked_in_probe([&] { return world.remove(ball); }), ErrorCode::probe_in_progress, "probe",
               "remove:");
}

TEST_F(WrongUse, 32_SavingInsideAProbe) {
  expect_error(asked_in_probe([&] { return world.save(); }), ErrorCode::probe_in_progress, "probe", "save:");
}

TEST_F(WrongUse, 33_AMotionAskedAboutABodyThatItDoesNotHave) {
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

// Bodies that do not support the request.

TEST_F(WrongUse, 34_AVelocityForAFixedBody) {
  expect_error(world.set_velocity(post, {}), ErrorCode::static_body, "body", "set_velocity:", post);
}

TEST_F(WrongUse, 35_AVelocityForADisabledBody) {
  world.disable(ball).value();
  expect_error(world.set_velocity(ball, {}), ErrorCode::disabled_body, "body", "set_velocity:", ball);
}

TEST_F(WrongUse, 36_EnablingTwice) {
  expect_error(world.enable(ball, {}), ErrorCode::enabled_body, "body", "enable:", ball);
}

TEST_F(WrongUse, 37_ASensorWithANegativeDistance) {
  expect_error(world.set_sensor(1, {.distances = {5.0, -1.0}}), ErrorCode::out_of_range, "sensor",
               "set_sensor:");
}

TEST_F(WrongUse, 38_ABoxTurnedInsideOut) {
  expect_error(world.add_static({.shape = Box{{1, 1, 1}, {0, 2, 2}}}), ErrorCode::out_of_range, "shape",
               "add_static:");
}

TEST_F(WrongUse, 39_ATriangleThatIsALine) {
  expect_error(world.add_zone(Triangle{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), ErrorCode::out_of_range, "shape",
               "add_zone:");
}

TEST_F(WrongUse, 40_ABodyInsideAnother) {
  World tight = World::create({.allow_overlap = false}).value();
  tight.add({.radius = 1}).value();
  expect_error(tight.add({.radius = 1, .position = {0.5, 0, 0}}), ErrorCode::overlapping, "position",
               "add:", BodyId{0, 0});
}

TEST_F(WrongUse, 41_ARayWithoutADirection) {
  expect_error(world.queries().ray_cast({0, 0, 0}, {0, 0, 0}, 1.0), ErrorCode::out_of_range, "direction",
               "ray_cast:");
}

// Bytes.

TEST_F(WrongUse, 42_BytesThatAreNoSnapshot) {
  expect_error(World::restore(std::vector<std::byte>(1000)), ErrorCode::bad_snapshot, "snapshot",
               "World::restore:");
}

TEST_F(WrongUse, 43_ASnapshotCutShort) {
  std::vector<std::byte> bytes = world.save().value();
  bytes.resize(bytes.size() / 2);
  expect_error(World::restore(bytes), ErrorCode::bad_snapshot, "snapshot", "World::restore:");
}

TEST_F(WrongUse, 44_ASnapshotAsARecording) {
  expect_error(Replay::open(world.save().value()), ErrorCode::bad_recording, "recording", "Replay::open:");
}

TEST_F(WrongUse, 45_StoppingARecordingThatWasNeverStarted) {
  expect_error(world.stop_recording(), ErrorCode::not_recording, "world", "stop_recording:");
  world.start_recording().value();
  expect_error(world.start_recording(), ErrorCode::recording, "world", "start_recording:");
}

// Words of the caller.

TEST_F(WrongUse, 46_AToleranceTooSmallForTheBox) {
  expect_error(World::create({.box = Box{{0, 0, 0}, {1, 1, 1e12}}}), ErrorCode::out_of_range,
               "contact_tolerance", "World::create: contact_tolerance must be at least");
}

TEST_F(WrongUse, 47_APlaneThatRepeatsOnZ) {
  expect_error(
      World::create({.box = Box{{0, 0, 0}, {9, 9, 9}}, .periodic = {true, true, true}, .dimensions = 2}),
      ErrorCode::out_of_range, "periodic", "World::create: periodic must be x, y or both");
}

TEST_F(WrongUse, 48_AMotionOfAnotherSimulation) {
  Simulation one(World::create({}).value()), another(World::create({}).value());
  const auto foreign = another.add_motion(std::move(motion));
  expect_error(one.add(foreign, 0), ErrorCode::out_of_range, "motion", "Simulation::add: motion");
}

TEST_F(WrongUse, 49_ContactEventsThatAreNone) {
  WorldDefinition definition;
  definition.contacts = ContactEvents{};
  expect_error(World::create(definition), ErrorCode::out_of_range, "contacts", "World::create:");
  expect_error(world.add({.contacts = static_cast<ContactEvents>(7)}), ErrorCode::out_of_range, "contacts",
               "add: contacts must be impacts, begin_and_end or all");
}

TEST_F(WrongUse, 50_TheBusiestBodiesWithoutProfiling) {
  expect_error(world.inspection().busiest(3), ErrorCode::not_profiling, "world", "busiest:");
}

}  // namespace
}  // namespace kinesphere::wrong_use_test
