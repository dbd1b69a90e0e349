// Triangles as thin as a world allows, against quadruple precision: distances are exact to the rounding of
// lengths, and certificates are useful wherever the distance is.
#include <gtest/gtest.h>

#include "number/infinity.hpp"
#include "support/exact_shapes.hpp"
#include "support/needles.hpp"

namespace kinesphere::needle_test {
namespace {

using exact::Wide;

constexpr std::uint64_t seed = 1402;
constexpr int cases = 20000;
/// Each is compared with the truth at 16 times.
constexpr int flights = 5000;
constexpr double tolerance = 1e-6;
/// The largest coordinate in a world with this tolerance.
constexpr double limit = 0x1p41 * tolerance;

double size_of(const Triangle& t, const Vec3& place) {
  return norm_one(t.a) + norm_one(t.b) + norm_one(t.c) + norm_one(place);
}

/// Returns a place at a distance between a billionth and a thousand from a point of the needle.
Vec3 place_near(const Needle& needle, Random& random) {
  return needle.point(random) + random.unit_vector() * std::pow(10.0, random.uniform(-9.0, 3.0));
}

TEST(Needle, NearestPointIsAsExactAsLengthsAre) {
  for (std::uint64_t k = 0; k < cases; ++k) {
    Random random = Random::at(seed, k, 0);
    const Needle needle = random_needle(random, limit);
    const Vec3 place = place_near(needle, random);
    const double wrong = 0x1p-47 * size_of(needle.triangle, place);
    const Wide truth = exact::distance(needle.triangle, exact::wide(place));
    const SurfacePoint nearest = nearest_point(needle.triangle, place);
    ASSERT_LE(std::abs(static_cast<double>(nearest.distance - truth)), wrong)
        << "seed " << seed << ", case " << k << ", " << needle;
    ASSERT_LE(static_cast<double>(exact::distance(needle.triangle, exact::wide(nearest.point))), wrong)
        << "seed " << seed << ", case " << k << ", " << needle;
    ASSERT_NEAR(norm(nearest.normal), 1.0, 1e-14);
  }
}

/// No corner lies in front of the plane through the nearest point, and the plane is as far away as the point.
TEST(Needle, LiesBehindThePlaneOfItsNearestPoint) {
  for (std::uint64_t k = 0; k < cases; ++k) {
    Random random = Random::at(seed, k, 1);
    const Needle needle = random_needle(random, limit);
    const Triangle& t = needle.triangle;
    const Vec3 place = place_near(needle, random);
    const SurfacePoint nearest = nearest_point(t, place);
    for (const Vec3& corner : {t.a, t.b, t.c}) {
      const auto before =
          exact::dot(exact::wide(nearest.normal), exact::moved(exact::wide(place), exact::wide(corner), -1));
      ASSERT_GE(static_cast<double>(before), nearest.distance - 0x1p-47 * size_of(t, place))
          << "seed " << seed << ", case " << k << ", " << needle;
    }
  }
}

TEST(Needle, GapLimitsEncloseTheTruthClosely) {
  for (std::uint64_t k = 0; k < cases; ++k) {
    Random random = Random::at(seed, k, 2);
    const Needle needle = random_needle(random, limit);
    const Bound bound{.position = place_near(needle, random), .radius = random.bits() % 2 == 0 ? 0.0 : 1e-2};
    const GapLimits got = gap_limits(bound, needle.triangle, 0.0);
    const exact::Gaps truth = exact::shape_gaps(bound, needle.triangle, 0.0);
    ASSERT_TRUE(Wide(got.lower) <= truth.lower && truth.upper <= Wide(got.upper))
        << "seed " << seed << ", case " << k << ", " << needle;
    ASSERT_LE(got.upper - got.lower, 0x1p-45 * (size_of(needle.triangle, bound.position) + bound.radius))
        << "seed " << seed << ", case " << k << ", " << needle;
  }
}

/// A body at a gap of one to a thousand tolerances.
struct Flight {
  Needle needle;
  Bound bound;
  double gap;
};

Flight random_flight(Random& random) {
  for (;;) {
    Flight f{random_needle(random, limit), {}, 0.0};
    f.bound.radius = random.bits() % 2 == 0 ? 0.0 : 1e-2;
    const double reach = f.bound.radius + tolerance * std::exp2(10.0 * random.uniform());
    f.bound.position = f.needle.point(random) + random.unit_vector() * reach;
    f.bound.velocity = 10.0 * random.unit_vector();
    f.gap = static_cast<double>(exact::shape_gaps(f.bound, f.needle.triangle, 0.0).lower);
    if (f.gap > 1.25 * tolerance) return f;
  }
}

TEST(Needle, MeetingIsNeverLateAndSpansMostOfTheGap) {
  for (std::uint64_t k = 0; k < flights; ++k) {
    Random random = Random::at(seed, k, 3);
    const Flight f = random_flight(random);
    const double speed = norm(f.bound.velocity);
    const double got = earliest_meeting(f.bound, f.needle.triangle, 0.0, 1.0);
    ASSERT_GE(got, 0.25 * f.gap / speed) << "seed " << seed << ", case " << k << ", " << f.needle;
    const Wide end = std::min(got, 1.0);
    for (int part = 1; part <= 16; ++part) {
      const Wide gap = exact::shape_gaps(f.bound, f.needle.triangle, end * part / 16).lower;
      ASSERT_GE(static_cast<double>(gap), 0.0) << "seed " << seed << ", case " << k << ", " << f.needle;
    }
  }
}

/// A body within four tolerances does not leave five before the way between takes.
TEST(Needle, SeparationIsNeverLateAndSpansMostOfTheTolerance) {
  int useful = 0;
  for (std::uint64_t k = 0; k < flights; ++k) {
    Random random = Random::at(seed, k, 4);
    const Needle needle = random_needle(random, limit);
    Bound bound{.radius = random.bits() % 2 == 0 ? 0.0 : 1e-2};
    const double reach = bound.radius + 4.0 * tolerance * random.uniform();
    bound.position = needle.point(random) + random.unit_vector() * reach;
    bound.velocity = 10.0 * random.unit_vector();
    if (exact::shape_gaps(bound, needle.triangle, 0.0).upper > Wide(4.0 * tolerance)) continue;
    ++useful;
    const double got = earliest_separation(bound, needle.triangle, 0.0, 1.0, 5.0 * tolerance);
    ASSERT_GE(got, 0.125 * tolerance / norm(bound.velocity))
        << "seed " << seed << ", case " << k << ", " << needle;
    const Wide end = std::min(got, 1.0);
    for (int part = 1; part <= 16; ++part) {
      const Wide gap = exact::shape_gaps(bound, needle.triangle, end * part / 16).upper;
      ASSERT_LE(static_cast<double>(gap), 5.0 * tolerance)
          << "seed " << seed << ", case " << k << ", " << needle;
    }
  }
  EXPECT_GT(useful, flights / 2);
}

}  // namespace
}  // namespace kinesphere::needle_test
