// A failure on one rank ends the run on all of them, with one message that names rank and body.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "distributed/one_world.hpp"
#include "simulation/scene/make_scene.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::distributed_failures_test {
namespace {

Scene scene() {
  SceneParameters parameters;
  parameters.bodies = 200;
  parameters.seconds = 1.0;
  parameters.box.upper = {110, 110, 110};
  return make_scene(parameters).value();
}

/// Expects that the error is equal on all ranks.
void expect_everywhere(const Result<void>& result, ErrorCode code, const std::string& part) {
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, code);
  EXPECT_NE(result.error().message.find(part), std::string::npos) << result.error().message;
  EXPECT_EQ(result.error().message.rfind("rank ", 0), 0u) << result.error().message;
  std::vector<std::byte> bytes;
  for (const char c : result.error().message) bytes.push_back(static_cast<std::byte>(c));
  Communicator communicator;
  for (const auto& others : communicator.gather(bytes)) EXPECT_EQ(others, bytes);
}

struct Fixture {
  Setting setting{.scene = scene()};
  std::unique_ptr<Motion> motion = setting.scene.motion->clone();
  DistributedWorld world = spread(setting, *motion);

  Result<void> run(const ResponseFn& respond, const OrderedEventFn& sink) {
    return world.run(setting.scene.end_time, respond, sink);
  }
  void expect_over() {
    const auto again = world.run(setting.scene.end_time, [](const OrderedEvent&) {});
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().code, ErrorCode::rank_failed);
  }
};

/// A motion that fails for one body.
class Failing final : public Motion {
 public:
  explicit Failing(std::unique_ptr<Motion> inner) : inner_(std::move(inner)) {}
  std::size_t size() const override { return inner_->size(); }
  bool contains(std::uint32_t body) const override { return inner_->contains(body); }
  BodyDefinition definition(std::uint32_t body, double t) const override {
    return inner_->definition(body, t);
  }
  State state(std::uint32_t body, double t) const override {
    State state = inner_->state(body, t);
    if (t > 0.5 && fails) state.velocity.x = std::numeric_limits<double>::quiet_NaN();
    if (t > 0.5 && throws) throw std::runtime_error("the sensor of body is broken");
    return state;
  }
  Trajectory trajectory(std::uint32_t body, double begin, double end) const override {
    return inner_->trajectory(body, begin, end);
  }
  Result<void> set_velocity(std::uint32_t body, double t, const Vec3& velocity) override {
    return inner_->set_velocity(body, t, velocity);
  }
  MotionOrigin origin(std::uint32_t body) const override { return inner_->origin(body); }
  Result<void> set_origin(std::uint32_t body, const MotionOrigin& origin) override {
    return inner_->set_origin(body, origin);
  }
  Result<void> remove(std::uint32_t body) override { return inner_->remove(body); }
  Result<void> write_body(std::uint32_t body, std::vector<std::byte>& bytes) const override {
    if (writing.fails_now()) return full("write_body");
    return inner_->write_body(body, bytes);
  }
  Result<std::uint32_t> read_body(std::span<const std::byte>& bytes) override {
    if (reading.fails_now()) return full("read_body");
    return inner_->read_body(bytes);
  }
  std::unique_ptr<Motion> clone() const override { return inner_->clone(); }

  bool fails = false;
  bool throws = false;
  /// A call that fails after a number of successful ones.
  struct Calls {
    int left = std::numeric_limits<int>::max();
    bool throws = false;

    bool fails_now() {
      const bool now = left-- == 0;
      if (now && throws) throw std::runtime_error("no room for this body");
      return now;
    }
  };
  mutable Calls writing{};
  Calls reading{};

 private:
  static Error full(const std::string& call) {
    return {ErrorCode::unsupported, "body", no_body, call + ": no room for this body"};
  }
  std::unique_ptr<Motion> inner_;
};

TEST(DistributedFailures, OfAProbeEndAllRanks) {
  for (const bool throws : {false, true}) {
    const Setting setting{.scene = scene()};
    Failing motion(setting.scene.motion->clone());
    DistributedWorld world = spread(setting, motion);
    // Only the last rank's motion fails.
    if (world.rank() == world.ranks() - 1) (throws ? motion.throws : motion.fails) = true;
    const auto done = world.run(setting.scene.end_time, [](const OrderedEvent&) {});
    const std::string rank = "rank " + std::to_string(world.ranks() - 1) + ": ";
    if (throws) {
      expect_everywhere(done, ErrorCode::callback_threw, rank + "the sensor of body is broken");
    } else {
      expect_everywhere(done, ErrorCode::not_finite, rank + "run: ");
      EXPECT_NE(done.error().body, no_body);
    }
  }
}

/// In a dense gas bodies change ranks when windows start, while clusters run, and at the end of a batch.
TEST(DistributedFailures, OfBodiesThatCannotMoveEndAllRanks) {
  SceneParameters parameters;
  for (const SceneParameters& built_in : built_in_scenes())
    if (built_in.name == "gas") parameters = built_in;
  parameters.bodies = 220;
  parameters.seconds = 0.5;
  parameters.packing = 0.45;
  const Setting setting{.scene = make_scene(parameters).value(), .sensors = true};
  // With one rank no body migrates.
  if (Communicator().ranks() == 1) return;
  for (const bool throws : {false, true}) {
    for (int good_ones = 0; good_ones < 300; good_ones += 7) {
      for (const bool writes : {false, true}) {
        SCOPED_TRACE(std::to_string(good_ones) + (writes ? " written" : " read"));
        Failing motion(setting.scene.motion->clone());
        DistributedWorld world = spread(setting, motion);
        if (world.rank() == world.ranks() - 1)
          (writes ? motion.writing : motion.reading) = {good_ones, throws};
        const auto done = world.run(
            setting.scene.end_time, [&](const Event& event) { return setting.answer(event); },
            [](const OrderedEvent&) {});
        const std::string rank = "rank " + std::to_string(world.ranks() - 1) + ": ";
        const bool as_error = !throws && !writes;
        expect_everywhere(done, as_error ? ErrorCode::unsupported : ErrorCode::callback_threw, rank);
        EXPECT_NE(done.error().message.find("no room for this body"), std::string::npos);
      }
    }
  }
}

TEST(DistributedFailures, OfAnAnswerEndAllRanks) {
  Fixture fixture;
  const ResponseFn respond = [&](const Event& event) {
    Response answer = fixture.setting.answer(event);
    if (event.time > 0.4 && answer.first_velocity) answer.first_velocity->y = std::nan("");
    return answer;
  };
  expect_everywhere(fixture.run(respond, [](const OrderedEvent&) {}), ErrorCode::not_finite,
                    "run: respond: first_velocity at ");
  fixture.expect_over();
}

TEST(DistributedFailures, OfAnActionEndAllRanks) {
  for (const Response& given : {Response{.first_action = BodyAction::remove}, Response{.stop = true}}) {
    Fixture fixture;
    const ResponseFn respond = [&](const Event& event) {
      return event.time > 0.4 ? given : fixture.setting.answer(event);
    };
    expect_everywhere(fixture.run(respond, [](const OrderedEvent&) {}), ErrorCode::unsupported,
                      "run: respond: a distributed world accepts velocities");
    fixture.expect_over();
  }
}

TEST(DistributedFailures, OfTheSinkEndAllRanks) {
  Fixture fixture;
  const ResponseFn respond = [&](const Event& event) { return fixture.setting.answer(event); };
  const auto sink = [&](const OrderedEvent& event) {
    if (fixture.world.rank() == 0 && event.event.time > 0.3) throw std::runtime_error("the disk is full");
  };
  expect_everywhere(fixture.run(respond, sink), ErrorCode::callback_threw,
                    "rank 0: run: sink: the disk is full");
  fixture.expect_over();
}

TEST(DistributedFailures, OfNamesThatAreThereTwice) {
  Fixture fixture;
  if (fixture.world.ranks() == 1) return;
  const std::uint32_t index = fixture.world.rank() == 1 ? 0 : 1000 + std::uint32_t(fixture.world.rank());
  const std::unique_ptr<Motion> more = fixture.setting.scene.motion->clone();
  const std::uint32_t mine =
      fixture.world.rank() == 0 ? 0u : static_cast<std::uint32_t>(fixture.world.rank());
  fixture.world.add(index, fixture.setting.body(mine), mine).value();
  expect_everywhere(fixture.run([](const Event&) { return Response{}; }, [](const OrderedEvent&) {}),
                    ErrorCode::out_of_range, "index must be that of no other body");
}

TEST(DistributedFailures, OfArguments) {
  Fixture fixture;
  DistributedWorld& world = fixture.world;
  const auto rank = static_cast<std::uint32_t>(world.rank());
  expect_error(world.add(rank, fixture.setting.body(rank), rank), ErrorCode::out_of_range, "index",
               "add: ", {rank, 0, 0});
  expect_error(world.add(7777, fixture.setting.body(rank), 100'000), ErrorCode::unknown_body,
               "number_in_motion", "add: ", {7777, 0, 0});
  BodyDefinition body = fixture.setting.body(rank);
  body.radius = -1.0;
  expect_error(world.add(7777, body, rank), ErrorCode::out_of_range, "radius", "add: ");
  expect_everywhere(world.set_sensor(1, {.distances = {-1.0}}), ErrorCode::out_of_range,
                    "rank 0: set_sensor: sensor");
  const auto silent = [](const OrderedEvent&) {};
  Setting bad{.scene = scene()};
  bad.scene.world.contact_tolerance = -1.0;
  const auto created = DistributedWorld::create(bad.scene.world, *fixture.motion);
  ASSERT_FALSE(created);
  EXPECT_EQ(created.error().argument, "contact_tolerance");
  WorldDefinition strict;
  strict.allow_overlap = false;
  const auto refused = DistributedWorld::create(strict, *fixture.motion);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
  expect_everywhere(world.run(std::nan(""), silent), ErrorCode::not_finite, "run: until");
}

TEST(DistributedFailures, OfSensorsThatComeAfterABodyOfAnyRankLeaveTheWorldAsItWas) {
  const Setting setting{.scene = scene()};
  const std::unique_ptr<Motion> motion = setting.scene.motion->clone();
  DistributedWorld world = DistributedWorld::create(setting.scene.world, *motion).value();
  const int last = world.ranks() - 1;
  if (world.rank() == last) world.add(0, setting.body(0), 0).value();
  expect_everywhere(world.set_sensor(1, {.distances = {1.0}}), ErrorCode::unsupported,
                    "rank " + std::to_string(last) + ": set_sensor");
  EXPECT_TRUE(world.run(0.1, [](const OrderedEvent&) {}));
}

}  // namespace
}  // namespace kinesphere::distributed_failures_test
