// The steps by which windows start: who is asked before, which windows suit, and what searches find.
//
// An engine takes them in this order. One that has a part of the bodies learns in between what the others
// have (distributed/).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/event_processor.hpp"
#include "engine/world_state.hpp"
#include "parallel/thread_pool.hpp"

namespace kinesphere {

/// Where so many have arrived since windows started, among so many, all start anew with them.
constexpr bool are_many(std::size_t arrived, std::size_t all) { return arrived > 8 && 8 * arrived > all; }

class WindowStart {
 public:
  /// `found`, by worker, is kept for its memory only.
  WindowStart(WorldState& tables, EventProcessor& main, PoolLease& shift, std::vector<SearchResults>& found)
      : state_(tables), main_(main), lease_(shift), found_(found) {}

  /// Bodies of which nothing is known yet.
  MotionStatistics survey(std::span<const std::uint32_t> numbers) const;
  /// The first main window lets most of them go about a quarter of the distance between them.
  void choose_policy(const MotionStatistics& statistics);

  /// Of bodies whose windows end, probes those for whom a larger capsule would cost more.
  Result<void> refresh(std::span<const std::uint32_t> ending);
  /// The windows that suit bodies which are in none, other than those of the tiers `held`
  /// (Window::free_at). For some there may be no window: they are dirty then.
  std::vector<BroadPhase::Starter> choose_windows(std::span<const std::uint32_t> numbers,
                                                  std::span<const int> held, WindowPolicy::Sample& round);
  /// They get capsules, and all pairs that may change before a window ends become hot. Returns how many pairs
  /// are near. With `others`, by number, pairs are not counted whose first body is one of these.
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
