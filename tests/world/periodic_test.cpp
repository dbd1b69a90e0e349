// Periodic space: every contact over all images, each once, with image counts that follow the paths.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "kinesphere/certificates.hpp"
#include "kinesphere/queries.hpp"
#include "number/infinity.hpp"
#include "support/expect_error.hpp"
#include "world/periodic_world.hpp"

namespace kinesphere::periodic_test {
namespace {

constexpr double eps = PeriodicWorld::eps;
constexpr Axes all_axes{true, true, true};

class Periodic : public testing::TestWithParam<PeriodicKind> {};

/// True for an overlap deeper than the tolerance can leave open.
bool is_clear(const Overlap& overlap) { return overlap.depth > 4.0 * eps; }

/// Expects the reported begins of one pair to be its overlaps.
void expect_same(const PeriodicWorld& p, BodyId a, BodyId b, const std::vector<Overlap>& overlaps,
                 const std::vector<Event>& begins) {
  std::size_t next = 0;
  for (const Overlap& overlap : overlaps) {
    while (next < begins.size() && begins[next].time < overlap.begin - 1e-3) ++next;
    const bool reported = next < begins.size() && begins[next].time <= overlap.begin + 1e-9;
    if (is_clear(overlap)) {
      EXPECT_TRUE(reported) << a << " and " << b << " overlap from " << overlap.begin << " unseen";
    }
    if (reported) ++next;
  }
  for (const Event& begin : begins) EXPECT_LE(p.true_gap(a, b, begin.time), eps) << begin;
  const auto clear = static_cast<std::size_t>(std::count_if(overlaps.begin(), overlaps.end(), is_clear));
  EXPECT_GE(begins.size(), clear);
  EXPECT_LE(begins.size(), overlaps.size()) << a << " and " << b;
}

TEST_P(Periodic, FindsEveryContactInAllImages) {
  PeriodicWorld p(GetParam());
  const double until = p.kind.duration;
  std::map<std::pair<BodyId, BodyId>, std::vector<Overlap>> truth;
  std::size_t total = 0;
  for (const BodyId a : p.ids)
    for (const BodyId b : p.ids)
      if (a < b) total += (truth[{a, b}] = p.overlaps(a, b, until)).size();
  std::map<std::pair<BodyId, BodyId>, std::vector<Event>> begins;
  std::set<std::pair<BodyId, BodyId>> touching;
  std::size_t stops = 0;
  while (const auto event = p.advance(until)) {
    p.check_event(*event);
    p.check_image(event->first);
    const std::pair pair{event->first, event->second};
    if (event->kind == EventKind::contact_begin) {
      begins[pair].push_back(*event);
      EXPECT_TRUE(touching.insert(pair).second) << *event;
    } else if (event->kind == EventKind::contact_end) {
      EXPECT_EQ(touching.erase(pair), 1u) << *event;
      EXPECT_GT(p.true_gap(event->first, event->second, event->time), 3.9 * eps);
    } else {
      EXPECT_NE(event->kind, EventKind::bound_violation) << *event;
    }
    if (++stops % 7 == 0) {
      ASSERT_TRUE(is_clean(p.world));
    }
  }
  EXPECT_TRUE(is_clean(p.world));
  EXPECT_GT(total, 20u) << "a test that tests nothing";
  for (const auto& [pair, overlaps] : truth) expect_same(p, pair.first, pair.second, overlaps, begins[pair]);
  for (const BodyId id : p.ids) p.check_image(id);
}

TEST_P(Periodic, GoesOnFromASnapshotToTheBit) {
  PeriodicWorld p(GetParam());
  p.run(0.4 * p.kind.duration);
  World restored = World::restore(p.world.save().value()).value();
  EXPECT_EQ(restored.save().value(), p.world.save().value());
  World clone = p.world.clone().value();
  const Random same = p.random;
  std::vector<EventHash> hashes;
  for (World* world : {&p.world, &restored, &clone}) {
    p.random = same;
    EventHash hash;
    while (const auto event = world->advance(p.kind.duration, p.probe()).value()) hash.add(*event);
    hashes.push_back(hash);
    EXPECT_TRUE(is_clean(*world));
    EXPECT_EQ(world->save().value(), p.world.save().value());
  }
  EXPECT_EQ(hashes[0].value(), hashes[1].value());
  EXPECT_EQ(hashes[0].value(), hashes[2].value());
}

/// The world's answers about the future, at several stops, must not be later than the event.
TEST_P(Periodic, AnswersAreNeverLate) {
  PeriodicWorld p(GetParam());
  const double end = p.kind.duration;
  for (int stop = 0; stop < 6; ++stop) {
    p.run(end * stop / 12.0);
    double first_of_all = infinity;
    bool any_touching = false;
    std::map<BodyId, double> first_of;
    for (const BodyId a : p.ids) first_of[a] = infinity;
    for (const BodyId a : p.ids) {
      for (const BodyId b : p.ids) {
        if (!(a < b)) continue;
        const SafeTime safe = p.world.certificates().safe_until(a, b).value();
        const DistanceLimits limits =
            p.world.certificates().distance_limits(a, b, p.world.time() + 0.01).value();
        const double gap = p.true_gap(a, b, p.world.time() + 0.01);
        EXPECT_LE(limits.lower, gap + 1e-9);
        EXPECT_GE(limits.upper, gap - 1e-9);
        any_touching |= safe.touching;
        if (safe.touching) {
          first_of[a] = first_of[b] = p.world.time();
          continue;
        }
        const auto overlaps = p.overlaps(a, b, end);
        if (overlaps.empty()) continue;
        EXPECT_LE(safe.time, overlaps[0].begin + 1e-9) << a << " " << b << " at " << p.world.time();
        const SafeTime fresh = p.world.certificates(p.probe()).safe_until(a, b).value();
        EXPECT_LE(fresh.time, overlaps[0].begin + 1e-9) << a << " " << b;
        first_of_all = std::min(first_of_all, overlaps[0].begin);
        for (const BodyId id : {a, b}) first_of[id] = std::min(first_of[id], overlaps[0].begin);
      }
    }
    for (const BodyId id : p.ids)
      EXPECT_LE(p.world.certificates().safe_until(id).value().time, first_of[id] + 1e-9) << id;
    EXPECT_LE(p.world.certificates().safe_until().value().time, first_of_all + 1e-9);
    EXPECT_GE(p.world.certificates().safe_until().value().touching, any_touching);  // or a wall is touched
    EXPECT_TRUE(is_clean(p.world));
  }
}

/// Returns the true positions in all relevant images.
std::vector<Vec3> images_of(const PeriodicWorld& p, BodyId id, int most) {
  const Vec3 at = p.shortest(p.state(id).position - p.kind.box.lower) + p.kind.box.lower;
  std::vector<Vec3> images;
  const auto range = [&](int axis) { return p.period[axis] > 0.0 ? most : 0; };
  for (int x = -range(0); x <= range(0); ++x)
    for (int y = -range(1); y <= range(1); ++y)
      for (int z = -range(2); z <= range(2); ++z)
        images.push_back(at + Vec3{x * p.period.x, y * p.period.y, z * p.period.z});
  return images;
}

double distance_to(const Box& box, const Vec3& point) {
  Vec3 away;
  for (int axis = 0; axis < 3; ++axis)
    away[axis] = std::max({box.lower[axis] - point[axis], point[axis] - box.upper[axis], 0.0});
  return norm(away);
}

void expect_found(const PeriodicWorld& p, const std::vector<OverlapHit>& found,
                  const std::function<double(const Vec3&)>& distance) {
  for (const BodyId id : p.ids) {
    double least = infinity;
    for (const Vec3& image : images_of(p, id, 4)) least = std::min(least, distance(image));
    const auto it =
        std::find_if(found.begin(), found.end(), [=](const OverlapHit& f) { return f.body == id; });
    if (least < p.radius(id) - 1e-9) {
      EXPECT_NE(it, found.end()) << id << " at " << least;
    }
    if (it != found.end() && it->certainty == Certainty::certainly) {
      EXPECT_LT(least, p.radius(id) + 1e-9) << id;
    }
  }
  const auto same = [](const OverlapHit& a, const OverlapHit& b) { return a.body == b.body; };
  EXPECT_EQ(std::adjacent_find(found.begin(), found.end(), same), found.end()) << "found twice";
}

TEST_P(Periodic, QueriesReachAcrossTheBorder) {
  PeriodicWorld p(GetParam());
  const double size = norm(p.kind.box.upper - p.kind.box.lower);
  for (int stop = 1; stop <= 8; ++stop) {
    p.run(p.kind.duration * stop / 20.0);
    Vec3 centre = p.any_point();
    if (stop % 2 == 0) centre.x = p.kind.box.upper.x;
    const double reach = 0.3 * size * p.random.uniform();
    const auto from_centre = [&](const Vec3& at) { return norm(at - centre) - reach; };
    expect_found(p, p.world.queries().overlapping(centre, reach).value(), from_centre);
    expect_found(p, p.world.queries(p.probe()).overlapping(centre, reach).value(), from_centre);
    const Vec3 half = p.flat(Vec3{1, 1, 1} * (0.5 * reach));
    const Box region{centre - half, centre + half};
    const auto from_region = [&](const Vec3& at) { return distance_to(region, at); };
    expect_found(p, p.world.queries().overlapping(region).value(), from_region);
    expect_found(p, p.world.queries(p.probe()).overlapping(region).value(), from_region);

    std::vector<std::pair<double, BodyId>> truth;
    for (const BodyId id : p.ids)
      truth.emplace_back(norm(p.shortest(p.state(id).position - centre)) - p.radius(id), id);
    std::sort(truth.begin(), truth.end());
    const auto near = p.world.queries(p.probe()).nearest(centre, 3).value();
    ASSERT_EQ(near.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(near[k].body, truth[k].second);
      EXPECT_NEAR(near[k].lower, truth[k].first, 1e-9);
    }
    EXPECT_GE(p.world.queries().nearest(centre, 3).value().size(), 3u);

    const Vec3 direction = p.flat(p.random.point_in_ball());
    const Vec3 unit = direction / norm(direction);
    const double length = 1.5 * size;
    double first = infinity;
    for (const BodyId id : p.ids)
      for (const Vec3& image : images_of(p, id, 9)) {
        const Vec3 way = image - centre;
        const double along = dot(way, unit);
        const double square = p.radius(id) * p.radius(id) - norm_squared(way - unit * along);
        if (square <= 0.0 || along + std::sqrt(square) < 0.0) continue;
        first = std::min(first, std::max(0.0, along - std::sqrt(square)));
      }
    const auto hits = p.world.queries(p.probe()).ray_cast(centre, direction, length).value();
    if (first < length - 1e-9) {
      ASSERT_FALSE(hits.empty());
      EXPECT_NEAR(hits[0].lower, first, 1e-7);
    } else if (first > length + 1e-9) {
      EXPECT_TRUE(hits.empty());
    }
    const auto rough = p.world.queries().ray_cast(centre, direction, length).value();
    if (first < length) {
      ASSERT_FALSE(rough.empty());
      EXPECT_LE(rough[0].lower, first + 1e-9);
    }
  }
}

constexpr Box ten{{0, 0, 0}, {10, 10, 10}};
constexpr Box five{{0, 0, 0}, {5, 5, 5}};
constexpr Box uneven{{0, 0, 0}, {2, 3, 4}};
constexpr PeriodicCrowd many{60, 0.1, 0.6, 5};
constexpr PeriodicCrowd between_walls{40, 0.1, 0.4, 2};
constexpr PeriodicCrowd fast{8, 0.05, 0.2, 300};
constexpr Reports wrapped = Reports::wrapped;

const PeriodicKind kinds[] = {
    {.name = "crowd", .box = ten, .crowd = many},
    {.name = "wrapped reports", .box = ten, .crowd = many, .reports = wrapped, .seed = 2},
    {.name = "reports in any image",
     .box = {{-7, 3, 100}, {3, 15, 108}},
     .crowd = many,
     .reports = Reports::any_image,
     .seed = 3},
    {.name = "thirds of the box",
     .box = {{0, 0, 0}, {3, 3, 3}},
     .crowd = {6, 0.5, 0.5, 3},
     .reports = wrapped,
     .seed = 4},
    {.name = "three cells",
     .box = {{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}},
     .crowd = {16, 0.2, 0.35, 3},
     .seed = 5},
    {.name = "a large one among small ones",
     .box = {{0, 0, 0}, {6, 6, 6}},
     .crowd = {40, 0.01, 0.1, 6},
     .duration = 12.0,
     .reports = wrapped,
     .first_radius = 1.0,
     .seed = 6},
    {.name = "fast ones", .box = uneven, .crowd = fast, .duration = 1.0, .reports = wrapped, .seed = 7},
    {.name = "fast ones, unwrapped", .box = uneven, .crowd = fast, .duration = 1.0, .seed = 8},
    {.name = "slab",
     .box = five,
     .periodic = {true, true, false},
     .crowd = between_walls,
     .duration = 3.0,
     .reports = wrapped,
     .seed = 9},
    {.name = "channel",
     .box = five,
     .periodic = {false, true, false},
     .crowd = between_walls,
     .duration = 3.0,
     .seed = 10},
    {.name = "discs",
     .box = {{0, 0, 0}, {6, 6, 0}},
     .periodic = {true, true, false},
     .dimensions = 2,
     .crowd = {30, 0.05, 0.3, 3},
     .reports = wrapped,
     .seed = 11},
};

INSTANTIATE_TEST_SUITE_P(Kinds, Periodic, testing::ValuesIn(kinds), [](const auto& tested) {
  std::string name = tested.param.name;
  std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
  return name;
});

TEST(PeriodicBox, PairsMeetAcrossACorner) {
  for (const Reports reports : {Reports::unwrapped, Reports::wrapped}) {
    PeriodicWorld p({.name = "corner", .box = {{0, 0, 0}, {10, 10, 10}}, .reports = reports});
    const BodyId a = p.add({.radius = 1, .position = {0.5, 0.5, 0.5}});
    const BodyId b = p.add({.radius = 1, .position = {7, 7, 7}, .velocity = {1, 1, 1}});
    const auto event = p.advance(100);
    ASSERT_TRUE(event);
    EXPECT_EQ(event->kind, EventKind::contact_begin);
    EXPECT_NEAR(event->time, 3.5 - 2.0 / std::sqrt(3.0), 1e-5);
    EXPECT_EQ(event->first, a);
    EXPECT_EQ(event->second, b);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(event->second_state.position[axis], 0.5 - 2.0 / std::sqrt(3.0), 1e-5);
      EXPECT_NEAR(event->normal[axis], -1.0 / std::sqrt(3.0), 1e-6);
    }
    p.check_event(*event);
  }
}

/// A body makes no contact with its own image, however often it passes the border.
TEST(PeriodicBox, OneBodyMeetsNobody) {
  PeriodicWorld p({.name = "alone", .box = {{0, 0, 0}, {3, 3, 3}}});
  const BodyId id = p.add({.radius = 0.5, .position = {1, 1, 1}, .velocity = {1000, 100, -10}});
  EXPECT_FALSE(p.advance(10));
  const BodyView view = p.world.body(id).value();
  EXPECT_GT(view.image[0], 3300);
  EXPECT_LT(view.image[2], -30);
  p.check_image(id);
}

TEST(PeriodicBox, PositionsFromTheCallerMayBeInAnyImage) {
  PeriodicWorld p({.name = "any", .box = {{0, 0, 0}, {10, 10, 10}}}, {.allow_overlap = false});
  const BodyId a = p.add({.radius = 1, .position = {25, -35, 5}});
  EXPECT_EQ(p.world.body(a).value().definition.position, (Vec3{5, 5, 5}));
  EXPECT_EQ(p.world.body(a).value().image, (std::array<std::int64_t, 3>{2, -4, 0}));
  expect_error(p.world.add({.radius = 1, .position = {-5, 105, 6.5}}), ErrorCode::overlapping, "position",
               "add", a);
  const BodyId b = p.add({.radius = 1, .position = {9.5, 5, 5}});
  expect_error(p.world.teleport(a, {{10.5, 5, 5}, {}}), ErrorCode::overlapping, "position", "teleport", b);
  p.world.teleport(a, {{-8, 5, 5}, {}}).value();
  p.set_position(a, {-8, 5, 5});
  EXPECT_EQ(p.world.body(a).value().image, (std::array<std::int64_t, 3>{-1, 0, 0}));
  EXPECT_FALSE(p.advance(1));
  const std::vector<BodyDefinition> together{{.radius = 0.5, .position = {5, 5, 0.2}},
                                             {.radius = 0.5, .position = {5, 5, 9.9}}};
  expect_error(p.world.add_all(together), ErrorCode::overlapping, "position", "add_all");
  EXPECT_TRUE(is_clean(p.world));
}

/// Bodies are added, removed, resized, teleported and get new velocities: the facts and the image counts hold
/// at each stop.
TEST(PeriodicBox, HoldsThroughEveryKindOfChange) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    SCOPED_TRACE(seed);
    const auto mode = seed % 2 == 0 ? ContactEvents::impacts : ContactEvents::begin_and_end;
    PeriodicWorld p({.name = "changes",
                     .box = {{0, 0, 0}, {6, 6, 6}},
                     .crowd = {25, 0.05, 0.5, 4},
                     .reports = Reports::any_image,
                     .first_radius = 1.0,
                     .seed = seed},
                    {.contacts = mode});
    std::set<std::pair<BodyId, BodyId>> touching;
    for (int step = 1; step <= 60; ++step) {
      const auto events = p.run(0.05 * step, [&](const Event& event) {
        // Ends that a change caused have the states before it.
        if (event.kind != EventKind::contact_end) p.check_event(event);
        if (event.kind == EventKind::contact_begin && mode == ContactEvents::impacts) {
          const Vec3 change = event.normal * event.approach_speed;
          p.set_velocity(event.first, p.state(event.first).velocity - change);
          p.set_velocity(event.second, p.state(event.second).velocity + change);
        } else if (event.kind == EventKind::contact_begin) {
          EXPECT_TRUE(touching.insert({event.first, event.second}).second) << event;
        } else if (event.kind == EventKind::contact_end) {
          EXPECT_EQ(touching.erase({event.first, event.second}), 1u) << event;
        }
      });
      if (mode == ContactEvents::begin_and_end)
        for (const BodyId a : p.world.bodies())
          for (const BodyId b : p.world.bodies()) {
            if (!(a < b)) continue;
            const double gap = p.true_gap(a, b, p.world.time());
            if (gap < -eps) {
              EXPECT_TRUE(touching.contains({a, b})) << a << " " << b << " gap " << gap;
            }
            if (gap > 5.1 * eps) {
              EXPECT_FALSE(touching.contains({a, b})) << a << " " << b << " gap " << gap;
            }
          }
      ASSERT_TRUE(is_clean(p.world)) << step;
      for (const BodyId id : p.world.bodies()) p.check_image(id);
      const BodyId id = p.world.bodies()[p.random.bits() % p.world.size()];
      const double choice = p.random.uniform();
      if (choice < 0.3) {
        p.set_velocity(id, 4.0 * p.random.point_in_ball());
      } else if (choice < 0.5) {
        const Vec3 place = p.any_point() + Vec3{12, -6, 0};
        p.world.teleport(id, {place, p.state(id).velocity}).value();
        p.set_position(id, place);
      } else if (choice < 0.7) {
        p.world.change(id, {.radius = 0.6 * p.random.uniform()}).value();
      } else if (choice < 0.85) {
        p.world.change(id, {.motion_limits = MotionLimits{.acceleration_limit = p.random.uniform()}}).value();
      } else {
        p.world.remove(id).value();
        p.add({.radius = 0.3,
               .acceleration_limit = 1.0,
               .position = p.any_point(),
               .velocity = 4.0 * p.random.point_in_ball()},
              Vec3{});
      }
    }
  }
}

/// Reports with errors, and true paths that bend as far as the limits allow.
TEST(PeriodicBox, NothingIsMissedWithErrorsAndAccelerations) {
  const double noise = 1e-3;
  PeriodicWorld p({.name = "noisy", .box = {{0, 0, 0}, {5, 4, 3}}}, {.separation_distance = 8 * noise});
  for (int k = 0; k < 20; ++k) {
    const double radius = k == 0 ? 0.48 : 0.05 + 0.2 * p.random.uniform();
    p.ids.push_back(p.add({.radius = radius,
                           .acceleration_limit = 2,
                           .position_error = noise,
                           .velocity_error = noise,
                           .position = p.any_point(),
                           .velocity = 3.0 * p.random.point_in_ball()},
                          1.999 * p.random.point_in_ball()));
  }
  p.kind.reports = Reports::any_image;
  p.distort = [&](BodyId, double, State& state) {
    state.position = p.reported(state.position + 0.999 * noise * p.random.point_in_ball());
    state.velocity += 0.999 * noise * p.random.point_in_ball();
  };
  std::set<std::pair<BodyId, BodyId>> touching;
  for (int step = 1; step <= 300; ++step) {
    for (const Event& event : p.run(0.01 * step)) {
      EXPECT_NE(event.kind, EventKind::bound_violation) << event;
      if (event.kind == EventKind::contact_begin) touching.insert({event.first, event.second});
      if (event.kind == EventKind::contact_end) touching.erase({event.first, event.second});
    }
    for (const BodyId a : p.ids)
      for (const BodyId b : p.ids)
        if (a < b && p.true_gap(a, b, p.world.time()) < -eps) {
          EXPECT_TRUE(touching.contains({a, b})) << a << " " << b << " at " << p.world.time();
        }
    if (step % 10 == 0) {
      for (const BodyId id : p.ids) p.steer(id, 1.999 * p.random.point_in_ball());
      EXPECT_TRUE(is_clean(p.world));
    }
  }
}

TEST(PeriodicBox, AGasConservesMomentumAndEnergy) {
  PeriodicWorld p({.name = "gas", .box = {{0, 0, 0}, {8, 8, 8}}, .reports = Reports::wrapped},
                  {.contacts = ContactEvents::impacts, .allow_overlap = false});
  while (p.ids.size() < 120) {
    const BodyDefinition body{
        .radius = 0.5, .position = p.any_point(), .velocity = 3.0 * p.random.point_in_ball()};
    if (p.world.add(body)) {
      p.world.remove(p.world.bodies().back()).value();
      p.ids.push_back(p.add(body));
    }
  }
  const auto momentum = [&] {
    Vec3 sum;
    for (const BodyId id : p.ids) sum += p.state(id).velocity;
    return sum;
  };
  const auto energy = [&] {
    double sum = 0.0;
    for (const BodyId id : p.ids) sum += 0.5 * norm_squared(p.state(id).velocity);
    return sum;
  };
  const Vec3 momentum_before = momentum();
  const double energy_before = energy();
  std::size_t bounces = 0;
  for (int step = 1; step <= 20; ++step) {
    p.run(0.1 * step, [&](const Event& event) {
      ASSERT_EQ(event.kind, EventKind::contact_begin) << event;
      ++bounces;
      const Vec3 change = event.normal * event.approach_speed;
      p.set_velocity(event.first, p.state(event.first).velocity - change);
      p.set_velocity(event.second, p.state(event.second).velocity + change);
    });
    for (const BodyId a : p.ids)
      for (const BodyId b : p.ids)
        if (a < b) {
          ASSERT_GE(p.true_gap(a, b, p.world.time()), -eps) << a << " " << b;
        }
    ASSERT_TRUE(is_clean(p.world));
  }
  EXPECT_GT(bounces, 300u);
  EXPECT_NEAR(norm(momentum() - momentum_before), 0.0, 1e-9);
  EXPECT_NEAR(energy() / energy_before, 1.0, 1e-10);
}

TEST(PeriodicBox, ABrokenPromiseIsNoticedAcrossTheBorder) {
  PeriodicWorld p({.name = "broken", .box = {{0, 0, 0}, {10, 10, 10}}, .reports = Reports::wrapped});
  const BodyId id =
      p.add({.radius = 1, .acceleration_limit = 1, .position = {9.5, 5, 5}, .velocity = {1, 0, 0}});
  p.run(0.1);
  p.set_position(id, {11.5, 5, 5});
  const auto events = p.run(20);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, EventKind::bound_violation);
  EXPECT_GT(events[0].position_excess, 0.5);
  EXPECT_LT(events[0].position_excess, 2.0);
  EXPECT_GE(events[0].first_state.position.x, 0.0);
  EXPECT_LT(events[0].first_state.position.x, 10.0);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(WrongPeriodic, IsRefused) {
  const Box box{{0, 0, 0}, {10, 10, 10}};
  const auto refused = [](const std::string& argument, const WorldDefinition& definition) {
    expect_error(World::create(definition), ErrorCode::out_of_range, argument, "World::create");
  };
  refused("periodic", {.periodic = all_axes});
  refused("periodic", {.periodic = {false, true, false}});
  refused("periodic", {.box = box, .periodic = all_axes, .dimensions = 2});
  refused("box", {.box = Box{{0, 0, 0}, {10, 1e-5, 10}}, .periodic = all_axes});
  EXPECT_TRUE(World::create({.box = Box{{0, 0, 0}, {10, 1e-5, 10}}, .periodic = {true, false, true}}));

  World world = World::create({.box = box, .periodic = {true, true, false}}).value();
  EXPECT_TRUE(world.add({.radius = 10.0 / 6.0}));
  expect_error(world.add({.radius = 1.9}), ErrorCode::out_of_range, "radius", "add");
  expect_error(world.add({.radius = 1.0, .position_error = 0.3}), ErrorCode::out_of_range, "radius", "add");
  expect_error(world.add({.radius = 1.0, .position = {3, 5, 11}}), ErrorCode::outside_domain, "position",
               "add");
  const BodyId id = world.add({.radius = 1.0, .position = {-3, 55, 5}}).value();
  const auto bytes = world.save().value();
  expect_error(world.change(id, {.radius = 1.9}), ErrorCode::out_of_range, "radius", "change", id);
  expect_error(world.change(id, {.motion_limits = MotionLimits{.position_error = 0.3}}),
               ErrorCode::out_of_range, "position_error", "change", id);
  expect_error(world.queries().sphere_cast({1, 1, 1}, 5.1, {1, 0, 0}, 10), ErrorCode::out_of_range, "radius",
               "sphere_cast");
  expect_error(world.queries().ray_cast({1, 1, 1}, {1, 0, 0}, 641), ErrorCode::out_of_range, "length",
               "ray_cast");
  EXPECT_EQ(world.save().value(), bytes);
  // A part that is too long is named with its length and that of the box, not a sensor that is not there.
  const RigidBody pole{.parts = {{{0, 0, 0}, {0, 0, 0}, 0.5}, {{-1, 0, 0}, {2, 0, 0}, 0.5}}};
  const auto too_long = world.add_rigid_body(pole);
  expect_error(too_long, ErrorCode::out_of_range, "parts",
               "add_rigid_body: parts[1] is 4 long and reaches 2.5");
  EXPECT_NE(too_long.error().message.find("box that is 10 long on x"), std::string::npos)
      << too_long.error().message;
  world.set_sensor(3, {.distances = {1.0}}).value();
  const auto too_far = world.add({.radius = 1.0, .sensor_class = 3});
  expect_error(too_far, ErrorCode::out_of_range, "sensor_class",
               "add: sensor_class must leave 2 (radius + sensor");
  EXPECT_EQ(world.bodies().size(), 2u);
  EXPECT_TRUE(world.queries().ray_cast({1, 1, 1}, {1, 0, 0}, 640));
  EXPECT_TRUE(world.queries().overlapping({1, 1, 1}, 1e6));
  EXPECT_EQ(world.queries().overlapping({1, 1, 1}, 1e6).value().size(), 2u);
}

}  // namespace
}  // namespace kinesphere::periodic_test
