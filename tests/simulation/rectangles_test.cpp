// Rectangles that turn: by hand, and along curves against dense samples.
#include "simulation/tracks/rectangles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinesphere/random.hpp"
#include "simulation/tracks/rectangle_conflicts.hpp"
#include "simulation/tracks/scene_of_tracks.hpp"

namespace kinesphere::rectangles_test {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double pi = 3.14159265358979323846;

/// A point of the outline, or of the inside, of a body: along and across it, from -1 to 1.
Vec3 point_of(const RectangleBody& body, const RectanglePose& pose, double along, double across) {
  const Vec3 direction{std::cos(pose.heading), std::sin(pose.heading), 0}, left{-direction.y, direction.x, 0};
  return pose.position + direction * (0.5 * along * body.length) + left * (0.5 * across * body.width);
}

bool is_inside(const RectangleBody& body, const RectanglePose& pose, const Vec3& point) {
  const Vec3 way = point - pose.position, direction{std::cos(pose.heading), std::sin(pose.heading), 0};
  return std::abs(dot(way, direction)) <= 0.5 * body.length &&
         std::abs(way.x * direction.y - way.y * direction.x) <= 0.5 * body.width;
}

/// Distance by points of both outlines; 0 where one has a point of the other inside.
double sampled_gap(const RectangleBody& a, const RectanglePose& at, const RectangleBody& b,
                   const RectanglePose& other) {
  constexpr int steps = 60;
  std::vector<Vec3> outlines[2];
  for (int k = 0; k < steps; ++k) {
    const double part = -1.0 + 2.0 * k / steps;
    for (const auto& [along, across] :
         {std::pair(part, -1.0), std::pair(1.0, part), std::pair(-part, 1.0), std::pair(-1.0, -part)}) {
      outlines[0].push_back(point_of(a, at, along, across));
      outlines[1].push_back(point_of(b, other, along, across));
    }
  }
  double least = never;
  for (const Vec3& one : outlines[0]) {
    if (is_inside(b, other, one)) return 0.0;
    for (const Vec3& two : outlines[1]) least = std::min(least, norm(one - two));
  }
  for (const Vec3& two : outlines[1])
    if (is_inside(a, at, two)) return 0.0;
  return least;
}

TEST(Rectangles, GapIsThatOfTheirOutlines) {
  const RectangleBody car{.length = 4, .width = 2};
  const auto at = [](double x, double y, double heading = 0.0) {
    return RectanglePose{{x, y, 0}, {}, heading};
  };
  EXPECT_DOUBLE_EQ(gap_between(car, at(0, 0), car, at(10, 0)), 6.0) << "behind each other";
  EXPECT_DOUBLE_EQ(gap_between(car, at(0, 0), car, at(0, 3.5)), 1.5) << "beside each other";
  EXPECT_DOUBLE_EQ(gap_between(car, at(0, 0), car, at(7, 6)), 5.0) << "corner to corner";
  EXPECT_NEAR(gap_between(car, at(0, 0), car, at(10, 0, pi / 2)), 7.0, 1e-12) << "across";
  EXPECT_DOUBLE_EQ(gap_between(car, at(0, 0), car, at(3.5, 0.5)), -0.5) << "half a metre frees them";
  const RectangleBody disc{.radius = 1.5};
  EXPECT_DOUBLE_EQ(gap_between(car, at(0, 0), disc, at(5, 5)), 3.5) << "corner to disc";
  Random random(71);
  for (int round = 0; round < 300; ++round) {
    const RectangleBody a{.length = random.uniform(1, 5), .width = random.uniform(0.5, 3)};
    const RectangleBody b{.length = random.uniform(1, 5), .width = random.uniform(0.5, 3)};
    const RectanglePose one = at(0, 0, random.uniform(-4, 4));
    const RectanglePose two = at(random.uniform(-6, 6), random.uniform(-6, 6), random.uniform(-4, 4));
    const double gap = gap_between(a, one, b, two), sampled = sampled_gap(a, one, b, two);
    EXPECT_NEAR(std::max(gap, 0.0), sampled, gap > 0.0 ? 0.01 : 0.1) << round;
  }
}

TEST(Rectangles, TouchWhereStraightMotionBringsThem) {
  const RectangleBody car{.length = 4, .width = 2}, disc{.radius = 1};
  const RectanglePose still{{0, 0, 0}, {}, 0};
  EXPECT_DOUBLE_EQ(time_to_touch(car, still, car, {{14, 0, 0}, {-5, 0, 0}, 0}), 2.0);
  EXPECT_EQ(time_to_touch(car, still, car, {{14, 2.01, 0}, {-5, 0, 0}, 0}), never) << "in the next lane";
  EXPECT_EQ(time_to_touch(car, still, car, {{14, 0, 0}, {5, 0, 0}, 0}), never) << "away from it";
  EXPECT_EQ(time_to_touch(car, still, car, {{3, 0, 0}, {5, 0, 0}, 0}), 0.0) << "they overlap";
  // Past the corner by less than the radius, and by more.
  EXPECT_NEAR(time_to_touch(car, still, disc, {{10, 1.6, 0}, {-1, 0, 0}, 0}), 10 - 2 - 0.8, 1e-9);
  EXPECT_EQ(time_to_touch(car, still, disc, {{10, 2.01, 0}, {-1, 0, 0}, 0}), never);
  Random random(72);
  int touched = 0;
  for (int round = 0; round < 600; ++round) {
    const RectangleBody a{.length = random.uniform(1, 5), .width = random.uniform(0.5, 3)};
    const RectangleBody b = round % 3 == 0 ? RectangleBody{.radius = random.uniform(0.2, 2)}
                                           : RectangleBody{.length = random.uniform(1, 5), .width = 1.5};
    const RectanglePose one{{0, 0, 0}, {random.uniform(-2, 2), 1, 0}, random.uniform(-4, 4)};
    const RectanglePose two{{random.uniform(-12, 12), random.uniform(-12, 12), 0},
                            {random.uniform(-2, 2), 0, 0},
                            random.uniform(-4, 4)};
    const double seconds = time_to_touch(a, one, b, two);
    const auto gap_after = [&](double s) {
      RectanglePose first = one, second = two;
      first.position += first.velocity * s;
      second.position += second.velocity * s;
      return gap_between(a, first, b, second);
    };
    double least = never;
    for (double s = 0.0; s < std::min(seconds, 20.0) - 1e-6; s += 0.01) least = std::min(least, gap_after(s));
    EXPECT_GT(least, 0.0) << round << ": not before";
    if (seconds == never) continue;
    EXPECT_LT(gap_after(seconds), 1e-9) << round;
    ++touched;
  }
  EXPECT_GT(touched, 60);
}

/// Two tracks of random walks, turned at random.
struct Scenario {
  explicit Scenario(Random& random, double size) {
    std::vector<Track> tracks;
    for (int body = 0; body < 2; ++body) {
      Track track;
      RectangleBody shape{.length = random.uniform(1, 4), .width = random.uniform(0.5, 2)};
      double heading = random.uniform(-3, 3);
      for (int k = 0; k <= 6; ++k) {
        track.push_back({1.0 * k, {random.uniform(0, size), random.uniform(0, size), 0}});
        shape.times.push_back(1.0 * k);
        shape.headings.push_back(heading += random.uniform(-1, 1));
      }
      tracks.push_back(track);
      bodies.push_back(shape);
    }
    scene = *scene_of_tracks(tracks, 1000.0, Interpolation::spline);
    whole = {{.first = 0,
              .second = 1,
              .begin = 0.0,
              .end = 6.0,
              .begins_with_track = true,
              .ends_with_track = true}};
  }
  double gap(double t) const { return distance_at(*scene.motion, bodies, 0, 1, t); }

  Scene scene;
  std::vector<RectangleBody> bodies;
  std::vector<Approach> whole;
};

TEST(Rectangles, ApproachesAreThoseOfDenseSamples) {
  Random random(73);
  constexpr double distance = 1.0, tolerance = 1e-6;
  std::size_t found = 0;
  for (int round = 0; round < 40; ++round) {
    const Scenario of(random, 9.0);
    auto approaches = approaches_of_rectangles(distance, tolerance, *of.scene.motion, of.bodies, of.whole);
    find_closest(*of.scene.motion, approaches, of.bodies, 1e-4);
    found += approaches.size();
    std::vector<double> least(approaches.size(), never);
    for (double t = 0.0; t <= 6.0; t += 1e-3) {
      const double gap = of.gap(t);
      const auto holding = std::ranges::find_if(
          approaches, [t](const Approach& each) { return each.begin <= t && t <= each.end; });
      const bool is_held = holding != approaches.end();
      EXPECT_TRUE(is_held || gap >= distance - tolerance) << round << " at " << t;
      EXPECT_TRUE(!is_held || gap <= distance + tolerance) << round << " at " << t;
      if (is_held) {
        double& lowest = least[static_cast<std::size_t>(holding - approaches.begin())];
        lowest = std::min(lowest, gap);
      }
    }
    for (std::size_t k = 0; k < approaches.size(); ++k) {
      const ClosestApproach& closest = approaches[k].closest;
      EXPECT_NEAR(closest.distance, of.gap(closest.time), 1e-9);
      EXPECT_LE(closest.distance, least[k] + 1e-4);
      EXPECT_TRUE(least[k] == never || closest.distance >= least[k] - 0.05);
    }
  }
  EXPECT_GT(found, 30u);
}

TEST(Rectangles, TurningAloneBringsThemNear) {
  const auto scene = *scene_of_tracks({{{0, {0, 0, 0}}, {10, {0, 0, 0}}}, {{0, {0, 4, 0}}, {10, {0, 4, 0}}}},
                                      100.0, Interpolation::linear);
  // The first turns by a half turn, and reaches up to 0.5 from the other where it stands across at 5 s.
  const std::vector<RectangleBody> bodies{{.length = 5, .width = 1, .times = {0, 10}, .headings = {0, pi}},
                                          {.length = 5, .width = 2, .times = {0}, .headings = {0}}};
  const std::vector<Approach> whole{{.first = 0, .second = 1, .begin = 0, .end = 10}};
  auto approaches = approaches_of_rectangles(0.6, 1e-6, *scene.motion, bodies, whole);
  ASSERT_EQ(approaches.size(), 1u);
  EXPECT_NEAR(approaches[0].begin + approaches[0].end, 10.0, 1e-4);
  EXPECT_GT(approaches[0].begin, 3.0) << "only while it stands nearly across";
  find_closest(*scene.motion, approaches, bodies, 1e-4);
  EXPECT_LE(approaches[0].closest.distance, 0.5);
  EXPECT_TRUE(approaches_of_rectangles(0.3, 1e-6, *scene.motion, bodies, whole).empty());
}

TEST(Rectangles, MinimaAreThoseOfDenseSamples) {
  Random random(74);
  for (int round = 0; round < 20; ++round) {
    const Scenario of(random, 9.0);
    const auto minima = minima_in(*of.scene.motion, of.whole, of.bodies);
    ASSERT_FALSE(minima.empty());
    constexpr double step = 0.02;
    for (double t = step; t < 6.0 - step; t += step) {
      if (!(of.gap(t) < of.gap(t - step) - 1e-3 && of.gap(t) < of.gap(t + step) - 1e-3)) continue;
      EXPECT_TRUE(std::ranges::any_of(
          minima,
          [t](const DistanceMinimum& minimum) { return std::abs(minimum.closest.time - t) < 2.0 * step; }))
          << round << " at " << t;
    }
  }
}

TEST(Rectangles, CoursesOfCollisionAreThoseOfDenseSamples) {
  Random random(75);
  int courses = 0;
  for (int round = 0; round < 200; ++round) {
    Scenario of(random, 20.0);
    find_closest(*of.scene.motion, of.whole, of.bodies, 1e-4);
    const CollisionCourse course = collision_course(*of.scene.motion, of.whole[0], of.bodies);
    double least = never, worst = 0.0;
    const auto first = pieces_of(*of.scene.motion, 0, of.bodies[0], 0.0, 6.0);
    const auto second = pieces_of(*of.scene.motion, 1, of.bodies[1], 0.0, 6.0);
    for (std::size_t k = 0; k < first.size(); ++k) {
      for (double t = first[k].begin; t < first[k].end; t += 2e-3) {
        const RectanglePose a = first[k].pose(t), b = second[k].pose(t);
        const double seconds = time_to_touch(of.bodies[0], a, of.bodies[1], b);
        least = std::min(least, seconds);
        if (seconds < never) worst = std::max(worst, norm(a.velocity - b.velocity) / (2.0 * seconds));
      }
    }
    if (of.whole[0].closest.distance <= 0.0) {
      EXPECT_EQ(course.least.seconds, 0.0);
      continue;
    }
    if (least == never) continue;
    EXPECT_NEAR(course.least.seconds, least, 0.01 + 0.05 * least) << round;
    EXPECT_NEAR(course.deceleration, worst, 0.05 * worst + 0.05) << round;
    ++courses;
  }
  EXPECT_GT(courses, 10);
}

TEST(Rectangles, PostEncroachmentTimesAreThoseOfDenseSamples) {
  Random random(76);
  int finite = 0;
  for (int round = 0; round < 100; ++round) {
    Scenario of(random, 20.0);
    find_closest(*of.scene.motion, of.whole, of.bodies, 1e-4);
    if (of.whole[0].closest.distance <= 0.0) continue;
    const PostEncroachment found = post_encroachment(*of.scene.motion, of.whole[0], of.bodies);
    const auto pose_of = [&](std::uint32_t body, double t) {
      const auto pieces = pieces_of(*of.scene.motion, body, of.bodies[body], t, t + 1e-6);
      return pieces.front().pose(t);
    };
    constexpr int steps = 300;
    std::vector<RectanglePose> poses[2];
    for (int k = 0; k < steps; ++k)
      for (std::uint32_t body : {0u, 1u}) poses[body].push_back(pose_of(body, 6.0 * k / steps));
    double least = never;
    for (std::size_t i = 0; i < steps; ++i) {
      for (std::size_t k = 0; k < steps; ++k) {
        const double seconds = 6.0 / steps * std::abs(double(i) - double(k));
        const double angle = std::remainder(poses[0][i].heading - poses[1][k].heading, 2.0 * pi);
        if (seconds < least && std::abs(angle) >= pi / 6 &&
            gap_between(of.bodies[0], poses[0][i], of.bodies[1], poses[1][k]) <= 0.0)
          least = seconds;
      }
    }
    EXPECT_LE(found.seconds, least + 1e-6) << round;
    if (least == never) continue;
    EXPECT_GE(found.seconds, least - 0.06) << round;
    ++finite;
  }
  EXPECT_GT(finite, 8);
}

TEST(Rectangles, OneThatFollowsEntersNoPlaceOfAConflict) {
  const auto scene = *scene_of_tracks({{{0, {-10, 0, 0}}, {10, {10, 0, 0}}},
                                       {{0, {-22, 0, 0}}, {10, {-2, 0, 0}}},
                                       {{0, {0, -8, 0}}, {10, {0, 2, 0}}}},
                                      1000.0, Interpolation::linear);
  RectangleBody car{.length = 2, .width = 1};
  car.times = {0.0};
  car.headings = {0.0};
  RectangleBody across = car;
  across.headings = {pi / 2};
  std::vector<Approach> approaches{{.first = 0, .second = 1, .begin = 0, .end = 10},
                                   {.first = 0, .second = 2, .begin = 0, .end = 10}};
  const std::vector<RectangleBody> bodies{car, car, across};
  find_closest(*scene.motion, approaches, bodies, 1e-4);
  EXPECT_EQ(post_encroachment(*scene.motion, approaches[0], bodies).seconds, never);
  // The first is out of the way of the other at 5 s + 1.5 / 2 s; that one enters its lane 1.5 m before 8 s.
  const PostEncroachment crossing = post_encroachment(*scene.motion, approaches[1], bodies);
  EXPECT_NEAR(crossing.seconds, 6.5 - 5.75, 1e-4);
  EXPECT_NEAR(crossing.at, 6.5, 1e-4);
}

}  // namespace
}  // namespace kinesphere::rectangles_test
