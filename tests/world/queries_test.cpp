// Queries against brute force on the true bodies: nothing is missed, certain results are true, and with a
// probe only position errors leave something open.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <functional>
#include <set>

#include "kinesphere/queries.hpp"
#include "number/infinity.hpp"
#include "world/crowd.hpp"

namespace kinesphere::queries_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double rounding = 1e-11;

/// Returns the way after which a sphere touches the ball; nothing if it does not.
double true_way(const Vec3& origin, double radius, const Vec3& unit, const Vec3& centre, double ball) {
  const Vec3 offset = origin - centre;
  const double reach = radius + ball;
  const double c = norm_squared(offset) - reach * reach;
  if (c <= 0.0) return 0.0;
  const double b = dot(offset, unit);
  const double discriminant = b * b - c;
  return b >= 0.0 || discriminant < 0.0 ? infinity : -b - std::sqrt(discriminant);
}

class Queries : public testing::TestWithParam<CrowdKind> {
 protected:
  Queries() : crowd(GetParam()) {}

  void ask() {
    probing = crowd.random.uniform() < 0.4;
    ASSERT_NO_FATAL_FAILURE(ask_sphere());
    ASSERT_NO_FATAL_FAILURE(ask_box());
    ASSERT_NO_FATAL_FAILURE(ask_nearest());
    ASSERT_NO_FATAL_FAILURE(ask_cast());
  }

  /// `true_distance(body)` is the distance of its surface from the region.
  void compare(const std::vector<OverlapHit>& found, const std::function<double(BodyId)>& true_distance) {
    std::set<BodyId> possible;
    for (const OverlapHit& each : found) {
      ASSERT_TRUE(possible.insert(each.body).second);
      const double distance = true_distance(each.body);
      if (each.certainty == Certainty::certainly) {
        ASSERT_LE(distance, rounding) << each.body;
        ++certain;
      } else {
        ++doubtful;
        if (probing) {
          ASSERT_LE(std::abs(distance), 4.0 * GetParam().noise + rounding) << each.body;
        }
      }
    }
    for (const BodyId id : crowd.world.bodies()) {
      if (!possible.contains(id)) {
        ASSERT_GE(true_distance(id), -rounding) << id << " is missed at " << crowd.world.time();
      }
    }
  }

  void ask_sphere() {
    const Vec3 centre = crowd.any_point();
    const double radius = 3.0 * crowd.random.uniform();
    const auto found = probing ? crowd.world.queries(crowd.probe()).overlapping(centre, radius)
                               : crowd.world.queries().overlapping(centre, radius);
    compare(*found,
            [&](BodyId id) { return norm(crowd.state(id).position - centre) - radius - crowd.radius(id); });
  }

  void ask_box() {
    const Vec3 corner = crowd.any_point();
    const Box box{corner, corner + Vec3{crowd.random.uniform(), 2.0, 3.0 * crowd.random.uniform()}};
    const auto found = probing ? crowd.world.queries(crowd.probe()).overlapping(box)
                               : crowd.world.queries().overlapping(box);
    compare(*found, [&](BodyId id) {
      const Vec3 at = crowd.state(id).position;
      const Vec3 nearest{std::clamp(at.x, box.lower.x, box.upper.x),
                         std::clamp(at.y, box.lower.y, box.upper.y),
                         std::clamp(at.z, box.lower.z, box.upper.z)};
      return norm(at - nearest) - crowd.radius(id);
    });
  }

  void ask_nearest() {
    const Vec3 point = crowd.any_point();
    const std::size_t count = 1 + crowd.random.bits() % 8;
    const auto distance = [&](BodyId id) {
      return norm(crowd.state(id).position - point) - crowd.radius(id);
    };
    std::vector<BodyId> order = crowd.world.bodies();
    std::sort(order.begin(), order.end(), [&](BodyId a, BodyId b) { return distance(a) < distance(b); });
    order.resize(std::min(count, order.size()));
    const auto found = probing ? crowd.world.queries(crowd.probe()).nearest(point, count)
                               : crowd.world.queries().nearest(point, count);
    ASSERT_GE(found->size(), order.size());
    if (probing && GetParam().noise == 0.0) {
      ASSERT_EQ(found->size(), order.size());
    }
    const auto is_nearest = [&](BodyId id) {
      return std::find(order.begin(), order.end(), id) != order.end();
    };
    std::size_t met = 0;
    for (const NearestHit& each : *found) {
      ASSERT_LE(each.lower, distance(each.body) + rounding);
      ASSERT_GE(each.upper, distance(each.body) - rounding);
      if (probing) {
        ASSERT_LE(each.upper - each.lower, 4.0 * GetParam().noise + 1e-10);
      }
      if (each.certainty == Certainty::certainly) {
        ASSERT_TRUE(is_nearest(each.body)) << each.body;
      }
      if (is_nearest(each.body)) ++met;
    }
    ASSERT_EQ(met, order.size()) << "one of the nearest is missed";
  }

  void ask_cast() {
    const Vec3 origin = crowd.any_point();
    const double radius = crowd.random.uniform() < 0.5 ? 0.0 : crowd.random.uniform();
    const Vec3 unit = crowd.random.unit_vector();
    const Vec3 direction = 7.0 * unit;
    const double length = 12.0 * crowd.random.uniform();
    World& world = crowd.world;
    const auto found =
        radius == 0.0 ? (probing ? world.queries(crowd.probe()).ray_cast(origin, direction, length)
                                 : world.queries().ray_cast(origin, direction, length))
                      : (probing ? world.queries(crowd.probe()).sphere_cast(origin, radius, direction, length)
                                 : world.queries().sphere_cast(origin, radius, direction, length));
    const auto way = [&](BodyId id) {
      return true_way(origin, radius, unit, crowd.state(id).position, crowd.radius(id));
    };
    double first = infinity;
    BodyId hit = no_body;
    for (const BodyId id : world.bodies()) {
      if (way(id) < first) {
        first = way(id);
        hit = id;
      }
    }
    if (first > length) hit = no_body;
    bool met = false;
    for (const CastHit& each : *found) {
      ASSERT_LE(each.lower, way(each.body) + 1e-7);
      ASSERT_GE(each.upper, way(each.body) - 1e-7);
      if (each.certainty == Certainty::certainly) {
        ASSERT_LE(way(each.body), first + 1e-7);
        ASSERT_EQ(found->size(), 1u);
      }
      met = met || each.body == hit;
    }
    if (hit != no_body) {
      ASSERT_TRUE(met) << hit << " is missed at " << world.time();
    }
    if (probing && GetParam().noise == 0.0) {
      if (first > 0.0) {
        ASSERT_EQ(found->size(), hit == no_body ? 0u : 1u);
      }
      if (hit != no_body && first > 0.0) {
        ++hits;
      }
    }
  }

  Crowd crowd;
  bool probing = false;
  std::size_t certain = 0;
  std::size_t doubtful = 0;
  std::size_t hits = 0;
};

TEST_P(Queries, AgreeWithBruteForce) {
  constexpr int questions = 6;
  for (int stop = 1; stop <= 40; ++stop) {
    // Queries also before the world has processed the changes.
    for (int k = 0; k < questions; ++k) ASSERT_NO_FATAL_FAILURE(ask()) << "stop " << stop;
    while (const auto event = crowd.advance(-1.0 + 0.05 * stop)) {
      ASSERT_NE(event->kind, EventKind::bound_violation);
      ASSERT_NO_FATAL_FAILURE(ask()) << "stop " << stop;
      crowd.bounce(*event);
      ASSERT_NO_FATAL_FAILURE(ask()) << "stop " << stop;
    }
    ASSERT_TRUE(is_clean(crowd.world));
    for (int k = 0; k < questions; ++k) ASSERT_NO_FATAL_FAILURE(ask()) << "stop " << stop;
    for (int k = 0; k < 4; ++k) crowd.change();
  }
  EXPECT_GT(certain, 100u);
  if (GetParam().bodies > 20 && GetParam().mode == ContactEvents::begin_and_end) {
    EXPECT_GT(doubtful, 0u);
  }
  if (GetParam().noise == 0.0) {
    EXPECT_GT(hits, 2u);
  }
}

/// Many queries are answered as one after the other is, by any number of workers.
TEST_P(Queries, ManyAtOnceAreAnsweredAsEach) {
  Workers workers = Workers::create(3).value();
  const auto any_body = [&] { return crowd.random.bits() % 2 == 0 ? no_body : crowd.any(); };
  for (int stop = 1; stop <= 4; ++stop) {
    std::vector<SphereQuery> spheres;
    std::vector<PointQuery> points;
    std::vector<RayQuery> rays;
    for (int k = 0; k < 60; ++k) {
      spheres.push_back({crowd.any_point(), 3.0 * crowd.random.uniform(), any_body()});
      points.push_back({crowd.any_point(), any_body()});
      rays.push_back({crowd.any_point(), 7.0 * crowd.random.unit_vector(), 12.0 * crowd.random.uniform(),
                      k % 2 == 0 ? 0.0 : crowd.random.uniform(), any_body()});
    }
    const auto filter = stop % 2 == 0 ? std::nullopt : std::optional(Filter{.category = 1, .mask = 1});
    const auto compare_all = [&](const World::Queries& queries) {
      const auto within = queries.overlapping_all(spheres, filter).value();
      const auto nearest = queries.nearest_all(points, 3, filter).value();
      const auto hit = queries.ray_cast_all(rays, filter).value();
      EXPECT_TRUE(queries.overlapping_all(spheres, filter, &workers).value() == within);
      EXPECT_TRUE(queries.nearest_all(points, 3, filter, &workers).value() == nearest);
      EXPECT_TRUE(queries.ray_cast_all(rays, filter, &workers).value() == hit);
      ASSERT_EQ(within.size(), spheres.size());
      for (std::size_t k = 0; k < spheres.size(); ++k) {
        const auto as_listed = [&](const auto& lists, const auto& one) {
          EXPECT_TRUE(std::ranges::equal(lists[k], one)) << "query " << k << ", stop " << stop;
        };
        as_listed(within, *queries.overlapping(spheres[k].centre, spheres[k].radius,
                                               {.filter = filter, .except = spheres[k].except}));
        as_listed(nearest,
                  *queries.nearest(points[k].point, 3, {.filter = filter, .except = points[k].except}));
        as_listed(hit, *queries.sphere_cast(rays[k].origin, rays[k].radius, rays[k].direction, rays[k].length,
                                            {.filter = filter, .except = rays[k].except}));
      }
    };
    compare_all(crowd.world.queries());
    // All reports that the lists rest on are fresh afterwards, so that none is asked for again.
    const auto probe = crowd.probe();
    std::size_t calls = 0;
    compare_all(crowd.world.queries([&](std::span<const BodyId> ids, double time, std::span<State> states) {
      ++calls;
      probe(ids, time, states);
    }));
    EXPECT_LE(calls, 9u) << "one call for all queries, or a few";
    while (const auto event = crowd.advance(-1.0 + 0.2 * stop)) crowd.bounce(*event);
    for (int k = 0; k < 4; ++k) crowd.change();
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Queries, crowd_kinds());

TEST(QueryOfAViolatedBound, FindsTheBodyWhereItIsNow) {
  Playground p;
  const BodyId a = p.add({.radius = 1, .position = {0, 0, 0}});
  p.add({.radius = 1, .position = {20, 0, 0}});
  EXPECT_FALSE(p.advance(1.0));
  p.set_position(a, {50, 0, 0});
  EXPECT_EQ(p.world.queries(p.probe()).nearest({1, 0, 0}, 1)->front().body.index, 1u);
  // The world has not advanced, so the body is not registered at its new place.
  ASSERT_EQ(p.world.queries().overlapping({52, 0, 0}, 1.5)->size(), 1u);
  EXPECT_EQ(p.world.queries().overlapping({52, 0, 0}, 1.5)->front().body, a);
  EXPECT_TRUE(p.world.queries().overlapping({0, 0, 0}, 1.5)->empty());
  EXPECT_EQ(p.world.queries().ray_cast({100, 0, 0}, {-1, 0, 0}, 60.0)->front().body, a);
  const auto event = p.advance(2.0);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::bound_violation);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(RayCast, TellsWayAndCertainty) {
  Playground p;
  const BodyId near = p.add({.radius = 1, .position = {5, 0, 0}});
  p.add({.radius = 1, .position = {9, 0, 0}});
  for (const Vec3 direction : {Vec3{1, 0, 0}, Vec3{1e-90, 0, 0}, Vec3{1e90, 0, 0}}) {
    const auto hits = p.world.queries().ray_cast({0, 0, 0}, direction, 100.0).value();
    ASSERT_EQ(hits.size(), 1u);
    EXPECT_EQ(hits[0].body, near);
    EXPECT_EQ(hits[0].certainty, Certainty::certainly);
    EXPECT_NEAR(hits[0].lower, 4.0, 1e-9);
    EXPECT_NEAR(hits[0].upper, 4.0, 1e-9);
  }
  EXPECT_NEAR(p.world.queries().sphere_cast({0, 0, 0}, 0.5, {1, 0, 0}, 100.0)->front().lower, 3.5, 1e-9);
  EXPECT_TRUE(p.world.queries().ray_cast({0, 0, 0}, {1, 0, 0}, 3.9)->empty()) << "too short";
  EXPECT_TRUE(p.world.queries().ray_cast({0, 0, 0}, {-1, 0, 0}, 100.0)->empty()) << "behind";
  EXPECT_TRUE(p.world.queries().ray_cast({0, 1.1, 0}, {1, 0, 0}, 100.0)->empty()) << "beside";
  EXPECT_EQ(p.world.queries().ray_cast({5, 0.5, 0}, {0, 1, 0}, 0.0)->front().upper, 0.0) << "inside";
}

TEST(RayCast, FindsTheFarEndOfALongWay) {
  Playground p;
  const BodyId far = p.add({.radius = 1, .position = {3e5, 4e5, 0}});
  p.add({.radius = 0.001, .position = {0, 1, 0}});
  const auto hits = p.world.queries().ray_cast({0, 0, 0}, {3, 4, 0}, 1e6).value();
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits[0].body, far);
  EXPECT_NEAR(hits[0].lower, 5e5 - 1.0, 1e-6);
}

TEST(Nearest, OfFewGivesAll) {
  Playground p;
  EXPECT_TRUE(p.world.queries().nearest({0, 0, 0}, 3)->empty());
  const BodyId far = p.add({.radius = 1, .position = {2e6, 0, 0}});
  EXPECT_TRUE(p.world.queries().nearest({0, 0, 0}, 0)->empty());
  const BodyId here = p.add({.radius = 1});
  const auto found = p.world.queries().nearest({0, 0, 0}, 3).value();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].body, here);
  EXPECT_NEAR(found[0].upper, -1.0, 1e-9);
  EXPECT_EQ(found[1].body, far);
  EXPECT_EQ(found[1].certainty, Certainty::certainly);
}

template <class T>
void expect_refusal(const Result<T>& result, ErrorCode code, const std::string& argument,
                    const std::string& call) {
  ASSERT_FALSE(result) << argument;
  EXPECT_EQ(result.error().code, code) << result.error().message;
  EXPECT_EQ(result.error().argument, argument) << result.error().message;
  EXPECT_EQ(result.error().message.rfind(call + ":", 0), 0u) << result.error().message;
}

TEST(WrongQueries, AreRefused) {
  Playground p;
  p.add({.radius = 1});
  ASSERT_FALSE(p.advance(1.0));
  const std::uint64_t probes = p.world.counters().probes;
  const auto check = [&](ErrorCode code, double bad) {
    const Vec3 v{0, bad, 0};
    expect_refusal(p.world.queries().overlapping(v, 1.0), code, "centre", "overlapping");
    expect_refusal(p.world.queries(p.probe()).overlapping(v, 1.0), code, "centre", "overlapping");
    expect_refusal(p.world.queries().overlapping({}, bad), code, "radius", "overlapping");
    expect_refusal(p.world.queries().overlapping(Box{{}, v}), code, "box", "overlapping");
    expect_refusal(p.world.queries(p.probe()).overlapping(Box{{}, v}), code, "box", "overlapping");
    expect_refusal(p.world.queries().nearest(v, 1), code, "point", "nearest");
    expect_refusal(p.world.queries(p.probe()).nearest(v, 1), code, "point", "nearest");
    expect_refusal(p.world.queries().ray_cast(v, {1, 0, 0}, 1.0), code, "origin", "ray_cast");
    expect_refusal(p.world.queries().ray_cast({}, {1, 0, 0}, bad), code, "length", "ray_cast");
    expect_refusal(p.world.queries(p.probe()).ray_cast({}, {1, 0, 0}, bad), code, "length", "ray_cast");
    expect_refusal(p.world.queries().ray_cast({}, v, 1.0), code, "direction", "ray_cast");
    expect_refusal(p.world.queries(p.probe()).ray_cast({}, v, 1.0), code, "direction", "ray_cast");
    expect_refusal(p.world.queries().sphere_cast(v, 1.0, {1, 0, 0}, 1.0), code, "origin", "sphere_cast");
    expect_refusal(p.world.queries().sphere_cast({}, 1.0, v, 1.0), code, "direction", "sphere_cast");
    expect_refusal(p.world.queries().sphere_cast({}, 1.0, {1, 0, 0}, bad), code, "length", "sphere_cast");
    expect_refusal(p.world.queries().sphere_cast({}, bad, {1, 0, 0}, 1.0), code, "radius", "sphere_cast");
    expect_refusal(p.world.queries(p.probe()).sphere_cast({}, bad, {1, 0, 0}, 1.0), code, "radius",
                   "sphere_cast");
  };
  for (const double bad : {nan, infinity, -infinity}) check(ErrorCode::not_finite, bad);
  for (const double bad : {1e200, -1e200}) check(ErrorCode::out_of_range, bad);
  expect_refusal(p.world.queries().ray_cast({}, {0, 0, 0}, 1.0), ErrorCode::out_of_range, "direction",
                 "ray_cast");
  expect_refusal(p.world.queries().overlapping(Box{{1, 0, 0}, {0, 1, 1}}), ErrorCode::out_of_range, "box",
                 "overlapping");
  expect_refusal(p.world.queries().overlapping({}, -1.0), ErrorCode::out_of_range, "radius", "overlapping");
  expect_refusal(p.world.queries().ray_cast({}, {1, 0, 0}, -1.0), ErrorCode::out_of_range, "length",
                 "ray_cast");
  expect_refusal(p.world.queries().sphere_cast({}, -1.0, {1, 0, 0}, 1.0), ErrorCode::out_of_range, "radius",
                 "sphere_cast");
  expect_refusal(p.world.queries().sphere_cast({}, 1.0, {}, 1.0), ErrorCode::out_of_range, "direction",
                 "sphere_cast");
  const auto queries = p.world.queries(p.probe());
  const auto refused_second = [&](const auto& result, const std::string& argument, const std::string& call) {
    expect_refusal(result, ErrorCode::out_of_range, argument, call);
    EXPECT_EQ(result.error().message.rfind(call + ": query 1, " + argument, 0), 0u) << result.error().message;
  };
  refused_second(queries.overlapping_all(std::vector<SphereQuery>{{}, {{}, -1.0}}), "radius",
                 "overlapping_all");
  refused_second(queries.nearest_all(std::vector<PointQuery>{{}, {{1e200, 0, 0}}}, 2), "point",
                 "nearest_all");
  refused_second(queries.ray_cast_all(std::vector<RayQuery>{{{}, {1, 0, 0}, 1.0}, {{}, {}, 1.0}}),
                 "direction", "ray_cast_all");
  EXPECT_EQ(p.world.counters().probes, probes);
}

TEST(ManyQueries, MayBeNone) {
  Playground p;
  EXPECT_EQ(p.world.queries().ray_cast_all({})->size(), 0u);
  p.add({.radius = 1});
  EXPECT_EQ(p.world.queries(p.probe()).nearest_all({}, 3)->size(), 0u);
}

TEST(ManyQueries, NeedWorkersThatAreFree) {
  Playground p, other;
  p.add({.radius = 1, .velocity = {1, 0, 0}});
  p.add({.radius = 1, .position = {4, 0, 0}});
  Workers workers = Workers::create(2).value();
  std::size_t events = 0;
  p.world
      .run(
          3.0, p.probe(),
          [&](const Event&) {
            ++events;
            const auto busy =
                other.world.queries().nearest_all(std::vector<PointQuery>{{}}, 1, {}, &workers).error();
            EXPECT_EQ(busy.code, ErrorCode::workers_busy) << busy.message;
          },
          &workers)
      .value();
  EXPECT_GT(events, 0u);
}

/// Returns the least time of several hundred searches for the nearest bodies, on a lattice with so many
/// bodies on an edge (processor time, s). `turns`: all have got another velocity before.
double time_of_nearest(int edge, bool turns) {
  World world = World::create({.contact_tolerance = 1e-3}).value();
  std::vector<BodyDefinition> bodies;
  for (int k = 0; k < edge * edge * edge; ++k)
    bodies.push_back(
        {.radius = 0.5, .position = {2.5 * (k % edge), 2.5 * (k / edge % edge), 2.5 * (k / edge / edge)}});
  EXPECT_TRUE(world.add_all(bodies));
  EXPECT_TRUE(world.advance(0.0, [&](std::span<const BodyId> ids, double, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = {bodies[ids[k].index].position, {}};
  }));
  if (turns) {
    for (const BodyId id : world.bodies()) EXPECT_TRUE(world.set_velocity(id, {1, 0, 0}));
  }
  double least = infinity;
  for (int turn = 0; turn < 5; ++turn) {
    const std::clock_t start = std::clock();
    for (std::size_t k = 0; k < 300; ++k)
      EXPECT_GE(world.queries().nearest(bodies[k * 37 % bodies.size()].position, 4).value().size(), 4u);
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

/// A search for the nearest bodies costs about the same among 1,000 as among 64,000, also if all have got
/// another velocity.
TEST(QueriesOfTheNearest, LookAroundOnly) {
  for (const bool turns : {false, true})
    EXPECT_LT(time_of_nearest(40, turns), 10.0 * time_of_nearest(10, turns)) << turns;
}

}  // namespace
}  // namespace kinesphere::queries_test
