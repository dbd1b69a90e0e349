// The hash of events: equal for equal events in any order, different for any different bit.
#include "kinesphere/event_hash.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace kinesphere::event_hash_test {
namespace {

std::uint64_t hash_of(const std::vector<Event>& events) {
  EventHash hash;
  for (const Event& event : events) hash.add(event);
  return hash.value();
}

const Event contact{.kind = EventKind::contact_begin, .time = 1.5, .first = {3, 0}, .second = {7, 2}};

/// Returns `contact` and events that differ from it in one field each.
std::vector<Event> variants() {
  std::vector<Event> events(8, contact);
  events[1].time = 1.5 + 0x1p-52;
  events[2].kind = EventKind::contact_end;
  events[3].first.index = 4;
  events[4].first.generation = 1;
  events[5].second.index = 8;
  events[6].second.generation = 3;
  events[7].wall = Wall::x_lower;
  return events;
}

TEST(EventHash, DiffersWhereAnEventDoes) {
  std::set<std::uint64_t> hashes{hash_of({})};
  const std::vector<Event> events = variants();
  for (std::size_t k = 0; k < events.size(); ++k)
    EXPECT_TRUE(hashes.insert(hash_of({events[k]})).second) << k;
}

TEST(EventHash, KnowsDistancesOfSensorsOnly) {
  const auto differ = [](EventKind kind) {
    Event near = contact, far = contact;
    near.kind = far.kind = kind;
    far.distance = 10.0;
    return hash_of({near}) != hash_of({far});
  };
  EXPECT_TRUE(differ(EventKind::sensor_enter));
  EXPECT_TRUE(differ(EventKind::sensor_leave));
  EXPECT_FALSE(differ(EventKind::contact_begin));
}

TEST(EventHash, KnowsHowOften) {
  const std::vector<Event> events = variants();
  EXPECT_NE(hash_of({events[0]}), hash_of({events[0], events[0]}));
  EXPECT_NE(hash_of({events[0], events[1]}), hash_of({events[1], events[1]}));
}

TEST(EventHash, OfPartsAddUp) {
  const std::vector<Event> events = variants();
  std::vector<EventHash> parts(3);
  for (std::size_t k = events.size(); k-- > 0;) parts[k % parts.size()].add(events[k]);
  EventHash whole;
  for (const EventHash& part : parts) whole += part;
  EXPECT_EQ(whole.value(), hash_of(events));
  EXPECT_NE(whole.value(), parts[0].value());
}

/// Hashes are compared across machines and versions. This one was computed without the library.
TEST(EventHash, IsTheSameEverywhere) {
  EXPECT_EQ(hash_of({}), 0u);
  EXPECT_EQ(hash_of(variants()), 0x22fbd9b593c0e96fu);
}

}  // namespace
}  // namespace kinesphere::event_hash_test
