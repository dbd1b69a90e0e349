// WindowStart provides the steps of a window start: probing, choice of windows, registration and searches.
//
// An engine calls them in this order. A process that owns some of the bodies exchanges data with the others
// between the steps (distributed/). PreparedStart calls them for parts of the bodies, before their windows
// start.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "parallel/thread_pool.hpp"
#include "processor/event_processor.hpp"
#include "processor/world_state.hpp"

namespace kinesphere {

/// Returns true if enough bodies were relocated since the last window start to restart all windows with them.
constexpr bool are_many(std::size_t arrived, std::size_t all) { return arrived > 8 && 8 * arrived > all; }

class WindowStart {
 public:
  /// A start at the present time. `found`, by worker, is passed only to reuse its memory.
  WindowStart(WorldState& state, EventProcessor& main, PoolLease& lease, std::vector<SearchResults>& found)
      : WindowStart(state, main, lease, found, state.broad_phase, main.time()) {}
  /// A start of the windows of another broad phase, at `time`, which may be later than the present.
  WindowStart(WorldState& state, EventProcessor& main, PoolLease& lease, std::vector<SearchResults>& found,
              BroadPhase& windows, double time)
      : state_(state), main_(main), lease_(lease), found_(found), windows_(windows), time_(time) {
    found_.resize(lease_.count());
  }

  /// Returns the motion statistics of bodies that have no window yet.
  MotionStatistics measure(std::span<const std::uint32_t> numbers) const;
  /// Chooses the window policy. Most bodies travel about a quarter of their spacing in the first main window.
  void choose_policy(const MotionStatistics& statistics);

  /// Probes now the bodies that will start, if a larger swept sphere would cost more than a report, and
  /// checks those whose turn it is (SpotChecks). Errors: those of probe().
  Result<void> refresh(std::span<const std::uint32_t> ending);
  /// Returns windows for bodies that have none, of rungs other than `held` (Window::free_at). A body for
  /// which there is no window is omitted and marked dirty.
  std::vector<BroadPhase::Starter> choose_windows(std::span<const std::uint32_t> numbers,
                                                  std::span<const int> held, WindowPolicy::Sample& sample);
  /// Registers swept spheres, and certifies all pairs that may change before the earlier window end. Returns
  /// the number of near pairs. If `others` is given, by number, pairs whose first body is marked there are
  /// not counted.
  std::uint64_t start(std::span<const BroadPhase::Starter> starters,
                      const std::vector<std::uint8_t>* others = nullptr);

  // The steps of start().
  /// Registers swept spheres, which BroadPhase::finish_start() sorts.
  void add_starters(std::span<const BroadPhase::Starter> starters);
  /// Searches for the slots from <= k < to below BroadPhase::started_slots(), and certifies the pairs.
  /// Returns the number of near pairs; `others` as for start().
  std::uint64_t find_pairs(std::size_t from, std::size_t to,
                           const std::vector<std::uint8_t>* others = nullptr);
  /// Certifies the pairs of bodies of `numbers` that touch or sense each other.
  void find_links(std::span<const std::uint32_t> numbers);
  void find_walls(std::span<const std::uint32_t> numbers);
  /// Moves all certificates found to the queue.
  void hand_over();

  PairCertifier certifier() const { return {state_, time_, windows_}; }

 private:
  Bodies& bodies() { return state_.bodies; }
  const Bodies& bodies() const { return state_.bodies; }

  WorldState& state_;
  EventProcessor& main_;
  PoolLease& lease_;
  std::vector<SearchResults>& found_;
  BroadPhase& windows_;
  double time_;  ///< at which the windows start
};

}  // namespace kinesphere
