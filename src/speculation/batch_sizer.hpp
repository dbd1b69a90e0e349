// BatchSizer decides how many due pairs a batch of an epoch contains, and whether speculative execution pays
// at all. It adapts both to how often clusters had to be executed again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

namespace kinesphere {

class BatchSizer {
 public:
  /// For a run with this number of threads in a world with this number of bodies. Few bodies have many
  /// conflicts between clusters, so their first epochs are processed without speculation.
  BatchSizer(std::size_t threads, std::size_t bodies)
      : threads_(std::max<std::size_t>(threads, 1)), least_due_(std::max<std::size_t>(2048 / threads_, 128)) {
    if (bodies < 16 * least_due_) paused_ = pause_ = 15;
  }

  /// For tests: speculates wherever it may pay with any number of threads.
  static BatchSizer eager() { return {16, std::numeric_limits<std::size_t>::max()}; }

  /// Forces speculative execution of every epoch, however long it takes and however few pairs are due.
  void require_speculation() {
    must_speculate_ = true;
    least_due_ = 8;
    paused_ = 0;
  }
  bool may_decline() const { return !must_speculate_; }
  /// Returns the fewest due pairs of a batch that repay its overhead.
  std::size_t fewest_due() const { return must_speculate_ ? 1 : least_due_; }

  /// Returns true if the next epoch is processed without speculation. Consumes one paused epoch.
  bool skips_epoch() {
    if (paused_ == 0) return false;
    --paused_;
    return true;
  }
  /// Returns the maximum number of due pairs in the next batch, for a world with this number of bodies.
  std::size_t most_due(std::size_t bodies) {
    if (most_due_ == 0) most_due_ = std::max(least_due_, bodies / 32);
    return most_due_;
  }
  void begin() { first_runs_ = repeats_ = 0; }
  /// Records the execution of a cluster with `due` due pairs; `again` if it has been executed before in this
  /// batch.
  void note_run(std::size_t due, bool again) { (again ? repeats_ : first_runs_) += due; }
  /// Returns true if repeated executions exceed 8 times the first-run work (in due pairs) in this batch; the
  /// caller then falls back to advance().
  bool repeats_too_often() const {
    constexpr std::size_t too_often = 8;
    return may_decline() && repeats_ > too_often * first_runs_;
  }
  /// Doubles the batch size if repeats are less than 1/128 of the first runs, halves it if they are more than
  /// 1/48. Call at the end of a batch. A small batch has few conflicts between clusters; a large batch has
  /// its fixed costs, a few percent of the smallest batch, for more pairs. In gases, a repeated execution
  /// costs three to four times a first one, as it comes in rounds with few clusters and comparisons of their
  /// own.
  void adapt(std::size_t bodies) {
    if (128 * repeats_ < first_runs_) {
      most_due_ = std::min(2 * most_due_, std::max(least_due_, bodies));
    } else if (48 * repeats_ > first_runs_) {
      most_due_ = std::max(most_due_ / 2, least_due_);
    }
  }
  /// Pauses speculation for 1, 3, 7, ... up to 31 epochs, longer with each consecutive call, while repeats
  /// exceed the share of the first runs that the threads can make up for, and the batch was not committed or
  /// could not be smaller. Resets the pause otherwise. `done` is true if the batch was committed.
  void pause(bool done) {
    constexpr int longest = 31;
    const std::size_t share = std::max<std::size_t>(16 / threads_, 3);
    const bool repeat_much = share * repeats_ > first_runs_ && (!done || most_due_ == least_due_);
    if (first_runs_ > 0) pause_ = repeat_much ? std::min(2 * pause_ + 1, longest) : 0;
    paused_ = pause_;
  }

 private:
  bool must_speculate_ = false;
  std::size_t threads_;
  std::size_t least_due_;       ///< minimum due pairs per batch; fewer do not repay its overhead
  std::size_t most_due_ = 0;    ///< maximum due pairs per batch; 0 until most_due() is called
  std::size_t first_runs_ = 0;  ///< due pairs of first executions in this batch
  std::size_t repeats_ = 0;     ///< due pairs of repeated executions in this batch
  int pause_ = 0;               ///< length of the current pause in epochs
  int paused_ = 0;              ///< epochs of the pause that are still to come
};

}  // namespace kinesphere
