// Callsigns and ships' names as they are shown.
#include "formats/streams/known_names.hpp"

#include <algorithm>

namespace kinesphere::program {

std::string_view shown_name(std::string_view name) {
  constexpr std::size_t most = 40;
  constexpr std::string_view blank_bytes(" \t\r\n\0", 5);
  name.remove_prefix(std::min(name.find_first_not_of(blank_bytes), name.size()));
  if (name.size() > most) {
    std::size_t end = most;
    // Bytes 10xxxxxx continue a character.
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;
    name = name.substr(0, end);
  }
  return name.substr(0, name.find_last_not_of(blank_bytes) + 1);
}

}  // namespace kinesphere::program
