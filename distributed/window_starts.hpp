// WindowStarts ends and starts windows on all ranks at one time. Each rank chooses the windows of its own
// bodies, with a window policy computed from the motion statistics of all ranks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "distributed/distribution.hpp"
#include "distributed/error_consensus.hpp"
#include "processor/window_start.hpp"

namespace kinesphere {

/// Bodies added since the last run.
struct Arrivals {
  std::vector<std::uint32_t> here;  ///< bodies of this rank, in ascending order
  std::uint64_t everywhere = 0;
  // Bodies of all ranks that have a window, and those whose window end is finite.
  std::uint64_t registered = 0;
  std::uint64_t moving = 0;
  bool has_exact = false;  ///< an exact body (SpotChecks) has arrived
};

/// All functions are collective. Errors: those of probes, equal on all ranks, after which the world cannot
/// continue; those of Migration::exchange().
class WindowStarts {
 public:
  WindowStarts(Communicator& communicator, ErrorConsensus& consensus, RankState& rank_state,
               Distribution& distribution)
      : communicator_(communicator), consensus_(consensus), rank_(rank_state), distribution_(distribution) {}

  /// Ends windows and starts new ones, as World::Engine::start_windows() does. Drops ghosts whose windows
  /// end; their owners send them again. `all`: all windows end now. `joining`: added bodies of this rank that
  /// get a window in this bulk start.
  Result<void> start(PoolLease& lease, bool all, std::span<const std::uint32_t> joining);

  /// Counts added and registered bodies over all ranks, for start_with(), and finds out whether any rank has
  /// a body that is no ball.
  Arrivals count_arrivals();
  /// Does what World::Engine::start_with_arrivals() does: if many bodies were added, all windows restart
  /// together with them. Bodies that stand still, and added bodies that are too few, remain dirty.
  Result<void> start_with(const Arrivals& arrivals, PoolLease& lease);
  /// Begins an epoch that ends with the earliest window end of all ranks. Precondition: all added bodies have
  /// been recertified.
  void begin_epoch_of_arrivals();

 private:
  void choose_policy(std::span<const std::uint32_t> joining, PoolLease& lease);
  void start_main_window();
  std::vector<int> union_of(const std::vector<int>& held);

  Communicator& communicator_;
  ErrorConsensus& consensus_;
  RankState& rank_;
  Distribution& distribution_;
  std::vector<SearchResults> found_;  ///< search results by worker; kept to reuse their memory
};

}  // namespace kinesphere
