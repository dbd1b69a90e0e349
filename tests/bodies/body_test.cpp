// The record of one body: what follows from its fields.
#include "bodies/body.hpp"

#include <gtest/gtest.h>

#include "archive/fields.hpp"
#include "support/read_back.hpp"

namespace kinesphere::body_test {
namespace {

Body ball() {
  Body body;
  body.alive = true;
  body.bound = {.time = 2.0, .velocity = {1, 0, 0}, .radius = 1.0, .acceleration_limit = 0.5};
  return body;
}

TEST(Body, IsFreshAtTheTimeOfItsReportOrWhereItRests) {
  Body body = ball();
  EXPECT_TRUE(body.fresh(2.0));
  EXPECT_FALSE(body.fresh(3.0));
  body.sleep_number = 0;
  EXPECT_TRUE(body.fresh(3.0)) << "it sleeps";
  body.change_number = 0;
  EXPECT_FALSE(body.fresh(3.0)) << "it has changed since";
  body = ball();
  body.shape_number = 0;
  EXPECT_TRUE(body.is_static());
  EXPECT_TRUE(body.fresh(3.0));
  body.carries_shape = true;
  EXPECT_FALSE(body.is_static());
  EXPECT_TRUE(body.has_shape());
  body.carries_shape = false;
  body.is_rigid = true;
  EXPECT_TRUE(body.is_shaped());
  EXPECT_FALSE(body.has_shape() || body.is_static());
}

TEST(Body, StandsStillWithoutMotionAndGrowth) {
  Body body = ball();
  EXPECT_FALSE(body.stands_still());
  body.stand_still();
  EXPECT_TRUE(body.stands_still());
  EXPECT_EQ(body.bound.radius, 1.0);
  body.bound.growth_speed = 1e-300;
  EXPECT_FALSE(body.stands_still());
}

TEST(Body, IsPresentIfItLivesAndIsEnabled) {
  Body body = ball();
  EXPECT_TRUE(body.present());
  body.enabled = false;
  EXPECT_FALSE(body.present());
  EXPECT_FALSE(Body{}.present());
}

TEST(Body, AcceleratesByItsLimitAndItsPlan) {
  Body body = ball();
  body.bound.planned_acceleration = {3, 0, 4};
  EXPECT_EQ(body.largest_acceleration(), 5.5);
}

TEST(Body, HasTheTraitsThatEventsSay) {
  Body body = ball();
  EXPECT_EQ(traits_of(body), BodyTraits{});
  body.solid = false;
  body.sleep_number = 3;
  EXPECT_EQ(traits_of(body), (BodyTraits{.is_static = false, .is_zone = true, .is_sleeping = true}));
}

TEST(Body, IsReadAsItWasWritten) {
  Body body = ball();
  body.revision = 7;
  body.contact_events = ContactEvents::impacts;
  body.user_data = 99;
  Body back;
  ASSERT_TRUE(read_back(body, back));
  EXPECT_EQ(back.bound, body.bound);
  EXPECT_EQ(back.revision, 7u);
  EXPECT_EQ(back.user_data, 99u);
  EXPECT_EQ(back.contact_events, ContactEvents::impacts);
}

}  // namespace
}  // namespace kinesphere::body_test
