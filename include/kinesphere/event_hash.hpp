// EventHash: one number for all events of a run. Two runs with equal numbers had bit-identical events.
//
//   EventHash hash;
//   for (const Event& event : world.events(until, probe)) hash.add(event);
//   std::printf("%016llx\n", static_cast<unsigned long long>(hash.value()));
#pragma once

#include <array>
#include <cstdint>

#include "kinesphere/event.hpp"

namespace kinesphere {

/// Hash of a set of events: the time, kind, ids and wall of each, and the distance of sensor events. It
/// leaves out states, points and speeds. The hash is a sum: events may be added in any order, and hashes of
/// parts of a run, wherever computed, add up to the hash of the whole run. It does not depend on the order
/// of delivery of events at one instant.
class EventHash {
 public:
  /// Add an event, and the events of another hash.
  void add(const Event& event);
  EventHash& operator+=(const EventHash& other);
  /// Returns the hash as one number. Equal sets of events have equal values.
  std::uint64_t value() const;
  /// parts() returns the whole content of a hash, for messages and files; of() makes a hash from it.
  std::array<std::uint64_t, 2> parts() const { return {sum_, count_}; }
  static EventHash of(const std::array<std::uint64_t, 2>& parts) {
    EventHash hash;
    hash.sum_ = parts[0];
    hash.count_ = parts[1];
    return hash;
  }

 private:
  std::uint64_t sum_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace kinesphere
