// Ways to pass a probe: by name, as a temporary, as a function, and empty.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <memory>

#include "kinesphere/certificates.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/probe.hpp"
#include "kinesphere/queries.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"

namespace kinesphere::lent_probe_test {
namespace {

void stand_still(std::span<const BodyId> ids, double, std::span<State> states) {
  for (std::size_t k = 0; k < ids.size(); ++k) states[k] = {{10.0 * ids[k].index, 0, 0}, {}};
}

State answer(const Probe& probe) {
  const BodyId id{0, 0};
  State state;
  probe(std::span(&id, 1), 0.0, std::span(&state, 1));
  return state;
}

/// Overwrites the part of the stack that held a temporary.
[[gnu::noinline]] double disturb_stack() {
  volatile double numbers[512];
  for (volatile double& number : numbers) number = -1.0;
  return numbers[17];
}

TEST(LentProbe, OwnsATemporary) {
  const double x = 7.0;
  const Probe small = [x](std::span<const BodyId>, double, std::span<State> states) {
    states[0] = {{x, 0, 0}, {}};
  };
  const std::array<double, 40> table{1.0, 2.0, 3.0};
  const Probe large = [table](std::span<const BodyId>, double, std::span<State> states) {
    states[0] = {{table[0], table[1], table[2]}, {}};
  };
  disturb_stack();
  EXPECT_EQ(answer(small).position, (Vec3{7, 0, 0}));
  EXPECT_EQ(answer(large).position, (Vec3{1, 2, 3}));
}

TEST(LentProbe, OwnsOneThatCannotBeCopied) {
  Probe probe = [number = std::make_unique<double>(5.0)](std::span<const BodyId>, double,
                                                         std::span<State> states) {
    states[0] = {{*number, 0, 0}, {}};
  };
  const Probe copy = probe;
  probe = &stand_still;
  EXPECT_EQ(answer(copy).position.x, 5.0);
  EXPECT_EQ(answer(probe).position.x, 0.0);
}

TEST(LentProbe, CopiesShareWhatTheyOwn) {
  const Probe counting = [calls = 0](std::span<const BodyId>, double, std::span<State> states) mutable {
    states[0] = {{double(++calls), 0, 0}, {}};
  };
  const Probe copy = counting;  // NOLINT(performance-unnecessary-copy-initialization): that is what is tested
  EXPECT_EQ(answer(counting).position.x, 1.0);
  EXPECT_EQ(answer(copy).position.x, 2.0);
  EXPECT_EQ(answer(counting).position.x, 3.0);
}

TEST(LentProbe, RefersToWhatHasAName) {
  auto calls = 0;
  auto counting = [&calls](std::span<const BodyId>, double, std::span<State>) { ++calls; };
  const Probe probe = counting;
  (void)answer(probe);
  const auto fixed = counting;
  (void)answer(Probe(fixed));
  EXPECT_EQ(calls, 2);
}

TEST(LentProbe, OfAMotionMayBeKept) {
  Ballistic motion = Ballistic::create({.start = {{{0, 0, 0}, {1, 0, 0}}, {{10, 0, 0}, {}}}}).value();
  World world = World::create({}).value();
  world.add({.velocity = {1, 0, 0}}).value();
  world.add({.position = {10, 0, 0}}).value();
  Probe probe = motion.probe();
  disturb_stack();
  const auto event = world.advance(100, probe).value();
  ASSERT_TRUE(event);
  EXPECT_NEAR(event->time, 8.0, 1e-6);
}

TEST(LentProbe, ThatIsEmptyIsRefusedByName) {
  static_assert(!std::is_constructible_v<Probe, std::nullptr_t>);
  static_assert(!std::is_invocable_v<decltype(&World::advance), World&, double, std::nullptr_t>);
  World world = World::create({}).value();
  const BodyId a = world.add({}).value();
  const BodyId b = world.add({.position = {10, 0, 0}}).value();
  const std::function<void(std::span<const BodyId>, double, std::span<State>)> unset;
  Probe::Function function = nullptr;
  for (const Probe& probe : {Probe(function), Probe(unset)}) {
    EXPECT_FALSE(probe);
    const auto refused = [](const auto& result, const std::string& call) {
      expect_error(result, ErrorCode::null_probe, "probe", call);
    };
    refused(world.advance(1, probe), "advance");
    refused(world.certificates(probe).safe_until(), "safe_until");
    refused(world.certificates(probe).safe_until(a), "safe_until");
    refused(world.certificates(probe).safe_until(a, b), "safe_until");
    refused(world.certificates(probe).earliest_contact(a), "earliest_contact");
    refused(world.certificates(probe).distance_limits(a, b, 1.0), "distance_limits");
    refused(world.queries(probe).overlapping({0, 0, 0}, 1.0), "overlapping");
    refused(world.queries(probe).overlapping(Box{{0, 0, 0}, {1, 1, 1}}), "overlapping");
    refused(world.queries(probe).nearest({0, 0, 0}, 1), "nearest");
    refused(world.queries(probe).ray_cast({0, 0, 0}, {1, 0, 0}, 1.0), "ray_cast");
    refused(world.queries(probe).sphere_cast({0, 0, 0}, 1.0, {1, 0, 0}, 1.0), "sphere_cast");
  }
  function = &stand_still;
  EXPECT_TRUE(world.advance(1, function));
}

}  // namespace
}  // namespace kinesphere::lent_probe_test
