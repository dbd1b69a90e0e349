// Which bodies may meet.
#include "bodies/filters.hpp"

#include <gtest/gtest.h>

namespace kinesphere::filters_test {
namespace {

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

}  // namespace
}  // namespace kinesphere::filters_test
