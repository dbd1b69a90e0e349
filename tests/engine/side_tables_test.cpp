// The side tables of bodies, against a map from the number of a body to its record.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "engine/bodies.hpp"
#include "kinesphere/random.hpp"
#include "number/infinity.hpp"

namespace kinesphere::side_tables_test {
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
      table.add(bodies[number], {.body = number, .limits = {.acceleration_limit = expected[number]}});
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
  table.add(bodies[1], {.body = 1});
  EXPECT_TRUE(table.is_valid(bodies));
  bodies[2].sleep_number = 0;
  EXPECT_FALSE(table.is_valid(bodies)) << "two bodies with one record";
  bodies[2].sleep_number = Body::none;
  table[bodies[1]].body = 9;
  EXPECT_FALSE(table.is_valid(bodies)) << "a record of no body";
}

TEST(Masses, AreTheUsualOneUnlessKept) {
  Masses masses;
  EXPECT_EQ(masses.of(1000), BodyDefinition{}.mass);
  masses.keep(1000, BodyDefinition{}.mass);
  EXPECT_TRUE(masses.is_valid(0)) << "the usual mass takes no memory";
  masses.keep(7, 2.5);
  EXPECT_EQ(masses.of(7), 2.5);
  EXPECT_EQ(masses.of(6), BodyDefinition{}.mass);
  EXPECT_TRUE(masses.is_valid(8));
  EXPECT_FALSE(masses.is_valid(7));
  masses.keep(7, BodyDefinition{}.mass);
  EXPECT_EQ(masses.of(7), BodyDefinition{}.mass);
}

TEST(ChangingRadii, FollowTheirLaw) {
  const ChangingRadius grows{.rate = 0.5, .radius = 1.0, .time = 2.0, .is_kept = true};
  EXPECT_EQ(grows.at(2.0), 1.0);
  EXPECT_EQ(grows.at(6.0), 3.0);
  EXPECT_EQ(grows.rate_at(6.0), 0.5);
  const ChangingRadius shrinks{.rate = -0.5, .radius = 1.0, .time = 2.0, .is_kept = true};
  EXPECT_EQ(shrinks.end(), 4.0);
  EXPECT_EQ(shrinks.at(3.0), 0.5);
  EXPECT_EQ(shrinks.rate_at(3.0), -0.5);
  for (const double late : {4.0, 5.0, 1e300}) {
    EXPECT_EQ(shrinks.at(late), 0.0) << "never below a point";
    EXPECT_EQ(shrinks.rate_at(late), 0.0);
    EXPECT_TRUE(shrinks.is_point(late));
  }
}

TEST(ChangingRadii, HaveRecordsOfBodiesThatChangedOnly) {
  ChangingRadii radii;
  radii.keep(5, {});
  EXPECT_FALSE(radii.any()) << "a body whose radius never changes takes no memory";
  radii.keep(5, {.rate = 1.0, .radius = 2.0, .is_kept = true});
  ASSERT_NE(radii.find(5), nullptr);
  EXPECT_EQ(radii.find(4), nullptr);
  EXPECT_EQ(radii.find(6), nullptr);
  EXPECT_EQ(radii.of(5).radius, 2.0);
  EXPECT_EQ(radii.of(4).radius, 0.0);
  EXPECT_TRUE(radii.is_valid(6));
  EXPECT_FALSE(radii.is_valid(5));
  radii.keep(5, {});
  EXPECT_EQ(radii.find(5), nullptr) << "the number belongs to another body";
}

TEST(Filters, AnswerAsBothBodiesAndTheCallerSay) {
  Filters filters;
  EXPECT_FALSE(filters.any());
  const Filter one{.category = 1, .mask = 2};
  const Filter two{.category = 2, .mask = 1};
  const Filter three{.category = 4, .mask = ~0u};
  filters.keep(3, Filter{});
  EXPECT_FALSE(filters.any()) << "the default filter restricts nothing";
  filters.keep(3, one);
  EXPECT_TRUE(filters.any());
  EXPECT_EQ(filters.of(3), one);
  EXPECT_EQ(filters.of(2), Filter{});
  EXPECT_EQ(filters.of(4), Filter{});
  const BodyId a{3, 0, 1};
  const BodyId b{4, 0, 1};
  EXPECT_TRUE(filters.may_meet(a, one, b, two));
  EXPECT_FALSE(filters.may_meet(a, one, b, three)) << "both have to allow it";
  int asked = 0;
  filters.keep_pair_filter([&](BodyId, BodyId) {
    ++asked;
    EXPECT_TRUE(filters.is_filtering());
    return asked != 2;
  });
  EXPECT_FALSE(filters.is_filtering());
  EXPECT_FALSE(filters.may_meet(a, one, b, three));
  EXPECT_EQ(asked, 0) << "the caller is asked last";
  EXPECT_TRUE(filters.may_meet(a, one, b, two));
  EXPECT_FALSE(filters.may_meet(a, one, b, two));
  EXPECT_FALSE(filters.may_touch(a, {.filter = one, .solid = false}, b, {.filter = two}));
  EXPECT_EQ(asked, 2) << "zones touch nothing";
}

TEST(PeriodicImages, MovesPathsToThePrimaryBoxAndCounts) {
  SCOPED_TRACE(seed);
  const Box box{{-1.0, 2.0, 0.0}, {3.0, 5.0, 1.0}};
  const Vec3 period{4.0, 3.0, 0.0};
  const Bodies bodies({.box = box, .periodic = {.x = true, .y = true}});
  Random random = Random::at(seed, 1, 0);
  for (int part = 0; part < 1000; ++part) {
    PeriodicImage image;
    Vec3 stored = 50.0 * random.point_in_ball();
    Vec3 on_path = stored;
    for (int step = 0; step < 4; ++step) {
      const Vec3 half{0.5 * random.uniform(), 0.3 * random.uniform(), 0.2};
      stored -= image.wrap(bodies.space(), {stored - half, stored + half});
      ASSERT_TRUE(image.is_valid(bodies.space()));
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_NEAR(stored[axis], image.middle[axis], 1e-12);
        ASSERT_NEAR(stored[axis] + image.image[axis] * period[axis], on_path[axis], 1e-10);
        if (period[axis] == 0.0) continue;
        ASSERT_GE(image.middle[axis], box.lower[axis]);
        ASSERT_LT(image.middle[axis], box.upper[axis]);
      }
      const Vec3 move = 10.0 * random.point_in_ball();
      stored += move;
      on_path += move;
    }
  }
  PeriodicImage image;
  image.image.z = 1.0;
  EXPECT_FALSE(image.is_valid(bodies.space())) << "that axis does not repeat";
  image.image = {0.5, 0.0, 0.0};
  EXPECT_FALSE(image.is_valid(bodies.space())) << "half a period";
  image.image = {};
  image.middle.x = infinity;
  EXPECT_FALSE(image.is_valid(bodies.space()));
}

}  // namespace
}  // namespace kinesphere::side_tables_test
