// Windows end on all ranks at the same time, and new ones start. Each rank chooses those of its own bodies,
// by a tempo that is made from what all ranks have.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "distributed/distribution.hpp"
#include "distributed/error_consensus.hpp"
#include "engine/window_start.hpp"

namespace kinesphere {

/// Bodies that have been added since the last run.
struct Arrivals {
  std::vector<std::uint32_t> here;  ///< in ascending order
  std::uint64_t everywhere = 0;
  // Those of all ranks that are there already: in windows, and in windows that end.
  std::uint64_t registered = 0;
  std::uint64_t moving = 0;
};

/// All functions are collective. Errors: those of probes, the same on all ranks, after which the world cannot
/// go on; those of Transit::exchange().
class WindowStarts {
 public:
  WindowStarts(Communicator& communicator, ErrorConsensus& agreement, RankState& local,
               Distribution& distribution)
      : communicator_(communicator), agreement_(agreement), local_(local), distribution_(distribution) {}

  /// As World::Engine::start_windows(). Copies whose windows end are dropped, and come anew. `all`: all
  /// windows end now. `joining`: bodies of this rank that have arrived, and get a window with the others.
  Result<void> start(PoolLease& shift, bool all, std::span<const std::uint32_t> joining);

  /// What start_with() needs to know of all ranks.
  Arrivals count_arrivals();
  /// As World::Engine::start_with_arrivals(): where many have arrived, all windows start anew with them.
  /// Those that stand still, and few that have come, are left dirty.
  Result<void> start_with(const Arrivals& arrivals, PoolLease& shift);
  /// After all arrivals have been settled: the phase ends with the first window of all ranks that ends.
  void begin_epoch_of_arrivals();

 private:
  void choose_policy(std::span<const std::uint32_t> joining, PoolLease& shift);
  void start_main_window();
  std::vector<int> union_of(const std::vector<int>& held);

  Communicator& communicator_;
  ErrorConsensus& agreement_;
  RankState& local_;
  Distribution& distribution_;
  std::vector<SearchResults> found_;  ///< by worker; kept for its memory only
};

}  // namespace kinesphere
