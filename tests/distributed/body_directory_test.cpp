// The bodies that a rank knows, by name and by number, and links to bodies that it does not know.
#include "distributed/body_directory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "distributed/pending_links.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::body_directory_test {
namespace {

constexpr int here = 2;

std::vector<std::uint32_t> sorted_copies(const BodyDirectory& directory) {
  std::vector<std::uint32_t> copies(directory.ghosts().begin(), directory.ghosts().end());
  std::sort(copies.begin(), copies.end());
  return copies;
}

TEST(BodyDirectory, FindsBodiesByName) {
  BodyDirectory directory(here);
  EXPECT_TRUE(directory.empty());
  directory.add(700, 0, here);
  directory.add(20, 3, 1);
  EXPECT_EQ(directory.find(700), 0u);
  EXPECT_EQ(directory.find(20), 3u);
  EXPECT_EQ(directory.find(0), std::nullopt);
  EXPECT_TRUE(directory.is_own(0));
  EXPECT_FALSE(directory.is_own(3));
  EXPECT_EQ(directory[3].owner, 1);
  EXPECT_EQ(directory.own_count(), 1u);
  directory.remove(700, 0);
  EXPECT_EQ(directory.find(700), std::nullopt);
  EXPECT_EQ(directory.own_count(), 0u);
}

TEST(BodyDirectory, TakesEachHolderOnce) {
  BodyDirectory directory(here);
  directory.add(5, 0, here);
  EXPECT_TRUE(directory.add_holder(0, 4));
  EXPECT_TRUE(directory.add_holder(0, 1));
  EXPECT_FALSE(directory.add_holder(0, 4));
  EXPECT_EQ(directory[0].holders, (std::vector<int>{4, 1}));
}

/// A freed number goes to another body, without state of the one before.
TEST(BodyDirectory, ForgetsWhatItRemoves) {
  BodyDirectory directory(here);
  directory.add(5, 0, here);
  directory.add_holder(0, 4);
  directory[0].cost = 3.0f;
  directory.remove(5, 0);
  directory.add(6, 0, 1);
  EXPECT_FALSE(directory.is_held(0, 4));
  EXPECT_EQ(directory[0].cost, 0.0f);
  EXPECT_FALSE(directory.is_own(0));
}

TEST(BodyDirectory, KeepsListOfCopies) {
  Random random = Random::at(1, 0, 0);
  BodyDirectory directory(here);
  std::set<std::uint32_t> known;
  std::set<std::uint32_t> copies;
  for (int step = 0; step < 5000; ++step) {
    const auto number = static_cast<std::uint32_t>(random.bits() % 50);
    const std::uint32_t name = 1000 - number;
    if (known.erase(number) > 0) {
      directory.remove(name, number);
      copies.erase(number);
    } else {
      const int owner = static_cast<int>(random.bits() % 4);
      directory.add(name, number, owner);
      known.insert(number);
      if (owner != here) copies.insert(number);
    }
    ASSERT_EQ(sorted_copies(directory), std::vector<std::uint32_t>(copies.begin(), copies.end()));
    ASSERT_EQ(directory.own_count(), known.size() - copies.size());
    for (const std::uint32_t one : known) ASSERT_EQ(directory.are_ghosts()[one], copies.count(one));
  }
}

TEST(PendingLinks, AreThereUntilPartnersCome) {
  PendingLinks links;
  EXPECT_EQ(links.of(1), nullptr);
  links.add_partner(1, {10});
  links.add_partner(1, {11});
  links.add_overlap(1, {10, 0.5, Senses::first});
  ASSERT_NE(links.of(1), nullptr);
  EXPECT_EQ(links.of(1)->partners, (std::vector<ContactRecord>{{10}, {11}}));
  links.remove(1, 10);
  ASSERT_NE(links.of(1), nullptr);
  EXPECT_EQ(links.of(1)->partners, (std::vector<ContactRecord>{{11}}));
  EXPECT_TRUE(links.of(1)->overlaps.empty());
  links.remove(1, 11);
  EXPECT_EQ(links.of(1), nullptr);
}

TEST(PendingLinks, AreReplacedAndForgotten) {
  PendingLinks links;
  links.add_partner(1, {10});
  links.set(1, {.partners = {{12}}});
  EXPECT_EQ(links.of(1)->partners, (std::vector<ContactRecord>{{12}}));
  links.set(1, {});
  EXPECT_EQ(links.of(1), nullptr);
  links.add_partner(1, {10});
  links.remove(1);
  EXPECT_EQ(links.of(1), nullptr);
}

}  // namespace
}  // namespace kinesphere::body_directory_test
