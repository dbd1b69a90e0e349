// Callsigns and ships' names that came in messages of their own, by the ids of the tracks.
#pragma once

#include <string>
#include <string_view>

#include "watch/recent_values.hpp"
#include "watch/track_names.hpp"

namespace kinesphere::program {

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
