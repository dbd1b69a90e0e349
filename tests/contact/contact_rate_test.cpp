// Contacts that follow each other: repeated within an interval, jammed at one instant.
#include "contact/contact_rate.hpp"

#include <gtest/gtest.h>

#include <array>

#include "support/read_back.hpp"

namespace kinesphere::contact_rate_test {
namespace {

class ContactRateTest : public ::testing::Test {
 protected:
  ContactRateTest() {
    recent.add(0, 1.0);
    recent.add(1, 0.0);
    recent.add(2, 1.0);
  }

  ContactRate recent;
  const std::array<std::uint32_t, 2> both{0, 1};
  const std::array<std::uint32_t, 2> others{1, 2};
  const std::array<std::uint32_t, 1> alone{0};
};

TEST_F(ContactRateTest, RepeatWithinTheIntervalOfOneOfTheTwo) {
  EXPECT_FALSE(recent.note(both, 5.0).repeated) << "the first one";
  EXPECT_FALSE(recent.note(others, 5.5).repeated) << "the interval of the one that has just touched is zero";
  EXPECT_TRUE(recent.note(alone, 5.75).repeated);
  EXPECT_FALSE(recent.note(alone, 6.75).repeated) << "the interval has passed";
  recent.set_zeno_interval(0, 10.0);
  EXPECT_TRUE(recent.note(both, 16.0).repeated);
}

TEST_F(ContactRateTest, JamWhereEachHasHadManyAtOneInstant) {
  int unmarked = 0;
  for (; !recent.note(both, 5.0).jammed; ++unmarked) ASSERT_LT(unmarked, 1000);
  EXPECT_EQ(unmarked, 64);
  EXPECT_FALSE(recent.note(others, 5.0).jammed) << "one of the two has had few";
  EXPECT_FALSE(recent.is_jammed(both, 5.0));
  for (int more = 0; more < 256; ++more) recent.note(both, 5.0);
  EXPECT_TRUE(recent.is_jammed(both, 5.0));
  EXPECT_FALSE(recent.is_jammed(others, 5.0));
  EXPECT_FALSE(recent.is_jammed(both, 5.5)) << "time has moved on";
  EXPECT_FALSE(recent.note(both, 5.5).jammed);
  EXPECT_FALSE(recent.is_jammed(both, 5.0)) << "at an instant that is over";
}

TEST_F(ContactRateTest, CrushWhomManyMeetAtEachOfManyInstants) {
  const auto fill = [&](double time, int contacts) {
    for (int k = 0; k < contacts; ++k) recent.note(alone, time);
  };
  double time = 0.0;
  const auto crush = [&] {
    int instants = 0;
    for (; !recent.is_crushed(alone) && instants < 1000; ++instants) fill(time += 0.5, 256);
    return instants;
  };
  EXPECT_EQ(crush(), 65) << "the last one is not over";
  EXPECT_FALSE(recent.is_crushed(both)) << "the other is not";
  recent.end_crush(alone);
  EXPECT_FALSE(recent.is_crushed(alone));
  for (int k = 0; k < 60; ++k) fill(time += 0.5, 256);
  fill(time += 0.5, 255);
  EXPECT_EQ(crush(), 65) << "not in a row";
  ContactRate::Body counted = recent.of(0);
  ++counted.full_instants;
  recent.restore(0, counted);
  EXPECT_FALSE(recent.is_valid());
}

TEST_F(ContactRateTest, GoOnAsBeforeWhenPutBackOrRead) {
  recent.note(both, 5.0);
  const ContactRate::Body checkpoint = recent.of(0);
  ContactRate back;
  ASSERT_TRUE(read_back(recent, back));
  EXPECT_EQ(back.size(), 3u);
  EXPECT_TRUE(back.is_valid());
  EXPECT_TRUE(back.note(alone, 5.5).repeated);
  EXPECT_FALSE(recent.note(alone, 8.0).repeated);
  recent.restore(0, checkpoint);
  EXPECT_TRUE(recent.note(alone, 5.5).repeated);
  recent.set_zeno_interval(0, -1.0);
  EXPECT_FALSE(recent.is_valid());
}

}  // namespace
}  // namespace kinesphere::contact_rate_test
