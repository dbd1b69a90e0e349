// Sensors with thousands of distances: the cost of a crossing does not depend on their number.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>

#include "number/infinity.hpp"
#include "support/playground.hpp"

namespace kinesphere::many_distances_test {
namespace {

Sensor sensor_of(int count, double first, double step) {
  Sensor sensor;
  sensor.distances.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) sensor.distances.push_back(first + step * k);
  return sensor;
}

/// A body with this many distances, and one that flies through it, until nothing is sensed any more.
class Passage {
 public:
  explicit Passage(int count) : reach_(0.01 * count) {
    p.world.set_sensor(1, sensor_of(count, 0.001, 0.01)).value();
    rests = p.add({.radius = 1, .sensor_class = 1}, Vec3{});
    comes = p.add({.radius = 1, .position = {3 + reach_, 0, 0}, .velocity = {-1, 0, 0}}, Vec3{});
  }
  double end() const { return 8 + 2 * reach_; }

  Playground p;
  BodyId rests, comes;

 private:
  double reach_;
};

/// Returns the processor time of a whole passage, or +infinity if it takes longer than `most`.
double seconds(int count, double most) {
  Passage passage(count);
  const std::clock_t start = std::clock();
  const auto elapsed = [start] { return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC; };
  while (passage.p.advance(passage.end()))
    if (elapsed() > most) return infinity;
  return elapsed();
}

double least_seconds(int count, double most) {
  double least = infinity;
  for (int run = 0; run < 5; ++run) least = std::min(least, seconds(count, std::min(most, least)));
  return least;
}

TEST(ManyDistances, CostLittleMoreThanTheirNumber) {
  const double few = least_seconds(250, infinity);
  // Eight times as many: 64 times the cost if each crossing cost their number, 512 times if it cost its
  // square.
  EXPECT_LT(least_seconds(2000, 30 * few), 30 * few) << "the cost of 250 distances is " << few << " seconds";
}

TEST(ManyDistances, AreCrossedInTheirOrder) {
  constexpr int count = 300;
  Passage passage(count);
  Playground& p = passage.p;
  std::vector<double> entered, left;
  while (const auto event = p.advance(passage.end())) {
    if (event->kind == EventKind::sensor_enter) entered.push_back(event->distance);
    if (event->kind == EventKind::sensor_leave) left.push_back(event->distance);
    ASSERT_TRUE((entered.size() + left.size()) % 50 != 0 || is_clean(p.world));
    ASSERT_EQ(p.world.sensor_overlaps(passage.comes).value().size(), entered.size() - left.size());
  }
  ASSERT_EQ(entered.size(), std::size_t{count});
  EXPECT_TRUE(std::is_sorted(entered.rbegin(), entered.rend()));
  std::reverse(entered.begin(), entered.end());
  EXPECT_EQ(left, entered);
}

/// Distances that a sensor gains between crossed ones are crossed at once, from the outermost inward;
/// distances that it loses are left.
TEST(ManyDistances, MayChangeAtAnyTime) {
  constexpr int count = 40;
  Passage passage(count);
  Playground& p = passage.p;
  p.run(1.2);  // half of them
  const auto before = p.world.sensor_overlaps(passage.rests).value();
  ASSERT_GT(before.size(), 10u);
  ASSERT_LT(before.size(), std::size_t{count});
  p.world.set_sensor(1, sensor_of(2 * count, 0.001, 0.005)).value();
  const double innermost = before.back().distance;
  std::vector<double> entered;
  while (const auto event = p.advance(p.world.time())) {
    ASSERT_EQ(event->kind, EventKind::sensor_enter) << *event;
    entered.push_back(event->distance);
  }
  EXPECT_TRUE(std::is_sorted(entered.rbegin(), entered.rend()));
  EXPECT_GE(entered.size(), before.size() - 1);
  EXPECT_TRUE(is_clean(p.world));
  // The other body senses, too, with some equal and some other distances.
  p.world.set_sensor(2, sensor_of(count, 0.001, 0.0125)).value();
  p.world.change(passage.comes, {.sensor_class = 2}).value();
  while (const auto event = p.advance(p.world.time())) EXPECT_EQ(event->kind, EventKind::sensor_enter);
  EXPECT_TRUE(is_clean(p.world));
  p.world.change(passage.rests, {.sensor_class = 0}).value();
  std::size_t left = 0;
  while (const auto event = p.advance(p.world.time())) {
    EXPECT_EQ(event->kind, EventKind::sensor_leave);
    ++left;
  }
  EXPECT_GT(left, before.size());
  for (const SensorOverlap& one : p.world.sensor_overlaps(passage.rests).value()) {
    const auto sensor = p.world.sensor(2);
    EXPECT_GE(one.distance, innermost - 0.03);
    EXPECT_TRUE(std::find(sensor.distances.begin(), sensor.distances.end(), one.distance) !=
                sensor.distances.end());
  }
  p.run(passage.end());
  EXPECT_TRUE(p.world.sensor_overlaps(passage.rests).value().empty());
  EXPECT_TRUE(is_clean(p.world));
}

}  // namespace
}  // namespace kinesphere::many_distances_test
