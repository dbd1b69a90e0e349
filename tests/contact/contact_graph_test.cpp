// The contact graph: delivery in order, the effect of a velocity change in between, and partners.
#include "contact/pending_events.hpp"

#include <gtest/gtest.h>

namespace kinesphere::contact_graph_test {
namespace {

/// Unit spheres on the x axis.
class ContactGraphTest : public ::testing::Test {
 protected:
  ContactGraphTest() {
    for (std::uint32_t body = 0; body < 3; ++body) book.add(body, 0.0);
  }

  Sphere sphere(std::uint32_t body) const {
    return {{body, 0}, 1.0, {{2.0 * body, 0, 0}, velocities[body]}, nullptr, false, 0, 1.0, {}, wanted};
  }

  Event begin(std::uint32_t a, std::uint32_t b) const {
    return contact_event(EventKind::contact_begin, 5.0, sphere(a), sphere(b));
  }

  std::optional<Event> deliver() {
    return instant.pop(
        book, [this](BodyId id) { return alive[id.index]; },
        [this](std::uint32_t body) { return sphere(body); }, [](const Event&) { return Senses::neither; },
        Box{{-1, -9, -9}, {9, 9, 9}});
  }

  /// Changes a velocity before the next event is delivered, as a response or the caller does.
  void kick(std::size_t body, const Vec3& velocity) {
    velocities[body] = velocity;
    instant.outdate();
  }

  ContactEvents wanted = ContactEvents::impacts;
  WorldDefinition definition{.zeno_interval = 1.0};
  ContactGraph book{definition};
  PendingEvents instant;
  Vec3 velocities[3] = {{1, 0, 0}, {0, 0, 0}, {-1, 0, 0}};
  bool alive[3] = {true, true, true};
};

TEST_F(ContactGraphTest, DeliversInOrderAndOnce) {
  instant.queue(begin(2, 1));
  instant.queue(begin(1, 0));
  instant.queue(begin(0, 1));
  const auto first = deliver();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->first.index, 0u);
  EXPECT_FALSE(first->repeated);
  EXPECT_TRUE(book.touch(0, 1) && book.touch(1, 0));
  EXPECT_FALSE(book.touch(1, 2));
  const auto second = deliver();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->second.index, 2u);
  EXPECT_TRUE(second->repeated) << "body 1 has just touched body 0";
  EXPECT_FALSE(deliver());
  EXPECT_EQ(instant.changed().size(), 2u);
}

TEST_F(ContactGraphTest, DropsWhatAKickHasTurnedApart) {
  instant.queue(begin(0, 1));
  kick(0, {-1, 0, 0});
  EXPECT_FALSE(deliver());
  EXPECT_FALSE(book.touch(0, 1));
}

TEST_F(ContactGraphTest, TellsTheNewestVelocity) {
  instant.queue(begin(0, 1));
  kick(0, {3, 0, 0});
  EXPECT_EQ(deliver()->approach_speed, 3.0);
}

TEST_F(ContactGraphTest, KeepsEndsOfTheRemovedButNotTheirBegins) {
  instant.queue(begin(0, 1));
  Event end = begin(1, 2);
  end.kind = EventKind::contact_end;
  instant.queue(end);
  alive[1] = false;
  const auto delivered = deliver();
  ASSERT_TRUE(delivered);
  EXPECT_EQ(delivered->kind, EventKind::contact_end);
  EXPECT_TRUE(instant.changed().empty());
}

TEST_F(ContactGraphTest, TellsAZenoGuardOncePerInstant) {
  Event guard = begin(0, 1);
  guard.kind = EventKind::zeno_guard;
  instant.queue(guard);
  EXPECT_TRUE(deliver());
  instant.queue(guard);
  EXPECT_FALSE(deliver());
  instant.start();
  instant.queue(guard);
  EXPECT_TRUE(deliver());
}

TEST_F(ContactGraphTest, ResponseThatPartsTheTwoMakesTheirNextApproachAnEvent) {
  for (const ContactEvents events :
       {ContactEvents::impacts, ContactEvents::begin_and_end, ContactEvents::all}) {
    wanted = events;
    velocities[0] = {1, 0, 0};
    instant.queue(begin(0, 1));
    EXPECT_FALSE(deliver()->already_touching);
    velocities[0] = {-1, 0, 0};
    EXPECT_FALSE(deliver()) << "takes note of the response";
    velocities[0] = {2, 0, 0};
    instant.queue(begin(0, 1));
    const auto again = deliver();
    ASSERT_TRUE(again);
    EXPECT_EQ(again->approach_speed, 2.0);
    EXPECT_EQ(again->already_touching, wants_ends(events));
    book.set_touching(begin(0, 1), false);
  }
}

TEST_F(ContactGraphTest, ResponseThatDoesNotPartTheTwoLetsThemThrough) {
  instant.queue(begin(0, 1));
  EXPECT_TRUE(deliver());
  // At least half of the approach is gone: what remains is another approach.
  velocities[0] = {0.5, 0, 0};
  book.turn_reported(0);
  instant.queue(begin(0, 1));
  EXPECT_TRUE(deliver());
  velocities[0] = {0.375, 0, 0};
  book.turn_reported(0);
  instant.queue(begin(0, 1));
  EXPECT_FALSE(deliver());
  EXPECT_EQ(contact_threshold(book.links_of(0, 1).contact, wanted).state.approach, ApproachState::reported);
}

TEST_F(ContactGraphTest, TurnsReportedApproachesOfABodyAndItsWalls) {
  velocities[0] = {-1, 0, 0};
  velocities[1] = {-2, 0, 0};
  instant.queue(wall_event(EventKind::wall_begin, 5.0, sphere(0), {{-1, -9, -9}, {9, 9, 9}}, Wall::x_lower));
  instant.queue(begin(0, 1));
  while (deliver()) {
  }
  EXPECT_EQ(book.wall_threshold(0, Wall::x_lower, wanted).state.approach, ApproachState::reported);
  book.turn_reported(0);
  EXPECT_EQ(book.wall_threshold(0, Wall::x_lower, wanted).state.approach, ApproachState::turned);
  EXPECT_EQ(contact_threshold(book.links_of(0, 1).contact, wanted).state.approach, ApproachState::turned);
  EXPECT_EQ(contact_threshold(book.links_of(1, 0).contact, wanted).state.approach, ApproachState::turned);
  EXPECT_TRUE(book.is_valid(3, Box{{-1, -9, -9}, {9, 9, 9}}));
}

TEST_F(ContactGraphTest, LetsAPairThroughIfResponsesGoOnAfterItWasMarkedAsJammed) {
  const Event event = begin(0, 1);
  const auto jam = [&](bool is_deep) {
    return book.note_jam(event, book.threshold_of(event, wanted), is_deep);
  };
  for (int k = 0; k < 20; ++k) EXPECT_FALSE(jam(false).is_last) << "no response has returned speed";
  EXPECT_TRUE(jam(true).is_news);
  const ContactGraph::Jam again = jam(true);
  EXPECT_FALSE(again.is_last || again.is_news);
  for (int contact = 0; contact < 70; ++contact) {
    velocities[0] = {1, 0, 0};
    instant.queue(begin(0, 1));
    EXPECT_EQ(deliver()->jammed, contact >= 64) << contact;
    velocities[0] = {-1, 0, 0};
    EXPECT_FALSE(deliver()) << "takes note of the response";
  }
  for (int k = 1; k < 8; ++k) {
    EXPECT_FALSE(jam(false).is_last) << k;
    EXPECT_EQ(book.threshold_of(event, wanted).state.approach, ApproachState::watched);
  }
  EXPECT_TRUE(jam(false).is_last);
  EXPECT_EQ(book.threshold_of(event, wanted).state.approach, ApproachState::ignored);
}

}  // namespace
}  // namespace kinesphere::contact_graph_test
