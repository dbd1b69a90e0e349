// One number for all events of a run: two runs with the same number went the same way, to the last bit.
//
//   EventHash hash;
//   for (const Event& event : world.events(until, probe)) hash.add(event);
//   std::printf("%016llx\n", static_cast<unsigned long long>(hash.value()));
#pragma once

#include <cstdint>

#include "kinesphere/event.hpp"

namespace kinesphere {

/// 64-bit FNV-1a over time, kind, ids and wall of each event, in order, and the distance of sensor events.
/// States, points and speeds are left out.
class EventHash {
 public:
  void add(const Event& event);
  std::uint64_t value() const { return value_; }

 private:
  void mix(std::uint64_t word);
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace kinesphere
