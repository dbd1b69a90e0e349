// Certificates of a bound and a static shape against dense samples in quadruple precision.
#include <gtest/gtest.h>

#include "support/bound_checks.hpp"
#include "support/exact_shapes.hpp"
#include "support/test_size.hpp"

namespace kinesphere::shape_certificates_test {
namespace {

using exact::Wide;

constexpr std::uint64_t seed = 1736;
const auto cases_per_family = rounds_of<std::uint64_t>(500);
constexpr int samples = 48;
template <class Solid>
struct ShapeCase {
  Bound bound;
  Solid solid;
  double from, horizon, distance;
};

std::ostream& operator<<(std::ostream& out, const Box& box) {
  return out << "Box{" << box.lower << ", " << box.upper << "}";
}
std::ostream& operator<<(std::ostream& out, const Triangle& t) {
  return out << "Triangle{" << t.a << ", " << t.b << ", " << t.c << "}";
}
std::ostream& operator<<(std::ostream& out, const Mesh& mesh) {
  for (std::size_t k = 0; k < mesh.size(); ++k) out << (k > 0 ? ", " : "Mesh of ") << mesh.triangle(k);
  return out;
}
template <class Solid>
std::ostream& operator<<(std::ostream& out, const ShapeCase<Solid>& c) {
  return out << "bound = " << c.bound << std::hexfloat << "\nsolid = " << c.solid << "\nfrom " << c.from
             << ", horizon " << c.horizon << ", distance " << c.distance << std::defaultfloat;
}

/// Returns a solid that may be flat or thin.
Box random_solid(Random& random, const Vec3& place, double size, Box*) {
  Box box{place, place};
  for (int axis = 0; axis < 3; ++axis) {
    if (chance(random, 0.1)) continue;
    box.lower[axis] -= size * random.uniform();
    box.upper[axis] += size * random.uniform() * (chance(random, 0.1) ? 1e-6 : 1.0);
  }
  return box;
}

Triangle random_solid(Random& random, const Vec3& place, double size, Triangle*) {
  // If rounding beside its place makes it vanish, a larger one is drawn.
  for (;; size *= 2.0) {
    const double thin = chance(random, 0.2) ? log_uniform(random, -16, -1) : 1.0;
    const Vec3 direction = random.unit_vector();
    Triangle t;
    t.a = place + size * random.point_in_ball();
    t.b = place + size * random.point_in_ball();
    t.c = t.a + (t.b - t.a) * random.uniform(-1.0, 2.0) + direction * (size * thin);
    if (chance(random, 0.2)) t.a.z = t.b.z = t.c.z = place.z;
    const double least =
        std::sqrt(std::min({norm_squared(t.a - t.b), norm_squared(t.b - t.c), norm_squared(t.c - t.a)}));
    const double longest = std::max({norm(t.a - t.b), norm(t.b - t.c), norm(t.c - t.a)});
    const double twice_area = norm(cross(t.b - t.a, t.c - t.a));
    if (least > 0.0 && twice_area > 0x1p-19 * longest * longest) return t;
  }
}

/// Returns up to eight triangles, most of which share corners; some are far away.
Mesh random_solid(Random& random, const Vec3& place, double size, Mesh*) {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> corners;
  const std::size_t count = 1 + random.bits() % 8;
  while (corners.size() < count) {
    const double far = chance(random, 0.2) ? size * log_uniform(random, 0, 8) : 0.0;
    const Triangle t =
        random_solid(random, place + far * random.unit_vector(), size, static_cast<Triangle*>(nullptr));
    for (const Vec3& corner : {t.a, t.b, t.c}) vertices.push_back(corner);
    const auto last = static_cast<std::uint32_t>(vertices.size() - 1);
    corners.push_back({last - 2, last - 1, last});
    // The corner that two triangles of a fan do not share is random.
    if (!chance(random, 0.7) || corners.size() == count) continue;
    vertices.push_back(place + size * random.point_in_ball());
    corners.push_back({last, last - 1, last + 1});
    if (!Mesh::create(vertices, corners)) corners.pop_back();
  }
  return Mesh::create(vertices, corners).value();
}

template <class Solid>
ShapeCase<Solid> draw(const Family& family, Random& random) {
  const PairCase pair = family.draw(random);
  ShapeCase<Solid> c{pair.a, {}, pair.from, pair.horizon, pair.distance};
  const double later = c.from + (c.horizon - c.from) * random.uniform();
  const Vec3 now = c.bound.centre_at(c.from);
  const Vec3 then = c.bound.centre_at(later);
  const double way = c.bound.radius_at(later) + norm(then - now) + 0x1p-300;
  const double size = way * log_uniform(random, -6, 6);
  const double away = chance(random, 0.5) ? c.bound.radius : way * random.uniform();
  const Vec3 side = random.unit_vector();
  c.solid = random_solid(random, then + side * away, size, static_cast<Solid*>(nullptr));
  // Squares of lengths must neither overflow nor vanish.
  const double scale = length_scale(c.bound, c.horizon) + norm_one(then) + size + std::abs(c.distance);
  if (!(scale < 1e60) || size < 1e-60 || !(c.horizon < 1e60)) return draw<Solid>(family, random);
  return c;
}

template <class Solid>
double scale_of(const ShapeCase<Solid>& c, double t, const Solid& solid) {
  const Box box = bounding_box(solid, infinity);
  return length_scale(c.bound, t) + norm_one(box.lower) + norm_one(box.upper) + std::abs(c.distance);
}

/// Calls `check` at times from `from` to the certificate, or to the horizon if it is infinite; many of them
/// near the end.
template <class Check>
void sample(double from, double horizon, double certificate, Check check) {
  const Wide end = certificate == infinity ? Wide(horizon) : Wide(certificate);
  for (int k = 0; k <= samples; ++k) {
    const Wide part = k % 2 == 0 ? Wide(k) / samples : 1 - Wide(std::ldexp(1.0, -k));
    check(Wide(from) + (end - Wide(from)) * part);
  }
}

template <class Solid>
void expect_meetings_never_late(const Family& family) {
  int useful = 0;
  for (std::uint64_t k = 0; k < cases_per_family; ++k) {
    Random random = Random::at(seed, k, 0);
    const auto c = draw<Solid>(family, random);
    const double got = earliest_meeting(c.bound, c.solid, c.from, c.horizon, c.distance);
    ASSERT_TRUE(got == infinity || (got >= c.from && got <= c.horizon)) << "case " << k << "\n" << c;
    if (got == c.from) {
      if (c.horizon - c.from < 0x1p-30 * std::abs(c.from)) continue;  // the clock is too coarse
      const double scale = scale_of(c, c.from, c.solid);
      const Wide gap = exact::shape_gaps(c.bound, c.solid, c.from).lower;
      // If the step is too short for the clock, the answer is `from`, too.
      const double still = 0x1p-20 * (c.horizon - c.from);
      const Wide soon = exact::shape_gaps(c.bound, c.solid, Wide(c.from) + still).lower;
      ASSERT_LE(static_cast<double>(exact::min(gap, soon) - c.distance),
                1e-4 * std::abs(static_cast<double>(gap)) + 0x1p-30 * scale)
          << "needlessly early: case " << k << "\n"
          << c;
      continue;
    }
    ++useful;
    bool late = false;
    sample(c.from, c.horizon, got,
           [&](Wide t) { late = late || exact::shape_gaps(c.bound, c.solid, t).lower < Wide(c.distance); });
    ASSERT_FALSE(late) << "seed " << seed << ", case " << k << ", got " << got << "\n" << c;
  }
  EXPECT_GT(useful, cases_per_family / 20) << "too few cases say anything";
}

template <class Solid>
void expect_separations_never_late(const Family& family) {
  for (std::uint64_t k = 0; k < cases_per_family; ++k) {
    Random random = Random::at(seed, k, 1);
    auto c = draw<Solid>(family, random);
    // The present gap is within the distance.
    const Wide now = exact::shape_gaps(c.bound, c.solid, c.from).upper;
    c.distance = static_cast<double>(now) + c.bound.radius_at(c.horizon) * log_uniform(random, -20, 2);
    const double got = earliest_separation(c.bound, c.solid, c.from, c.horizon, c.distance);
    ASSERT_TRUE(got == infinity || (got >= c.from && got <= c.horizon)) << "case " << k << "\n" << c;
    if (got == c.from) continue;
    bool late = false;
    sample(c.from, c.horizon, got,
           [&](Wide t) { late = late || exact::shape_gaps(c.bound, c.solid, t).upper > Wide(c.distance); });
    ASSERT_FALSE(late) << "seed " << seed << ", case " << k << ", got " << got << "\n" << c;
  }
}

template <class Solid>
void expect_gaps_enclosed(const Family& family, double length) {
  for (std::uint64_t k = 0; k < cases_per_family; ++k) {
    Random random = Random::at(seed, k, 2);
    const auto c = draw<Solid>(family, random);
    const double t = c.from + (c.horizon - c.from) * random.uniform();
    const GapLimits got = gap_limits(c.bound, c.solid, t);
    const exact::Gaps truth = exact::shape_gaps(c.bound, c.solid, t);
    const double scale = scale_of(c, t, c.solid);
    ASSERT_TRUE(Wide(got.lower) <= truth.lower && truth.upper <= Wide(got.upper)) << "case " << k << "\n"
                                                                                  << c;
    ASSERT_LE(static_cast<double>(truth.lower - got.lower), length * scale) << "case " << k << "\n" << c;
    ASSERT_LE(static_cast<double>(got.upper - truth.upper), length * scale) << "case " << k << "\n" << c;
  }
}

class ShapeCertificates : public testing::TestWithParam<Family> {};

TEST_P(ShapeCertificates, meeting_a_box_is_never_late) { expect_meetings_never_late<Box>(GetParam()); }
TEST_P(ShapeCertificates, meeting_a_triangle_is_never_late) {
  expect_meetings_never_late<Triangle>(GetParam());
}
TEST_P(ShapeCertificates, meeting_a_mesh_is_never_late) { expect_meetings_never_late<Mesh>(GetParam()); }
TEST_P(ShapeCertificates, separation_from_a_mesh_is_never_late) {
  expect_separations_never_late<Mesh>(GetParam());
}
TEST_P(ShapeCertificates, separation_from_a_box_is_never_late) {
  expect_separations_never_late<Box>(GetParam());
}
TEST_P(ShapeCertificates, separation_from_a_triangle_is_never_late) {
  expect_separations_never_late<Triangle>(GetParam());
}
TEST_P(ShapeCertificates, gaps_enclose_the_truth_closely) {
  expect_gaps_enclosed<Box>(GetParam(), 0x1p-43);
  expect_gaps_enclosed<Triangle>(GetParam(), 0x1p-43);
  expect_gaps_enclosed<Mesh>(GetParam(), 0x1p-43);
}

INSTANTIATE_TEST_SUITE_P(Families, ShapeCertificates, testing::ValuesIn(all_families), family_name);

const Box unit_box{{-1, -1, -1}, {1, 1, 1}};
const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
constexpr double tiny = 1e-9;

/// The times of ballistic bodies are known.
TEST(ShapeMeeting, OfFallingBalls) {
  const Vec3 down{0, 0, -10};
  const Bound over_face{.position = {1, 1, 6}, .planned_acceleration = down, .radius = 1};
  EXPECT_NEAR(earliest_meeting(over_face, flat, 0, 10), 1.0, tiny);
  const Bound under_face{.position = {1, 1, -6}, .planned_acceleration = -down, .radius = 1};
  EXPECT_NEAR(earliest_meeting(under_face, flat, 0, 10), 1.0, tiny);
  const Bound over_box{.position = {0.5, 0, 7}, .planned_acceleration = down, .radius = 1};
  EXPECT_NEAR(earliest_meeting(over_box, unit_box, 0, 10), 1.0, tiny);
  // Beside an edge, in the middle of the radius: the gap closes at height sqrt(1 - 1/4).
  const Bound over_edge{
      .position = {2, -0.5, 5 + std::sqrt(0.75)}, .planned_acceleration = down, .radius = 1};
  EXPECT_NEAR(earliest_meeting(over_edge, flat, 0, 10), 1.0, tiny);
  const Bound over_corner{
      .position = {-0.3, -0.4, 5 + std::sqrt(0.75)}, .planned_acceleration = down, .radius = 1};
  EXPECT_NEAR(earliest_meeting(over_corner, flat, 0, 10), 1.0, tiny);
  const Bound log{.position = {2, -1.000001, 5}, .velocity = {0, 0, -5}, .radius = 1};
  EXPECT_EQ(earliest_meeting(log, flat, 0, infinity), infinity);
}

TEST(ShapeMeeting, OfACentreInsideABox) {
  const Bound inside{.position = {0.25, 0, 0}, .radius = 0.5};
  EXPECT_EQ(earliest_meeting(inside, unit_box, 2, 5), 2.0);
  // The gap is -0.75 - 0.5 and falls to -1.5, reached with the centre in the middle.
  const Bound deeper{.position = {0.25, 0, 0}, .velocity = {-1, 0, 0}, .radius = 0.5};
  EXPECT_NEAR(earliest_meeting(deeper, unit_box, 0, 5, -1.35), 0.1, tiny);
}

TEST(ShapeMeeting, IsNeverForDepthsThatATriangleDoesNotHave) {
  const Bound through{.position = {1, 1, 1}, .velocity = {0, 0, -1}, .radius = 0.1};
  EXPECT_EQ(earliest_meeting(through, flat, 0, 100, -0.11), infinity);
  EXPECT_NEAR(earliest_meeting(through, flat, 0, 100, -0.05), 0.95, tiny);
}

TEST(ShapeSeparation, OfRollingAndRisingBalls) {
  // Up from a face while moving along it: only the way up counts.
  const Bound rising{.position = {1, 1, 1}, .velocity = {0.5, 0.5, 0.1}, .radius = 1};
  EXPECT_NEAR(earliest_separation(rising, flat, 0, 10, 0.05), 0.5, tiny);
  EXPECT_NEAR(earliest_separation({.position = {0.2, 0.2, 2}, .velocity = {0.5, 0.5, 0.1}, .radius = 1},
                                  unit_box, 0, 10, 0.05),
              0.5, tiny);
  // Along the face, over its edge at x = 4, and away from its corner at sqrt(1 + 0.21).
  const Bound rolling{.position = {1, 0, 1}, .velocity = {1, 0, 0}, .radius = 1};
  EXPECT_NEAR(earliest_separation(rolling, flat, 0, 10, 0.1), 3 + std::sqrt(0.21), tiny);
  const Bound on_box{.position = {0, 0.5, 2}, .velocity = {1, 0, 0}, .radius = 1};
  EXPECT_NEAR(earliest_separation(on_box, unit_box, 0, 10, 0.1), 1 + std::sqrt(0.21), tiny);
  // At rest there is no end.
  EXPECT_EQ(earliest_separation({.position = {1, 1, 1}, .radius = 1}, flat, 0, infinity, 0.1), infinity);
}

TEST(ShapeSeparation, OfACentreInsideABox) {
  const Bound leaving{.velocity = {1, 0, 0}, .radius = 0.5};
  EXPECT_NEAR(earliest_separation(leaving, unit_box, 0, 10, 0.25), 1.75, tiny);
  EXPECT_NEAR(earliest_separation(leaving, unit_box, 0, 10, -0.75), 0.75, tiny);
  EXPECT_NEAR(earliest_separation(leaving, unit_box, 0, 10, -0.5), 1.0, tiny);
}

}  // namespace
}  // namespace kinesphere::shape_certificates_test
