// Certificates of bodies that make many turns.
#include "bound/all_turns.hpp"

#include <gtest/gtest.h>

#include "bound/rigid_certificates.hpp"
#include "bound/rigid_thing.hpp"

namespace kinesphere::all_turns_test {
namespace {

constexpr std::uint64_t seed = 5207;

/// A body that turns about z, at the origin at time 0.
struct Spinner {
  std::vector<RigidPart> parts;
  std::vector<PartBall> balls = balls_around(parts);
  RigidExtent extent{};

  explicit Spinner(std::vector<RigidPart> given, double spin = 1e8, const Vec3& place = {})
      : parts(std::move(given)) {
    extent = {.bound = {.position = place},
              .parts = parts,
              .balls = balls,
              .rotation = {.angular_velocity = {0, 0, spin}},
              .spin = spin};
    for (const RigidPart& part : parts) extent.radius = std::max(extent.radius, outer_radius(part));
    extent.bound.radius = extent.radius;
  }
  Spinner(const Spinner&) = delete;
  Spinner& operator=(const Spinner&) = delete;

  template <class Other>
  double meets(const Other& other, double until = 10.0) const {
    return earliest_meeting(extent.bound, RigidPair<Other>{extent, other}, 0.0, until);
  }
  double meets(const Convex& solid) const { return meets(Placed<Convex>{solid}); }
  template <class Other>
  double parts_from(const Other& other, double until = 10.0) const {
    return earliest_separation(extent.bound, RigidPair<Other>{extent, other}, 0.0, until, 0.01);
  }
};

const std::vector<RigidPart> rod{{{-1, 0, 0}, {1, 0, 0}, 0.1}};
/// On a floor at z = 0, about which it turns.
const std::vector<RigidPart> top{{{0, 0, -1}, {0, 0, 1}, 0.1}};
const std::vector<RigidPart> ball{{.radius = 0.1}};

TEST(AllTurns, KeepBodiesApartForEver) {
  const Spinner fan(rod);
  // Within the ball around the fan, above the disc of its blades.
  EXPECT_EQ(fan.meets(Spinner(ball, 0.0, {0, 0.9, 0.3}).extent), infinity);
  EXPECT_EQ(fan.meets(Spinner(rod, -1e8, {0, 0.9, 0.3}).extent), infinity);
  EXPECT_EQ(fan.meets(HalfSpace{{0, 0, 1}, -0.2}), infinity);
  EXPECT_EQ(fan.meets(Convex(Box{{-1, -1, 0.2}, {1, 1, 0.4}})), infinity);
  EXPECT_EQ(fan.meets(Convex(Triangle{{-1, -1, 0.2}, {1, -1, 0.2}, {0, 1, 0.2}})), infinity);
  // A bullet passes by another one.
  Spinner bullet(top, 1e6, {0.3, 0, -5});
  bullet.extent.bound.velocity = {0, 0, 1};
  EXPECT_EQ(Spinner(top).meets(bullet.extent), infinity);
}

TEST(AllTurns, AreMetByWhatComesIntoThem) {
  const Spinner fan(rod);
  Spinner comes(ball, 0.0, {0.5, 0.2, 3.2});
  comes.extent.bound.velocity = {0, 0, -1};
  const double met = fan.meets(comes.extent);
  EXPECT_LE(met, 3.0 + 1e-6);
  EXPECT_GE(met, 3.0 - 1e-6);
  EXPECT_LT(fan.meets(Spinner(ball, 0.0, {0.5, 0.2, 0.1}).extent), 1e-7);
}

TEST(AllTurns, StayInTouch) {
  const Spinner spins(top);
  EXPECT_EQ(spins.parts_from(HalfSpace{{0, 0, 1}, -1.1}), infinity);
  const Convex floor = Box{{-1, -1, -2}, {1, 1, -1.1}};
  EXPECT_EQ(spins.parts_from(Placed<Convex>{floor}), infinity);
  EXPECT_EQ(Spinner(rod).parts_from(Spinner(ball, 0.0, {0, 0.15, 0}).extent), infinity);
  EXPECT_LT(Spinner(rod).parts_from(Spinner(ball, 0.0, {0.5, 0.1, 0}).extent), 1e-7);
}

/// Any spin, and at random times: nobody is nearer, or farther, than the certificates say.
TEST(AllTurns, AgreeWithPoses) {
  SCOPED_TRACE(seed);
  const double now = rigid_thing_now;
  int certified = 0;
  for (std::uint64_t k = 0; k < 1500; ++k) {
    SCOPED_TRACE(k);
    Random random = Random::at(seed, 0, k);
    Thing one(random, true, 3), other(random, k % 3 != 0, 2);
    for (Thing* thing : {&one, &other}) {
      const double faster = std::pow(10.0, random.uniform(0.0, 6.0));
      if (thing->extent.spin_growth > 0.0) continue;
      thing->extent.rotation.angular_velocity *= faster;
      thing->extent.spin *= faster * (1.0 + 1e-15);
    }
    const RigidPair<RigidExtent> pair{one.extent, other.extent};
    const double until = now + 30.0 / one.extent.spin + 0.2 * random.uniform();
    const Vec3 push = random.point_in_ball();
    const auto gap = [&](double time) {
      return nearest_parts(one.pose_at(time, {}, 0.0), other.pose_at(time, push, 0.5)).gap;
    };
    const double inner = std::max(gap(now), 0.0) + random.uniform();
    const double meets = std::min(until, earliest_meeting_in_all_turns(pair, now, until, 0.0));
    const double parts = std::min(until, earliest_separation_in_all_turns(pair, now, until, inner));
    certified += (meets > now) + (parts > now);
    for (int look = 0; look < 30; ++look) {
      const double time = random.uniform(now, until);
      if (time < meets) {
        ASSERT_GT(gap(time), -1e-7) << time << " before " << meets;
      }
      if (time < parts) {
        ASSERT_LT(gap(time), inner + 1e-7) << time << " before " << parts;
      }
    }
  }
  EXPECT_GT(certified, 800);
}

}  // namespace
}  // namespace kinesphere::all_turns_test
