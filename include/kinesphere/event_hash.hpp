// One number for all events of a run: two runs with the same number went the same way, to the last bit.
//
//   EventHash hash;
//   for (const Event& event : world.events(until, probe)) hash.add(event);
//   std::printf("%016llx\n", static_cast<unsigned long long>(hash.value()));
#pragma once

#include <array>
#include <cstdint>

#include "kinesphere/event.hpp"

namespace kinesphere {

/// A hash of a set of events: time, kind, ids and wall of each, and the distance of sensor events. States,
/// points and speeds are left out. It is a sum, so that events may be added in any order, and hashes of parts
/// of a run, wherever these were made, add up to that of the whole. When events happened is in their times;
/// which of two at one instant was told first is not in the hash.
class EventHash {
 public:
  void add(const Event& event);
  EventHash& operator+=(const EventHash& other);
  std::uint64_t value() const;
  /// All that a hash is made of, for messages and files; and a hash that is made of it.
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
