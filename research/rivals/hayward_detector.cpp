// The collision predictor of Hayward, Aubry, Foisy and Ghallab (1995): every pair of bodies has a safe
// interval, in which the two certainly do not touch, and the most urgent pair is rechecked first.
//
// There is no grid: memory is O(n^2), and the cost of a recheck does not depend on other bodies. A recheck
// probes the two bodies and renews the interval of that pair alone. Other intervals stay valid, since an
// interval is a fact about bodies, not about bounds.
#include <algorithm>
#include <functional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "research/rivals/bound_detector.hpp"
#include "research/rivals/rivals.hpp"
#include "simulation/detector/checked_detector.hpp"

namespace kinesphere {
namespace {

/// Two bodies, or a body twice for its walls. Pairs are numbered row by row.
struct Pair {
  std::uint32_t larger;
  std::uint32_t smaller;

  Pair(std::uint32_t a, std::uint32_t b) : larger(std::max(a, b)), smaller(std::min(a, b)) {}
  std::uint32_t number() const { return row_start(larger) + smaller; }

  static std::uint32_t row_start(std::uint32_t row) {
    return static_cast<std::uint32_t>(std::uint64_t{row} * (row + 1) / 2);
  }
};

/// Largest number of bodies for which the number of a pair fits into 32 bits.
constexpr std::size_t most_bodies = 90000;

class Hayward final : public BoundDetector {
 public:
  Hayward(const WorldDefinition& definition, const Motion& motion) : BoundDetector(definition, motion) {}

  std::string_view name() const override { return "hayward"; }

 private:
  void on_new_course(std::uint32_t number) override {
    // For a pair of two new bodies the second call renews the interval.
    for (std::uint32_t other = 0; other < size(); ++other)
      if (body(other).present && !body(other).new_course) renew({number, other});
  }

  void on_removed(std::uint32_t number) override {
    for (std::uint32_t other = 0; other < size(); ++other) set_end(Pair(number, other), infinity);
  }

  void on_contact_change(std::uint32_t a, std::uint32_t b) override { renew({a, b}); }

  double next_time() const override {
    while (!ends_.empty() && interval_ends_[ends_.top().second] != ends_.top().first) ends_.pop();
    return ends_.empty() ? infinity : ends_.top().first;
  }

  /// Rechecks the most urgent pair. Called after next_time(), so the first entry is not stale.
  void handle_next() override {
    const Pair pair = pair_of(ends_.top().second);
    ++counters_.pair_checks;
    if (!fresh(pair.larger)) probe(pair.larger);
    if (!fresh(pair.smaller)) probe(pair.smaller);
    renew(pair);
  }

  /// Starts a new safe interval of the pair at time().
  void renew(const Pair& pair) {
    set_end(pair, pair.larger == pair.smaller ? wall_outlook(pair.larger)
                                              : pair_outlook(pair.larger, pair.smaller));
  }

  double end_of(const Pair& pair) const {
    return pair.number() < interval_ends_.size() ? interval_ends_[pair.number()] : infinity;
  }

  void set_end(const Pair& pair, double time) {
    if (time == end_of(pair)) return;
    if (pair.number() >= interval_ends_.size()) interval_ends_.resize(Pair::row_start(size()), infinity);
    interval_ends_[pair.number()] = time;
    if (time < infinity) ends_.emplace(time, pair.number());
  }

  Pair pair_of(std::uint32_t number) const {
    std::uint32_t low = 0;
    std::uint32_t high = size();
    while (high - low > 1) {
      const std::uint32_t middle = low + (high - low) / 2;
      (Pair::row_start(middle) <= number ? low : high) = middle;
    }
    return {low, number - Pair::row_start(low)};
  }

  using End = std::pair<double, std::uint32_t>;  ///< end of the safe interval, number of the pair

  std::vector<double> interval_ends_;  ///< by number of the pair; +infinity: none
  /// A heap, earliest end first. An entry is stale if its time is not the pair's in interval_ends_.
  mutable std::priority_queue<End, std::vector<End>, std::greater<>> ends_;
};

}  // namespace

Result<std::unique_ptr<Detector>> make_hayward_detector(const WorldDefinition& definition,
                                                        const Motion& motion) {
  if (motion.size() > most_bodies) {
    return Error{ErrorCode::unsupported, "motion", no_body,
                 "make_hayward_detector: motion must have at most " + std::to_string(most_bodies) +
                     " bodies, but has " + std::to_string(motion.size())};
  }
  return make_checked<Hayward>(definition, motion);
}

}  // namespace kinesphere
