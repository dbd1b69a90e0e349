// `kinesphere-mpi run`: simulates a scene in a world that is distributed over all ranks.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "job_clock.hpp"
#include "kinesphere/distributed/mpi_session.hpp"
#include "scenes/scene_options.hpp"

namespace kinesphere::program {

struct DistributedRunOptions {
  SceneOptions scene;
  std::optional<int> threads;
  std::string contacts;
  bool file_per_rank = false;
  std::string checkpoint;
  std::optional<double> every;
  JobLimits job;
  bool resume = false;
  bool hash_only = false;
  bool quiet = false;
};

/// `options` must live until the command line has been parsed.
CLI::App* add_distributed_run_command(CLI::App& program, DistributedRunOptions& options);
/// Collective. Returns the exit code: exit_unfinished if the run has stopped with a checkpoint before its
/// end. Throws SharedError. An error of one rank, for which others may be waiting, ends the program on all
/// ranks at once.
int distributed_run(const MpiSession& session, const DistributedRunOptions& options);

}  // namespace kinesphere::program
