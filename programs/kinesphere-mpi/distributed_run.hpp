// `kinesphere-mpi run`: simulates a scene in a world that is spread over all ranks.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "kinesphere/distributed/mpi_session.hpp"
#include "scene_options.hpp"

namespace kinesphere::program {

struct DistributedRunOptions {
  SceneOptions scene;
  std::optional<int> threads;
  std::string contacts;
  bool file_per_rank = false;
  std::string checkpoint;
  std::optional<double> every;
  bool resume = false;
  bool hash_only = false;
  bool quiet = false;
};

/// `options` must live until the command line has been parsed.
CLI::App* add_distributed_run_command(CLI::App& program, DistributedRunOptions& options);
/// Collective. Throws SharedError. What goes wrong on one rank alone while others may wait for it ends the
/// program there and then, on all ranks.
void distributed_run(const MpiSession& session, const DistributedRunOptions& options);

}  // namespace kinesphere::program
