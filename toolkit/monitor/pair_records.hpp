// Records of pairs: what is certain of two tracks, and until when.
#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "kinesphere/monitor/separation.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

struct LevelState {
  Verdict verdict = Verdict::apart;
  double since = -infinity;
  double until = -infinity;  ///< A certain verdict holds until this time, whatever is reported.
};

/// Two tracks that are near each other. As long as they are certified to be apart at all levels until `due`,
/// `levels` is empty; otherwise the pair is open, and has a state at each level.
struct PairRecord {
  double due = infinity;  ///< when time alone may change a verdict
  std::vector<LevelState> levels;

  bool is_open() const { return !levels.empty(); }
  bool is_apart() const {
    return std::all_of(levels.begin(), levels.end(),
                       [](const LevelState& state) { return state.verdict == Verdict::apart; });
  }
  bool is_undecided() const {
    return std::any_of(levels.begin(), levels.end(),
                       [](const LevelState& state) { return state.verdict == Verdict::undecided; });
  }
  /// Returns true if the pair is certified to be apart, or has a certain verdict, only until `now`.
  bool is_expiring(double now) const {
    return !is_open() || std::any_of(levels.begin(), levels.end(), [now](const LevelState& state) {
      return state.verdict != Verdict::undecided && state.until <= now;
    });
  }
};

/// A record with the numbers of its two tracks, as stored in a snapshot.
template <class Record>
struct SavedPair {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  Record record{};
};

/// Records of pairs by the numbers of their two tracks. The order of the two arguments does not matter.
template <class Record>
class PairMap {
 public:
  Record* find(std::uint32_t a, std::uint32_t b) {
    const auto at = records_.find(key(a, b));
    return at == records_.end() ? nullptr : &at->second;
  }
  const Record* find(std::uint32_t a, std::uint32_t b) const {
    const auto at = records_.find(key(a, b));
    return at == records_.end() ? nullptr : &at->second;
  }
  Record& add(std::uint32_t a, std::uint32_t b) { return records_[key(a, b)]; }
  void remove(std::uint32_t a, std::uint32_t b) { records_.erase(key(a, b)); }
  /// Returns all records in the order of their pairs.
  std::vector<SavedPair<Record>> sorted() const {
    std::vector<SavedPair<Record>> sorted;
    for_each([&](std::uint32_t a, std::uint32_t b, const Record& record) {
      sorted.push_back({a, b, record});
    });
    std::sort(sorted.begin(), sorted.end(), [](const SavedPair<Record>& p, const SavedPair<Record>& q) {
      return std::tie(p.first, p.second) < std::tie(q.first, q.second);
    });
    return sorted;
  }
  std::size_t size() const { return records_.size(); }
  /// Calls visit(a, b, record) with a < b for all records, in unspecified order.
  template <class Visit>
  void for_each(Visit visit) const {
    for (const auto& [pair, record] : records_)
      visit(static_cast<std::uint32_t>(pair >> 32), static_cast<std::uint32_t>(pair), record);
  }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }

  std::unordered_map<std::uint64_t, Record> records_;
};

}  // namespace kinesphere
