// Events that wait for delivery: their order, those that are dropped, and those that were caused by the
// caller.
#include "contact/pending_events.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "archive/fields.hpp"
#include "support/read_back.hpp"

namespace kinesphere::pending_events_test {
namespace {

constexpr double now = 5.0;

/// Three unit spheres in a row along x, which touch; the outer ones move inwards.
class PendingEventsTest : public testing::Test {
 protected:
  PendingEventsTest() {
    for (std::uint32_t body = 0; body < 3; ++body) graph.add(body, 0.0);
  }
  Sphere sphere(std::uint32_t body) const {
    return {.id = {body, 0}, .radius = 1.0, .state = {{2.0 * body, 0, 0}, {1.0 - body, 0, 0}}};
  }
  Event pair(EventKind kind, std::uint32_t a, std::uint32_t b, double distance = 0.0) const {
    Event event = contact_event(kind, now, sphere(a), sphere(b), graph.space());
    event.distance = distance;
    return event;
  }
  std::optional<Event> pop() {
    return events.pop(
        graph, [this](BodyId id) { return id != gone; }, [this](std::uint32_t body) { return sphere(body); },
        [](const Event&) { return Senses::second; }, std::nullopt);
  }
  std::vector<EventKind> pop_all() {
    std::vector<EventKind> kinds;
    while (const auto event = pop()) kinds.push_back(event->kind);
    return kinds;
  }

  ContactGraph graph{WorldDefinition{.contacts = ContactEvents::all}};
  PendingEvents events;
  BodyId gone = no_body;
};

TEST_F(PendingEventsTest, AreQuietUntilOneWaits) {
  EXPECT_TRUE(events.is_quiet());
  events.queue(pair(EventKind::contact_begin, 0, 1));
  EXPECT_FALSE(events.is_quiet());
  EXPECT_TRUE(pop());
  EXPECT_TRUE(events.is_quiet());
  EXPECT_TRUE(events.awaits_response());
  EXPECT_EQ(pop(), std::nullopt);
  EXPECT_FALSE(events.awaits_response()) << "the caller has answered by then";
}

TEST_F(PendingEventsTest, EndsOfTheCallerComeFirstAndUnchanged) {
  graph.set_touching(pair(EventKind::contact_begin, 0, 1), true);
  graph.set_touching(pair(EventKind::sensor_enter, 0, 1, 4.0), true);
  events.queue(pair(EventKind::contact_begin, 1, 2));
  events.end_all_contacts(
      graph, 0, now, [this](std::uint32_t body) { return sphere(body); }, std::nullopt);
  EXPECT_TRUE(events.has_ends());
  EXPECT_FALSE(graph.touch(0, 1));
  gone = {0, 0};
  EXPECT_EQ(pop_all(),
            (std::vector{EventKind::contact_end, EventKind::sensor_leave, EventKind::contact_begin}));
}

TEST_F(PendingEventsTest, OnlyThoseContactsEndThatHaveTo) {
  graph.set_touching(pair(EventKind::contact_begin, 0, 1), true);
  graph.set_touching(pair(EventKind::contact_begin, 1, 2), true);
  events.end_contacts(
      graph, 1, now, [this](std::uint32_t body) { return sphere(body); }, std::nullopt,
      [](const Event& end) { return end.second.index == 2; });
  EXPECT_TRUE(graph.touch(0, 1));
  EXPECT_FALSE(graph.touch(1, 2));
}

TEST_F(PendingEventsTest, BeginsAreJudgedAgainAndDroppedIfTheyDoNotHold) {
  events.queue(pair(EventKind::contact_begin, 0, 2));
  EXPECT_EQ(pop(), std::nullopt) << "the two are two radii apart";
  EXPECT_FALSE(graph.touch(0, 2));
}

TEST_F(PendingEventsTest, AreJudgedByWhatIsKnownOfTheirOwnBodies) {
  // With such rates no approach is certain.
  const ContactTerms unlikely{ContactEvents::all, 2.0, 1e20, 0.0};
  const auto approach_of = [&](std::uint32_t a, std::uint32_t b) {
    const Event begin = pair(EventKind::contact_begin, a, b);
    return graph.threshold_of(begin, ContactEvents::all).state.approach;
  };
  events.queue(pair(EventKind::contact_begin, 1, 2), &unlikely);
  ASSERT_TRUE(pop());
  EXPECT_EQ(approach_of(1, 2), ApproachState::watched);
  graph.set_touching(pair(EventKind::contact_begin, 1, 2), false);
  events.queue(pair(EventKind::contact_begin, 1, 2), &unlikely);
  events.queue(pair(EventKind::contact_begin, 0, 1));
  ASSERT_TRUE(pop());
  EXPECT_EQ(approach_of(0, 1), ApproachState::reported) << "of two that wait, the bodies are looked at";
}

TEST_F(PendingEventsTest, SensorEventsSayWhoSenses) {
  events.queue(pair(EventKind::sensor_enter, 0, 2, 4.0));
  const auto enter = pop();
  ASSERT_TRUE(enter);
  EXPECT_EQ(enter->senses, Senses::second);
  events.queue(pair(EventKind::sensor_leave, 0, 2, 4.0));
  const auto leave = pop();
  ASSERT_TRUE(leave);
  EXPECT_EQ(leave->senses, Senses::second) << "as it was entered";
  EXPECT_TRUE(graph.overlaps_of(0, 2).empty());
}

TEST_F(PendingEventsTest, DropsThoseThatNoLongerMayBe) {
  events.queue(pair(EventKind::contact_begin, 0, 1));
  events.queue(pair(EventKind::contact_begin, 1, 2));
  events.drop_pending(0, [](const Event&) { return false; });
  const auto left = pop();
  ASSERT_TRUE(left);
  EXPECT_EQ(left->first.index, 1u);
  EXPECT_EQ(pop(), std::nullopt);
}

TEST_F(PendingEventsTest, DeliveredEventsChangeTheGraphAndSoCertificates) {
  events.queue(pair(EventKind::contact_begin, 0, 1));
  ASSERT_TRUE(pop());
  EXPECT_TRUE(graph.touch(0, 1));
  ASSERT_EQ(events.changed().size(), 1u);
  EXPECT_EQ(events.changed().front(), std::pair(0u, 1u));
}

TEST_F(PendingEventsTest, AreReadAsTheyWereAndChecked) {
  events.queue(pair(EventKind::contact_begin, 0, 1));
  events.queue(pair(EventKind::zeno_guard, 1, 2));
  PendingEvents back;
  ASSERT_TRUE(read_back(events, back));
  const auto is_valid = [&](std::size_t bodies, double time) {
    return back.is_valid(bodies, time, std::nullopt, [=](BodyId id) { return id.index < bodies; });
  };
  EXPECT_TRUE(is_valid(3, now));
  EXPECT_FALSE(is_valid(2, now)) << "an event of an unknown body";
  EXPECT_FALSE(is_valid(3, now + 1.0)) << "events of another time";
}

}  // namespace
}  // namespace kinesphere::pending_events_test
