// The lists of crossed sensor distances, and which distance comes next, against plain ones.
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "contact/overlap_records.hpp"
#include "contact/sensor_table.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::overlap_records_test {
namespace {

constexpr std::uint64_t seed = 1405;

std::vector<OverlapRecord> content(OverlapRecords::List list) { return {list.begin(), list.end()}; }

TEST(OverlapRecords, AreSortedByPartnerAndFromTheOutermostInward) {
  OverlapRecords overlaps;
  for (const OverlapRecord& one : {OverlapRecord{7, 2.0}, {3, 5.0}, {7, 9.0}, {3, 0.0}, {7, 4.0}})
    overlaps.add(2, one);
  EXPECT_EQ(content(overlaps.of(2)),
            (std::vector<OverlapRecord>{{3, 5.0}, {3, 0.0}, {7, 9.0}, {7, 4.0}, {7, 2.0}}));
  EXPECT_EQ(content(overlaps.of(2, 7)), (std::vector<OverlapRecord>{{7, 9.0}, {7, 4.0}, {7, 2.0}}));
  EXPECT_TRUE(overlaps.of(2, 5).empty());
  EXPECT_TRUE(overlaps.of(1).empty());
  EXPECT_TRUE(overlaps.of(100, 3).empty());
}

TEST(OverlapRecords, AreWhatWasAddedAndNotErased) {
  Random random(seed);
  OverlapRecords overlaps;
  std::vector<std::set<OverlapRecord>> mirror(5);
  for (int step = 0; step < 20000; ++step) {
    const auto body = static_cast<std::uint32_t>(random.bits() % mirror.size());
    const OverlapRecord one{static_cast<std::uint32_t>(random.bits() % 4),
                            static_cast<double>(random.bits() % 8)};
    ASSERT_EQ(overlaps.contains(body, one), mirror[body].contains(one)) << "step " << step;
    if (random.bits() % 200 == 0) {
      overlaps.clear(body);
      mirror[body].clear();
    } else if (random.bits() % 2 == 0) {
      if (mirror[body].insert(one).second) overlaps.add(body, one);
    } else {
      overlaps.erase(body, one);
      mirror[body].erase(one);
    }
    ASSERT_EQ(content(overlaps.of(body)),
              std::vector<OverlapRecord>(mirror[body].begin(), mirror[body].end()))
        << "step " << step;
  }
}

TEST(OverlapRecords, OfADamagedSnapshotAreSortedAllTheSame) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<OverlapRecord> list;
  list.reserve(100);
  for (int k = 0; k < 100; ++k) list.push_back({0, k % 3 == 0 ? nan : k});
  std::sort(list.begin(), list.end());
  EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
  EXPECT_EQ(list.front().distance, 98.0);
  EXPECT_TRUE(std::isnan(list.back().distance));
}

/// Two sensors with some distances in common, any of which may have been crossed.
TEST(SensorTable, NextInwardIsTheLargestThatIsNotCrossed) {
  Random random(seed + 1);
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

}  // namespace
}  // namespace kinesphere::overlap_records_test
