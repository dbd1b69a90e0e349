// Worlds of two dimensions: discs have the events of spheres in the plane z = 0, without the cost of the
// third axis.
#include <gtest/gtest.h>

#include <algorithm>

#include "kinesphere/certificates.hpp"
#include "kinesphere/queries.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"

namespace kinesphere::plane_test {
namespace {

constexpr double eps = 1e-6;

Vec3 flat(Vec3 v) { return {v.x, v.y, 0.0}; }

/// Adds equal bodies for each definition.
class Discs : public Playground {
 public:
  explicit Discs(const WorldDefinition& definition, std::uint64_t seed, std::size_t bodies = 80)
      : Playground(definition), random(seed) {
    for (std::size_t k = 0; k < bodies; ++k) {
      const double limit = 2.0 * random.uniform();
      add({.radius = 0.05 + 0.35 * random.uniform(),
           .acceleration_limit = limit,
           .position = {10.0 * random.uniform(), 10.0 * random.uniform(), 0.0},
           .velocity = 2.0 * flat(random.point_in_ball())},
          0.99 * limit * flat(random.point_in_ball()));
    }
  }

  Random random;
};

/// The walls of the third axis are out of reach.
WorldDefinition definition(int dimensions, ContactEvents mode = ContactEvents::begin_and_end) {
  return {.box = Box{{0, 0, -50}, {10, 10, 50}},
          .dimensions = dimensions,
          .contact_tolerance = eps,
          .contacts = mode};
}

auto without_time(const Event& event) {
  return std::tuple(event.kind, event.first, event.second, event.wall);
}

void expect_same_events(std::vector<Event> flat_events, std::vector<Event> deep_events) {
  // Two contacts at almost equal times may be in another order.
  const auto order = [](const Event& a, const Event& b) {
    return without_time(a) != without_time(b) ? without_time(a) < without_time(b) : a.time < b.time;
  };
  std::sort(flat_events.begin(), flat_events.end(), order);
  std::sort(deep_events.begin(), deep_events.end(), order);
  ASSERT_EQ(flat_events.size(), deep_events.size());
  for (std::size_t k = 0; k < flat_events.size(); ++k) {
    EXPECT_EQ(without_time(flat_events[k]), without_time(deep_events[k]));
    // Each time is exact to within the tolerance, which a grazing pair takes long to cross.
    const double closing = std::abs(flat_events[k].approach_speed);
    const double margin = 2.0 * eps / std::max(closing, 1e-3) + 1e-9;
    EXPECT_NEAR(flat_events[k].time, deep_events[k].time, margin) << flat_events[k] << deep_events[k];
    EXPECT_EQ(flat_events[k].first_state.position.z, 0.0);
    EXPECT_EQ(flat_events[k].normal.z, 0.0);
  }
}

TEST(Plane, DiscsMeetAsSpheresInThePlaneDo) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    Discs discs(definition(2), seed);
    Discs spheres(definition(3), seed);
    const auto events = discs.run(2.0);
    EXPECT_GT(events.size(), 150u);
    expect_same_events(events, spheres.run(2.0));
    EXPECT_TRUE(is_clean(discs.world));
  }
}

TEST(Plane, BouncingDiscsStayApart) {
  Playground p({.box = Box{{0, 0, 7}, {10, 10, -3}},
                .dimensions = 2,
                .contact_tolerance = eps,
                .contacts = ContactEvents::impacts,
                .allow_overlap = false});
  Random random(5);
  std::vector<BodyId> ids;
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      ids.push_back(p.add({.radius = 0.5,
                           .position = {1.0 + 1.1 * x, 1.0 + 1.1 * y, 0},
                           .velocity = flat(random.point_in_ball())}));
  for (int step = 1; step <= 10; ++step) {
    p.run(0.5 * step, [&](const Event& event) {
      const Vec3 change = event.normal * event.approach_speed;
      if (event.second == no_body)
        return p.set_velocity(event.first, p.state(event.first).velocity - 2.0 * change);
      p.set_velocity(event.first, p.state(event.first).velocity - change);
      p.set_velocity(event.second, p.state(event.second).velocity + change);
    });
    ASSERT_TRUE(is_clean(p.world));
    for (const BodyId a : ids)
      for (const BodyId b : ids)
        if (a < b) {
          ASSERT_GE(p.gap(a, b), -eps) << a << " " << b;
        }
  }
  EXPECT_GT(p.world.counters().events[static_cast<std::size_t>(EventKind::contact_begin)], 100u);
}

/// A box without depth stands in one layer of cells.
TEST(Plane, BoxesHaveNoDepth) {
  Discs discs(definition(2), 7);
  discs.run(0.2);
  for (const BodyId id : discs.world.bodies()) {
    const Box box = discs.world.body(id).value().box;
    EXPECT_EQ(box.lower.z, 0.0);
    EXPECT_EQ(box.upper.z, 0.0);
  }
}

TEST(Plane, GoesOnFromASnapshotToTheBit) {
  Discs p(definition(2), 9);
  p.run(0.5);
  World restored = World::restore(p.world.save().value()).value();
  std::vector<EventHash> hashes;
  for (World* world : {&p.world, &restored}) {
    EventHash hash;
    while (const auto event = world->advance(1.5, p.probe()).value()) hash.add(*event);
    hashes.push_back(hash);
  }
  EXPECT_EQ(hashes[0].value(), hashes[1].value());
  EXPECT_EQ(p.world.save().value(), restored.save().value());
}

TEST(Plane, QueriesAndAnswersAreThoseOfThePlane) {
  Discs discs(definition(2), 11);
  Discs spheres(definition(3), 11);
  discs.run(0.7);
  spheres.run(0.7);
  const auto ids_of = [](const auto& found) {
    std::vector<BodyId> ids;
    for (const auto& each : found) ids.push_back(each.body);
    return ids;
  };
  const Vec3 centre{4, 5, 0};
  EXPECT_EQ(ids_of(discs.world.queries(discs.probe()).overlapping(centre, 2.0).value()),
            ids_of(spheres.world.queries(spheres.probe()).overlapping(centre, 2.0).value()));
  // The z of a region does not matter.
  EXPECT_EQ(ids_of(discs.world.queries(discs.probe()).overlapping({{2, 2, 30}, {5, 5, 40}}).value()),
            ids_of(spheres.world.queries(spheres.probe()).overlapping({{2, 2, 0}, {5, 5, 0}}).value()));
  EXPECT_EQ(ids_of(discs.world.queries(discs.probe()).nearest(centre, 5).value()),
            ids_of(spheres.world.queries(spheres.probe()).nearest(centre, 5).value()));
  EXPECT_EQ(ids_of(discs.world.queries(discs.probe()).ray_cast({0, 0, 0}, {1, 1, 0}, 14).value()),
            ids_of(spheres.world.queries(spheres.probe()).ray_cast({0, 0, 0}, {1, 1, 0}, 14).value()));
  World lonely = World::create(definition(2)).value();
  const BodyId id = lonely.add({.radius = 1, .position = {5, 5, 0}, .velocity = {0, 1, 0}}).value();
  const EarliestContact first = lonely.certificates().earliest_contact(id).value();
  EXPECT_EQ(first.wall, Wall::y_upper);
  EXPECT_NEAR(first.time, 4.0, 1e-3);
}

TEST(WrongPlane, IsRefused) {
  for (const int dimensions : {-1, 0, 1, 4})
    expect_error(World::create({.dimensions = dimensions}), ErrorCode::out_of_range, "dimensions",
                 "World::create");
  EXPECT_TRUE(World::create({.box = Box{{0, 0, 0}, {1, 1, 0}}, .dimensions = 2}))
      << "the z of the box does not matter";
  Playground p({.dimensions = 2});
  const auto refused = [&](const std::string& argument, const BodyDefinition& body) {
    expect_error(p.world.add(body), ErrorCode::out_of_range, argument, "add");
  };
  refused("position", {.position = {0, 0, 1e-300}});
  refused("velocity", {.velocity = {0, 0, -1}});
  refused("planned_acceleration", {.planned_acceleration = {0, 0, -9.81}});
  const BodyId id = p.add({.radius = 1, .acceleration_limit = 1});
  p.run(1.01);
  const auto bytes = p.world.save().value();
  expect_error(p.world.set_velocity(id, {0, 0, 1}), ErrorCode::out_of_range, "velocity", "set_velocity", id);
  expect_error(p.world.teleport(id, {{0, 0, 1}, {}}), ErrorCode::out_of_range, "position", "teleport", id);
  expect_error(p.world.teleport(id, {{}, {0, 0, 1}}), ErrorCode::out_of_range, "velocity", "teleport", id);
  expect_error(p.world.change(id, {.motion_limits = MotionLimits{.planned_acceleration = {0, 0, 1}}}),
               ErrorCode::out_of_range, "planned_acceleration", "change", id);
  expect_error(p.world.queries().overlapping({0, 0, 1}, 1.0), ErrorCode::out_of_range, "centre",
               "overlapping");
  expect_error(p.world.queries().nearest({0, 0, 1}, 1), ErrorCode::out_of_range, "point", "nearest");
  expect_error(p.world.queries().ray_cast({0, 0, 1}, {1, 0, 0}, 1), ErrorCode::out_of_range, "origin",
               "ray_cast");
  expect_error(p.world.queries().ray_cast({0, 0, 0}, {1, 0, 1}, 1), ErrorCode::out_of_range, "direction",
               "ray_cast");
  EXPECT_EQ(p.world.save().value(), bytes);
  for (const bool velocity : {false, true}) {
    p.distort = [=](BodyId, double, State& state) { (velocity ? state.velocity : state.position).z = 0.5; };
    expect_error(p.world.queries(p.probe()).nearest({}, 1), ErrorCode::out_of_range,
                 velocity ? "velocity" : "position", "nearest", id);
  }
}

}  // namespace
}  // namespace kinesphere::plane_test
