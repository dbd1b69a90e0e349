// The list of bodies to recertify.
#include "processor/dirty_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace kinesphere::dirty_list_test {
namespace {

using Numbers = std::vector<std::uint32_t>;

class DirtyListTest : public testing::Test {
 protected:
  DirtyListTest() {
    for (int body = 0; body < 6; ++body) bodies_.add({.radius = 1.0}, 0.0);
    for (const std::uint32_t number : {4u, 1u, 4u, 5u, 2u, 1u}) list_.add(bodies_, number);
  }

  Bodies bodies_{WorldDefinition{}};
  DirtyList list_;
};

TEST_F(DirtyListTest, HasEachBodyOnceInOrder) {
  EXPECT_EQ(list_.numbers(), (Numbers{4, 1, 5, 2}));
  for (const std::uint32_t number : {1u, 2u, 4u, 5u}) EXPECT_TRUE(bodies_[number].dirty);
  EXPECT_FALSE(bodies_[0].dirty || bodies_[3].dirty);
}

TEST_F(DirtyListTest, SortsAndDropsBodiesThatAreClean) {
  list_.forget(bodies_[5]);
  EXPECT_EQ(list_.sort(bodies_), (Numbers{1, 2, 4}));
  list_.add(bodies_, 5);
  list_.add(bodies_, 0);
  EXPECT_EQ(list_.sort(bodies_), (Numbers{0, 1, 2, 4, 5}));
}

TEST_F(DirtyListTest, ABodyThatBecameCleanAndDirtyAgainIsSortedOnce) {
  list_.forget(bodies_[4]);
  list_.add(bodies_, 4);
  EXPECT_EQ(list_.numbers(), (Numbers{4, 1, 5, 2, 4}));
  EXPECT_EQ(list_.sort(bodies_), (Numbers{1, 2, 4, 5}));
}

TEST_F(DirtyListTest, BodiesThatTurnAloneHaveNotMoved) {
  list_.add(bodies_, 3, true);
  list_.add(bodies_, 1, true);  // it has moved before
  EXPECT_TRUE(bodies_[3].turned && !bodies_[1].turned);
  EXPECT_TRUE(std::ranges::equal(list_.moved(), Numbers{4, 1, 5, 2}));
  list_.add(bodies_, 3, true);
  EXPECT_TRUE(bodies_[3].turned);
  list_.add(bodies_, 3);
  list_.add(bodies_, 3, true);
  EXPECT_FALSE(bodies_[3].turned);
  EXPECT_TRUE(std::ranges::equal(list_.moved(), Numbers{4, 1, 5, 2, 3}));
}

}  // namespace
}  // namespace kinesphere::dirty_list_test
