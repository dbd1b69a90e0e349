// Results: a value, or an error that asking for the value throws.
#include "kinesphere/result.hpp"

#include <gtest/gtest.h>

#include "kinesphere/world.hpp"

namespace kinesphere {
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
  expect_throws(world.remove({3, 0}));
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

}  // namespace
}  // namespace kinesphere
