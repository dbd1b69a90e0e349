// A table of swept spheres: each has a slot until the table is filled anew; removed ones leave free slots.
#include "broadphase/swept_sphere_table.hpp"

#include <gtest/gtest.h>

namespace kinesphere::swept_sphere_table_test {
namespace {

SweptSphere capsule(float x) { return {{x, 2.0f * x, 3.0f}, {0.5f, -x, 0.0f}, 0.25f}; }

TEST(SweptSphereTable, KeepsPlacesWhileBodiesComeAndGo) {
  SweptSphereTable table;
  for (std::uint32_t number = 0; number < 5; ++number)
    EXPECT_EQ(table.add(10 + number, capsule(static_cast<float>(number))), number);
  table.replace(1, capsule(7.0f));
  table.remove(3);
  EXPECT_EQ(table.slots(), 5u);
  EXPECT_EQ(table.bodies(), 4u);
  EXPECT_EQ(table.free_slots(), 1u);
  EXPECT_EQ(table.number_at(1), 11u);
  EXPECT_EQ(table.swept_sphere_at(1), capsule(7.0f));
  EXPECT_EQ(table.number_at(3), SweptSphereTable::free_slot);
  EXPECT_EQ(table.swept_sphere_at(4), capsule(4.0f));
  EXPECT_TRUE(table.is_valid());
  const UnsortedSweptSpheres all = table.all();
  EXPECT_EQ(all.numbers, (std::vector<std::uint32_t>{10, 11, 12, 14}));
  EXPECT_EQ(all.spheres[3], capsule(4.0f));
}

TEST(SweptSphereTable, HasNoHolesOnceItIsFilledAnew) {
  SweptSphereTable table;
  for (std::uint32_t number = 0; number < 40; ++number) table.add(number, capsule(0.0f));
  table.remove(3);
  table.resize(20, 4);
  for (std::uint32_t place = 0; place < 20; ++place)
    table.fill(place, 100 - place, capsule(static_cast<float>(place)));
  EXPECT_TRUE(table.is_valid());
  EXPECT_EQ(table.bodies(), 20u);
  EXPECT_EQ(table.number_at(3), 97u);
  const SweptSphereColumns columns = table.columns();
  EXPECT_EQ(columns[1][19], 38.0f);
  for (std::uint32_t number = 0; number < 4; ++number) table.add(number, capsule(1.0f));
  EXPECT_EQ(table.columns(), columns) << "there is room for so many more";
  table.clear();
  EXPECT_EQ(table.slots(), 0u);
  EXPECT_TRUE(table.is_valid());
}

TEST(SweptSphereTable, GivesFreeSlotsToOthers) {
  SweptSphereTable table;
  table.resize(3, 0);
  table.fill(0, 10, capsule(1.0f));
  table.leave_free(1);
  table.fill(2, 12, capsule(2.0f));
  EXPECT_TRUE(table.is_valid());
  EXPECT_EQ(table.bodies(), 2u);
  EXPECT_EQ(table.free_slots(), 1u);
  table.occupy(1, 11, capsule(3.0f));
  EXPECT_TRUE(table.is_valid());
  EXPECT_EQ(table.free_slots(), 0u);
  EXPECT_EQ(table.number_at(1), 11u);
  EXPECT_EQ(table.swept_sphere_at(1), capsule(3.0f));
  EXPECT_EQ(table.all().numbers, (std::vector<std::uint32_t>{10, 11, 12}));
}

TEST(SweptSphereTable, HolesAreNearNobody) {
  SweptSphereTable table;
  table.add(0, capsule(1.0f));
  table.add(1, capsule(1.0f));
  table.remove(0);
  SweptSphereSearches searches;
  searches.queries.push_back({capsule(1.0f), 0.0f, 1.0f});
  searches.ranges.push_back({0, table.slots()});
  searches.make(table.columns());
  std::vector<std::uint32_t> found;
  searches.for_each_found([&](std::uint32_t, std::uint32_t place) { found.push_back(place); });
  EXPECT_EQ(found, std::vector<std::uint32_t>{1});
}

}  // namespace
}  // namespace kinesphere::swept_sphere_table_test
