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

  /// A begin without acceleration, whose mark depends on the least interval only.
  ContactRate::Marks note(std::span<const std::uint32_t> bodies, double time) {
    return recent.note(bodies, {time, 0.1, 0.0}, rule);
  }

  ContactRate recent;
  const ContactRule rule{WorldDefinition{.contact_tolerance = 0x1p-8, .zeno_interval = 1.0}};
  const std::array<std::uint32_t, 2> both{0, 1};
  const std::array<std::uint32_t, 2> others{1, 2};
  const std::array<std::uint32_t, 1> alone{0};
};

TEST_F(ContactRateTest, RepeatWithinTheIntervalOfOneOfTheTwo) {
  EXPECT_FALSE(note(both, 5.0).repeated) << "the first one";
  EXPECT_FALSE(note(others, 5.5).repeated) << "the interval of the one that has just touched is zero";
  EXPECT_TRUE(note(alone, 5.75).repeated);
  EXPECT_FALSE(note(alone, 6.75).repeated) << "the interval has passed";
}

// The Zeno speed of acceleration 1 is a quarter.
TEST_F(ContactRateTest, RepeatSlowContactsOfBodiesThatArePressedUponEachOther) {
  for (const std::uint32_t body : {0u, 1u, 2u}) recent.set_zeno_interval(body, 10.0);
  const auto is_repeated = [&](std::span<const std::uint32_t> bodies, const ContactRate::Begin& begin) {
    return recent.note(bodies, begin, rule).repeated;
  };
  EXPECT_FALSE(is_repeated(alone, {5.0, 0.2, 1.0})) << "the first one";
  EXPECT_TRUE(is_repeated(alone, {7.0, 0.2, 1.0}));
  EXPECT_FALSE(is_repeated(alone, {9.0, 0.3, 1.0})) << "too fast for a hop within the tolerance";
  EXPECT_TRUE(is_repeated(alone, {9.5, 0.3, 1.0})) << "within the least interval of the rule";
  EXPECT_FALSE(is_repeated(alone, {20.0, 0.2, 1.0})) << "the interval of the body has passed";
  // The ground carries body 0, and body 0 carries body 1, which accelerates as it does.
  EXPECT_TRUE(is_repeated(both, {22.0, 0.2, 0.0}));
  EXPECT_TRUE(is_repeated(others, {24.0, 0.2, 0.0}));
  EXPECT_FALSE(is_repeated(others, {26.0, 0.3, 0.0})) << "too fast";
  EXPECT_TRUE(is_repeated(others, {28.0, 0.2, 0.0}));
  EXPECT_TRUE(is_repeated(others, {28.0, 0.3, 0.0})) << "at the same instant";
  EXPECT_FALSE(is_repeated(others, {40.0, 0.2, 0.0})) << "the intervals of both have passed";
  EXPECT_FALSE(is_repeated(others, {41.0, 0.2, 0.0})) << "nothing presses them since";
}

TEST_F(ContactRateTest, RepeatNoContactOfBodiesThatOnlyFallTogether) {
  for (const std::uint32_t body : {0u, 1u}) recent.set_zeno_interval(body, 10.0);
  for (int k = 0; k < 20; ++k)
    EXPECT_FALSE(recent.note(both, {5.0 + 2.0 * k, k % 2 == 0 ? 1e-9 : -1e-9, 0.0}, rule).repeated) << k;
}

TEST_F(ContactRateTest, JamWhereEachHasHadManyAtOneInstant) {
  int unmarked = 0;
  for (; !note(both, 5.0).jammed; ++unmarked) ASSERT_LT(unmarked, 1000);
  EXPECT_EQ(unmarked, 64);
  EXPECT_FALSE(note(others, 5.0).jammed) << "one of the two has had few";
  EXPECT_FALSE(recent.is_jammed(both, 5.0));
  for (int more = 0; more < 256; ++more) note(both, 5.0);
  EXPECT_TRUE(recent.is_jammed(both, 5.0));
  EXPECT_FALSE(recent.is_jammed(others, 5.0));
  EXPECT_FALSE(recent.is_jammed(both, 5.5)) << "time has moved on";
  EXPECT_FALSE(note(both, 5.5).jammed);
  EXPECT_FALSE(recent.is_jammed(both, 5.0)) << "at an instant that is over";
}

TEST_F(ContactRateTest, CrushWhomManyMeetAtEachOfManyInstants) {
  const auto fill = [&](double time, int contacts) {
    for (int k = 0; k < contacts; ++k) note(alone, time);
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
  note(both, 5.0);
  const ContactRate::Body checkpoint = recent.of(0);
  ContactRate back;
  ASSERT_TRUE(read_back(recent, back));
  EXPECT_EQ(back.size(), 3u);
  EXPECT_TRUE(back.is_valid());
  EXPECT_TRUE(back.note(alone, {5.5, 0.1, 0.0}, rule).repeated);
  EXPECT_FALSE(note(alone, 8.0).repeated);
  recent.restore(0, checkpoint);
  EXPECT_TRUE(note(alone, 5.5).repeated);
  recent.set_zeno_interval(0, -1.0);
  EXPECT_FALSE(recent.is_valid());
}

}  // namespace
}  // namespace kinesphere::contact_rate_test
