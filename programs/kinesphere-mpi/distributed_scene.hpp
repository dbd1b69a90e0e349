// Runs a scene in a distributed world, with events in files and with checkpoints.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "checkpoint_folder.hpp"
#include "contact_files.hpp"
#include "job_clock.hpp"
#include "kinesphere/distributed/distributed_world.hpp"
#include "rank_table.hpp"
#include "ranks.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

struct DistributedSceneOptions {
  std::string scene_text;  ///< see scene_text()
  ContactOptions contacts{};
  std::string checkpoint_folder{};              ///< empty for no checkpoints
  std::optional<double> checkpoint_interval{};  ///< simulated time
  bool resume = false;
};

/// Totals over all ranks.
struct RunTotals {
  Counters counters{};
  EventHash hash{};
  std::optional<double> resumed_at{};
  double simulated_seconds = 0.0;  ///< in this run of the program
  double real_seconds = 0.0;
};

/// All functions but use() are collective, and must be called in this order. They throw SharedError on all
/// ranks; any other exception is one rank's alone.
class DistributedScene {
 public:
  /// Throws only std::bad_alloc. `workers` may be null.
  DistributedScene(const Ranks& ranks, const Scene& scene, DistributedSceneOptions options, JobClock& clock,
                   Workers* workers);

  /// Makes the world, or restores it, and opens files.
  void start();
  /// Runs to the end of the scene. Returns false if the clock has stopped it before, with a checkpoint.
  bool run();
  /// Returns the cost on this rank.
  RankUse use() const;
  RunTotals totals() const;
  /// Gives the files of events their final names.
  void commit() { contacts_->commit(); }

 private:
  void create();
  std::optional<RunState> resume();
  bool restore(std::uint64_t number, RunState& state);
  void require_same_run(const RunState& state) const;
  void tell_first(const std::string& message) const;
  std::vector<std::uint32_t> bodies_of_others() const;
  double next_checkpoint() const;
  void choose_slice(double seconds);
  void save();
  void tell_progress() const;

  const Ranks& ranks_;
  const Scene& scene_;
  DistributedSceneOptions options_;
  JobClock& clock_;
  Workers* workers_;
  std::unique_ptr<Motion> motion_;
  std::optional<DistributedWorld> world_;
  std::optional<CheckpointFolder> checkpoints_;
  std::optional<ContactFiles> contacts_;
  double slice_;  ///< the simulated time after which waiting events are written and the clock is looked at
  double saved_at_ = -std::numeric_limits<double>::infinity();  ///< simulated time of the last checkpoint
  std::optional<double> resumed_at_;
  double processor_seconds_at_start_ = 0.0;
  std::chrono::steady_clock::time_point started_{};
  std::chrono::duration<double> real_time_{};
};

}  // namespace kinesphere::program
