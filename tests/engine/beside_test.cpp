// What an island notes about its bodies for others.
#include "engine/beside.hpp"

#include <gtest/gtest.h>

namespace kinesphere::beside_test {
namespace {

TEST(Beside, TellsReportsAndRenewalsFromKicks) {
  Sea sea;
  sea.places = {{.island = 0, .kept = 0}};
  sea.kept.resize(1);
  sea.kept[0].body.body.stamp = 5;
  sea.is_kept = {1};
  Beside beside;
  beside.begin(sea, 0);
  const Since& at_first = sea.kept[0].since;
  EXPECT_EQ(at_first.change, infinity);

  beside.note_change(0, 1.5);
  EXPECT_EQ(at_first.change, 1.5);
  // The window of the body ends; what is known of it stays.
  beside.add({.number = 0, .stamp = 5, .time = 2.0});
  EXPECT_EQ(at_first.change, 1.5);
  EXPECT_EQ(at_first.kick, infinity);
  const auto since_kick = [&](std::size_t k) { return beside.kicks.all()[k].since; };
  EXPECT_EQ(since_kick(0).change, infinity);

  beside.add({.number = 0, .stamp = 6, .time = 3.0});
  EXPECT_EQ(at_first.kick, infinity);
  EXPECT_EQ(since_kick(0).change, 3.0);
  EXPECT_EQ(since_kick(0).kick, 3.0);
  EXPECT_EQ(since_kick(1).change, infinity);
  beside.note_change(0, 4.0);
  beside.note_change(0, 5.0);
  EXPECT_EQ(since_kick(1).change, 4.0);
  EXPECT_EQ(since_kick(1).kick, infinity);
}

TEST(Beside, SeesBodiesOfOtherIslandsAsThePartBegan) {
  Sea sea;
  sea.places = {{.island = 0, .kept = 0}, {.island = 1, .kept = 1}, {.island = 2, .kept = 2}, {}};
  sea.kept.resize(3);
  sea.is_kept = {1, 1, 0};
  Beside beside;
  beside.begin(sea, 0);
  EXPECT_EQ(beside.as_it_began(0), nullptr);
  EXPECT_EQ(beside.as_it_began(1), &sea.kept[1]);
  // Nobody changes these.
  EXPECT_EQ(beside.as_it_began(2), nullptr);
  EXPECT_EQ(beside.as_it_began(3), nullptr);
}

}  // namespace
}  // namespace kinesphere::beside_test
