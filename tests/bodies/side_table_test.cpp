// A side table of bodies, against a map from the number of a body to its record.
#include "bodies/side_table.hpp"

#include <gtest/gtest.h>

#include <map>

#include "bodies/body_table.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::side_table_test {
namespace {

constexpr std::uint64_t seed = 5102;

std::uint32_t draw(Random& random, std::uint32_t below) {
  return static_cast<std::uint32_t>(random.uniform() * below);
}

TEST(SideTable, HasTheRecordsOfAMap) {
  SCOPED_TRACE(seed);
  constexpr std::uint32_t count = 40;
  Random random = Random::at(seed, 0, 0);
  BodyTable bodies;
  for (std::uint32_t number = 0; number < count; ++number) (void)bodies.take();
  SleepRecords table;
  std::map<std::uint32_t, double> expected;
  for (int step = 0; step < 3000; ++step) {
    const std::uint32_t number = draw(random, count);
    if (expected.contains(number)) {
      if (random.uniform() < 0.3) {
        table[bodies[number]].limits.acceleration_limit = expected[number] = random.uniform();
      } else {
        table.remove(bodies, number);
        expected.erase(number);
      }
    } else if (random.uniform() < 0.5) {
      expected[number] = random.uniform();
      table.add(bodies[number], number).limits.acceleration_limit = expected[number];
    } else {
      table.remove(bodies, number);  // nothing to remove
    }
    ASSERT_EQ(table.empty(), expected.empty());
    ASSERT_TRUE(table.is_valid(bodies));
    for (std::uint32_t body = 0; body < count; ++body) {
      const SleepRecord* const found = table.find(bodies[body]);
      ASSERT_EQ(found != nullptr, expected.contains(body)) << step << ' ' << body;
      if (found == nullptr) continue;
      ASSERT_EQ(found->body, body);
      ASSERT_EQ(found->limits.acceleration_limit, expected[body]);
    }
  }
}

TEST(SideTable, SeesRecordsThatNoBodyHas) {
  BodyTable bodies;
  for (int body = 0; body < 3; ++body) (void)bodies.take();
  SleepRecords table;
  table.add(bodies[1], 1);
  EXPECT_TRUE(table.is_valid(bodies));
  bodies[2].sleep_number = 0;
  EXPECT_FALSE(table.is_valid(bodies)) << "two bodies with one record";
  bodies[2].sleep_number = Body::none;
  table[bodies[1]].body = 9;
  EXPECT_FALSE(table.is_valid(bodies)) << "a record of no body";
}

}  // namespace
}  // namespace kinesphere::side_table_test
