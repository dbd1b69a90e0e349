// Balls with random accelerations and velocity changes among static bodies that are added and removed at
// random, compared with brute force.
#include <gtest/gtest.h>

#include <set>

#include "kinesphere/certificates.hpp"
#include "support/random_contacts.hpp"
#include "support/test_size.hpp"
#include "world/surroundings.hpp"

namespace kinesphere::random_surroundings_test {
namespace {

constexpr double eps = 1e-5;
constexpr double size = 8.0;

class RandomSurroundings : public testing::TestWithParam<ContactScene> {
 protected:
  RandomSurroundings() : p({.contact_tolerance = eps, .contacts = GetParam().mode}), random(GetParam().seed) {
    for (int k = 0; k < 12; ++k) come();
    for (int k = 0; k < 8; ++k) join();
  }

  Vec3 any_point() { return {size * random.uniform(), size * random.uniform(), size * random.uniform()}; }

  Shape any_shape() {
    const Vec3 at = any_point();
    switch (random.bits() % 5) {
      case 0:
        return Ball{at, random.uniform()};
      case 1: {
        const Vec3 normal = random.unit_vector();
        return HalfSpace{normal, dot(normal, at) - 5.0};
      }
      case 2:
        return Box{at, at + Vec3{random.uniform(), 2 * random.uniform(), random.uniform()}};
      case 3:
        return any_mesh(at);
      default: {
        if (random.bits() % 3 == 0) return needle_through(at);
        const Vec3 side = 3.0 * random.unit_vector();
        const Vec3 other = 3.0 * random.unit_vector();
        return Triangle{at, at + side, at + other};
      }
    }
  }

  /// Returns a hill of 32 triangles.
  Mesh any_mesh(const Vec3& at) {
    constexpr std::uint32_t sides = 4;
    std::vector<Vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> corners;
    for (std::uint32_t j = 0; j <= sides; ++j)
      for (std::uint32_t k = 0; k <= sides; ++k)
        vertices.push_back(at + 0.7 * Vec3{double(j), double(k), random.uniform()});
    for (std::uint32_t j = 0; j < sides; ++j)
      for (std::uint32_t k = 0; k < sides; ++k) {
        const std::uint32_t first = j * (sides + 1) + k;
        corners.push_back({first, first + 1, first + sides + 1});
        corners.push_back({first + sides + 2, first + 1, first + sides + 1});
      }
    return Mesh::create(vertices, corners).value();
  }

  /// Returns a triangle as long as a world with this tolerance allows, and hardly thicker than the minimum.
  Triangle needle_through(const Vec3& place) {
    constexpr double length = 1e7;
    const Vec3 along = length * random.unit_vector();
    const Vec3 across = cross(along, random.unit_vector());
    const Vec3 height = across / norm(across) * (0x1.1p-20 * length);
    const Vec3 corner = place - 0.5 * along - 0.25 * height;
    return {corner, corner + along, corner + random.uniform(0.25, 0.75) * along + height};
  }

  void come() { shapes.push_back(p.place(any_shape())); }

  void join() {
    const Vec3 plan = random.uniform() < 0.5 ? Vec3{0, 0, -0.3} : Vec3{};
    const BodyDefinition body{.radius = balls.size() % 4 == 0 ? 0.0 : 0.05 + 0.5 * random.uniform(),
                              .acceleration_limit = 2,
                              .planned_acceleration = plan,
                              .position = any_point(),
                              .velocity = 3.0 * random.point_in_ball()};
    balls.push_back(p.add(body, plan));
  }

  BodyId any(const std::vector<BodyId>& ids) { return ids[random.bits() % ids.size()]; }

  void change() {
    const BodyId ball = any(balls);
    const std::size_t k = random.bits() % shapes.size();
    const BodyId shape = shapes[k];
    const bool enabled = p.world.body(shape)->enabled;
    switch (random.bits() % 8) {
      case 0:
        p.world.remove(shape).value();
        touching.remove(shape);
        shapes.erase(shapes.begin() + static_cast<std::ptrdiff_t>(k));
        return come();
      case 1:
        if (enabled) p.world.disable(shape).value();
        if (!enabled) p.world.enable(shape, {}).value();
        return;
      case 2: {
        const Filter shut{.category = 2, .mask = 0};
        const bool open = p.world.body(shape)->definition.filter == Filter{};
        return p.world.change(shape, {.filter = open ? shut : Filter{}}).value();
      }
      case 3: {
        const Vec3 back = (Vec3{4, 4, 4} - p.state(ball).position) * 0.5;
        return p.set_velocity(ball, back + random.point_in_ball());
      }
      default:
        return steer(ball);
    }
  }

  /// Steers the ball back towards the middle.
  void steer(BodyId ball) {
    const Vec3 away = p.state(ball).position - Vec3{4, 4, 4};
    const Vec3 plan = p.world.body(ball)->definition.planned_acceleration;
    p.steer(ball, plan - away / (norm(away) + 0.1) + 0.99 * random.point_in_ball());
  }

  bool may_touch(BodyId shape) const {
    const BodyView view = p.world.body(shape).value();
    return view.enabled && view.definition.filter == Filter{};
  }

  /// Returns the rounding error of a gap: a hundredth of the tolerance for a needle, almost nothing for
  /// others.
  static double rounding(const Shape& shape) {
    const auto* triangle = std::get_if<Triangle>(&shape);
    if (triangle == nullptr) return 1e-12;
    return 1e-12 + 0x1p-49 * (norm_one(triangle->a) + norm_one(triangle->b) + norm_one(triangle->c));
  }

  void check_gaps() {
    for (const BodyId ball : balls)
      for (const BodyId shape : shapes) {
        if (!may_touch(shape)) continue;
        const bool touch = touching.contains(ball, shape);
        const double gap = distance(p.fixed.at(shape), p.state(ball).position) - p.radius(ball);
        const auto limits = p.world.certificates().distance_limits(ball, shape, p.world.time()).value();
        ASSERT_LE(limits.lower, gap + 1e-12);
        ASSERT_GE(limits.upper, gap - 1e-12);
        if (GetParam().mode == ContactEvents::impacts) continue;
        const double wrong = rounding(p.fixed.at(shape));
        ASSERT_TRUE(gap >= -eps - wrong || touch) << ball << " is unreported in " << shape << " by " << gap;
        ASSERT_TRUE(gap <= 5 * eps + wrong || !touch)
            << ball << " and " << shape << " are apart, gap " << gap;
      }
  }

  Surroundings p;
  Random random;
  std::vector<BodyId> shapes, balls;
  TouchingPairs touching{GetParam().mode};
};

TEST_P(RandomSurroundings, NothingIsMissed) {
  std::size_t begins = 0;
  const int stops = rounds_of(1500);
  for (int stop = 1; stop <= stops && !HasFatalFailure(); ++stop) {
    change();
    for (const BodyId ball : balls) steer(ball);
    const double quiet = p.world.certificates().safe_until()->time;
    const double quiet_of_one = p.world.certificates().safe_until(balls[0])->time;
    p.run(p.world.time() + 0.2 * random.uniform(), [&](const Event& event) {
      touching.note(event, p.world);
      if (event.kind == EventKind::contact_begin) {
        ++begins;
        const bool of_one = event.first == balls[0] || event.second == balls[0];
        if (GetParam().mode == ContactEvents::begin_and_end) {
          EXPECT_GE(event.time, quiet);
          EXPECT_TRUE(!of_one || event.time >= quiet_of_one);
        }
        if (GetParam().mode == ContactEvents::impacts) p.bounce(event);
      }
    });
    ASSERT_TRUE(is_clean(p.world));
    check_gaps();
  }
  EXPECT_GT(begins, static_cast<std::size_t>(stops) / 15);
  // Time does not crawl: a body far from all changes, or deep in a box, is not rechecked.
  const Counters& counters = p.world.counters();
  EXPECT_LE(counters.pair_checks, 2 * counters.probes);
  EXPECT_LE(counters.steps(), 3 * counters.probes);
}

INSTANTIATE_TEST_SUITE_P(, RandomSurroundings,
                         testing::Values(ContactScene{ContactEvents::begin_and_end, 0.0, 1},
                                         ContactScene{ContactEvents::begin_and_end, 0.0, 2},
                                         ContactScene{ContactEvents::begin_and_end, 0.0, 3},
                                         ContactScene{ContactEvents::begin_and_end, 0.0, 4},
                                         ContactScene{ContactEvents::impacts, 0.0, 5},
                                         ContactScene{ContactEvents::impacts, 0.0, 6},
                                         ContactScene{ContactEvents::impacts, 0.0, 8}));

}  // namespace
}  // namespace kinesphere::random_surroundings_test
