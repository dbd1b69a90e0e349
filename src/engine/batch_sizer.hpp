// How many pairs islands take on in a part of a phase, and whether they are worth their while at all: learned
// from how often they have had to run again.
#pragma once

#include <algorithm>
#include <cstddef>

namespace kinesphere {

class BatchSizer {
 public:
  /// All is done by islands, however long they take and however few pairs are due.
  void require_speculation() {
    must_speculate_ = true;
    least_due_ = 8;
  }
  bool may_decline() const { return !must_speculate_; }

  /// Whether a phase is left without islands.
  bool skips_epoch() {
    if (paused_ == 0) return false;
    --paused_;
    return true;
  }
  /// How many pairs may be due in the next part, among so many bodies.
  std::size_t most_due(std::size_t bodies) {
    if (most_due_ == 0) most_due_ = std::max(least_due_, bodies / 32);
    return most_due_;
  }
  void begin() { first_runs_ = repeats_ = 0; }
  /// An island runs in which so many pairs are due.
  void note_run(std::size_t due, bool again) { (again ? repeats_ : first_runs_) += due; }
  /// So many run again and again in this part that others had better do it.
  bool repeats_too_often() const {
    constexpr std::size_t too_often = 8;
    return may_decline() && repeats_ > too_often * first_runs_;
  }
  /// The part is done. In a short part few kicked bodies meet others; in a long one each body is copied once
  /// for many pairs.
  void adapt(std::size_t bodies) {
    if (16 * repeats_ < first_runs_) {
      most_due_ = std::min(2 * most_due_, std::max(least_due_, bodies));
    } else if (6 * repeats_ > first_runs_) {
      most_due_ = std::max(most_due_ / 2, least_due_);
    }
  }
  /// If the islands of a part that could not be shorter ran again and again, nobody runs any for some phases:
  /// for more and more of them, as long as it turns out to be so. `done` says whether they did their part.
  void pause(bool done) {
    constexpr int longest = 31;
    const bool repeat_much = 3 * repeats_ > first_runs_ && (!done || most_due_ == least_due_);
    if (first_runs_ > 0) pause_ = repeat_much ? std::min(2 * pause_ + 1, longest) : 0;
    paused_ = pause_;
  }

 private:
  bool must_speculate_ = false;
  std::size_t least_due_ = 128;  ///< in a part: fewer are not worth the while
  std::size_t most_due_ = 0;     ///< in a part
  std::size_t first_runs_ = 0;   ///< pairs that were due in groups when these first ran in this part
  std::size_t repeats_ = 0;      ///< the same when they ran again
  int pause_ = 0;                ///< so many phases without islands
  int paused_ = 0;               ///< that are still to come
};

}  // namespace kinesphere
