// Certificates, gaps and boxes of invalid shapes and NaNs: nothing is certified.
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "kinesphere/shape.hpp"
#include "number/infinity.hpp"

namespace kinesphere::wrong_shapes_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Bound ball{.time = 0.5, .position = {5, 0, 0}, .velocity = {-1, 0, 0}, .radius = 1};
constexpr double from = 1.0;
constexpr Box box{{-1, -1, -1}, {1, 1, 1}};
constexpr Triangle triangle{{0, -1, -1}, {0, 1, -1}, {0, 0, 1}};

std::vector<Vec3*> corners_of(Box& shape) { return {&shape.lower, &shape.upper}; }
std::vector<Vec3*> corners_of(Triangle& shape) { return {&shape.a, &shape.b, &shape.c}; }

template <class Solid>
void expect_nothing_certified(const Bound& bound, const Solid& shape) {
  EXPECT_EQ(earliest_meeting(bound, shape, from, 1000.0), from);
  EXPECT_EQ(earliest_separation(bound, shape, from, 1000.0, 0.5), from);
  const GapLimits gap = gap_limits(bound, shape, from);
  EXPECT_FALSE(gap.lower > 0.0 && gap.upper < infinity) << gap.lower << " " << gap.upper;
}

template <class Solid>
void expect_nothing_of_nan(const Solid& shape) {
  for (std::size_t corner = 0; corner < corners_of(const_cast<Solid&>(shape)).size(); ++corner)
    for (int axis = 0; axis < 3; ++axis) {
      Solid wrong = shape;
      (*corners_of(wrong)[corner])[axis] = nan;
      SCOPED_TRACE(testing::Message() << "corner " << corner << ", axis " << axis);
      expect_nothing_certified(ball, wrong);
    }
  for (int axis = 0; axis < 3; ++axis) {
    Bound wrong = ball;
    wrong.position[axis] = nan;
    expect_nothing_certified(wrong, shape);
    wrong = ball;
    wrong.velocity[axis] = nan;
    expect_nothing_certified(wrong, shape);
  }
  EXPECT_EQ(earliest_meeting(ball, shape, from, 1000.0, nan), from);
  EXPECT_EQ(earliest_separation(ball, shape, from, 1000.0, nan), from);
  EXPECT_LE(earliest_meeting(ball, shape, from, nan), 4.5);
  EXPECT_EQ(earliest_meeting(ball, shape, from, 1000.0, infinity), from);
}

TEST(WrongShape, NanInABoxCertifiesNothing) { expect_nothing_of_nan(box); }
TEST(WrongShape, NanInATriangleCertifiesNothing) { expect_nothing_of_nan(triangle); }

TEST(WrongShape, ATriangleThatIsAPointCertifiesNothing) { expect_nothing_certified(ball, Triangle{}); }

TEST(WrongShape, AnyPlaceOfATriangleThatIsALineIsOnTheLine) {
  const Triangle line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_LE(earliest_meeting(ball, line, from, 1000.0), 2.5);
  EXPECT_EQ(nearest_point(line, {5, 0, 0}).point, (Vec3{2, 0, 0}));
  EXPECT_EQ(nearest_point(line, {5, 0, 0}).distance, 3.0);
}

TEST(WrongShape, NearestPlaceToNowhereIsNowhere) {
  const Vec3 nowhere{nan, 0, 0};
  EXPECT_FALSE(nearest_point(HalfSpace{{0, 0, 1}, 0}, nowhere).distance <= infinity &&
               is_finite(nearest_point(HalfSpace{{0, 0, 1}, 0}, nowhere).point));
  EXPECT_FALSE(is_finite(nearest_point(box, nowhere).point));
  EXPECT_FALSE(is_finite(nearest_point(triangle, nowhere).point));
}

}  // namespace
}  // namespace kinesphere::wrong_shapes_test
