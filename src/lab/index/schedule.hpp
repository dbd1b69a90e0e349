// The schedule: at most one future time per body, earliest first.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <type_traits>
#include <vector>

#include "lab/index/time_group.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

class HeapCounter;

/// What a schedule can do. A body that is not scheduled has the time +infinity, and to set that is to remove
/// it. Times are never NaN. `next_time` is +infinity when nobody is scheduled; otherwise `next_body` is
/// scheduled then, and of several the one with the lowest number, so that the order never depends on history.
template <class S>
concept Schedule = requires(S schedule, const S& constant, std::uint32_t body, double time) {
  schedule.set(body, time);
  schedule.remove(body);
  { constant.next_time() } -> std::convertible_to<double>;
  { constant.next_body() } -> std::convertible_to<std::uint32_t>;
  { constant.time_of(body) } -> std::convertible_to<double>;
};

/// The plain reference: a table and a scan.
class LinearSchedule {
 public:
  void set(std::uint32_t body, double time);
  void remove(std::uint32_t body) { times_.erase(body); }
  double next_time() const;
  std::uint32_t next_body() const;
  double time_of(std::uint32_t body) const;

 private:
  std::map<std::uint32_t, double> times_;  ///< of the scheduled
};

/// A tournament tree: the lowest level has the bodies' times, and every level above the least of each group
/// of the one below, up to a level of one group. Cost: O(log n) for `set`, `next_body` and
/// `soon`, O(1) for the rest.
/// Memory: 9 bytes per body number, up to the highest that was ever scheduled.
class TreeSchedule {
 public:
  void reserve(std::size_t bodies) { levels_[0].reserve((bodies + width - 1) / width); }
  void set(std::uint32_t body, double time);
  void remove(std::uint32_t body) { set(body, infinity); }
  double next_time() const { return next_time_; }
  std::uint32_t next_body() const;
  /// Someone else who is due soon: most often the next one after next_body(). Perhaps nobody.
  std::optional<std::uint32_t> soon() const;
  double time_of(std::uint32_t body) const {
    return body < room() ? levels_[0][body / width][body % width] : infinity;
  }

  /// Bytes hold the bodies' times alone.
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [levels, height, next_time] = self;
    if constexpr (std::same_as<Archive, HeapCounter>) {
      archive(levels);
    } else {
      archive(levels[0]);
    }
    if constexpr (!std::is_const_v<Self>) self.build();
  }
  /// For one that was read in a world of this many bodies: true when its times can have been set for them.
  bool is_valid(std::size_t bodies) const;

 private:
  static constexpr std::size_t width = TimeGroup::width;
  using Level = std::vector<TimeGroup>;
  /// Enough for every body number: 8^11 is more than 2^32.
  static constexpr std::size_t most_levels = 11;

  std::size_t room() const { return levels_[0].size() * width; }
  std::uint32_t first_within(std::size_t index, std::size_t level, double time) const;
  void make_room(std::uint32_t body);
  void build();
  void complete();

  std::array<Level, most_levels> levels_;  ///< from the lowest; from `height_` on they are empty
  std::size_t height_ = 0;
  double next_time_ = infinity;  ///< the least of the highest level
};

}  // namespace kinesphere
