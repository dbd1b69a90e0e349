// The Bentley-Ottmann sweep over time, for lines in the plane of one axis and time.
//
//   sweep.insert(0, {.start = 0.0, .speed = 1.0});
//   sweep.insert(1, {.start = 2.0, .speed = -1.0});
//   sweep.sort([](auto below, auto above) { ... });  // the order at time 0
//   sweep.begin(10.0);
//   while (sweep.next_time() <= 10.0) sweep.step();  // 0 and 1 cross at time 1
//
// All lines span one interval of time, so the status of the sweep needs no search tree: it is an array in
// which neighbours change places, and the queue holds the crossings of neighbours.
//
// The sweep uses no library: CGAL's is made for segments that begin and end anywhere, and decides each
// comparison with exact arithmetic. Here rounding is harmless, because the caller widens its intervals by
// more than rounding can hide, so the large dependency would buy nothing. Guarantees, whatever ties and
// rounding do:
//   - The sweep ends: two lines change places at most once, and only if the lower one is the faster.
//   - The order at a time is wrong at most for lines that are nearer each other then than order_error().
//   - The sweep is deterministic: crossings of one time come in the order of their numbers, and lines that
//     coincide keep their order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace kinesphere {

/// The line start + speed s, for a time s >= 0.
struct Line {
  double start = 0.0;
  double speed = 0.0;

  double at(double s) const { return start + speed * s; }
};

/// The sweep through the lines of one plane.
class Sweep {
 public:
  /// Two lines that change places: `below` was the lower one before.
  struct Crossing {
    double time;
    std::uint32_t below;
    std::uint32_t above;
  };

  /// Adds a line on top of all others. Numbers should be small, as tables are indexed by them. Cost: O(1).
  void insert(std::uint32_t number, const Line& line);
  /// Removes a line. Cost: O(n).
  void erase(std::uint32_t number);
  bool contains(std::uint32_t number) const { return number < rank_.size() && rank_[number] != absent; }
  std::size_t size() const { return status_.size(); }

  /// Returns a line, which may be changed before sort().
  Line& line(std::uint32_t number) { return status_[rank_[number]].line; }
  const Line& line(std::uint32_t number) const { return status_[rank_[number]].line; }

  /// Calls visit(number, line) for every line; `visit` may change the line before sort().
  template <class Visit>
  void for_each_line(Visit&& visit) {
    for (Entry& entry : status_) visit(entry.number, entry.line);
  }

  /// Returns true if line a is below line b in the present order.
  bool is_below(std::uint32_t a, std::uint32_t b) const { return rank_[a] < rank_[b]; }

  /// Sorts the lines into their order at time 0, by insertion. Calls exchanged(below, above) after each
  /// exchange of two neighbours, of which `below` was the lower one until then. Cost: O(n + exchanges).
  template <class Exchanged>
  void sort(Exchanged&& exchanged) {
    for (std::size_t k = 1; k < status_.size(); ++k)
      for (std::size_t j = k; j > 0 && status_[j].line.start < status_[j - 1].line.start; --j) {
        exchange(j - 1);
        exchanged(status_[j].number, status_[j - 1].number);
      }
  }

  /// Begins to look for crossings in [0, duration]. Precondition: sort() was called. Cost: O(n + crossings of
  /// neighbours).
  void begin(double duration);
  /// Returns the time of the next crossing, +infinity if none is left.
  double next_time() const {
    return queue_.empty() ? std::numeric_limits<double>::infinity() : queue_.front().time;
  }
  /// Performs the next crossing and returns it. Cost: O(log n).
  Crossing step();

  /// Returns the largest distance of two lines in the wrong order, if no coordinate of any of `lines` lines
  /// exceeds `size` during the interval (length). Two neighbours are exchanged at a time that three roundings
  /// separate from that of their crossing, at most 2^-49 size apart; others are as far apart as the
  /// neighbours between them together.
  static double order_error(std::size_t lines, double size) {
    return static_cast<double>(lines) * (0x1p-48 * size);
  }

 private:
  struct Entry {
    Line line;
    std::uint32_t number;
  };
  static constexpr std::uint32_t absent = std::numeric_limits<std::uint32_t>::max();

  void exchange(std::size_t lower) {
    std::swap(status_[lower], status_[lower + 1]);
    rank_[status_[lower].number] = static_cast<std::uint32_t>(lower);
    rank_[status_[lower + 1].number] = static_cast<std::uint32_t>(lower + 1);
  }
  bool find_crossing(std::size_t lower);
  void schedule_crossing(std::size_t lower);
  void drop_outdated();
  void pop();

  std::vector<Entry> status_;        ///< from below
  std::vector<std::uint32_t> rank_;  ///< by number: index in status_
  std::vector<Crossing> queue_;  ///< a heap; a crossing of lines that are no longer neighbours is outdated
  double time_ = 0.0;
  double duration_ = 0.0;
};

}  // namespace kinesphere
