// Results: a value, or an error that value() throws.
#include "kinesphere/result.hpp"
#include "kinesphere/queries.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinesphere/world.hpp"

namespace kinesphere::result_test {
namespace {

template <class T>
void expect_throws(const Result<T>& result) {
  try {
    (void)result.value();
    FAIL() << "nothing was thrown";
  } catch (const BadResult& bad) {
    EXPECT_EQ(bad.what(), result.error().message);
    EXPECT_EQ(bad.error().code, result.error().code);
    EXPECT_EQ(bad.error().argument, result.error().argument);
  }
}

TEST(Result, ThatIsAnErrorThrowsItWhenAskedForItsValue) {
  World world = World::create({}).value();
  expect_throws(world.add({.radius = -1}));
  expect_throws(world.remove(BodyId{3, 0}));
  expect_throws(world.user_data({3, 0}));
  expect_throws(World::create({.contact_tolerance = 0}));
  EXPECT_THROW((void)*world.add({.radius = -1}), BadResult);
  EXPECT_THROW((void)world.body({3, 0})->enabled, BadResult);
}

TEST(Result, ThatIsAValueGivesIt) {
  World world = World::create({}).value();
  Result<BodyId> added = world.add({});
  ASSERT_TRUE(added);
  EXPECT_EQ(*added, (BodyId{0, 0}));
  EXPECT_EQ(added->index, 0u);
  EXPECT_NO_THROW(world.remove(added.value()).value());
}

TEST(Result, MayHaveAnotherValueInPlaceOfAnError) {
  World world = World::create({}).value();
  const Result<BodyId> added = world.add({}), refused = world.add({.radius = -1});
  EXPECT_TRUE(added.has_value());
  EXPECT_FALSE(refused.has_value());
  EXPECT_EQ(added.value_or(no_body), (BodyId{0, 0}));
  EXPECT_EQ(refused.value_or(no_body), no_body);
  EXPECT_EQ(world.user_data(no_body).value_or(7), 7u);
  EXPECT_EQ(world.body(no_body).has_value(), false);
  EXPECT_TRUE(world.remove(*added).has_value());
  EXPECT_FALSE(world.remove(*added).has_value());
}

TEST(Result, ThatIsTemporaryGivesItsValueAndNoReferenceIntoItself) {
  using Values = Result<std::vector<int>>;
  static_assert(std::is_same_v<decltype(*std::declval<Values>()), std::vector<int>>);
  static_assert(std::is_same_v<decltype(*std::declval<const Values>()), std::vector<int>>);
  static_assert(std::is_same_v<decltype(std::declval<Values>().value()), std::vector<int>>);
  static_assert(std::is_same_v<decltype(std::declval<const Values>().value()), std::vector<int>>);
  static_assert(std::is_same_v<decltype(std::declval<Values>().error()), Error>);
  static_assert(std::is_same_v<decltype(*std::declval<Values&>()), std::vector<int>&>);
  World world = World::create({}).value();
  world.add_all(std::vector<BodyDefinition>(3)).value();
  std::size_t found = 0;
  for (const OverlapHit& each : *world.queries().overlapping({0, 0, 0}, 100.0)) found += each.body.index + 1u;
  EXPECT_EQ(found, 6u);
}

TEST(Result, ThatIsASuccessHasNoError) {
  World world = World::create({}).value();
  EXPECT_THROW((void)Result<void>{}.error(), std::logic_error);
  EXPECT_THROW((void)world.add({}).error(), std::logic_error);
  const Result<void> made = world.change({0, 0}, {.user_data = 7});
  EXPECT_THROW((void)made.error(), std::logic_error);
}

TEST(ErrorCode, HasANameOfItsOwn) {
  std::set<std::string_view> names;
  for (int code = 0; code <= static_cast<int>(ErrorCode::diverged); ++code)
    EXPECT_TRUE(names.insert(name_of(static_cast<ErrorCode>(code))).second) << code;
  EXPECT_FALSE(names.contains(""));
  EXPECT_EQ(name_of(ErrorCode::not_finite), "not_finite");
  EXPECT_EQ(name_of(ErrorCode::moved_from), "moved_from");
}

}  // namespace
}  // namespace kinesphere::result_test
