// What ships have said of themselves, by their MMSI.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <utility>

namespace kinesphere::program {

/// Keeps a value of each of the `most` ships that were used last, and of at most as many more, however many a
/// sender invents.
template <class Value>
class RecentShips {
 public:
  static constexpr std::size_t most = 65'536;

  void set(std::uint32_t mmsi, Value value) {
    recent_[mmsi] = value;
    if (recent_.size() < most) return;
    earlier_ = std::move(recent_);
    recent_.clear();
  }
  /// Returns the value; Value{} if there is none.
  Value value_of(std::uint32_t mmsi) {
    if (const auto at = recent_.find(mmsi); at != recent_.end()) return at->second;
    const auto at = earlier_.find(mmsi);
    if (at == earlier_.end()) return {};
    const Value value = at->second;
    set(mmsi, value);
    return value;
  }

  nlohmann::json save() const {
    const auto pairs = [](const auto& ships) {
      auto all = nlohmann::json::array();
      for (const auto& [mmsi, value] : ships) all.push_back({mmsi, value});
      return all;
    };
    return {{"recent", pairs(recent_)}, {"earlier", pairs(earlier_)}};
  }
  void restore(const nlohmann::json& state) {
    for (auto& [name, ships] : {std::pair{"recent", &recent_}, {"earlier", &earlier_}})
      for (const auto& each : state.at(name)) (*ships)[each.at(0)] = each.at(1);
  }

 private:
  std::unordered_map<std::uint32_t, Value> recent_, earlier_;
};

}  // namespace kinesphere::program
