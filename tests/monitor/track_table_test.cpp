// The tables of tracks and of pairs, against plain maps.
#include "monitor/track_table.hpp"

#include <gtest/gtest.h>

#include <map>
#include <utility>
#include <vector>

#include "kinesphere/random.hpp"
#include "monitor/pair_records.hpp"

namespace kinesphere::track_table_test {
namespace {

constexpr std::uint64_t seed = 5203;

TEST(TrackTable, FindsTheTracksOfAMap) {
  SCOPED_TRACE(seed);
  Random random = Random::at(seed, 0, 0);
  TrackTable table;
  std::map<TrackId, std::uint32_t> expected;
  for (int step = 0; step < 4000; ++step) {
    const auto id = static_cast<TrackId>(random.uniform() * 60.0) * 0x9e3779b97f4a7c15u;
    if (const auto known = expected.find(id); known != expected.end()) {
      ASSERT_EQ(table.find(id), known->second);
      ASSERT_EQ(table[known->second].id, id);
      table.remove(known->second);
      expected.erase(known);
    } else {
      ASSERT_EQ(table.find(id), std::nullopt);
      const std::uint32_t number = table.add(id, 2);
      expected[id] = number;
      ASSERT_TRUE(table[number].present);
      ASSERT_EQ(table[number].track_class, 2u);
      ASSERT_EQ(table[number].own, 0.0) << "nothing is left of an earlier track";
      table[number].own = 1.0;
    }
    ASSERT_EQ(table.size(), expected.size());
    ASSERT_LE(table.numbers(), 60u) << "numbers are used again";
  }
  std::vector<TrackId> ids;
  for (const auto& [id, number] : expected) ids.push_back(id);
  EXPECT_EQ(table.ids(), ids);
  EXPECT_TRUE(table.index());
  for (const auto& [id, number] : expected) EXPECT_EQ(table.find(id), number);
}

TEST(TrackTable, SeesTablesThatNoCallsMake) {
  TrackTable table;
  table.add(7, 0);
  const std::uint32_t number = table.add(8, 0);
  EXPECT_TRUE(table.index());
  table[number].id = 7;
  EXPECT_FALSE(table.index()) << "two tracks with one id";
  table[number].id = 8;
  table[number].present = false;
  EXPECT_FALSE(table.index()) << "a number that is neither free nor in use";
}

TEST(PairMap, DoesNotMindTheOrderOfTheTwo) {
  SCOPED_TRACE(seed);
  Random random = Random::at(seed, 1, 0);
  PairMap<int> pairs;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> expected;
  for (int step = 0; step < 3000; ++step) {
    const auto a = static_cast<std::uint32_t>(random.uniform() * 12.0);
    const auto b = static_cast<std::uint32_t>(random.uniform() * 12.0);
    if (a == b) continue;
    const auto pair = std::minmax(a, b);
    if (random.uniform() < 0.4) {
      pairs.remove(a, b);
      expected.erase(pair);
    } else {
      pairs.add(a, b) = expected[pair] = step;
    }
    ASSERT_EQ(pairs.size(), expected.size());
    ASSERT_EQ(pairs.find(a, b), pairs.find(b, a));
  }
  std::size_t k = 0;
  const auto sorted = pairs.sorted();
  ASSERT_EQ(sorted.size(), expected.size());
  for (const auto& [pair, record] : expected) {
    EXPECT_EQ(std::pair(sorted[k].first, sorted[k].second), pair);
    EXPECT_EQ(sorted[k++].record, record);
  }
}

TEST(PairRecords, KnowTheirVerdicts) {
  PairMap<PairRecord> records;
  PairRecord& record = records.add(4, 2);
  EXPECT_EQ(records.find(2, 4), &record);
  EXPECT_FALSE(record.is_open());
  EXPECT_TRUE(record.is_expiring(0.0)) << "nothing but its certificate is known of it";
  record.levels.resize(2);
  EXPECT_TRUE(record.is_open());
  EXPECT_TRUE(record.is_apart());
  EXPECT_FALSE(record.is_undecided());
  record.levels[1].verdict = Verdict::undecided;
  EXPECT_FALSE(record.is_apart());
  EXPECT_TRUE(record.is_undecided());
  record.levels[0].until = record.levels[1].until = 5.0;
  EXPECT_FALSE(record.is_expiring(4.0));
  EXPECT_TRUE(record.is_expiring(5.0));
  record.levels[0].until = infinity;
  EXPECT_FALSE(record.is_expiring(5.0)) << "what is undecided does not expire";
}

}  // namespace
}  // namespace kinesphere::track_table_test
