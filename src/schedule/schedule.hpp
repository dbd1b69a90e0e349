// The schedule: at most one future time per body, earliest first.
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

namespace kinesphere {

/// When a body is due. Ordered by time, then by body number, so that the order never depends on history.
struct Due {
  double time;
  std::uint32_t body;

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [when, who] = self;
    archive(when, who);
  }

  friend bool operator<(const Due& a, const Due& b) {
    return std::tie(a.time, a.body) < std::tie(b.time, b.body);
  }
  friend bool operator==(const Due&, const Due&) = default;
};

/// What a schedule can do. `set` adds a body or changes its time (+infinity is a time like any other);
/// `earliest` needs a schedule that is not empty.
template <class S>
concept Schedule = requires(S schedule, const S& constant, std::uint32_t body, double time) {
  schedule.set(body, time);
  schedule.remove(body);
  { constant.earliest() } -> std::convertible_to<Due>;
  { constant.empty() } -> std::convertible_to<bool>;
  { constant.contains(body) } -> std::convertible_to<bool>;
  { constant.time_of(body) } -> std::convertible_to<double>;
};

/// The plain reference: a table and a scan.
class LinearSchedule {
 public:
  void set(std::uint32_t body, double time);
  void remove(std::uint32_t body);
  Due earliest() const;
  bool empty() const { return size_ == 0; }
  bool contains(std::uint32_t body) const { return body < entries_.size() && entries_[body].present; }
  double time_of(std::uint32_t body) const { return entries_[body].time; }

 private:
  struct Entry {
    double time = 0.0;
    bool present = false;
  };
  std::vector<Entry> entries_;
  std::size_t size_ = 0;
};

/// A four-ary heap that knows where each body stands. Cost: O(log n) for set and remove, O(1) for the rest.
class HeapSchedule {
 public:
  void set(std::uint32_t body, double time);
  void remove(std::uint32_t body);
  Due earliest() const { return heap_.front(); }
  bool empty() const { return heap_.empty(); }
  bool contains(std::uint32_t body) const { return body < positions_.size() && positions_[body] != absent; }
  double time_of(std::uint32_t body) const { return heap_[positions_[body]].time; }
  std::size_t size() const { return heap_.size(); }

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [heap, positions] = self;
    archive(heap, positions);
  }
  /// For one that was read: true when it is a heap, and each body stands where it is said to.
  bool is_sound() const;

 private:
  static constexpr std::uint32_t absent = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t arity = 4;

  void place(std::size_t position, const Due& due);
  void sift_up(std::size_t position, const Due& due);
  void sift_down(std::size_t position, const Due& due);

  std::vector<Due> heap_;
  std::vector<std::uint32_t> positions_;  ///< by body
};

}  // namespace kinesphere
