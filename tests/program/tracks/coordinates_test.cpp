// Coordinates: near and far, plane and around the Earth, there and back.
#include "tracks/coordinates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "program/support.hpp"

namespace kinesphere::program::coordinates_test {
namespace {

TEST(Coordinates, KeepTheZeroOfWhatIsNearIt) {
  const Coordinates near(Box{{-3, 20, 0}, {5, 40, 2}}, {1.0, 1.0, 1.0});
  EXPECT_EQ(near.local({1.1, 30.3, 1}), (Vec3{1.1, 30.3, 1}));
  const Coordinates one_place(Box{{0.5, 0.25, 0}, {0.5, 0.25, 0}}, {1.0, 1.0, 1.0});
  EXPECT_EQ(one_place.as_in_file(one_place.local({0.5, 0.25, 0})), (Vec3{0.5, 0.25, 0}));
}

TEST(Coordinates, ShiftWhatIsFarWithoutRounding) {
  const Coordinates far(Box{{500000, 5400000, 0}, {500020, 5400010, 0}}, {1.0, 1.0, 1.0});
  const Vec3 position{500001.1234567, 5400003.7654321, 0};
  const Vec3 local = far.local(position);
  EXPECT_LT(norm(local), 2000.0);
  EXPECT_EQ(far.as_in_file(local), position);
}

TEST(Coordinates, AreMetresOfOtherUnits) {
  const Coordinates feet(Box{{0, 0, 0}, {10, 10, 0}}, {0.3048, 0.3048, 1.0});
  EXPECT_DOUBLE_EQ(feet.local({10, 0, 0}).x, 3.048);
  EXPECT_DOUBLE_EQ(feet.as_in_file({3.048, 0, 0}).x, 10);
}

TEST(UtmZone, IsANumberAndALetter) {
  EXPECT_EQ(parse_utm_zone("33N", "--positions utm").number, 33);
  EXPECT_TRUE(parse_utm_zone("5n", "--positions utm").north);
  EXPECT_FALSE(parse_utm_zone("60S", "--positions utm").north);
  for (const char* wrong : {"", "33", "N", "0N", "61N", "33X", "33NN", "-3N"}) {
    EXPECT_EQ(error_of([&] { parse_utm_zone(wrong, "--positions utm"); }),
              std::string("--positions utm: expected a UTM zone such as 33N or 5S, but got '") + wrong + "'");
  }
}

/// True if the program can project; all tests below need it.
bool can_project() {
  const Vec3 here{};
  try {
    project({&here, 1}, false, ProjectionChoice::automatic);
    return true;
  } catch (const ProgramError&) {
    return false;
  }
}

class ProjectionTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!can_project()) GTEST_SKIP() << "built without GeographicLib";
  }
};

TEST_F(ProjectionTest, PlaneHasTrueLengths) {
  const std::vector<Vec3> points{{11.0, 54.0, 0}, {11.2, 54.1, 0}};
  const auto plane = project(points, false, ProjectionChoice::automatic);
  ASSERT_TRUE(plane->is_plane());
  // One minute of latitude at 54 degrees north on WGS 84.
  const double minute = norm(plane->local({11.1, 54.05 + 1.0 / 60, 0}) - plane->local({11.1, 54.05, 0}));
  EXPECT_NEAR(minute, 1855.0, 1.0);
  const Vec3 back = plane->geographic(plane->local({11.15, 54.02, 7}));
  EXPECT_NEAR(back.x, 11.15, 1e-12);
  EXPECT_NEAR(back.y, 54.02, 1e-12);
  EXPECT_EQ(back.z, 7);
}

TEST_F(ProjectionTest, DateLineAndPolesAreNoBorders) {
  const std::vector<Vec3> points{{179.99, -17.0, 0}, {-179.99, -17.0, 0}};
  const auto plane = project(points, false, ProjectionChoice::automatic);
  EXPECT_NEAR(norm(plane->local(points[0]) - plane->local(points[1])), 2130, 2);
  EXPECT_LT(norm(plane->local({539.99 - 360, -17.0, 0}) - plane->local(points[0])), 1e-6);
  const std::vector<Vec3> pole{{0, 89.99, 0}, {180, 89.99, 0}};
  const auto polar = project(pole, false, ProjectionChoice::automatic);
  EXPECT_NEAR(norm(polar->local(pole[0]) - polar->local(pole[1])), 2234, 1);
}

TEST_F(ProjectionTest, GoesIntoSpaceWhereThePlaneIsTooWrong) {
  const std::vector<Vec3> continent{{-120, 35, 0}, {-75, 40, 0}};
  const auto earth = project(continent, false, ProjectionChoice::automatic);
  EXPECT_FALSE(earth->is_plane());
  // 111.2 km of a great circle in a straight line.
  EXPECT_NEAR(norm(earth->local({-120, 35, 0}) - earth->local({-120, 36, 0})), 110945, 10);
  const Vec3 back = earth->geographic(earth->local({-100, 30, 1234}));
  EXPECT_NEAR(back.x, -100, 1e-12);
  EXPECT_NEAR(back.y, 30, 1e-12);
  EXPECT_NEAR(back.z, 1234, 1e-8);
  EXPECT_TRUE(project(continent, false, ProjectionChoice::plane)->is_plane());
  const std::vector<Vec3> all_around{{0, 0, 0}, {180, 0, 0}, {90, 0, 0}, {-90, 0, 0}};
  EXPECT_FALSE(project(all_around, false, ProjectionChoice::automatic)->is_plane());
  EXPECT_EQ(error_of([&] { project(all_around, false, ProjectionChoice::plane); }),
            "--projection plane: expected points on one side of the Earth, but they are all around it: use "
            "--projection earth");
  EXPECT_FALSE(project(std::vector<Vec3>{{1, 2, 10000}}, true, ProjectionChoice::automatic)->is_plane());
}

TEST_F(ProjectionTest, ThePlaneSaysHowWrongItIs) {
  // 200 km around the middle: tangential lengths are too long by (r / R)^2 / 6, 0.0165 %.
  std::vector<Vec3> points;
  for (int k = 0; k < 8; ++k)
    points.push_back({10 + 1.8 * std::cos(k * 0.7853981634), 1.8 * std::sin(k * 0.7853981634), 0});
  const auto plane = project(points, false, ProjectionChoice::automatic);
  EXPECT_NE(plane->description().find("0.017 %"), std::string::npos) << plane->description();
  double longest = 0, shortest = 2;
  for (const Vec3& point : points) {
    for (const Vec3& step : {Vec3{1e-3, 0, 0}, Vec3{0, 1e-3, 0}, Vec3{1e-3, 1e-3, 0}}) {
      const auto there = project(std::vector<Vec3>{point}, false, ProjectionChoice::plane);
      const double truth = norm(there->local(point + step) - there->local(point));
      const double reported = norm(plane->local(point + step) - plane->local(point));
      longest = std::max(longest, reported / truth);
      shortest = std::min(shortest, reported / truth);
    }
  }
  EXPECT_GT(longest, 1.0001);
  EXPECT_LT(longest, 1.000166);
  EXPECT_GT(shortest, 1 - 1e-7);
}

TEST_F(ProjectionTest, UtmIsGeographicToo) {
  const Coordinates zone(Box{{499000, 5400000, 0}, {501000, 5401000, 0}}, {1.0, 1.0, 1.0}, UtmZone{33, true});
  const auto place = zone.geographic(zone.local({500000, 5400000, 3}));
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x, 15.0, 1e-9);
  EXPECT_NEAR(place->y, 48.75, 0.01);
  EXPECT_EQ(place->z, 3);
}

}  // namespace
}  // namespace kinesphere::program::coordinates_test
