// Static bodies: contacts with them, their times, and queries.
#include <gtest/gtest.h>

#include <set>

#include "kinesphere/certificates.hpp"
#include "kinesphere/queries.hpp"
#include "number/infinity.hpp"
#include "support/expect_error.hpp"
#include "world/surroundings.hpp"

namespace kinesphere::surroundings_test {
namespace {

constexpr double eps = 1e-6;
const HalfSpace ground{{0, 0, 1}, 0.0};
const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
const Box unit_box{{-1, -1, -1}, {1, 1, 1}};

struct Flight {
  const char* name;
  Shape shape;
  Vec3 position, velocity;
  double radius;
  double begin, end;  ///< when the gap is 0; infinite where it never is
  Vec3 normal;        ///< from the ball to the shape, at the begin
};

std::ostream& operator<<(std::ostream& out, const Flight& flight) { return out << flight.name; }

class FlightThrough : public testing::TestWithParam<Flight> {};

TEST_P(FlightThrough, BeginsAndEndsOnTime) {
  const Flight& f = GetParam();
  for (const bool ball_first : {true, false}) {
    Surroundings p({.contact_tolerance = eps});
    BodyId shape, ball;
    const BodyDefinition body{
        .radius = f.radius, .acceleration_limit = 0.5, .position = f.position, .velocity = f.velocity};
    if (!ball_first) shape = p.place(f.shape);
    ball = p.add(body, Vec3{});
    if (ball_first) shape = p.place(f.shape);
    const double speed = norm(f.velocity);
    std::vector<Event> events;
    while (const auto event = p.advance(20.0)) {
      events.push_back(*event);
      EXPECT_TRUE(is_clean(p.world));
      EXPECT_EQ(event->first, ball_first ? ball : shape);
      EXPECT_EQ(event->second, ball_first ? shape : ball);
      EXPECT_NEAR(event->gap, p.gap_to(ball, shape), 1e-11);
    }
    EXPECT_TRUE(is_clean(p.world));
    if (f.begin == infinity) {
      EXPECT_TRUE(events.empty()) << events;
      continue;
    }
    ASSERT_EQ(events.size(), 2u) << events;
    EXPECT_EQ(events[0].kind, EventKind::contact_begin);
    EXPECT_NEAR(events[0].time, f.begin, 1e-4 / speed);
    EXPECT_LE(std::abs(events[0].gap), eps);
    const Vec3 normal = ball_first ? f.normal : -f.normal;
    EXPECT_NEAR(norm(events[0].normal - normal), 0.0, 1e-3);
    EXPECT_NEAR(distance(f.shape, events[0].point), 0.0, eps);
    EXPECT_NEAR(events[0].approach_speed, dot(f.normal, f.velocity), 1e-3 * speed);
    EXPECT_EQ(events[1].kind, EventKind::contact_end);
    EXPECT_NEAR(events[1].time, f.end, 2e-3 / speed);
    EXPECT_GE(events[1].gap, 4 * eps);
    EXPECT_LE(events[1].gap, 5 * eps);
  }
}

INSTANTIATE_TEST_SUITE_P(
    , FlightThrough,
    testing::Values(
        Flight{"thin_body_through_thin_triangle",
               flat,
               {1, 1, 500},
               {0, 0, -1000},
               1e-3,
               0.499999,
               0.500001,
               {0, 0, -1}},
        Flight{"from_below", flat, {1, 1, -6}, {0, 0, 1}, 1.0, 5, 7, {0, 0, 1}},
        Flight{"over_an_edge", flat, {2, -0.6, 5.8}, {0, 0, -1}, 1.0, 5, 6.6, {0, 0.6, -0.8}},
        Flight{"over_a_corner", flat, {-0.36, -0.48, 5.8}, {0, 0, -1}, 1.0, 5, 6.6, {0.36, 0.48, -0.8}},
        Flight{"against_an_edge", flat, {2, -6, 0}, {0, 1, 0}, 1.0, 5, 8 + std::sqrt(2.0), {0, 1, 0}},
        Flight{"just_past_an_edge", flat, {2, -1.00001, 5}, {0, 0, -1}, 1.0, infinity, infinity, {}},
        Flight{"through_a_box", unit_box, {0.5, 0.5, 7}, {0, 0, -1}, 1.0, 5, 9, {0, 0, -1}},
        Flight{"past_the_corner_of_a_box", unit_box, {2, 2.2, 7}, {0, 0, -2}, 1.5, infinity, infinity, {}},
        Flight{"onto_the_edge_of_a_box", unit_box, {1.6, 0, 6.8}, {0, 0, -1}, 1.0, 5, 8.6, {-0.6, 0, -0.8}},
        Flight{"through_a_ball", Ball{{0, 0, 0}, 2}, {0, 0, 8}, {0, 0, -1}, 1.0, 5, 11, {0, 0, -1}},
        Flight{"past_a_half_space", ground, {0, 0, 5}, {3, 0, 0}, 1.0, infinity, infinity, {}}),
    [](const auto& flight) { return std::string(flight.param.name); });

TEST(Surroundings, IntoAHalfSpaceAndOutAgain) {
  Surroundings p({.contact_tolerance = eps});
  const BodyId floor = p.place(ground);
  const BodyId ball =
      p.add({.radius = 1, .planned_acceleration = {0, 0, 2}, .position = {0, 0, 4}, .velocity = {1, 0, -4}});
  const auto events = p.run(100.0, [&](const Event&) { EXPECT_TRUE(is_clean(p.world)); });
  ASSERT_EQ(events.size(), 2u) << events;
  // The height 3 - 4 t + t^2 is 0 at 1 and 3.
  EXPECT_NEAR(events[0].time, 1.0, 1e-6);
  EXPECT_NEAR(events[1].time, 3.0, 1e-4);
  EXPECT_EQ(events[0].first, floor);
  EXPECT_EQ(events[0].normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(events[0].second, ball);
  EXPECT_LE(p.world.counters().searches, 200u);
}

TEST(Surroundings, OverlapsBeginAtOnceAndEndWithEitherBody) {
  Surroundings p({.contact_tolerance = eps});
  const BodyId ball = p.add({.radius = 1, .position = {0.5, 0, 0}});
  const BodyId box = p.place(unit_box);
  const auto begin = p.advance(0.0);
  ASSERT_TRUE(begin);
  EXPECT_EQ(begin->kind, EventKind::contact_begin);
  EXPECT_NEAR(begin->gap, -1.5, 1e-12);
  EXPECT_EQ(begin->normal, (Vec3{-1, 0, 0})) << "the nearest face is at x = 1";
  EXPECT_FALSE(p.advance(1.0));
  // Disabled and enabled again.
  p.world.disable(box).value();
  EXPECT_TRUE(is_clean(p.world));
  EXPECT_EQ(p.advance(2.0)->kind, EventKind::contact_end);
  EXPECT_FALSE(p.advance(2.0));
  p.world.enable(box, {{9, 9, 9}, {1, 1, 1}}).value();
  const auto again = p.advance(3.0);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->time, 2.0);
  EXPECT_NEAR(again->gap, -1.5, 1e-12);
  EXPECT_TRUE(is_clean(p.world));
  // A filter ends the contact, and no new one begins.
  p.world.change(box, {.filter = Filter{.category = 2, .mask = 0}}).value();
  EXPECT_EQ(p.advance(3.0)->kind, EventKind::contact_end);
  EXPECT_FALSE(p.advance(3.0));
  EXPECT_TRUE(is_clean(p.world));
  p.world.change(box, {.filter = Filter{}}).value();
  EXPECT_EQ(p.advance(4.0)->kind, EventKind::contact_begin);
  EXPECT_TRUE(is_clean(p.world));
  p.world.remove(box).value();
  EXPECT_EQ(p.advance(4.0)->kind, EventKind::contact_end);
  EXPECT_FALSE(p.advance(5.0));
  EXPECT_TRUE(is_clean(p.world));
  // The body's index and its shape's slot are used again.
  EXPECT_EQ(p.place(flat).index, box.index);
  EXPECT_EQ(std::get<Triangle>(p.world.body({box.index, box.generation + 1}).value().shape), flat);
  EXPECT_EQ(p.advance(6.0)->kind, EventKind::contact_begin);
  p.set_position(ball, {0, 0, 50});
  p.world.teleport(ball, p.state(ball)).value();
  EXPECT_EQ(p.advance(6.0)->kind, EventKind::contact_end);
  EXPECT_FALSE(p.advance(7.0));
  EXPECT_TRUE(is_clean(p.world));
}

TEST(Surroundings, FixedBodiesDoNotConcernEachOther) {
  Surroundings p;
  p.place(ground);
  for (int k = 0; k < 6; ++k) {
    p.place(Box{{-1, -1, 0.5 * k}, {1, 1, 0.5 * k + 1}});
    p.place(Ball{{0, 0, 0.5 * k}, 1});
    p.place(flat);
  }
  EXPECT_FALSE(p.advance(100.0));
  EXPECT_TRUE(is_clean(p.world));
  EXPECT_EQ(p.world.counters().probes, 0u);
  EXPECT_EQ(p.world.counters().certificates, 0u);
  EXPECT_EQ(p.world.certificates().safe_until().value().time, infinity);
}

/// Six half-spaces and twelve triangles for the walls of a box: the events inside are equal.
class MarginOf : public testing::TestWithParam<const char*> {
 protected:
  static constexpr double size = 10.0;

  static std::vector<StaticDefinition> walls_of(const std::string& kind) {
    if (kind == "half_spaces") {
      std::vector<StaticDefinition> all;
      for (int axis = 0; axis < 3; ++axis) {
        HalfSpace lower{{}, 0.0}, upper{{}, -size};
        lower.normal[axis] = 1.0;
        upper.normal[axis] = -1.0;
        all.push_back({.shape = lower});
        all.push_back({.shape = upper});
      }
      return all;
    }
    if (kind == "boxes") {
      std::vector<StaticDefinition> all;
      for (int axis = 0; axis < 3; ++axis)
        for (const bool up : {false, true}) {
          Box box{{-5, -5, -5}, {size + 5, size + 5, size + 5}};
          (up ? box.lower : box.upper)[axis] = up ? size : 0.0;
          all.push_back({.shape = box});
        }
      return all;
    }
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k) corners.push_back({size * (k & 1), size * (k >> 1 & 1), size * (k >> 2 & 1)});
    using Corners = std::vector<std::array<std::uint32_t, 3>>;
    return triangles(corners, Corners{{0, 1, 3},
                                      {0, 3, 2},
                                      {4, 5, 7},
                                      {4, 7, 6},
                                      {0, 1, 5},
                                      {0, 5, 4},
                                      {2, 3, 7},
                                      {2, 7, 6},
                                      {0, 2, 6},
                                      {0, 6, 4},
                                      {1, 3, 7},
                                      {1, 7, 5}})
        .value();
  }
};

TEST_P(MarginOf, BouncesAsWallsDo) {
  const std::string kind = GetParam();
  std::vector<std::size_t> counts;
  std::vector<State> last;
  for (const bool walled : {true, false}) {
    WorldDefinition definition{.contact_tolerance = eps, .contacts = ContactEvents::impacts};
    if (walled) definition.box = Box{{0, 0, 0}, {size, size, size}};
    Surroundings p(definition);
    // The filters separate all bodies, so that each bounces alone.
    Random random(7);
    std::vector<BodyId> balls;
    for (int k = 0; k < 6; ++k) {
      const Vec3 position{1 + 8 * random.uniform(), 1 + 8 * random.uniform(), 1 + 8 * random.uniform()};
      const Vec3 velocity = 6.0 * random.point_in_ball();
      balls.push_back(p.add({.radius = 0.5,
                             .acceleration_limit = 1,
                             .planned_acceleration = {0, 0, -3},
                             .position = position,
                             .velocity = velocity,
                             .filter = {.group = -1}}));
    }
    if (!walled) p.place_all(walls_of(kind));
    std::size_t contacts = 0;
    p.run(20.0, [&](const Event& event) {
      if (event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin) ++contacts;
      p.bounce(event);
      if (contacts % 16 == 0) {
        EXPECT_TRUE(is_clean(p.world));
      }
    });
    counts.push_back(contacts);
    last.push_back(p.state(balls[0]));
  }
  EXPECT_GT(counts[0], 90u);
  EXPECT_EQ(counts[0], counts[1]);
  EXPECT_NEAR(norm(last[0].position - last[1].position), 0.0, 1e-2);
}

INSTANTIATE_TEST_SUITE_P(, MarginOf, testing::Values("half_spaces", "boxes", "triangles"),
                         [](const auto& room) { return std::string(room.param); });

TEST(Surroundings, OneBounceOnASharedEdge) {
  Surroundings p({.contact_tolerance = eps, .contacts = ContactEvents::impacts});
  const std::vector<Vec3> vertices{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  const std::vector<std::array<std::uint32_t, 3>> corners{{0, 1, 2}, {0, 2, 3}};
  p.place_all(triangles(vertices, corners).value());
  const BodyId ball = p.add({.radius = 1, .position = {2, 2, 3}, .velocity = {0, 0, -1}});
  const auto events = p.run(10.0, [&](const Event& event) {
    EXPECT_EQ(event.kind, EventKind::contact_begin);
    p.bounce(event);
  });
  EXPECT_EQ(events.size(), 1u) << events;
  EXPECT_NEAR(p.state(ball).velocity.z, 1.0, 1e-9);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(Surroundings, ABallRestsAndRollsOnAMesh) {
  // Stopped again and again: the Zeno guard and the mesh's edges together.
  Surroundings p({.contact_tolerance = eps, .contacts = ContactEvents::impacts});
  const std::vector<Vec3> vertices{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  const std::vector<std::array<std::uint32_t, 3>> corners{{0, 1, 2}, {0, 2, 3}};
  p.place_all(triangles(vertices, corners).value());
  const BodyId ball = p.add(
      {.radius = 0.5, .planned_acceleration = {0, 0, -10}, .position = {1, 3, 0.6}, .velocity = {1, -1, 0}});
  double lowest = infinity;
  p.run(2.0, [&](const Event& event) {
    if (event.kind != EventKind::contact_begin) return;
    const Vec3 v = p.state(ball).velocity;
    p.set_velocity(ball, v + event.normal * ((event.repeated ? 2.0 : 1.5) * event.approach_speed));
    lowest = std::min(lowest, p.state(ball).position.z - 0.5);
  });
  EXPECT_GE(lowest, -eps);
  EXPECT_NEAR(p.state(ball).position.x, 3.0, 1e-3);
  EXPECT_LT(p.state(ball).position.z, 0.52);
  EXPECT_TRUE(is_clean(p.world));
}

/// Returns hills of (2 n^2) triangles.
std::vector<StaticDefinition> terrain(int n, double width) {
  std::vector<Vec3> vertices;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const double x = i * 1.0 / n, y = j * 1.0 / n;
      vertices.push_back(
          {width * x, width * y, 12.0 * x * (1 - x) * (3 * y - 1) * (y - 0.8) + 0.1 * ((i * 7 + j * 5) % 3)});
    }
  std::vector<std::array<std::uint32_t, 3>> corners;
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      corners.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      corners.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return triangles(vertices, corners).value();
}

TEST(Terrain, BallsThatFallThroughTouchWhatBruteForceSays) {
  constexpr double big_eps = 1e-4;
  Surroundings p({.contact_tolerance = big_eps});
  const auto hills = p.place_all(terrain(40, 20.0));
  ASSERT_EQ(hills.size(), 3200u);
  Random random(3);
  std::vector<BodyId> balls;
  for (int k = 0; k < 30; ++k) {
    const Vec3 position{20 * random.uniform(), 20 * random.uniform(), 3 + 5 * random.uniform()};
    const Vec3 push = 0.9 * random.point_in_ball();
    balls.push_back(p.add({.radius = 0.05 + 0.5 * random.uniform(),
                           .acceleration_limit = 1,
                           .planned_acceleration = {0, 0, -5},
                           .position = position,
                           .velocity = 3 * random.point_in_ball(),
                           .filter = {.group = -1}},
                          Vec3{0, 0, -5} + push));
  }
  std::set<std::pair<BodyId, BodyId>> touching;
  const auto note = [&](const Event& event) {
    const auto pair = std::pair(event.first, event.second);
    const bool news =
        event.kind == EventKind::contact_begin ? touching.insert(pair).second : touching.erase(pair) == 1;
    EXPECT_TRUE(news) << event;
  };
  std::size_t events = 0, touched = 0;
  for (int stop = 1; stop <= 40; ++stop) {
    events += p.run(0.075 * stop, note).size();
    for (const BodyId ball : balls)
      for (const BodyId hill : hills) {
        const double gap = p.gap_to(ball, hill);
        const bool touch = touching.contains({hill, ball});
        if (touch) ++touched;
        ASSERT_TRUE(gap > -big_eps || touch) << ball << " is unreported in " << hill << " by " << gap;
        ASSERT_TRUE(gap < 5 * big_eps + 1e-9 || !touch)
            << ball << " does not touch " << hill << ", gap " << gap;
      }
    if (stop == 15) {
      EXPECT_TRUE(is_clean(p.world));
    }
  }
  EXPECT_GT(events, 300u);
  EXPECT_GT(touched, 100u);
}

TEST(Terrain, BouncingBallsStayAboveIt) {
  constexpr double big_eps = 1e-4;
  Surroundings p({.contact_tolerance = big_eps, .contacts = ContactEvents::impacts});
  const auto hills = p.place_all(terrain(24, 20.0));
  Random random(4);
  std::vector<BodyId> balls;
  for (int k = 0; k < 20; ++k)
    balls.push_back(p.add(
        {.radius = 0.2 + 0.3 * random.uniform(),
         .acceleration_limit = 1,
         .planned_acceleration = {0, 0, -5},
         .position = {4 + 12 * random.uniform(), 4 + 12 * random.uniform(), 4 + 5 * random.uniform()}}));
  std::size_t bounces = 0;
  for (int stop = 1; stop <= 20; ++stop) {
    p.run(0.2 * stop, [&](const Event& event) {
      ++bounces;
      EXPECT_NE(event.kind, EventKind::zeno_guard);
      p.bounce(event);
    });
    for (const BodyId ball : balls)
      for (const BodyId hill : hills) ASSERT_GE(p.gap_to(ball, hill), -big_eps) << ball << " in " << hill;
  }
  EXPECT_GT(bounces, 30u);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(Surroundings, SavedInTheMiddleOfContacts) {
  Surroundings p({.contact_tolerance = eps});
  p.place(ground);
  const BodyId gone = p.place(Ball{{0, 0, 2}, 1});
  p.place(unit_box);
  p.place(Triangle{{-9, -9, 1.5}, {9, -9, 1.5}, {0, 9, 1.5}});
  p.world.remove(gone).value();
  for (int k = 0; k < 8; ++k)
    p.add(
        {.radius = 0.6, .acceleration_limit = 1, .position = {k - 3.5, 0, 2.5}, .velocity = {0, 0, -0.2 * k}},
        Vec3{});
  p.run(4.0);
  World back = World::restore(p.world.save().value()).value();
  EXPECT_EQ(back.save().value(), p.world.save().value());
  EXPECT_TRUE(is_clean(back));
  std::size_t events = 0;
  while (const auto event = p.world.advance(20.0, p.probe()).value()) {
    const auto same = back.advance(20.0, p.probe()).value();
    ASSERT_TRUE(same);
    EXPECT_EQ(same->time, event->time);
    EXPECT_EQ(same->first, event->first);
    EXPECT_EQ(same->second, event->second);
    ++events;
  }
  EXPECT_FALSE(back.advance(20.0, p.probe()).value());
  EXPECT_GT(events, 5u);
  EXPECT_EQ(back.save().value(), p.world.save().value());
}

TEST(Surroundings, SavedWhenOneHasTakenTheIndexOfABallThatTouched) {
  for (const double height : {0.5, 3.0}) {
    Surroundings p({.box = Box{{-9, -9, -9}, {9, 9, 9}}, .contact_tolerance = eps});
    p.place(ground);
    const BodyId ball = p.add({.radius = 1, .position = {0, height == 3.0 ? 8.5 : 0.0, height}}, Vec3{});
    ASSERT_TRUE(p.advance(1.0)) << "it touches the ground or a wall";
    p.world.remove(ball).value();
    EXPECT_EQ(p.world.add_static({.shape = unit_box})->index, ball.index);
    EXPECT_TRUE(World::restore(p.world.save().value()));
    EXPECT_TRUE(is_clean(p.world));
  }
}

TEST(Surroundings, OneThatSensesIsRegisteredWithItsReach) {
  Surroundings p;
  p.world.set_sensor(1, {.distances = {2}}).value();
  const BodyId box = p.world.add_static({.shape = unit_box, .sensor_class = 1}).value();
  EXPECT_TRUE(is_clean(p.world));
  p.world.set_sensor(1, {.distances = {3}}).value();
  EXPECT_TRUE(is_clean(p.world));
  p.world.disable(box).value();
  p.world.set_sensor(1, {}).value();
  p.world.enable(box, {}).value();
  EXPECT_TRUE(is_clean(p.world));
}

TEST(Surroundings, AnswersAreCertifiedAndNear) {
  Surroundings p({.contact_tolerance = eps});
  const BodyId triangle = p.place(flat);
  const BodyId box = p.place(Box{{10, -1, -1}, {12, 1, 1}});
  const BodyId ball = p.add({.radius = 1, .position = {1, 1, 6}, .velocity = {0, 0, -1}});
  EXPECT_NEAR(p.world.certificates().safe_until(triangle, ball)->time, 5.0, 1e-3);
  EXPECT_NEAR(p.world.certificates().safe_until(ball)->time, 5.0, 1e-3);
  EXPECT_NEAR(p.world.certificates().safe_until()->time, 5.0, 1e-3);
  EXPECT_EQ(p.world.certificates().earliest_contact(ball)->partner, triangle);
  EXPECT_EQ(p.world.certificates().earliest_contact(triangle)->partner, ball);
  EXPECT_EQ(p.world.certificates().safe_until(box, triangle)->time, infinity);
  EXPECT_EQ(p.world.certificates().earliest_contact(box)->time, infinity);
  EXPECT_FALSE(p.advance(2.0));
  const auto now = p.world.certificates(p.probe()).distance_limits(ball, triangle, 2.0).value();
  EXPECT_NEAR(now.lower, 3.0, 1e-9);
  EXPECT_NEAR(now.upper, 3.0, 1e-9);
  EXPECT_LE(now.lower, 3.0);
  EXPECT_GE(now.upper, 3.0);
  EXPECT_EQ(p.world.certificates().distance_limits(box, triangle, 3.0)->upper, infinity);
  EXPECT_NEAR(p.world.certificates(p.probe()).safe_until(ball)->time, 5.0, 1e-3);
}

TEST(Surroundings, QueriesKnowTheirShapes) {
  Surroundings p;
  const BodyId triangle = p.place(flat);
  const BodyId box = p.place(Box{{10, -1, -1}, {12, 1, 1}});
  const BodyId floor = p.place(HalfSpace{{0, 0, 1}, -20.0});
  const BodyId ball = p.place(Ball{{0, 0, 10}, 2});
  EXPECT_FALSE(p.advance(0.0));
  const auto ids = [](const std::vector<OverlapHit>& found) {
    std::vector<BodyId> all;
    for (const OverlapHit& f : found) {
      EXPECT_EQ(f.certainty, Certainty::certainly);
      all.push_back(f.body);
    }
    return all;
  };
  using Ids = std::vector<BodyId>;
  EXPECT_EQ(ids(p.world.queries().overlapping(Vec3{1, 1, 1}, 1.001).value()), Ids{triangle});
  EXPECT_EQ(ids(p.world.queries().overlapping(Vec3{3, 3, 0}, 1.41).value()), Ids{}) << "beside the long side";
  EXPECT_EQ(ids(p.world.queries().overlapping(Vec3{3, 3, 0}, 1.42).value()), Ids{triangle});
  EXPECT_EQ(ids(p.world.queries().overlapping(Vec3{11, 0, 0}, 0.1).value()), Ids{box});
  EXPECT_EQ(ids(p.world.queries().overlapping(Vec3{0, 0, 0}, 20.001).value()),
            (Ids{triangle, box, floor, ball}));
  EXPECT_EQ(ids(p.world.queries().overlapping(Box{{2.1, 2.1, -1}, {3, 3, 1}}).value()), Ids{})
      << "only its box does";
  EXPECT_EQ(ids(p.world.queries().overlapping(Box{{1.9, 1.9, -1}, {3, 3, 1}}).value()), Ids{triangle});
  EXPECT_EQ(ids(p.world.queries().overlapping(Box{{11.5, 0, 0}, {20, 1, 1}}).value()), Ids{box});
  EXPECT_EQ(ids(p.world.queries().overlapping(Box{{0, 0, -30}, {1, 1, -25}}).value()), Ids{floor});
  const auto grazed = p.world.queries().overlapping(Vec3{1, 1, 1}, 1.0).value();
  ASSERT_EQ(grazed.size(), 1u);
  EXPECT_EQ(grazed[0].certainty, Certainty::possibly) << "rounding decides";
  const auto near = p.world.queries().nearest({1, 1, 3}, 2).value();
  ASSERT_EQ(near.size(), 2u);
  EXPECT_EQ(near[0].body, triangle);
  EXPECT_NEAR(near[0].lower, 3.0, 1e-9);
  EXPECT_EQ(near[1].body, ball);
  EXPECT_EQ(p.world.queries().nearest({0, 0, -21}, 1)->front().body, floor);

  const auto hit = [&](const Vec3& origin, double radius, const Vec3& direction) {
    const auto hits = p.world.queries().sphere_cast(origin, radius, direction, 100.0).value();
    EXPECT_EQ(hits.size(), 1u);
    if (hits.empty()) return std::pair(no_body, 0.0);
    EXPECT_EQ(hits[0].certainty, Certainty::certainly);
    EXPECT_LE(hits[0].lower, hits[0].upper);
    EXPECT_NEAR(hits[0].lower, hits[0].upper, 1e-8);
    return std::pair(hits[0].body, std::round(hits[0].lower * 1e6) * 1e-6);
  };
  EXPECT_EQ(hit({1, 1, -5}, 0.5, {0, 0, 1}), std::pair(triangle, 4.5));
  EXPECT_EQ(hit({1, 1, -5}, 0.0, {0, 0, 1}), std::pair(triangle, 5.0)) << "a ray goes through";
  EXPECT_EQ(hit({1, 1, 3}, 0.0, {0, 0, -1}), std::pair(triangle, 3.0));
  EXPECT_EQ(hit({5, 0, 0}, 0.0, {1, 0, 0}), std::pair(box, 5.0));
  EXPECT_EQ(hit({11, 0, 0}, 0.0, {1, 0, 0}), std::pair(box, 0.0));
  EXPECT_EQ(hit({-5, -5, 0}, 1.0, {0, 0, -1}), std::pair(floor, 19.0));
  EXPECT_EQ(hit({0, 0, 20}, 1.0, {0, 0, -1}), std::pair(ball, 7.0));
  EXPECT_TRUE(p.world.queries().ray_cast({3, 3, 5}, {0, 0, -1}, 10.0)->empty());
  EXPECT_FALSE(p.world.queries().ray_cast({2, 0, 5}, {0, 0, -1}, 10.0)->empty()) << "an edge is possibly hit";
}

TEST(Surroundings, WrongCalls) {
  Surroundings p({.contact_tolerance = eps, .allow_overlap = false});
  World& w = p.world;
  const BodyId box = p.place(unit_box);
  constexpr auto range = ErrorCode::out_of_range;
  expect_error(w.add_static({.shape = Ball{{0, 0, 0}, -1}}), range, "radius", "add_static: ");
  expect_error(w.add_static({.shape = Ball{{infinity, 0, 0}, 1}}), ErrorCode::not_finite, "shape",
               "add_static: ");
  expect_error(w.add_static({.shape = HalfSpace{{0, 0, 2}, 0}}), range, "shape", "add_static: ");
  expect_error(w.add_static({.shape = HalfSpace{{0, 0, 1}, 1e9}}), range, "shape", "add_static: ");
  expect_error(w.add_static({.shape = HalfSpace{{0, 0, 1}, infinity}}), ErrorCode::not_finite, "shape",
               "add_static: ");
  expect_error(w.add_static({.shape = Box{{0, 0, 0}, {1, -1, 1}}}), range, "shape", "add_static: ");
  expect_error(w.add_static({.shape = Box{{0, 0, 0}, {1, 1e9, 1}}}), range, "shape", "add_static: ");
  expect_error(w.add_static({.shape = Triangle{}}), range, "shape", "add_static: ");
  expect_error(w.add_static({.shape = Triangle{{0, 0, 0}, {1, 0, 0}, {2, 1e-7, 0}}}), range, "shape",
               "add_static: ");
  const std::vector<StaticDefinition> two{{.shape = ground}, {.shape = Triangle{}}};
  expect_error(w.add_static_all(two), range, "shape", "add_static_all: bodies[1]: ");
  EXPECT_EQ(w.size(), 1u);
  expect_error(w.set_velocity(box, {}), ErrorCode::static_body, "body", "set_velocity: ", box);
  expect_error(w.teleport(box, {}), ErrorCode::static_body, "body", "teleport: ", box);
  expect_error(w.change(box, {.radius = 1}), ErrorCode::static_body, "body", "change: ", box);
  expect_error(w.change(box, {.motion_limits = MotionLimits{}}), ErrorCode::static_body, "body",
               "change: ", box);
  expect_error(w.add({.radius = 1, .position = {1.5, 0, 0}}), ErrorCode::overlapping, "position",
               "add: ", box);
  const BodyId ball = p.add({.radius = 1, .position = {0, 0, 2}});
  expect_error(w.add_static({.shape = Triangle{{-5, -5, 2}, {5, -5, 2}, {0, 5, 2}}}), ErrorCode::overlapping,
               "shape", "add_static: ", ball);
  w.disable(box).value();
  p.world.teleport(ball, {{0, 0, 0}, {}}).value();
  p.set_position(ball, {});
  expect_error(w.enable(box, {}), ErrorCode::overlapping, "shape", "enable: ", ball);
  EXPECT_EQ(w.body(box)->is_static, true);
  EXPECT_EQ(w.body(ball)->is_static, false);
  EXPECT_EQ(std::get<Box>(w.body(box).value().shape), unit_box);
  EXPECT_EQ(std::get<Ball>(w.body(ball).value().shape).radius, 1.0);
  p.place(HalfSpace{{0, 0, 1 + 1e-9}, -5});
  const auto inside = [&](std::span<const BodyId>, double, std::span<State> states) {
    expect_error(w.add_static({.shape = ground}), ErrorCode::probe_in_progress, "probe", "add_static: ");
    expect_error(w.add_static_all(two), ErrorCode::probe_in_progress, "probe", "add_static_all: ");
    std::fill(states.begin(), states.end(), State{});
  };
  (void)w.advance(1.0, inside).value();
  EXPECT_TRUE(is_clean(w));
}

TEST(Surroundings, OneBallOnTheFloorDoesNotRepeatAnother) {
  Surroundings p({.contact_tolerance = eps, .contacts = ContactEvents::impacts, .zeno_interval = 0.5});
  p.place(ground);
  for (int k = 0; k < 3; ++k)
    p.add({.radius = 1, .position = {5.0 * k, 0, 2.0 + 0.1 * k}, .velocity = {0, 0, -1}});
  const auto events = p.run(2.0, [&](const Event& event) { p.bounce(event); });
  ASSERT_EQ(events.size(), 3u);
  for (const Event& event : events) EXPECT_FALSE(event.repeated) << event;
}

TEST(Surroundings, ManyBallsOnOneFloorCostNoMoreEach) {
  // The floor keeps no list that grows with the balls and is traversed for each of them.
  std::vector<double> wakes;
  for (const int count : {100, 1600}) {
    Surroundings p({.contact_tolerance = eps});
    p.place(ground);
    for (int k = 0; k < count; ++k)
      p.add({.radius = 0.4, .acceleration_limit = 0.1, .position = {k % 40 * 1.0, k / 40 * 1.0, 0.4}},
            Vec3{});
    p.run(5.0);
    wakes.push_back(static_cast<double>(p.world.counters().pair_checks) / count);
  }
  EXPECT_LT(wakes[1], 1.5 * wakes[0] + 1.0);
}

}  // namespace
}  // namespace kinesphere::surroundings_test
