// Reachable sets contain what they may contain whatever their time of reference; separations by component.
#include "monitor/reachable_set.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/random.hpp"

namespace kinesphere::reachable_set_test {
namespace {

constexpr std::uint64_t seed = 5223;

TEST(ReachableSet, ContainsItselfAsOfAnotherTime) {
  SCOPED_TRACE(seed);
  for (std::uint64_t k = 0; k < 500; ++k) {
    SCOPED_TRACE(k);
    Random random = Random::at(seed, 0, k);
    ReachableSet set;
    set.time = random.uniform(-5.0, 5.0);
    set.position = 1e3 * random.point_in_ball();
    set.velocity = 10.0 * random.point_in_ball();
    set.acceleration = random.point_in_ball();
    set.radius = ErrorBound::cylinder(random.uniform(), random.uniform());
    set.speed = random.uniform();
    set.growth = random.uniform();
    const ReachableSet later = set.moved_to(set.time + random.uniform(0.0, 3.0));
    EXPECT_EQ(later.end, set.end);
    for (int look = 0; look < 10; ++look) {
      const double time = later.time + 3.0 * random.uniform();
      EXPECT_LE(norm(later.centre_at(time) - set.centre_at(time)) + set.radius_at(time).total(),
                later.radius_at(time).total());
      EXPECT_LE(set.radius_at(time).horizontal(), later.radius_at(time).horizontal());
      EXPECT_LE(set.radius_at(time).vertical(), later.radius_at(time).vertical());
      const Bound ball = set.bound();
      EXPECT_NEAR(norm(ball.centre_at(time) - set.centre_at(time)), 0.0, 1e-9);
      EXPECT_GE(ball.radius_at(time), set.radius_at(time).total() * (1.0 - 1e-12));
    }
  }
}

/// The definitions of Separation::Shape.
bool is_within(const Separation& separation, const Vec3& offset) {
  const double flat = std::hypot(offset.x, offset.y), upright = std::abs(offset.z);
  if (separation.shape == Separation::Shape::ellipsoid)
    return std::pow(flat / separation.horizontal, 2) + std::pow(upright / separation.vertical, 2) <= 1.0;
  return flat <= separation.horizontal && upright <= separation.vertical;
}

bool is_within(const Components& components, const Vec3& offset) {
  for (const Component& component : components)
    if (norm(component.part(offset)) > component.limit) return false;
  return true;
}

TEST(Components, AreWithinWhereTheSeparationIs) {
  SCOPED_TRACE(seed);
  int within = 0;
  for (std::uint64_t k = 0; k < 3000; ++k) {
    SCOPED_TRACE(k);
    Random random = Random::at(seed, 1, k);
    const double horizontal = random.uniform(0.5, 2.0), vertical = random.uniform(0.5, 2.0);
    const Separation separation =
        k % 2 == 0 ? Separation::ellipsoid(horizontal, vertical) : Separation::cylinder(horizontal, vertical);
    const Components components(separation, 3, 0.01);
    const Vec3 offset = 2.5 * random.point_in_ball();
    within += is_within(separation, offset) ? 1 : 0;
    EXPECT_EQ(is_within(components, offset), is_within(separation, offset));
    // A point on a sphere around the offset is within what is enlarged by the radius.
    const double radius = 0.3 * random.uniform();
    if (is_within(separation, offset)) {
      EXPECT_TRUE(is_within(components.enlarged(ErrorBound(radius * (1.0 + 1e-9))),
                            offset + radius * random.unit_vector()));
      EXPECT_TRUE(is_within(components.enlarged(0.1), 1.1 * (1.0 - 1e-9) * offset));
    }
  }
  EXPECT_GT(within, 100);
}

TEST(Components, InThePlaneKnowNoHeight) {
  for (const Separation& separation : {Separation::ellipsoid(1.0, 0.1), Separation::cylinder(1.0, 0.1)}) {
    const Components components(separation, 2, 0.01);
    EXPECT_EQ(components.end() - components.begin(), 1);
    EXPECT_TRUE(is_within(components, {0.9, 0.0, 0.0}));
    EXPECT_FALSE(is_within(components, {1.1, 0.0, 0.0}));
  }
}

TEST(Components, PredictTheEntryOfWellClearAlone) {
  EXPECT_TRUE(Components(Separation::well_clear(1.0, 1.0, 3.0, 10.0), 3, 0.01).predicts_entry);
  EXPECT_FALSE(Components(Separation::cylinder(1.0, 1.0, 10.0), 3, 0.01).predicts_entry);
  EXPECT_EQ(Components(Separation::well_clear(1.0, 1.0, 3.0, 10.0), 3, 0.01).begin()->modified_tau, 3.0);
  EXPECT_EQ(Components(Separation::sphere(1.0, 4.0), 3, 0.01).look_ahead, 4.0);
}

}  // namespace
}  // namespace kinesphere::reachable_set_test
