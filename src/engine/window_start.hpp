// WindowStart provides the steps of a window start: probing, choice of windows, registration and searches.
//
// An engine calls them in this order. A process that owns some of the bodies exchanges data with the others
// between the steps (distributed/).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/event_processor.hpp"
#include "engine/world_state.hpp"
#include "parallel/thread_pool.hpp"

namespace kinesphere {

/// Returns true if enough bodies were relocated since the last window start to restart all windows with them.
constexpr bool are_many(std::size_t arrived, std::size_t all) { return arrived > 8 && 8 * arrived > all; }

class WindowStart {
 public:
  /// `found`, by worker, is passed only to reuse its memory.
  WindowStart(WorldState& state, EventProcessor& main, PoolLease& lease, std::vector<SearchResults>& found)
      : state_(state), main_(main), lease_(lease), found_(found) {}

  /// Returns the motion statistics of bodies that have no window yet.
  MotionStatistics measure(std::span<const std::uint32_t> numbers) const;
  /// Chooses the window policy. Most bodies travel about a quarter of their spacing in the first main window.
  void choose_policy(const MotionStatistics& statistics);

  /// Probes the bodies whose windows end, if a larger swept sphere would cost more than a report. Errors:
  /// those of probe().
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

 private:
  std::uint64_t find_pairs(const std::vector<std::uint8_t>* others);
  void find_links_and_walls(std::span<const BroadPhase::Starter> starters);
  Bodies& bodies() { return state_.bodies; }
  const Bodies& bodies() const { return state_.bodies; }
  double time() const { return main_.time(); }

  WorldState& state_;
  EventProcessor& main_;
  PoolLease& lease_;
  std::vector<SearchResults>& found_;
};

}  // namespace kinesphere
