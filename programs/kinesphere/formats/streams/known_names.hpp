// What tracks have said of themselves before: a bounded memory, and the callsigns and ships' names in it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace kinesphere::program {

/// Keeps a value of each of the `most` keys that were used last, and of at most as many more, however many a
/// sender invents.
template <class Key, class Value>
class RecentValues {
 public:
  static constexpr std::size_t most = 65'536;

  void set(const Key& key, Value value) {
    recent_[key] = std::move(value);
    if (recent_.size() < most) return;
    earlier_ = std::move(recent_);
    recent_.clear();
  }
  /// Returns the value, valid until the next call; nullptr if there is none.
  const Value* find(const Key& key) {
    if (const auto at = recent_.find(key); at != recent_.end()) return &at->second;
    const auto at = earlier_.find(key);
    if (at == earlier_.end()) return nullptr;
    set(key, Value(at->second));
    const auto kept = recent_.find(key);
    return kept != recent_.end() ? &kept->second : &earlier_.find(key)->second;
  }
  /// Returns the value; Value{} if there is none.
  Value value_of(const Key& key) {
    const Value* const value = find(key);
    return value != nullptr ? *value : Value{};
  }

  /// Returns how many values are kept; some may be there twice.
  std::size_t size() const { return recent_.size() + earlier_.size(); }

  static void serialize(auto& self, auto& archive) {
    auto& [recent, earlier] = self;
    archive(recent, earlier);
  }

 private:
  std::unordered_map<Key, Value> recent_, earlier_;
};

/// Returns a callsign or name of a stream without blanks at its ends, cut to at most 40 bytes between
/// characters of UTF-8. It is still text of a stranger: whoever writes it has to escape it.
inline std::string_view shown_name(std::string_view name) {
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

class KnownNames {
 public:
  using Values = RecentValues<std::string, std::string>;

  /// Sets the name of a track to shown_name() of it; an empty one changes nothing.
  void set(std::string_view id, std::string_view name) {
    if (name = shown_name(name); !name.empty()) names_.set(std::string(id), std::string(name));
  }
  /// Returns the name, valid until the next call; empty if it is not known.
  std::string_view name_of(std::string_view id) {
    const std::string* const name = names_.find(std::string(id));
    return name != nullptr ? std::string_view(*name) : std::string_view();
  }
  std::size_t size() const { return names_.size(); }

  static void serialize(auto& self, auto& archive) { archive(self.names_); }

 private:
  Values names_;
};

}  // namespace kinesphere::program
