// Certificates of rigid bodies, against bodies that move in any way that their limits allow.
#include "bound/rigid_certificates.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "bound/convex.hpp"
#include "bound/placed.hpp"
#include "bound/rigid_thing.hpp"
#include "number/infinity.hpp"

namespace kinesphere::rigid_certificates_test {
namespace {

constexpr std::uint64_t seed = 4101;
constexpr double now = rigid_thing_now;
constexpr double until = now + 0.8;
/// Rounding of the nearest parts of bodies that are posed.
constexpr double rounding_errors = 1e-9;

/// `true_gap(time)` is the gap that the two have in one admissible course.
template <class Other, class TrueGap>
void expect_certain(const RigidPair<Other>& pair, TrueGap true_gap, Random& random) {
  const Bound& bound = pair.body.bound;
  const double gap_now = true_gap(now);
  const double outer = random.uniform() < 0.5 ? 0.0 : 0.3 * random.uniform();
  const double inner = std::max(gap_now, 0.0) + 0.5 * random.uniform();
  const double meets = earliest_meeting(bound, pair, now, until, outer);
  const double parts = earliest_separation(bound, pair, now, until, inner);
  for (int look = 0; look <= 24; ++look) {
    const double time = now + (until - now) * look / 24.0;
    const double gap = true_gap(time);
    const GapLimits limits = gap_limits(bound, pair, time);
    ASSERT_LE(limits.lower, gap + rounding_errors) << time;
    // Where parts overlap, the nearest ones need not be the deepest.
    if (gap > 0.0) {
      ASSERT_GE(limits.upper, gap - rounding_errors) << time;
    }
    if (is_beyond(pair, time, outer)) {
      ASSERT_GT(gap, outer - rounding_errors) << time;
    }
    if (time < meets) {
      ASSERT_GT(gap, outer - rounding_errors) << time << " before " << meets;
    }
    if (time < parts) {
      ASSERT_LT(gap, inner + rounding_errors) << time << " before " << parts;
    }
  }
}

/// Returns ten triangles within about `size` of the origin, which share corners.
Mesh any_mesh(Random& random, double size) {
  std::vector<Vec3> vertices{size * random.point_in_ball()};
  for (int k = 0; k < 11; ++k)
    vertices.push_back(0.5 * vertices.back() + 0.5 * size * random.point_in_ball());
  std::vector<std::array<std::uint32_t, 3>> corners;
  for (std::uint32_t k = 0; k < 10; ++k) corners.push_back({k, k + 1, k + 2});
  const auto made = Mesh::create(vertices, corners);
  return made ? made.value() : any_mesh(random, size);
}

double gap_by_brute_force(const RigidPose& pose, const Mesh& mesh) {
  double least = infinity;
  for (std::size_t k = 0; k < mesh.size(); ++k)
    least = std::min(least, nearest_parts(pose, mesh.triangle(k)).gap);
  return least;
}

class RigidCertificates : public testing::Test {
 protected:
  /// Calls check(thing, course of it, random) for many things; `course(time)` is its pose.
  template <class Check>
  void for_each_thing(std::uint64_t series, Check check) {
    SCOPED_TRACE(seed);
    for (std::uint64_t k = 0; k < 250 && !HasFailure(); ++k) {
      SCOPED_TRACE(k);
      Random random = Random::at(seed, series, k);
      const Thing thing(random, k % 2 == 0, 3);
      const Vec3 push = random.point_in_ball();
      const double braking = random.uniform();
      check(
          thing, [&](double time) { return thing.pose_at(time, push, braking); }, random);
    }
  }
};

TEST_F(RigidCertificates, HoldForTwoBodies) {
  for_each_thing(0, [](const Thing& one, auto first, Random& random) {
    const Thing other(random, random.uniform() < 0.5, 3);
    const Vec3 push = random.point_in_ball();
    const auto gap = [&](double time) {
      return nearest_parts(first(time), other.pose_at(time, push, 0.5)).gap;
    };
    expect_certain(RigidPair<RigidExtent>{one.extent, other.extent}, gap, random);
  });
}

TEST_F(RigidCertificates, HoldBesideShapesAtRest) {
  for_each_thing(1, [](const Thing& thing, auto pose, Random& random) {
    const auto check = [&]<class Other>(const Other& other, auto gap_to) {
      expect_certain(
          RigidPair<Other>{thing.extent, other}, [&](double time) { return gap_to(pose(time)); }, random);
    };
    const auto beside = [&](const auto& solid) {
      return [&](const RigidPose& seen) { return nearest_parts(seen, solid).gap; };
    };
    const HalfSpace wall{random.unit_vector(), random.uniform(-3.0, -1.0)};
    check(wall, beside(wall));
    const Vec3 corner = 3.0 * random.point_in_ball();
    const Box box{corner, corner + Vec3{random.uniform(), random.uniform(), random.uniform()}};
    const Triangle triangle{corner, corner + random.unit_vector(), corner + random.unit_vector()};
    const Convex convex_box = box, convex_triangle = triangle;
    check(Placed<Convex>{convex_box}, beside(box));
    check(Placed<Convex>{convex_triangle}, beside(triangle));
    const Mesh mesh = any_mesh(random, 3.0);
    check(Placed<Mesh>{mesh}, [&](const RigidPose& seen) { return gap_by_brute_force(seen, mesh); });
  });
}

/// Checks a thing beside a shape that a random body carries. `gap_to(pose)` is the gap to the shape at rest.
template <class Solid, class Thing, class Pose, class Gap>
void expect_certain_beside_carried(const Solid& solid, double radius, const Thing& thing, Pose pose,
                                   Random& random, Gap gap_to) {
  const Bound carrier{.time = now - random.uniform(),
                      .position = 2.0 * random.point_in_ball(),
                      .velocity = random.point_in_ball(),
                      .radius = radius,
                      .acceleration_limit = random.uniform()};
  const Vec3 push = random.point_in_ball();
  const auto gap = [&](double time) {
    const double s = time - carrier.time;
    RigidPose seen = pose(time);
    seen.position -= carrier.centre_at(time) + push * (0.5 * carrier.acceleration_limit * s * s);
    return gap_to(seen);
  };
  expect_certain(RigidPair<Placed<Solid>>{thing.extent, {solid, &carrier, radius}}, gap, random);
}

TEST_F(RigidCertificates, HoldBesideCarriedShapes) {
  for_each_thing(2, [](const Thing& thing, auto pose, Random& random) {
    const Vec3 lower = -0.2 * random.unit_vector();
    const Box box{{-std::abs(lower.x), -std::abs(lower.y), -std::abs(lower.z)}, {0.3, 0.2, 0.1}};
    const double radius = std::max(norm(box.lower), norm(box.upper)) * (1.0 + 1e-9);
    expect_certain_beside_carried(Convex(box), radius, thing, pose, random,
                                  [&](const RigidPose& seen) { return nearest_parts(seen, box).gap; });
  });
}

TEST_F(RigidCertificates, HoldBesideCarriedMeshes) {
  for_each_thing(3, [](const Thing& thing, auto pose, Random& random) {
    const Mesh mesh = any_mesh(random, 1.0);
    expect_certain_beside_carried(mesh, 2.0 + 1e-9, thing, pose, random,
                                  [&](const RigidPose& seen) { return gap_by_brute_force(seen, mesh); });
  });
}

/// The certificates of a mesh are those of its triangles, or are later where these are early.
TEST_F(RigidCertificates, OfAMeshAreAsLateAsThoseOfItsTriangles) {
  for_each_thing(4, [](const Thing& thing, auto, Random& random) {
    const Mesh mesh = any_mesh(random, 3.0);
    const RigidPair<Placed<Mesh>> pair{thing.extent, {mesh}};
    double meets = infinity, parts = now;
    for (std::size_t k = 0; k < mesh.size(); ++k) {
      const Convex triangle = mesh.triangle(k);
      const RigidPair<Placed<Convex>> alone{thing.extent, {triangle}};
      meets = std::min(meets, earliest_meeting(thing.extent.bound, alone, now, until, 0.01));
      parts = std::max(parts, earliest_separation(thing.extent.bound, alone, now, until, 2.0));
    }
    const double found = earliest_meeting(thing.extent.bound, pair, now, until, 0.01);
    EXPECT_GE(found, now + 0.9 * (std::min(meets, until) - now)) << meets;
    EXPECT_GE(earliest_separation(thing.extent.bound, pair, now, until, 2.0),
              now + 0.5 * (std::min(parts, until) - now));
  });
}

TEST(RigidMeeting, OfATurningRodIsNearlyExact) {
  // A rod of length 2 turns about its middle, once in two pi; a ball waits at (0, 1.5, 0).
  const RigidPart rod{{-1, 0, 0}, {1, 0, 0}, 0.25};
  const PartBall around = ball_around(rod);
  const RigidExtent body{.bound = {.radius = 1.25},
                         .radius = 1.25,
                         .parts = std::span(&rod, 1),
                         .balls = std::span(&around, 1),
                         .rotation = {.angular_velocity = {0, 0, 1}},
                         .spin = 1.0};
  const RigidPart ball{.radius = 0.5};
  const PartBall same = ball_around(ball);
  const RigidExtent waits{.bound = {.position = {0, 1.5, 0}, .radius = 0.5},
                          .radius = 0.5,
                          .parts = std::span(&ball, 1),
                          .balls = std::span(&same, 1)};
  const RigidPair<RigidExtent> pair{body, waits};
  // The end of the rod is within 0.75 of the ball where 1 + 1.5^2 - 3 sin(t) = 0.75^2.
  const double expected = std::asin((3.25 - 0.5625) / 3.0);
  const double found = earliest_meeting(body.bound, pair, 0.0, 2.0);
  EXPECT_LE(found, expected);
  EXPECT_NEAR(found, expected, 1e-6);
}

}  // namespace
}  // namespace kinesphere::rigid_certificates_test
