// The state of a contact: what of it is remembered, and which bytes are one. What a contact graph stores
// about a body can be moved to another graph.
#include "contact/contact_state.hpp"

#include <gtest/gtest.h>

#include "contact/contacts_of_body.hpp"
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

TEST(ContactsOfBody, AreTheSameInAnotherGraph) {
  const WorldDefinition definition;
  ContactGraph graph(definition), other(definition);
  for (std::uint32_t body = 0; body < 3; ++body) graph.add(body, 0.0), other.add(body, 0.0);
  graph.set_touching({.kind = EventKind::wall_begin, .first = {0, 0}, .wall = Wall::x_lower}, true);
  graph.set_touching({.kind = EventKind::contact_begin, .first = {0, 0}, .second = {1, 0}}, true);
  graph.set_touching({.kind = EventKind::sensor_enter, .first = {0, 0}, .second = {2, 0}, .distance = 2.0},
                     true);
  const ContactsOfBody contacts = ContactsOfBody::of(graph, 0);
  contacts.set(other, 0);
  EXPECT_TRUE(other.touches_wall(0, Wall::x_lower));
  EXPECT_TRUE(other.partners_of(0).empty()) << "the others are not told";
  other.set_links(0, contacts.partners.all(), contacts.overlaps);
  EXPECT_TRUE(other.touch(1, 0));
  ASSERT_EQ(other.overlaps_of(2).size(), 1u);
  EXPECT_EQ(other.overlaps_of(0, 2).front().distance, 2.0);
  EXPECT_TRUE(other.is_valid(3, Box{{-1, -1, -1}, {1, 1, 1}}));
}

}  // namespace
}  // namespace kinesphere::contact_state_test
