// Promises so loose that time would practically never reach the end of a call: an error names the body.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::loose_promise_test {
namespace {

/// Bodies that lie in a row, far from each other, of which one promises nearly nothing.
struct Row {
  explicit Row(const BodyDefinition& loose, int others = 40, double start_time = 0.0)
      : world(World::create({.start_time = start_time}).value()) {
    for (int k = 0; k < others; ++k)
      world.add({.acceleration_limit = 1, .position = {10.0 * (k + 1), 0, 0}}).value();
    body = world.add(loose).value();
  }
  auto probe() const {
    return [others = body.index](std::span<const BodyId> ids, double, std::span<State> states) {
      for (std::size_t k = 0; k < ids.size(); ++k)
        states[k] = {{ids[k].index < others ? 10.0 * (ids[k].index + 1) : 0.0, 0, 0}, {}};
    };
  }

  World world;
  BodyId body;
};

TEST(LoosePromise, IsNamedAndTimeGoesOnWithATighterOne) {
  Row row({.acceleration_limit = 1e30}, 2, -1.0);
  const auto stuck = row.world.advance(9.0, row.probe());
  expect_error(stuck, ErrorCode::out_of_range, "acceleration_limit",
               "advance: acceleration_limit of body 2 must let time reach 9, but is 1e+30", row.body);
  EXPECT_LT(row.world.time(), -0.9);
  row.world.change(row.body, {.motion_limits = MotionLimits{.acceleration_limit = 1e3}}).value();
  EXPECT_FALSE(row.world.advance(9.0, row.probe()).value());
  EXPECT_EQ(row.world.time(), 9.0);
}

TEST(LoosePromise, IsNamedInARunToo) {
  Row alone({.acceleration_limit = 1e30}, 2);
  const auto sink = [](const Event&) {};
  expect_error(alone.world.run(1.0, alone.probe(), sink), ErrorCode::out_of_range, "acceleration_limit",
               "run: ", alone.body);
  Workers workers = Workers::create(2).value();
  Row row({.acceleration_limit = 1e30});
  expect_error(row.world.run(1.0, row.probe(), sink, &workers), ErrorCode::out_of_range, "acceleration_limit",
               "run: ", row.body);
}

TEST(LoosePromise, NamesWhatIsLoose) {
  Row errors({.velocity_error = 1e20}, 1);
  expect_error(errors.world.advance(1.0, errors.probe()), ErrorCode::out_of_range, "velocity_error",
               "advance: ", errors.body);
}

TEST(LoosePromise, IsNoneIfTheEndIsWithinReach) {
  // Windows of nanoseconds, and a time of nanoseconds: atoms in units of metres and seconds.
  Row atoms({.acceleration_limit = 1e16}, 2);
  EXPECT_TRUE(atoms.world.advance(1e-9, atoms.probe()));
  EXPECT_EQ(atoms.world.time(), 1e-9);
  // A call with no end in mind.
  Row patient({.acceleration_limit = 1e16}, 0);
  int asked = 0;
  // In more instants than Pace counts before it looks how far time has gone.
  constexpr int most_asked = 1'200'000;
  const auto until_tired = [&](std::span<const BodyId>, double, std::span<State> states) {
    if (++asked > most_asked) throw std::runtime_error("enough");
    std::fill(states.begin(), states.end(), State{});
  };
  EXPECT_THROW((void)patient.world.advance(1e12, until_tired), std::runtime_error);
  EXPECT_GT(patient.world.counters().starts, 1u << 20);
  // Without limits time may go as far as it can.
  Row still({}, 0);
  EXPECT_TRUE(still.world.advance(1e30, still.probe()));
}

}  // namespace
}  // namespace kinesphere::loose_promise_test
