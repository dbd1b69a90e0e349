// Which bodies a rank knows, by name and by number, and what becomes of links to those that it does not know.
#include "distributed/roster.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "distributed/dangling_links.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::roster_test {
namespace {

constexpr int here = 2;

std::vector<std::uint32_t> sorted_copies(const Roster& roster) {
  std::vector<std::uint32_t> copies(roster.copies().begin(), roster.copies().end());
  std::sort(copies.begin(), copies.end());
  return copies;
}

TEST(Roster, FindsBodiesByName) {
  Roster roster(here);
  EXPECT_TRUE(roster.empty());
  roster.add(700, 0, here);
  roster.add(20, 3, 1);
  EXPECT_EQ(roster.find(700), 0u);
  EXPECT_EQ(roster.find(20), 3u);
  EXPECT_EQ(roster.find(0), std::nullopt);
  EXPECT_TRUE(roster.is_own(0));
  EXPECT_FALSE(roster.is_own(3));
  EXPECT_EQ(roster[3].owner, 1);
  EXPECT_EQ(roster.own_count(), 1u);
  roster.remove(700, 0);
  EXPECT_EQ(roster.find(700), std::nullopt);
  EXPECT_EQ(roster.own_count(), 0u);
}

TEST(Roster, TakesEachHolderOnce) {
  Roster roster(here);
  roster.add(5, 0, here);
  EXPECT_TRUE(roster.add_holder(0, 4));
  EXPECT_TRUE(roster.add_holder(0, 1));
  EXPECT_FALSE(roster.add_holder(0, 4));
  EXPECT_EQ(roster[0].holders, (std::vector<int>{4, 1}));
}

/// A number that is given back goes to another body, which has nothing of the one before.
TEST(Roster, ForgetsWhatItRemoves) {
  Roster roster(here);
  roster.add(5, 0, here);
  roster.add_holder(0, 4);
  roster[0].cost = 3.0f;
  roster.remove(5, 0);
  roster.add(6, 0, 1);
  EXPECT_FALSE(roster.is_held(0, 4));
  EXPECT_EQ(roster[0].cost, 0.0f);
  EXPECT_FALSE(roster.is_own(0));
}

TEST(Roster, KeepsListOfCopies) {
  Random random = Random::at(1, 0, 0);
  Roster roster(here);
  std::set<std::uint32_t> known;
  std::set<std::uint32_t> copies;
  for (int step = 0; step < 5000; ++step) {
    const auto number = static_cast<std::uint32_t>(random.bits() % 50);
    const std::uint32_t name = 1000 - number;
    if (known.erase(number) > 0) {
      roster.remove(name, number);
      copies.erase(number);
    } else {
      const int owner = static_cast<int>(random.bits() % 4);
      roster.add(name, number, owner);
      known.insert(number);
      if (owner != here) copies.insert(number);
    }
    ASSERT_EQ(sorted_copies(roster), std::vector<std::uint32_t>(copies.begin(), copies.end()));
    ASSERT_EQ(roster.own_count(), known.size() - copies.size());
    for (const std::uint32_t one : known) ASSERT_EQ(roster.are_copies()[one], copies.count(one));
  }
}

TEST(DanglingLinks, AreThereUntilPartnersCome) {
  DanglingLinks links;
  EXPECT_EQ(links.of(1), nullptr);
  links.add_partner(1, 10);
  links.add_partner(1, 11);
  links.add_crossing(1, {10, 0.5, Senses::first});
  ASSERT_NE(links.of(1), nullptr);
  EXPECT_EQ(links.of(1)->partners, (std::vector<std::uint32_t>{10, 11}));
  links.remove(1, 10);
  ASSERT_NE(links.of(1), nullptr);
  EXPECT_EQ(links.of(1)->partners, std::vector<std::uint32_t>{11});
  EXPECT_TRUE(links.of(1)->crossings.empty());
  links.remove(1, 11);
  EXPECT_EQ(links.of(1), nullptr);
}

TEST(DanglingLinks, AreReplacedAndForgotten) {
  DanglingLinks links;
  links.add_partner(1, 10);
  links.set(1, {.partners = {12}});
  EXPECT_EQ(links.of(1)->partners, std::vector<std::uint32_t>{12});
  links.set(1, {});
  EXPECT_EQ(links.of(1), nullptr);
  links.add_partner(1, 10);
  links.remove(1);
  EXPECT_EQ(links.of(1), nullptr);
}

}  // namespace
}  // namespace kinesphere::roster_test
