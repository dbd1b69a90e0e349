// The distances of sensor classes, and which one comes next, against plain sets.
#include "contact/sensor_table.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "archive/fields.hpp"
#include "archive/heap_counter.hpp"
#include "kinesphere/random.hpp"
#include "support/read_back.hpp"

namespace kinesphere::sensor_table_test {
namespace {

constexpr std::uint64_t seed = 1406;

/// Two sensors with some distances in common, any of which may have been crossed.
TEST(SensorTable, NextInwardIsTheLargestThatIsNotCrossed) {
  Random random(seed);
  int ended = 0;
  for (int k = 0; k < 20000; ++k) {
    SensorTable table;
    Sensor sensors[2];
    std::set<double> sensed;
    const Sensing a{0, 1};
    const Sensing b{static_cast<SensorClass>(random.bits() % 2), 2};
    for (const SensorClass number : {SensorClass{0}, SensorClass{1}}) {
      Sensor& sensor = sensors[number];
      for (std::uint64_t count = random.bits() % 6; count > 0; --count)
        sensor.distances.push_back(static_cast<double>(random.bits() % 9));
      if (random.bits() % 4 == 0) sensor.mask = random.bits() % 4;
      table.set(number, sensor);
    }
    const auto sense = [&](const Sensing& watcher, const Sensing& watched) {
      const Sensor& sensor = sensors[watcher.sensor_class];
      if ((sensor.mask & watched.category) != 0)
        sensed.insert(sensor.distances.begin(), sensor.distances.end());
    };
    sense(a, b);
    sense(b, a);
    std::vector<OverlapRecord> crossed;
    std::vector<double> others;
    const bool in_order = random.bits() % 2 == 0;
    const std::size_t outermost = random.bits() % (sensed.size() + 1);
    for (const double distance : std::vector<double>(sensed.rbegin(), sensed.rend())) {
      const bool is_crossed = in_order ? crossed.size() < outermost : random.bits() % 2 == 0;
      if (is_crossed)
        crossed.push_back({1, distance});
      else
        others.push_back(distance);
    }
    const auto next = table.next_inward(a, b, crossed);
    ASSERT_EQ(next.has_value(), !others.empty()) << "case " << k;
    ASSERT_TRUE(!next || *next == others.front()) << "case " << k;
    ended += next ? 0 : 1;
    for (int distance = 0; distance < 9; ++distance)
      ASSERT_EQ(table.senses(a, b, distance), sensed.contains(distance)) << "case " << k;
  }
  EXPECT_GT(ended, 1000);
}

TEST(SensorTable, HasDistancesOfClassesThatWereSet) {
  SensorTable table;
  EXPECT_FALSE(table.any());
  EXPECT_EQ(table.reach(7), 0.0);
  table.set(7, {});
  EXPECT_FALSE(table.any()) << "a sensor without distances senses nothing";
  table.set(7, {.distances = {1.0, 5.0, 1.0, 3.0}});
  EXPECT_TRUE(table.any());
  EXPECT_EQ(table.reach(7), 5.0);
  EXPECT_EQ(table.reach(6), 0.0);
  EXPECT_EQ(table.of(7).distances.size(), 4u) << "as given";
  EXPECT_EQ(table.of(200), Sensor{});
  EXPECT_EQ(reach_of(table.of(7)), 5.0);
  EXPECT_EQ(reach_of({}), 0.0);
}

TEST(SensorTable, SensesWhatItsMaskAllows) {
  SensorTable table;
  table.set(1, {.distances = {2.0}, .mask = 4});
  const Sensing watcher{1, 1}, seen{0, 4}, unseen{0, 2};
  EXPECT_TRUE(table.senses_one_way(watcher, seen, 2.0));
  EXPECT_FALSE(table.senses_one_way(watcher, seen, 2.5)) << "at exactly that distance";
  EXPECT_FALSE(table.senses_one_way(seen, watcher, 2.0));
  EXPECT_TRUE(table.senses(seen, watcher, 2.0));
  EXPECT_FALSE(table.senses(watcher, unseen, 2.0));
  EXPECT_EQ(table.next_inward(watcher, unseen, {}), std::nullopt);
}

TEST(SensorTable, SensesAlikeAfterItWasBytes) {
  SensorTable table, back;
  table.set(2, {.distances = {1.0, 3.0}});
  ASSERT_TRUE(read_back(table, back));
  EXPECT_EQ(back.of(2), table.of(2));
  EXPECT_EQ(back.reach(2), 3.0);
  EXPECT_TRUE(back.senses({2, 1}, {0, 1}, 1.0));
}

}  // namespace
}  // namespace kinesphere::sensor_table_test
