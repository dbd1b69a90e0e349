// The cost model: compared with results worked out by hand, and with the detector itself.
#include "research/rivals/event_driven/cost_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kinesphere/random.hpp"
#include "research/rivals/rivals.hpp"
#include "simulation/detector/detector.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/scene/make_scene.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::cost_model_test {
namespace {

const Box box{{0, 0, 0}, {200, 200, 200}};

/// Returns the spheres in other units of length and time; exact for powers of two.
std::vector<MovingSphere> scaled(std::vector<MovingSphere> spheres, double length, double time) {
  for (MovingSphere& sphere : spheres) {
    sphere.radius *= length;
    sphere.speed *= length / time;
    sphere.growth_speed *= length / time;
    sphere.limit *= length / (time * time);
  }
  return spheres;
}

std::vector<MovingSphere> random_spheres(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<MovingSphere> spheres(count);
  for (MovingSphere& sphere : spheres) {
    sphere.radius = random.uniform(0.1, 10.0);
    sphere.speed = random.uniform(4.0, 43.0);
    sphere.limit = random.uniform(10.0, 20.0);
  }
  return spheres;
}

CostModel model_of(const std::vector<MovingSphere>& spheres, const Box& extent = box, bool walls = true) {
  return {spheres, extent, walls};
}

TEST(CostModel, counts_crossings_of_points_that_fly_straight) {
  // A point crosses |v_x| + |v_y| + |v_z| over the edge planes a second; each component is v/2 on average.
  const std::vector<MovingSphere> points(1, {.speed = 12.0});
  // Planes are 10 apart: 19 are inside of the box, and the two on its walls count half.
  const ExpectedRates rates = model_of(points, box, false).expected_rates(10.0);
  EXPECT_NEAR(rates.entering, 3.0 * 6.0 * 20.0 / 200.0, 1e-9);
  EXPECT_NEAR(rates.leaving, rates.entering, 1e-9);
  EXPECT_NEAR(rates.resetting, 0.0, 1e-9);
  EXPECT_EQ(rates.colliding, 0.0);
  EXPECT_EQ(rates.pair_tests, 0.0);
}

TEST(CostModel, resets_a_body_at_rest_as_eq_8_says) {
  const std::vector<MovingSphere> spheres(1, {.radius = 1.0, .limit = 2.0});
  EXPECT_NEAR(model_of(spheres, box, false).expected_rates(10.0).resetting,
              1.0 / std::sqrt((10.0 - 2.0) / 2.0), 1e-9);
  const std::vector<MovingSphere> uncertain(1, {.radius = 1.0, .growth_speed = 3.0});
  EXPECT_NEAR(model_of(uncertain, box, false).expected_rates(10.0).resetting, 3.0 / 4.0, 1e-9);
}

/// Spheres in a dilute gas without growth meet as in kinetic theory, and are rechecked a few times more.
TEST(CostModel, counts_collisions_as_kinetic_theory_does) {
  constexpr double bodies = 1000.0, radius = 0.1, speed = 10.0;
  const std::vector<MovingSphere> spheres(static_cast<std::size_t>(bodies),
                                          {.radius = radius, .speed = speed});
  const double relative_speed = std::numbers::sqrt2 * speed;
  const double cross_section = std::numbers::pi * 4.0 * radius * radius;
  const double contacts = 0.5 * bodies * (bodies - 1.0) / 8e6 * cross_section * relative_speed;
  const double colliding = model_of(spheres, box, false).expected_rates(10.0).colliding;
  EXPECT_GT(colliding, contacts);
  EXPECT_LT(colliding, 5.0 * contacts);
  const double with_walls = model_of(spheres).expected_rates(10.0).colliding;
  EXPECT_GT(with_walls, colliding + bodies * 6.0 / 200.0 * speed / 4.0);
}

TEST(CostModel, chooses_the_same_cells_in_any_units) {
  const std::vector<MovingSphere> spheres = random_spheres(300, 1);
  const double edge = model_of(spheres).choose_cell_edge();
  for (const double length : {0x1p-40, 0.5, 1024.0, 0x1p40})
    for (const double time : {0x1p-20, 1.0, 0x1p20}) {
      const Box extent{box.lower * length, box.upper * length};
      EXPECT_EQ(model_of(scaled(spheres, length, time), extent).choose_cell_edge(), edge * length)
          << length << " " << time;
    }
}

/// A scene as in the paper, and the counters of its run with cells of some edge.
class CostModelOfScene : public testing::TestWithParam<std::uint32_t> {
 protected:
  CostModelOfScene() : scene_(make_scene({.bodies = GetParam(), .seconds = 1.0}).value()) {}

  CostModel model() const {
    std::vector<MovingSphere> spheres;
    for (std::uint32_t k = 0; k < scene_.bodies.size(); ++k) {
      const BodyDefinition body = scene_.motion->definition(k, 0.0);
      spheres.push_back({.radius = scene_.bodies[k].radius,
                         .speed = norm(body.velocity),
                         .limit = body.acceleration_limit});
    }
    return model_of(spheres);
  }

  DetectorCounters run(double edge) const {
    const auto paper = [edge](const WorldDefinition& definition, const Motion& motion) {
      return make_paper_detector(definition, motion, {.cell_edge = edge});
    };
    return run_scene(scene_, paper).value().counters;
  }

  Scene scene_;
};

void expect_near_factor(double expected, std::uint64_t measured, double factor, const char* what) {
  EXPECT_LT(expected, factor * static_cast<double>(measured)) << what;
  EXPECT_GT(expected * factor, static_cast<double>(measured)) << what;
}

TEST_P(CostModelOfScene, expects_what_happens) {
  for (const double edge : {10.0, 25.0, 60.0}) {
    SCOPED_TRACE(edge);
    const ExpectedRates expected = model().expected_rates(edge);
    const DetectorCounters measured = run(edge);
    expect_near_factor(expected.entering, measured.entering, 3.0, "entering");
    expect_near_factor(expected.leaving, measured.leaving, 3.0, "leaving");
    expect_near_factor(expected.colliding, measured.colliding, 1.5, "colliding");
    expect_near_factor(expected.pair_tests, measured.certificates, 2.0, "pair tests");
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, CostModelOfScene, testing::Values(100, 400));

}  // namespace
}  // namespace kinesphere::cost_model_test
