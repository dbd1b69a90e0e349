// Equal runs have equal events, to the bit: repeated, in small steps, and after a move of the world.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>

#include "kinesphere/response.hpp"
#include "support/playground.hpp"

namespace kinesphere::determinism_test {
namespace {

std::vector<std::pair<BodyDefinition, Vec3>> crowd() {
  Random random(21);
  std::vector<std::pair<BodyDefinition, Vec3>> bodies;
  for (int k = 0; k < 120; ++k) {
    const double limit = k % 4 == 0 ? 0.0 : 3.0;
    bodies.push_back({{.radius = 0.2 + 0.5 * random.uniform(),
                       .acceleration_limit = limit,
                       .position = {1 + 2.0 * (k % 5), 1 + 2.0 * (k / 5 % 5), 1 + 2.0 * (k / 25)},
                       .velocity = 3.0 * random.point_in_ball()},
                      0.99 * limit * random.point_in_ball()});
  }
  return bodies;
}

WorldDefinition definition(ContactEvents mode) {
  return {.box = Box{{0, 0, 0}, {10, 10, 10}}, .contacts = mode};
}

void answer(Playground& p, const Event& event, ContactEvents mode) {
  if (mode == ContactEvents::begin_and_end || event.approach_speed <= 0) return;
  const Bounce after = bounce(event, 1.0, 1.0, 1.0);
  p.set_velocity(event.first, after.first_velocity);
  if (event.second != no_body) p.set_velocity(event.second, after.second_velocity);
}

class Determinism : public testing::TestWithParam<ContactEvents> {};

INSTANTIATE_TEST_SUITE_P(Modes, Determinism,
                         testing::Values(ContactEvents::begin_and_end, ContactEvents::impacts));

std::vector<Event> run_in_steps(ContactEvents mode, int steps, bool move = false) {
  Playground p(definition(mode));
  for (const auto& [body, acceleration] : crowd()) p.add(body, acceleration);
  std::vector<Event> events;
  for (int k = 1; k <= steps; ++k) {
    const double until = 2.0 * k / steps;
    const auto more = p.run(until, [&](const Event& event) {
      answer(p, event, mode);
      if (!move) return;
      World elsewhere = std::move(p.world);
      World other = World::create({}).value();
      other = std::move(elsewhere);
      p.world = std::move(other);
    });
    events.insert(events.end(), more.begin(), more.end());
  }
  return events;
}

void expect_same(const std::vector<Event>& found, const std::vector<Event>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Event& a = found[k];
    const Event& b = expected[k];
    ASSERT_TRUE(a.time == b.time && a.kind == b.kind && a.first == b.first && a.second == b.second &&
                a.wall == b.wall && a.first_state == b.first_state && a.second_state == b.second_state &&
                a.gap == b.gap && a.normal == b.normal && a.point == b.point && a.repeated == b.repeated)
        << k << ":\n"
        << a << "\n"
        << b;
  }
}

TEST_P(Determinism, AgainInStepsAndMoved) {
  const auto expected = run_in_steps(GetParam(), 1);
  ASSERT_GT(expected.size(), 200u);
  expect_same(run_in_steps(GetParam(), 1), expected);
  expect_same(run_in_steps(GetParam(), 7), expected);
  expect_same(run_in_steps(GetParam(), 20000), expected);
  expect_same(run_in_steps(GetParam(), 3, true), expected);
}

TEST(OrderOfAdding, ChangesNoContact) {
  const auto contacts = [](bool backwards) {
    Playground p(definition(ContactEvents::begin_and_end));
    auto bodies = crowd();
    if (backwards) std::reverse(bodies.begin(), bodies.end());
    for (const auto& [body, acceleration] : bodies) p.add(body, acceleration);
    const auto name = [&](BodyId id) {
      const auto last = static_cast<std::uint32_t>(bodies.size()) - 1;
      return id == no_body ? id.index : backwards ? last - id.index : id.index;
    };
    std::map<std::tuple<std::uint32_t, std::uint32_t, Wall>, std::vector<Event>> found;
    for (const Event& event : p.run(2.0)) {
      const std::pair<std::uint32_t, std::uint32_t> pair =
          std::minmax({name(event.first), name(event.second)});
      found[{pair.first, pair.second, event.wall}].push_back(event);
    }
    return found;
  };
  const auto forwards = contacts(false);
  const auto backwards = contacts(true);
  ASSERT_EQ(forwards.size(), backwards.size());
  for (const auto& [key, events] : forwards) {
    const auto other = backwards.find(key);
    ASSERT_NE(other, backwards.end());
    ASSERT_EQ(events.size(), other->second.size()) << events << other->second;
    for (std::size_t k = 0; k < events.size(); ++k) {
      const Event& a = events[k];
      const Event& b = other->second[k];
      EXPECT_EQ(a.kind, b.kind);
      // Within the tolerance, at the speed at which the pair crosses it.
      const double speed = std::max(0.01, std::abs(a.approach_speed));
      EXPECT_NEAR(a.time, b.time, 2e-6 / speed) << a << "\n" << b;
    }
  }
}

}  // namespace
}  // namespace kinesphere::determinism_test
