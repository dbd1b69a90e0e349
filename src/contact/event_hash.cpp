#include <bit>

#include "kinesphere/event_hash.hpp"

namespace kinesphere {

void EventHash::add(const Event& event) {
  mix(std::bit_cast<std::uint64_t>(event.time));
  mix(static_cast<std::uint64_t>(event.kind) | static_cast<std::uint64_t>(event.wall) << 8);
  mix(event.first.index | std::uint64_t{event.first.generation} << 32);
  mix(event.second.index | std::uint64_t{event.second.generation} << 32);
  if (is_of_sensor(event.kind)) mix(std::bit_cast<std::uint64_t>(event.distance));
}

void EventHash::mix(std::uint64_t word) {
  for (int byte = 0; byte < 8; ++byte) {
    value_ = (value_ ^ (word >> (8 * byte) & 0xff)) * 0x100000001b3u;
  }
}

}  // namespace kinesphere
