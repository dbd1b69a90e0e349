// The set of events, mirrored into a std::set.
#include "contact/event_set.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "archive/archive.hpp"
#include "archive/fields.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::event_set_test {
namespace {

constexpr std::uint64_t seed = 411;

/// Returns one of few events; only the gap distinguishes equal ones.
Event draw(Random& random, std::uint64_t bodies) {
  const auto first = static_cast<std::uint32_t>(random.bits() % bodies);
  const auto kind = random.bits() % 2 == 0 ? EventKind::contact_begin : EventKind::contact_end;
  return {.kind = kind, .first = {first, 0}, .second = {first + 1, 0}, .gap = random.uniform()};
}

void expect_same(const EventSet& events, const std::set<Event, DeliveredBefore>& mirror) {
  std::vector<double> found, wanted;
  events.for_each([&](const Event& event) { found.push_back(event.gap); });
  for (const Event& event : mirror) wanted.push_back(event.gap);
  ASSERT_EQ(found, wanted);
  ASSERT_EQ(events.empty(), mirror.empty());
  ASSERT_TRUE(events.is_valid());
}

TEST(EventSet, is_a_set) {
  for (const std::uint64_t bodies : {1u, 2u, 5u, 40u}) {
    EventSet events;
    std::set<Event, DeliveredBefore> mirror;
    Random random = Random::at(seed, bodies, 0);
    for (int step = 0; step < 4000; ++step) {
      const Event event = draw(random, bodies);
      const auto choice = random.bits() % 8;
      ASSERT_EQ(events.contains(event), mirror.contains(event));
      if (choice < 4) {
        events.insert(event);
        mirror.insert(event);
      } else if (choice == 4) {
        events.erase(event);
        mirror.erase(event);
      } else if (choice == 5 && random.bits() % 4 == 0) {
        const auto goes = [&](const Event& one) { return one.first.index % 3 == event.first.index % 3; };
        events.erase_if(goes);
        std::erase_if(mirror, goes);
      } else if (!mirror.empty()) {
        ASSERT_EQ(events.take_first().gap, mirror.extract(mirror.begin()).value().gap);
      }
      ASSERT_NO_FATAL_FAILURE(expect_same(events, mirror)) << "seed " << seed << ", step " << step;
    }
  }
}

TEST(EventSet, asks_all_or_none) {
  EventSet events;
  const auto begins = [](const Event& event) { return event.kind == EventKind::contact_begin; };
  EXPECT_TRUE(events.all_of(begins) && events.none_of(begins));
  events.insert({.kind = EventKind::contact_begin});
  EXPECT_TRUE(events.all_of(begins) && !events.none_of(begins));
  events.insert({.kind = EventKind::contact_end});
  EXPECT_FALSE(events.all_of(begins) || events.none_of(begins));
  events.take_first();
  EXPECT_TRUE(!events.all_of(begins) && events.none_of(begins));
}

/// Reads a set with these parts back from bytes; returns true if it is accepted.
bool is_valid(const std::optional<Event>& first, const std::set<Event, DeliveredBefore>& others) {
  ByteWriter writer;
  writer(first, others);
  ByteReader reader(writer.bytes());
  EventSet events;
  reader(events);
  return !reader.failed() && reader.remaining() == 0 && events.is_valid();
}

TEST(EventSet, that_was_read_is_sound_if_the_first_comes_first) {
  const Event a{.first = {1, 0}}, b{.first = {2, 0}};
  EXPECT_TRUE(is_valid({}, {}));
  EXPECT_TRUE(is_valid(a, {}));
  EXPECT_TRUE(is_valid(a, {b}));
  EXPECT_FALSE(is_valid(b, {a}));
  EXPECT_FALSE(is_valid(a, {a}));
  EXPECT_FALSE(is_valid({}, {a}));
}

}  // namespace
}  // namespace kinesphere::event_set_test
