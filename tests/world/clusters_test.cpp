// Crowds far from each other, with bodies of very different speeds and limits: no body keeps the whole crowd
// as neighbours.
#include <gtest/gtest.h>

#include "kinesphere/inspection.hpp"
#include "support/playground.hpp"

namespace kinesphere::clusters_test {
namespace {

constexpr double harbour_distance = 1e6;
constexpr double berth_width = 40.0;

Vec3 flat(const Vec3& v) { return {v.x, v.y, 0.0}; }

/// Rows of bodies that are almost at rest, in harbours far apart, with a few fast bodies among them.
class Harbours : public Playground {
 public:
  explicit Harbours(std::uint64_t seed, int harbours = 4, int berths = 300)
      : Playground({.contact_tolerance = 1e-4}), random(seed) {
    for (int harbour = 0; harbour < harbours; ++harbour) {
      const Vec3 corner{harbour * harbour_distance, random.uniform(0.0, 1e4), 0.0};
      for (int berth = 0; berth < berths; ++berth) moor(corner, berth);
      for (int ferry = 0; ferry < 20; ++ferry) sail(corner);
    }
  }

  void moor(const Vec3& corner, int berth) {
    constexpr int row = 20;
    const Vec3 place{berth_width * (berth % row), berth_width * (berth / row), 0.0};
    const double limit = 1e-4 * (1.0 + random.uniform());
    add({.radius = 10.0,
         .acceleration_limit = limit,
         .position = corner + place,
         .velocity = 0.01 * random.point_in_ball()},
        0.5 * limit * random.point_in_ball());
  }

  void sail(const Vec3& corner) {
    const double limit = random.uniform(0.05, 2.0);
    add({.radius = 10.0,
         .acceleration_limit = limit,
         .position = corner + Vec3{random.uniform(-800.0, 800.0), random.uniform(-800.0, 800.0), 0.0},
         .velocity = random.uniform(5.0, 50.0) * flat(random.unit_vector())},
        0.1 * limit * flat(random.point_in_ball()));
  }

  double candidates_per_search() const {
    const Counters counters = world.counters();
    return static_cast<double>(counters.candidates) / static_cast<double>(counters.searches);
  }
  double bytes_per_body() const {
    return static_cast<double>(world.inspection().memory().total()) / static_cast<double>(world.size());
  }

  Random random;
};

TEST(Clusters, body_in_a_cluster_has_few_neighbours) {
  Harbours harbours(1);
  const auto events = harbours.run(300.0);
  EXPECT_FALSE(events.empty());
  EXPECT_LT(harbours.candidates_per_search(), 64.0);
  EXPECT_LT(harbours.bytes_per_body(), 4000.0);
  EXPECT_TRUE(is_clean(harbours.world));
}

/// Bodies added one by one start as rounds of one body each.
TEST(Clusters, body_that_comes_later_has_few_neighbours) {
  Harbours harbours(2, 2, 0);
  harbours.run(1.0);
  for (int berth = 0; berth < 600; ++berth) {
    for (int harbour = 0; harbour < 2; ++harbour)
      harbours.moor({harbour * harbour_distance, 0.0, 0.0}, berth);
    harbours.run(1.0 + 0.01 * berth);
  }
  harbours.run(300.0);
  EXPECT_LT(harbours.candidates_per_search(), 200.0);
  EXPECT_LT(harbours.bytes_per_body(), 4000.0);
  EXPECT_TRUE(is_clean(harbours.world));
}

/// A slow body far from all others has a large swept sphere for a long time, until others approach.
TEST(Clusters, body_that_sails_into_a_crowd_makes_its_box_smaller) {
  Harbours harbours(3, 2, 300);
  const BodyId ship = harbours.add({.radius = 10.0,
                                    .acceleration_limit = 0.01,
                                    .position = {-40'000.0, 300.0, 50.0},
                                    .velocity = {20.0, 0.0, 0.0}});
  harbours.run(2050.0);
  EXPECT_LT(harbours.state(ship).position.x, 2000.0);
  EXPECT_LT(harbours.candidates_per_search(), 64.0);
  EXPECT_TRUE(is_clean(harbours.world));
}

TEST(Clusters, are_told_the_same_events_again) {
  Harbours first(4);
  Harbours second(4);
  EXPECT_EQ(first.run(200.0).size(), second.run(200.0).size());
  EXPECT_EQ(first.hash.value(), second.hash.value());
}

}  // namespace
}  // namespace kinesphere::clusters_test
