// The state of a contact: what of it is remembered, and which bytes are one.
#include "contact/contact_state.hpp"

#include <gtest/gtest.h>

#include "support/read_back.hpp"

namespace kinesphere::contact_state_test {
namespace {

TEST(ContactState, HasAHistoryIfThereIsSomethingBesideTheApproach) {
  EXPECT_FALSE(ContactState{}.has_history());
  EXPECT_FALSE(ContactState{.approach = ApproachState::reported}.has_history());
  EXPECT_TRUE(ContactState{.jams = 1}.has_history());
  EXPECT_TRUE(ContactState{.guard_reported = true}.has_history());
}

TEST(ContactState, IsReadAsItWasWritten) {
  for (const auto approach :
       {ApproachState::watched, ApproachState::reported, ApproachState::turned, ApproachState::ignored}) {
    const ContactRecord record{9, {.approach = approach, .jams = 4, .guard_reported = true}};
    ContactRecord back{0};
    ASSERT_TRUE(read_back(record, back));
    EXPECT_EQ(back, record);
    EXPECT_TRUE(back.state.is_valid());
  }
  EXPECT_FALSE(ContactState{.approach = static_cast<ApproachState>(4)}.is_valid()) << "of damaged bytes";
}

}  // namespace
}  // namespace kinesphere::contact_state_test
