// `kinesphere-mpi run`: simulates a scene in a world that is distributed over all ranks.
#include "distributed_run.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <new>
#include <vector>

#include "base/output_paths.hpp"
#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "base/validators.hpp"
#include "contact_files.hpp"
#include "distributed_scene.hpp"
#include "rank_table.hpp"
#include "ranks.hpp"
#include "scene_text.hpp"
#include "scenes/summary.hpp"

namespace kinesphere::program {
namespace {

void check_options(const DistributedRunOptions& options) {
  if (!options.contacts.empty()) table_format_of(options.contacts);
  if (options.file_per_rank && options.contacts.empty())
    throw ProgramError("--file-per-rank: expected only with --contacts");
  const bool saves = options.every || options.job.checkpoint_every || options.job.time_limit;
  if (saves && options.checkpoint.empty())
    throw ProgramError("--every, --checkpoint-every and --time-limit: expected only with --checkpoint");
  if (!saves && !options.checkpoint.empty())
    throw ProgramError("--checkpoint: expected with --every, --checkpoint-every or --time-limit");
  if (options.every && *options.every <= 0.0)
    throw ProgramError(fmt::format("--every: expected a finite number > 0, but got {}", *options.every));
  if (options.resume && options.checkpoint.empty())
    throw ProgramError("--resume: expected only with --checkpoint");
}

/// Throws for features of World that a distributed world lacks.
void check_features(const Scene& scene) {
  for (const SceneBody& body : scene.bodies) {
    if (body.appears > scene.world.start_time || body.vanishes <= scene.end_time)
      throw ProgramError(
          fmt::format("{}: expected bodies that are there from start to end, as others cannot be distributed",
                      scene.name));
  }
  if (!scene.turns.empty())
    throw ProgramError(fmt::format(
        "{}: expected no bodies that turn by themselves, as these cannot be distributed", scene.name));
}

ContactOptions contact_options(const DistributedRunOptions& options) {
  if (options.contacts.empty()) return {};
  return {options.contacts, options.file_per_rank ? ContactOutput::file_per_rank : ContactOutput::one_file};
}

std::string summary_of(const SceneParameters& parameters, const Scene& scene, const RunTotals& totals,
                       const std::vector<RankUse>& use) {
  SceneResult result;
  result.counters = {totals.counters};
  result.simulated_time = scene.end_time - scene.world.start_time;
  result.body_time = result.simulated_time * static_cast<double>(scene.bodies.size());
  Summary summary;
  add_scene(summary, parameters);
  summary.row("ranks", grouped(use.size()));
  summary.row("simulated", fmt::format("{} s", number(result.simulated_time)),
              fmt::format("{} body-seconds", number(result.body_time)));
  if (totals.resumed_at) summary.row("resumed at", fmt::format("{} s", number(*totals.resumed_at)));
  summary.space();
  add_events(summary, result,
             {.ends = scene.response == SceneResponse::pass_through, .internals = scene.resting_speed > 0.0});
  summary.space();
  const std::uint64_t probes = result.counters.probes;
  summary.row("probes", grouped(probes),
              fmt::format("{} per body-second", number(static_cast<double>(probes) / result.body_time)));
  summary.space();
  summary.row("hash", fmt::format("{:016x}", totals.hash.value()));
  add_speed(summary, totals.simulated_seconds, totals.real_seconds);
  return fmt::format("{}\n{}", summary.text(), rank_table(use));
}

/// Everything prepared before ranks wait for each other.
struct Preparation {
  SceneSource source;
  Scene scene;
  ContactOptions contacts;
  std::optional<Workers> workers;
};

Preparation prepare(const Ranks& ranks, const DistributedRunOptions& options) {
  Preparation prepared;
  ranks.together(exit_wrong_input, [&] {
    check_options(options);
    prepared.source = options.scene.source();
    prepared.scene = make_scene(prepared.source);
    check_features(prepared.scene);
    prepared.contacts = contact_options(options);
    const bool is_one = !options.file_per_rank;
    const OutputPath output{"--contacts",
                            is_one ? options.contacts : fmt::format("{}.{}", options.contacts, ranks.rank())};
    check_outputs({&output, 1}, {&prepared.source.file, 1});
    if (options.threads) prepared.workers = require(Workers::create(*options.threads));
  });
  return prepared;
}

int run_scene(const Ranks& ranks, const DistributedRunOptions& options, const Preparation& prepared,
              DistributedScene& distributed) {
  distributed.start();
  if (!distributed.run()) return exit_unfinished;
  const std::vector<RankUse> use = ranks.gather(distributed.use());
  const RunTotals totals = distributed.totals();
  // A full disk must not suppress the summary.
  std::optional<SharedError> failure;
  try {
    distributed.commit();
  } catch (const SharedError& error) {
    failure = error;
  }
  ranks.on_first(1, [&] {
    if (options.hash_only) {
      print("{:016x}\n", totals.hash.value());
    } else if (!options.quiet) {
      print("{}", summary_of(prepared.source.parameters, prepared.scene, totals, use));
    }
    finish_output();
  });
  if (failure) throw SharedError(*failure);
  return exit_fine;
}

/// Tells of processes that belong together, as whoever started them says, and have not found each other: each
/// would simulate the whole scene, and write over what the others write.
void tell_if_alone(const Ranks& ranks) {
  if (ranks.count() > 1) return;
  for (const char* const name : {"SLURM_STEP_NUM_TASKS", "PMI_SIZE", "PMIX_SIZE", "OMPI_COMM_WORLD_SIZE"}) {
    const char* const tasks = std::getenv(name);
    if (tasks == nullptr || std::atoi(tasks) <= 1) continue;
    fmt::print(
        stderr,
        "kinesphere-mpi: this process is alone, but {} says {}: the others simulate the same scene; start "
        "them by mpirun, or by srun --mpi=pmix\n",
        name, tasks);
    return;
  }
}

/// Other ranks may be waiting for this one, so this ends all of them.
[[noreturn]] void end_all(const MpiSession& session, const char* message) {
  fmt::print(stderr, "kinesphere-mpi: rank {}: {}\n", session.rank(), message);
  std::fflush(stderr);
  session.abort(1);
}

}  // namespace

CLI::App* add_distributed_run_command(CLI::App& program, DistributedRunOptions& options) {
  CLI::App* command = program.add_subcommand("run", "Simulate a scene on all ranks and summarise it");
  add_scene_options(*command, options.scene);
  add_response_options(*command, options.scene);
  command->add_option("--threads", options.threads, "Accepted, without effect: each rank works on one thread")
      ->check(whole_number(Workers::most_threads, 1));
  command->add_option("--contacts", options.contacts, "Write every event to this .csv or .jsonl file")
      ->type_name("FILE");
  command->add_flag("--file-per-rank", options.file_per_rank,
                    "Each rank writes its events to FILE.<rank> instead");
  command
      ->add_option("--checkpoint", options.checkpoint,
                   "Save the world to this folder from time to time; the last two checkpoints are kept")
      ->type_name("FOLDER");
  command->add_option("--every", options.every, "Simulated time between checkpoints")->check(finite_number());
  const auto add_duration = [&](const char* name, std::optional<double>& seconds, const char* description) {
    command->add_option(name, seconds, description)
        ->type_name("DURATION")
        ->transform(CLI::AsNumberWithUnit(
            std::map<std::string, double>{{"s", 1.0}, {"min", 60.0}, {"h", 3600.0}, {"d", 86400.0}}))
        ->check(CLI::PositiveNumber);
  };
  add_duration("--checkpoint-every", options.job.checkpoint_every,
               "Real time between checkpoints, such as 30min");
  add_duration(
      "--time-limit", options.job.time_limit,
      "Stop after this real time, such as 23.5h, with a checkpoint and exit code 75; so do SIGTERM and "
      "SIGUSR1");
  add_duration("--progress", options.job.progress_every,
               "The first rank says on stderr how far the run has come, each time after this real time");
  command->add_flag(
      "--resume", options.resume,
      "Go on from the newest checkpoint in FOLDER, on any number of ranks; from the start where "
      "there is none");
  command->add_flag("--hash-only", options.hash_only, "Print the hash of the contacts and nothing else");
  command->add_flag("--quiet", options.quiet, "No summary");
  return command;
}

int distributed_run(const MpiSession& session, const DistributedRunOptions& options) {
  const Ranks ranks;
  tell_if_alone(ranks);
  JobLimits limits = options.job;
  limits.heeds_signals = !options.checkpoint.empty();
  JobClock clock(ranks, limits);
  Preparation prepared = prepare(ranks, options);
  DistributedScene distributed(ranks, prepared.scene,
                               {.scene_text = scene_text(prepared.source.parameters),
                                .contacts = prepared.contacts,
                                .checkpoint_folder = options.checkpoint,
                                .checkpoint_interval = options.every,
                                .resume = options.resume},
                               clock, prepared.workers ? &*prepared.workers : nullptr);
  try {
    return run_scene(ranks, options, prepared, distributed);
  } catch (const SharedError&) {
    throw;
  } catch (const std::bad_alloc&) {
    end_all(session, "out of memory");
  } catch (const std::exception& error) {
    end_all(session, error.what());
  }
}

}  // namespace kinesphere::program
