// The table of bodies against a plain list of the ids that were given out.
#include "bodies/body_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere::body_table_test {
namespace {

constexpr std::uint64_t seed = 5101;

TEST(BodyTable, AnIdDenotesOneBodyForever) {
  SCOPED_TRACE(seed);
  Random random = Random::at(seed, 0, 0);
  BodyTable table;
  std::vector<BodyId> live;
  std::vector<BodyId> gone;
  std::set<std::pair<std::uint32_t, std::uint32_t>> given_out;
  for (int step = 0; step < 5000; ++step) {
    SCOPED_TRACE(step);
    if (live.empty() || random.uniform() < 0.55) {
      const BodyId expected = table.next_id();
      const std::uint32_t number = table.take();
      const BodyId id = table.id_of(number);
      ASSERT_EQ(id, expected);
      ASSERT_TRUE(given_out.emplace(id.index, id.generation).second) << "an id was given out twice";
      live.push_back(id);
    } else {
      const auto k = static_cast<std::size_t>(random.uniform() * static_cast<double>(live.size()));
      std::swap(live[k], live.back());
      table.give_back(table.number_of(live.back()));
      gone.push_back(live.back());
      live.pop_back();
    }
    ASSERT_EQ(table.live_count(), live.size());
    if (step % 100 != 0) continue;
    for (const BodyId id : live) ASSERT_TRUE(table.is_alive(id) && table.was_given_out(id));
    for (const BodyId id : gone) ASSERT_TRUE(!table.is_alive(id) && table.was_given_out(id));
    ASSERT_TRUE(table.is_valid());
  }
  EXPECT_LT(table.numbers(), given_out.size()) << "numbers are used again";
}

TEST(BodyTable, TellsTheIdsOfComingAdditions) {
  BodyTable table;
  for (int body = 0; body < 8; ++body) (void)table.take();
  for (const std::uint32_t number : {5u, 1u, 3u}) table.give_back(number);
  std::vector<BodyId> expected;
  for (std::size_t before = 0; before < 6; ++before) expected.push_back(table.next_id(before));
  for (const BodyId id : expected) {
    EXPECT_FALSE(table.was_given_out(id));
    EXPECT_EQ(table.id_of(table.take()), id);
  }
}

TEST(BodyTable, AFreedNumberKeepsNothingButItsHistory) {
  BodyTable table;
  const std::uint32_t number = table.take();
  table[number].radius = 3.0;
  table[number].revision = 17;
  table[number].solid = false;
  table.give_back(number);
  ASSERT_EQ(table.take(), number);
  EXPECT_EQ(table[number].radius, 0.0);
  EXPECT_TRUE(table[number].solid);
  EXPECT_EQ(table[number].revision, 17u) << "certificates of the earlier body stay invalid";
  EXPECT_EQ(table[number].generation, 1u);
}

TEST(BodyTable, CountsBodiesThatArePresent) {
  BodyTable table;
  for (int body = 0; body < 4; ++body) (void)table.take();
  table[1].enabled = false;
  table.give_back(2);
  EXPECT_EQ(table.live_count(), 3u);
  EXPECT_EQ(table.present_count(), 2u);
}

TEST(BodyTable, NamesDefineTheOrder) {
  BodyTable table;
  const std::uint32_t first = table.take(70);
  const std::uint32_t second = table.take(20);
  EXPECT_EQ(table.names().size(), 2u);
  EXPECT_TRUE(table.comes_before(second, first));
  EXPECT_EQ(table.id_of(second).index, 20u);
  EXPECT_EQ(table.number_of(table.id_of(second)), second);
}

TEST(BodyTable, TablesHaveTagsOfTheirOwn) {
  const BodyTable one;
  const BodyTable other;
  EXPECT_NE(one.tag(), 0u);
  EXPECT_NE(one.tag(), other.tag());
  EXPECT_EQ(one.tagged({4, 2, 0}), (BodyId{4, 2, one.tag()}));
}

}  // namespace
}  // namespace kinesphere::body_table_test
