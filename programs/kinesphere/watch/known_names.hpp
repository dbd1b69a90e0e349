// Callsigns and ships' names that came in messages of their own, by the ids of the tracks.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <unordered_map>

namespace kinesphere::program {

/// Keeps the `most` tracks that were used last, and at most as many more, however many a sender invents.
class KnownNames {
 public:
  static constexpr std::size_t most = 65'536;

  /// Sets the name of a track to shown_name() of it; an empty one changes nothing.
  void set(std::string_view id, std::string_view name);
  /// Returns the name, valid until the next call; empty if it is not known.
  std::string_view name_of(std::string_view id);

  nlohmann::json save() const;
  void restore(const nlohmann::json& state);

 private:
  std::unordered_map<std::string, std::string> recent_, earlier_;
};

}  // namespace kinesphere::program
