// A bounded memory of what tracks have said of themselves.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
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

  nlohmann::json save() const {
    const auto pairs = [](const auto& values) {
      auto all = nlohmann::json::array();
      for (const auto& [key, value] : values) all.push_back({key, value});
      return all;
    };
    return {{"recent", pairs(recent_)}, {"earlier", pairs(earlier_)}};
  }
  void restore(const nlohmann::json& state) {
    for (auto& [name, values] : {std::pair{"recent", &recent_}, {"earlier", &earlier_}})
      for (const auto& each : state.at(name)) (*values)[each.at(0).template get<Key>()] = each.at(1);
  }

 private:
  std::unordered_map<Key, Value> recent_, earlier_;
};

}  // namespace kinesphere::program
