// NameTable finds the numbers of bodies by their names.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace kinesphere {

class NameTable {
 public:
  /// Makes room for so many names.
  explicit NameTable(std::size_t names) : entries_(std::bit_ceil(2 * names + 2), {0, nothing}) {}

  /// Adds a name that is not there yet. Precondition: there is room.
  void add(std::uint32_t name, std::uint32_t number) { entries_[place_of(name)] = {name, number}; }
  std::optional<std::uint32_t> find(std::uint32_t name) const {
    const auto& [found, number] = entries_[place_of(name)];
    return number == nothing ? std::nullopt : std::optional(number);
  }

 private:
  static constexpr std::uint32_t nothing = ~std::uint32_t{0};

  std::size_t place_of(std::uint32_t name) const {
    const std::size_t mask = entries_.size() - 1;
    std::size_t place = (name * 0x9E3779B97F4A7C15u >> 24) & mask;
    while (entries_[place].second != nothing && entries_[place].first != name) place = (place + 1) & mask;
    return place;
  }

  std::vector<std::pair<std::uint32_t, std::uint32_t>> entries_;  ///< names and numbers; open addressing
};

}  // namespace kinesphere
