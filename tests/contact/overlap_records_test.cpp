// The lists of crossed sensor distances against plain ones.
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "contact/overlap_records.hpp"
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

}  // namespace
}  // namespace kinesphere::overlap_records_test
