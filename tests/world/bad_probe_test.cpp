// Bad probe answers: the call fails and may be repeated; the later results are unaffected.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "support/playground.hpp"

namespace kinesphere::bad_probe_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using Spoil = std::function<void(std::span<const BodyId>, std::span<State>)>;

/// A crowd with several probes at one instant.
void populate(Playground& p) {
  Random random(99);
  for (int k = 0; k < 60; ++k) {
    const BodyDefinition body{
        .radius = 0.35,
        .acceleration_limit = 5,
        .position = {1.0 + 2.0 * (k % 4), 1.0 + 2.0 * (k / 4 % 4), 1.0 + 2.0 * (k / 16)},
        .velocity = 3.0 * random.point_in_ball()};
    p.add(body, 4.9 * random.point_in_ball());
  }
  // Mirror images, with contacts at exactly equal times.
  for (const double sign : {-1.0, 1.0}) {
    p.add({.radius = 0.5, .position = {sign * 20, 0, 0}, .velocity = {-sign, 0, 0}});
    p.add({.radius = 0.5, .position = {sign * 22, 0, 0}, .velocity = {-3 * sign, 0, 0}});
  }
}

struct Kind {
  const char* name;
  ContactEvents mode;
  bool bounces;
};

/// Runs the crowd; `spoil`, if set, ruins the answer to every third probe at first.
std::vector<Event> run(const Kind& kind, const Spoil& spoil, std::uint64_t& failures) {
  Playground p({.contacts = kind.mode});
  populate(p);
  std::vector<Event> events;
  int question = 0;
  bool ruin = false;
  const auto good = p.probe();
  const auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    good(ids, time, states);
    ruin = !ruin && question++ % 3 == 0;
    if (spoil && ruin) spoil(ids, states);
  };
  for (;;) {
    auto result = p.world.advance(2.0, probe);
    if (!result) {
      ++failures;
      EXPECT_LE(p.world.time(), 2.0);
      continue;
    }
    if (!*result) break;
    const Event event = **result;
    events.push_back(event);
    EXPECT_TRUE(is_clean(p.world));
    if (kind.bounces && event.kind == EventKind::contact_begin && event.approach_speed > 0) {
      p.set_velocity(event.first, event.first_state.velocity - event.normal * event.approach_speed);
      p.set_velocity(event.second, event.second_state.velocity + event.normal * event.approach_speed);
    }
  }
  EXPECT_TRUE(is_clean(p.world));
  return events;
}

class BadProbe : public testing::TestWithParam<Kind> {};

TEST_P(BadProbe, RepeatingTheCallGivesTheSameEvents) {
  std::uint64_t failures = 0;
  const std::vector<Event> expected = run(GetParam(), {}, failures);
  ASSERT_EQ(failures, 0u);
  ASSERT_GT(expected.size(), 15u);
  const std::vector<std::pair<const char*, Spoil>> ways{
      {"NaN in the last answer", [](auto, auto states) { states.back().position.y = nan; }},
      {"an infinite velocity in the first",
       [](auto, auto states) { states.front().velocity.z = -1.0 / 0.0; }},
      {"too far away", [](auto, auto states) { states[states.size() / 2].position.x = 1e30; }},
      {"only the first half",
       [](auto, auto states) {
         for (std::size_t k = states.size() / 2; k < states.size(); ++k)
           states[k] = {{nan, nan, nan}, {nan, nan, nan}};
       }},
  };
  for (const auto& [what, spoil] : ways) {
    SCOPED_TRACE(what);
    failures = 0;
    const std::vector<Event> found = run(GetParam(), spoil, failures);
    EXPECT_GT(failures, 20u);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      ASSERT_EQ(found[k].time, expected[k].time) << "\n" << found[k] << "\n" << expected[k];
      ASSERT_EQ(found[k].kind, expected[k].kind);
      ASSERT_EQ(found[k].first, expected[k].first) << "\n" << found[k] << "\n" << expected[k];
      ASSERT_EQ(found[k].second, expected[k].second) << "\n" << found[k] << "\n" << expected[k];
      ASSERT_EQ(found[k].gap, expected[k].gap);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, BadProbe,
                         testing::Values(Kind{"BeginAndEnd", ContactEvents::begin_and_end, true},
                                         Kind{"PassThrough", ContactEvents::begin_and_end, false},
                                         Kind{"Impacts", ContactEvents::impacts, true}),
                         [](const auto& kind) { return kind.param.name; });

TEST(BadAnswer, NamesTheBodyTheTimeAndWhy) {
  Playground p;
  p.add({.radius = 1});
  const BodyId culprit = p.add({.radius = 1, .position = {10, 0, 0}, .velocity = {-1, 0, 0}});
  p.distort = [&](BodyId id, double, State& state) {
    if (id == culprit) state.velocity = {0, nan, 0};
  };
  const auto result = p.world.advance(20.0, p.probe());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::not_finite);
  EXPECT_EQ(result.error().argument, "velocity");
  EXPECT_EQ(result.error().body, culprit);
  EXPECT_NE(result.error().message.find("probe"), std::string::npos) << result.error().message;
  EXPECT_NE(result.error().message.find("body 1"), std::string::npos) << result.error().message;
  // The first answers are the definitions; the bodies meet later, and only then the bad answer matters.
  p.distort = {};
  EXPECT_EQ(p.run(20.0).size(), 2u);
}

TEST(BadAnswer, ProbeThatDoesNotAnswerIsToldSo) {
  Playground p;
  p.add({.velocity = {1, 0, 0}});
  const auto silent = [](std::span<const BodyId>, double, std::span<State>) {};
  const auto result = p.world.advance(1e7, silent);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::not_finite);
  EXPECT_EQ(result.error().argument, "position");
}

TEST(BadAnswer, BodyMayBeRemovedInstead) {
  Playground p;
  const BodyId lost = p.add({.radius = 1, .velocity = {1, 0, 0}});
  const BodyId a = p.add({.radius = 1, .position = {50, 50, 0}, .velocity = {0, -1, 0}});
  const BodyId b = p.add({.radius = 1, .position = {50, 40, 0}});
  p.distort = [&](BodyId id, double, State& state) {
    if (id == lost) state.position.x = nan;
  };
  std::vector<Event> events;
  bool removed = false;
  for (;;) {
    auto result = p.world.advance(1000.0, p.probe());
    if (!result) {
      ASSERT_FALSE(removed);
      EXPECT_EQ(result.error().body, lost);
      p.world.remove(lost).value();
      removed = true;
      continue;
    }
    if (!*result) break;
    events.push_back(**result);
  }
  EXPECT_TRUE(removed);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[0].first, a);
  EXPECT_EQ(events[0].second, b);
  EXPECT_EQ(p.world.time(), 1000.0);
}

TEST(BadAnswer, KicksAndNewBodiesBeforeTheRepetitionCount) {
  Playground p;
  const BodyId a = p.add({.radius = 1, .acceleration_limit = 1, .velocity = {1, 0, 0}});
  // A report matters only with another body nearby.
  p.add({.radius = 1, .position = {-40, 0, 0}});
  bool fail = false;
  p.distort = [&](BodyId, double, State& state) {
    if (fail) state.position.x = nan;
  };
  p.run(1.0);
  fail = true;
  ASSERT_FALSE(p.world.advance(100.0, p.probe()));
  fail = false;
  p.set_velocity(a, {0, 1, 0});
  const Vec3 there = p.state(a).position;
  p.add({.radius = 1, .position = there + Vec3{0, 5, 0}});
  p.steer(a, {0, 0, 0});
  const double time = p.world.time();
  const auto events = p.run(time + 100.0);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_NEAR(events[0].time, time + 3.0, 1e-5);
}

/// A sleeping body near the floor is rechecked as often as may matter. When its reports begin to err towards
/// an approaching body, a recheck finds the two nearer than before, and has to probe.
TEST(BadAnswer, InALookAroundHidesNoContact) {
  std::size_t failures = 0;
  for (int k = 0; k < 60; ++k) {
    const double distance = 1.2 + 0.01 * k;
    Playground p({.box = Box{{0, 0, 0}, {20, 20, 20}}});
    const BodyId resting = p.add(
        {.radius = 0.5, .acceleration_limit = 1, .position_error = 0.1, .position = {2, 10, 0.605}}, Vec3{});
    p.add({.radius = 0.5, .position = {2 + distance, 10, 0.605}, .velocity = {-1, 0, 0}});
    // Far from the pair: swept spheres are as large as bodies are sparse, and last for many rechecks.
    p.add({.radius = 0.5, .position = {18, 2, 18}});
    p.distort = [&](BodyId id, double, State& state) {
      if (id == resting) state.position.x += 0.099;
    };
    bool ruin = false;
    const auto good = p.probe();
    const auto every_other_bad = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
      good(ids, time, states);
      ruin = !ruin;
      if (ruin) states.back().position.x = nan;
    };
    auto event = p.world.advance(10.0, every_other_bad);
    for (; !event; ++failures) event = p.world.advance(10.0, every_other_bad);
    ASSERT_TRUE(*event) << "distance " << distance;
    EXPECT_EQ((*event)->kind, EventKind::contact_begin);
    EXPECT_LE((*event)->time, distance - 1.0 + 1e-6) << "distance " << distance;
  }
  EXPECT_GT(failures, 100u);
}

/// Two pairs meet at one instant; a body of the second pair gives a bad answer when the first contact is
/// already known.
TEST(BadAnswer, TellsNoEventBeforeAllOfItsInstantAreKnown) {
  const auto two_pairs = [](Playground& p) {
    for (const double y : {-16.0, 16.0})
      for (const double side : {-1.0, 1.0})
        p.add({.radius = 1, .position = {3 * side, y, 0}, .velocity = {-side, 0, 0}});
  };
  Playground plain;
  two_pairs(plain);
  const auto expected = plain.run(3.0);
  ASSERT_EQ(of_kind(expected, EventKind::contact_begin).size(), 2u);
  const double instant = expected[0].time;
  ASSERT_EQ(expected[1].time, instant);

  Playground p;
  two_pairs(p);
  std::vector<std::uint32_t> asked;
  bool ruin = true;
  const auto good = p.probe();
  const auto bad_once = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    good(ids, time, states);
    for (std::size_t k = 0; k < ids.size(); ++k) {
      asked.push_back(ids[k].index);
      if (time == instant && ids[k].index == 3 && std::exchange(ruin, false)) states[k].position.x = nan;
    }
  };
  ASSERT_FALSE(p.world.advance(3.0, bad_once));
  EXPECT_EQ(p.world.time(), instant);
  asked.clear();
  const auto event = p.world.advance(3.0, bad_once);
  ASSERT_TRUE(event && *event);
  EXPECT_EQ((*event)->first, expected[0].first);
  EXPECT_EQ((*event)->time, instant);
  std::sort(asked.begin(), asked.end());
  EXPECT_EQ(asked, (std::vector<std::uint32_t>{2, 3})) << "before the event was reported";
}

TEST(Probe, MayNotCallTheWorldThatAskedIt) {
  Playground p;
  const BodyId a = p.add({.velocity = {1, 0, 0}});
  p.add({.position = {9, 0, 0}});
  int asked = 0;
  const auto good = p.probe();
  const auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    ++asked;
    const auto refused = [](const auto& result, std::string_view call) {
      ASSERT_FALSE(result);
      EXPECT_EQ(result.error().code, ErrorCode::probe_in_progress);
      EXPECT_EQ(result.error().message.rfind(call, 0), 0u) << result.error().message;
    };
    refused(p.world.add(BodyDefinition{}), "add");
    refused(p.world.add_all(std::vector<BodyDefinition>(2)), "add_all");
    refused(p.world.reserve(5), "reserve");
    refused(p.world.remove(a), "remove");
    refused(p.world.set_velocity(a, {}), "set_velocity");
    refused(p.world.teleport(a, {}), "teleport");
    refused(p.world.change(a, {.radius = 1}), "change");
    refused(p.world.change(a, {.motion_limits = MotionLimits{}}), "change");
    refused(p.world.disable(a), "disable");
    refused(p.world.enable(a, {}), "enable");
    refused(p.world.change(a, {.filter = Filter{}}), "change");
    refused(p.world.set_pair_filter({}), "set_pair_filter");
    refused(p.world.refresh_filter(a), "refresh_filter");
    refused(p.world.change(a, {.user_data = 1}), "change");
    refused(p.world.remove({}), "remove");
    refused(p.world.set_velocities({}, {}), "set_velocities");
    refused(p.world.advance(1e9, p.probe()), "advance");
    EXPECT_TRUE(p.world.contains(a));
    EXPECT_EQ(p.world.size(), 2u);
    good(ids, time, states);
  };
  int events = 0;
  while (p.world.advance(20.0, probe).value()) ++events;
  EXPECT_EQ(events, 2);
  EXPECT_GT(asked, 0);
  EXPECT_TRUE(p.world.add({.position = {0, 99, 0}}));
}

TEST(Probe, ThatThrowsLeavesAWorldThatGoesOn) {
  Playground p;
  for (int k = 0; k < 8; ++k)
    p.add({.radius = 0.5,
           .acceleration_limit = 1,
           .position = {4.0 * k, 0, 0},
           .velocity = {k < 4 ? 1.0 : -1.0, 0, 0}},
          Vec3{});
  int question = 0;
  const auto good = p.probe();
  const auto moody = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    if (question++ % 2 == 0) throw std::runtime_error("no connection");
    good(ids, time, states);
  };
  std::size_t begins = 0;
  for (;;) {
    try {
      auto event = p.world.advance(10.0, moody).value();
      if (!event) break;
      if (event->kind == EventKind::contact_begin) ++begins;
    } catch (const std::runtime_error&) {
      ASSERT_LT(question, 100000);
    }
  }
  EXPECT_EQ(begins, 13u)
      << "each of the 4 from the left meets each of the 4 from the right that is near enough";
}

}  // namespace
}  // namespace kinesphere::bad_probe_test
