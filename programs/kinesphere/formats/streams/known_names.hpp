// Callsigns and ships' names that came in messages of their own, by the ids of the tracks.
#pragma once

#include <string>
#include <string_view>

#include "formats/streams/recent_values.hpp"

namespace kinesphere::program {

/// Returns a callsign or name of a stream without blanks at its ends, cut to at most 40 bytes between
/// characters of UTF-8. It is still text of a stranger: whoever writes it has to escape it.
std::string_view shown_name(std::string_view name);

class KnownNames : private RecentValues<std::string, std::string> {
 public:
  using RecentValues::most;
  using RecentValues::restore;
  using RecentValues::save;

  /// Sets the name of a track to shown_name() of it; an empty one changes nothing.
  void set(std::string_view id, std::string_view name) {
    if (name = shown_name(name); !name.empty()) RecentValues::set(std::string(id), std::string(name));
  }
  /// Returns the name, valid until the next call; empty if it is not known.
  std::string_view name_of(std::string_view id) {
    const std::string* const name = find(std::string(id));
    return name != nullptr ? std::string_view(*name) : std::string_view();
  }
};

}  // namespace kinesphere::program
