// Certificates as answers: never late, as sharp as the bounds allow, and consistent with and without a probe.
#include <gtest/gtest.h>

#include <algorithm>

#include "kinesphere/certificates.hpp"
#include "kinesphere/queries.hpp"
#include "number/infinity.hpp"
#include "support/expect_error.hpp"
#include "world/crowd.hpp"

namespace kinesphere::answers_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool begins(const Event& event) {
  return event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
}

/// An answer: no begin that concerns these bodies (no_body: any body) comes before `time`.
struct Claim {
  BodyId first = no_body;
  BodyId second = no_body;
  double time;

  bool concerns(const Event& event) const {
    const auto with = [&](BodyId id) { return id == no_body || event.first == id || event.second == id; };
    return with(first) && with(second);
  }
};

class Answers : public testing::TestWithParam<CrowdKind> {
 protected:
  Answers() : crowd(GetParam()) {}

  /// Makes a few queries, half of them with the probe. Checks at once what they say about the present.
  void ask() {
    World& world = crowd.world;
    const BodyId a = crowd.any();
    BodyId b = crowd.any();
    while (b == a) b = crowd.any();
    const bool probe = crowd.random.uniform() < 0.5;
    const std::uint64_t probes = world.counters().probes;
    const auto pair =
        probe ? world.certificates(crowd.probe()).safe_until(a, b) : world.certificates().safe_until(a, b);
    const auto body =
        probe ? world.certificates(crowd.probe()).safe_until(a) : world.certificates().safe_until(a);
    const auto all =
        probe ? world.certificates(crowd.probe()).safe_until() : world.certificates().safe_until();
    const auto contact = probe ? world.certificates(crowd.probe()).earliest_contact(a)
                               : world.certificates().earliest_contact(a);
    ASSERT_EQ(world.counters().probes > probes,
              pair->probed || body->probed || all->probed || contact->probed);
    claims.push_back({a, b, pair->time});
    claims.push_back({a, no_body, body->time});
    claims.push_back({no_body, no_body, all->time});
    ASSERT_GE(all->time, world.time());
    ASSERT_EQ(contact->time, world.certificates().safe_until(a)->time);
    ASSERT_EQ(contact->partner == no_body && contact->wall == Wall::none, contact->time == infinity);
    if (contact->partner != no_body) {
      ASSERT_NEAR(contact->time, world.certificates().safe_until(a, contact->partner)->time, 1e-12);
    }
    for (const SafeTime& answer : {*pair, *body, *all}) {
      if (answer.touching) {
        ASSERT_EQ(answer.time, world.time());
      }
    }
    ask_distance(a, b, probe);
  }

  void ask_distance(BodyId a, BodyId b, bool probe) {
    World& world = crowd.world;
    for (const double ahead : {0.0, 0.01, 0.3, 2.0}) {
      const double time = world.time() + ahead;
      const auto limits = probe ? world.certificates(crowd.probe()).distance_limits(a, b, time)
                                : world.certificates().distance_limits(a, b, time);
      const double gap = crowd.gap(a, b, time);
      ASSERT_LE(limits->lower, gap + 1e-12) << "at " << world.time() << " for " << time;
      ASSERT_GE(limits->upper, gap - 1e-12) << "at " << world.time() << " for " << time;
      if (probe && ahead == 0.0) {
        ASSERT_LE(limits->upper - limits->lower, 8.0 * GetParam().noise + 1e-10);
      }
    }
  }

  /// The answer for the whole world must be the least of the answers for all pairs and walls.
  void compare_with_all_pairs() {
    const World& world = crowd.world;
    const std::vector<BodyId> ids = world.bodies();
    double first = infinity;
    for (const BodyId a : ids) {
      double first_of_body = infinity;
      for (const BodyId b : ids)
        if (a != b) first_of_body = std::min(first_of_body, world.certificates().safe_until(a, b)->time);
      const auto contact = world.certificates().earliest_contact(a);
      if (contact->wall == Wall::none) {
        ASSERT_NEAR(contact->time, first_of_body, 1e-9);
      } else {
        ASSERT_LE(contact->time, first_of_body + 1e-9);
      }
      first = std::min(first, contact->time);
    }
    ASSERT_NEAR(world.certificates().safe_until()->time, first, 1e-9);
  }

  void check(const Event& event) {
    ASSERT_NE(event.kind, EventKind::bound_violation) << event;
    if (!begins(event)) return;
    for (const Claim& set : claims) {
      if (set.concerns(event)) {
        ASSERT_GE(event.time, set.time) << set.first << " " << set.second << " " << event;
      }
    }
  }

  Crowd crowd;
  std::vector<Claim> claims;
};

TEST_P(Answers, AreNeverLaterThanWhatHappens) {
  std::size_t begun = 0;
  for (int stop = 1; stop <= 80; ++stop) {
    claims.clear();
    // Queries also before the world has processed the changes.
    for (int k = 0; k < 5; ++k) ASSERT_NO_FATAL_FAILURE(ask());
    if (stop % 8 == 1) {
      ASSERT_NO_FATAL_FAILURE(compare_with_all_pairs());
    }
    while (const auto event = crowd.advance(-1.0 + 0.05 * stop)) {
      if (begins(*event)) ++begun;
      ASSERT_NO_FATAL_FAILURE(check(*event)) << "stop " << stop;
      ASSERT_NO_FATAL_FAILURE(ask());
      if (stop % 8 == 0) {
        ASSERT_NO_FATAL_FAILURE(compare_with_all_pairs());
      }
      if (GetParam().mode == ContactEvents::impacts && begins(*event)) {
        crowd.bounce(*event);
        claims.clear();
        ASSERT_NO_FATAL_FAILURE(ask());
      }
    }
    ASSERT_TRUE(is_clean(crowd.world));
    for (int k = 0; k < 5; ++k) ASSERT_NO_FATAL_FAILURE(ask());
    for (int k = 0; k < 4; ++k) crowd.change();
  }
  EXPECT_GT(begun, 5u);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Answers, crowd_kinds());

TEST(SafeUntil, IsSharpForBallisticBodies) {
  Playground p;
  const BodyId a = p.add({.radius = 1, .position = {0, 0, 0}, .velocity = {1, 0, 0}});
  const BodyId b = p.add({.radius = 1, .position = {10, 0, 0}, .velocity = {-1, 0, 0}});
  const BodyId c = p.add({.radius = 1, .position = {0, 50, 0}, .velocity = {0, 1, 0}});
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(p.world.certificates().safe_until(a, b)->time, 4.0, 1e-5);
    EXPECT_NEAR(p.world.certificates().safe_until(b)->time, 4.0, 1e-5);
    EXPECT_NEAR(p.world.certificates().safe_until()->time, 4.0, 1e-5);
    EXPECT_EQ(p.world.certificates().earliest_contact(a)->partner, b);
    EXPECT_EQ(p.world.certificates().earliest_contact(b)->partner, a);
    EXPECT_EQ(p.world.certificates().safe_until(a, c)->time, infinity);
    EXPECT_EQ(p.world.certificates().safe_until(c)->time, infinity);
    EXPECT_EQ(p.world.certificates().earliest_contact(c)->partner, no_body);
    EXPECT_FALSE(p.world.certificates().safe_until()->touching);
    EXPECT_FALSE(p.advance(1.0 + k));
  }
}

TEST(SafeUntil, NamesTheWall) {
  Playground p({.box = Box{{0, 0, 0}, {10, 10, 10}}});
  const BodyId a = p.add({.radius = 1, .position = {5, 5, 5}, .velocity = {0, -1, 0}});
  const auto contact = p.world.certificates().earliest_contact(a);
  EXPECT_EQ(contact->wall, Wall::y_lower);
  EXPECT_EQ(contact->partner, no_body);
  EXPECT_NEAR(contact->time, 4.0, 1e-5);
  const auto event = p.advance(10.0);
  ASSERT_TRUE(event);
  EXPECT_GE(event->time, contact->time);
  EXPECT_TRUE(p.world.certificates().earliest_contact(a)->touching);
  EXPECT_EQ(p.world.certificates().earliest_contact(a)->wall, Wall::y_lower);
  EXPECT_EQ(p.world.certificates().safe_until()->time, p.world.time());
}

TEST(SafeUntil, IsNowWhileTouching) {
  Playground p;
  const BodyId a = p.add({.radius = 1, .position = {0, 0, 0}, .velocity = {1, 0, 0}});
  const BodyId b = p.add({.radius = 1, .position = {3, 0, 0}});
  ASSERT_TRUE(p.advance(10.0));
  for (const SafeTime& answer :
       {*p.world.certificates().safe_until(a, b), *p.world.certificates().safe_until(a),
        *p.world.certificates().safe_until(), *p.world.certificates(p.probe()).safe_until(a, b)}) {
    EXPECT_EQ(answer.time, p.world.time());
    EXPECT_TRUE(answer.touching);
    EXPECT_FALSE(answer.probed);
  }
  EXPECT_TRUE(p.world.certificates().earliest_contact(b)->touching);
  EXPECT_EQ(p.world.certificates().earliest_contact(b)->partner, a);
}

TEST(SafeUntil, AProbeMakesItLater) {
  Playground p;
  const BodyId a = p.add({.radius = 1, .acceleration_limit = 1, .position = {0, 0, 0}}, Vec3{});
  const BodyId b = p.add({.radius = 1, .acceleration_limit = 1, .position = {100, 0, 0}}, Vec3{});
  EXPECT_FALSE(p.advance(7.0));
  EXPECT_FALSE(p.world.certificates().safe_until(a, b)->probed);
  const double before = p.world.certificates().safe_until(a, b)->time;
  const auto probed = p.world.certificates(p.probe()).safe_until(a, b);
  EXPECT_TRUE(probed->probed);
  EXPECT_GT(probed->time, before + 1.0);
  EXPECT_FALSE(p.world.certificates(p.probe()).safe_until(a, b)->probed) << "reports are fresh now";
  EXPECT_EQ(p.world.certificates().safe_until()->time, probed->time);
}

TEST(SafeUntil, OfNobodyIsForEver) {
  World world = World::create({}).value();
  EXPECT_EQ(world.certificates().safe_until()->time, infinity);
  const BodyId only = world.add({.acceleration_limit = 1}).value();
  EXPECT_EQ(world.certificates().safe_until()->time, infinity);
  EXPECT_EQ(world.certificates().safe_until(only)->time, infinity);
}

TEST(SafeUntil, TakesAKickIntoAccountBeforeTheNextAdvance) {
  Playground p;
  const BodyId a = p.add({.radius = 1, .position = {0, 0, 0}, .velocity = {-1, 0, 0}});
  const BodyId b = p.add({.radius = 1, .position = {10, 0, 0}});
  EXPECT_FALSE(p.advance(2.0));
  EXPECT_EQ(p.world.certificates().safe_until(a, b)->time, infinity);
  p.set_velocity(a, {1, 0, 0});
  EXPECT_NEAR(p.world.certificates().safe_until(a, b)->time, 12.0, 1e-5);
  EXPECT_NEAR(p.world.certificates().distance_limits(a, b, 7.0)->upper, 5.0, 1e-9);
}

TEST(AnswersWithProbe, TellOfABrokenPromise) {
  Playground p;
  const BodyId a = p.add({.radius = 1, .position = {0, 0, 0}});
  const BodyId b = p.add({.radius = 1, .position = {10, 0, 0}});
  EXPECT_FALSE(p.advance(1.0));
  p.set_position(a, {4, 0, 0});
  const auto limits = p.world.certificates(p.probe()).distance_limits(a, b, 1.0);
  EXPECT_NEAR(limits->lower, 4.0, 1e-9);
  EXPECT_NEAR(limits->upper, 4.0, 1e-9);
  const auto event = p.advance(2.0);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::bound_violation);
  EXPECT_EQ(event->first, a);
  EXPECT_TRUE(is_clean(p.world));
}

/// Queries without a probe must not influence later results.
TEST(AnswersWithoutProbe, ChangeNothing) {
  const auto hash = [](bool ask) {
    Crowd crowd({ContactEvents::begin_and_end, true, 0.0, 40, 9});
    for (int stop = 1; stop <= 20; ++stop) {
      while (crowd.advance(-1.0 + 0.05 * stop)) {
        if (!ask) continue;
        const std::vector<BodyId> ids = crowd.world.bodies();
        (void)crowd.world.certificates().safe_until();
        (void)crowd.world.certificates().earliest_contact(ids[0]);
        (void)crowd.world.certificates().distance_limits(ids[0], ids[1], 3.0);
        (void)crowd.world.queries().overlapping({5, 5, 5}, 2.0);
        (void)crowd.world.queries().nearest({5, 5, 5}, 3);
        (void)crowd.world.queries().ray_cast({0, 0, 0}, {1, 1, 1}, 20.0);
      }
      for (int k = 0; k < 3; ++k) crowd.change();
    }
    return crowd.hash.value();
  };
  EXPECT_EQ(hash(true), hash(false));
}

TEST(WrongQuestions, AreRefused) {
  Playground p({.start_time = 3.0});
  const BodyId a = p.add({.radius = 1});
  const BodyId gone = p.add({.radius = 1, .position = {5, 0, 0}});
  p.world.remove(gone).value();
  for (const auto& [wrong, code] :
       {std::pair(gone, ErrorCode::stale_body), std::pair(BodyId{9, 0}, ErrorCode::unknown_body)}) {
    expect_error(p.world.certificates().safe_until(wrong), code, "body", "safe_until:", wrong);
    expect_error(p.world.certificates(p.probe()).safe_until(wrong), code, "body", "safe_until:", wrong);
    expect_error(p.world.certificates().safe_until(a, wrong), code, "body", "safe_until:", wrong);
    expect_error(p.world.certificates(p.probe()).safe_until(wrong, a), code, "body", "safe_until:", wrong);
    expect_error(p.world.certificates().earliest_contact(wrong), code, "body", "earliest_contact:", wrong);
    expect_error(p.world.certificates(p.probe()).earliest_contact(wrong), code, "body",
                 "earliest_contact:", wrong);
    expect_error(p.world.certificates().distance_limits(wrong, a, 4.0), code, "body",
                 "distance_limits:", wrong);
    expect_error(p.world.certificates(p.probe()).distance_limits(a, wrong, 4.0), code, "body",
                 "distance_limits:", wrong);
  }
  expect_error(p.world.certificates().safe_until(a, a), ErrorCode::out_of_range, "second", "safe_until:", a);
  expect_error(p.world.certificates().distance_limits(a, a, 4.0), ErrorCode::out_of_range, "second",
               "distance_limits:", a);
  const BodyId b = p.add({.radius = 1, .position = {5, 0, 0}});
  expect_error(p.world.certificates().distance_limits(a, b, 2.9), ErrorCode::time_backwards, "time",
               "distance_limits:");
  expect_error(p.world.certificates(p.probe()).distance_limits(a, b, 2.9), ErrorCode::time_backwards, "time",
               "distance_limits:");
  for (const double bad : {nan, infinity})
    expect_error(p.world.certificates().distance_limits(a, b, bad), ErrorCode::not_finite, "time",
                 "distance_limits:");
  EXPECT_NEAR(p.world.certificates().distance_limits(a, b, 1e300)->lower, 3.0, 1e-9) << "they stand still";
  EXPECT_EQ(p.world.counters().probes, 0u);
}

TEST(WrongQuestions, FromInsideAProbeAreRefused) {
  Playground p;
  const BodyId a = p.add({.radius = 1});
  const BodyId b = p.add({.radius = 1, .position = {5, 0, 0}});
  ASSERT_FALSE(p.advance(1.0));
  int asked = 0;
  const auto nosy = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    const auto refused = [](const auto& result, const std::string& call) {
      expect_error(result, ErrorCode::probe_in_progress, "probe", call + ":");
    };
    refused(p.world.certificates().safe_until(a, b), "safe_until");
    refused(p.world.certificates().safe_until(a), "safe_until");
    refused(p.world.certificates().safe_until(), "safe_until");
    refused(p.world.certificates(p.probe()).safe_until(), "safe_until");
    refused(p.world.certificates().earliest_contact(a), "earliest_contact");
    refused(p.world.certificates().distance_limits(a, b, 2.0), "distance_limits");
    refused(p.world.queries().overlapping({0, 0, 0}, 1.0), "overlapping");
    refused(p.world.queries().overlapping(Box{}), "overlapping");
    refused(p.world.queries().nearest({0, 0, 0}, 1), "nearest");
    refused(p.world.queries().ray_cast({0, 0, 0}, {1, 0, 0}, 1.0), "ray_cast");
    refused(p.world.queries().sphere_cast({0, 0, 0}, 1.0, {1, 0, 0}, 1.0), "sphere_cast");
    ++asked;
    p.probe()(ids, time, states);
  };
  EXPECT_TRUE(p.world.certificates(nosy).distance_limits(a, b, 2.0));
  EXPECT_EQ(asked, 1);
}

TEST(WrongQuestions, ABadReportIsDropped) {
  Playground p;
  const BodyId a = p.add({.radius = 1, .acceleration_limit = 1}, Vec3{});
  const BodyId b = p.add({.radius = 1, .acceleration_limit = 1, .position = {5, 0, 0}}, Vec3{});
  ASSERT_FALSE(p.advance(0.5));
  p.distort = [](BodyId, double, State& state) { state.position.x = nan; };
  expect_error(p.world.certificates(p.probe()).safe_until(a, b), ErrorCode::not_finite, "position",
               "safe_until:", a);
  expect_error(p.world.certificates(p.probe()).earliest_contact(b), ErrorCode::not_finite, "position",
               "earliest_contact:", b);
  expect_error(p.world.queries(p.probe()).nearest({0, 0, 0}, 1), ErrorCode::not_finite, "position",
               "nearest:", a);
  const auto refused = [](const auto& result, const std::string& call) {
    ASSERT_FALSE(result) << call;
    EXPECT_EQ(result.error().code, ErrorCode::not_finite) << result.error().message;
    EXPECT_EQ(result.error().message.rfind(call + ":", 0), 0u) << result.error().message;
  };
  refused(p.world.certificates(p.probe()).safe_until(a), "safe_until");
  refused(p.world.certificates(p.probe()).safe_until(), "safe_until");
  refused(p.world.certificates(p.probe()).distance_limits(a, b, 1.0), "distance_limits");
  refused(p.world.queries(p.probe()).overlapping({1, 0, 0}, 0.1), "overlapping");
  refused(p.world.queries(p.probe()).overlapping(Box{{1, 0, 0}, {2, 1, 1}}), "overlapping");
  refused(p.world.queries(p.probe()).ray_cast({-3, 0, 0}, {1, 0, 0}, 9.0), "ray_cast");
  refused(p.world.queries(p.probe()).sphere_cast({-3, 0, 0}, 0.5, {1, 0, 0}, 9.0), "sphere_cast");
  p.distort = {};
  EXPECT_TRUE(p.world.certificates(p.probe()).safe_until(a, b)->probed);
  p.run(2.0);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(Answers, DoNotProbeDisabledBodies) {
  Playground p;
  const BodyId a = p.add({.acceleration_limit = 1, .position = {0, 0, 0}});
  const BodyId b = p.add({.acceleration_limit = 1, .position = {9, 0, 0}});
  ASSERT_FALSE(p.advance(0.5));
  p.world.disable(a).value();
  ASSERT_FALSE(p.advance(1.0));
  p.distort = [&](BodyId id, double, State&) { EXPECT_NE(id, a); };
  EXPECT_TRUE(p.world.certificates(p.probe()).distance_limits(a, b, 2.0));
  EXPECT_TRUE(p.world.certificates(p.probe()).safe_until(a, b));
  EXPECT_TRUE(p.world.certificates(p.probe()).safe_until(a));
  EXPECT_TRUE(p.world.certificates(p.probe()).earliest_contact(a));
  EXPECT_TRUE(p.world.queries(p.probe()).nearest({0, 0, 0}, 2));
}

}  // namespace
}  // namespace kinesphere::answers_test
