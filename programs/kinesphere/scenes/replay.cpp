// `kinesphere replay`: repeats a recording, and reports whether all results are equal.
#include "scenes/replay.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <span>

#include "base/help_text.hpp"
#include "base/input_file.hpp"
#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "scenes/summary.hpp"
#include "simulation/run/recorded_scene.hpp"

namespace kinesphere::program {

CLI::App* add_replay_command(CLI::App& program, ReplayOptions& options) {
  CLI::App* command = program.add_subcommand(
      "replay", "Repeat what `run --record` recorded; the first step that goes another way is named");
  command->add_option("FILE", options.file, "The recording")->required();
  command->add_flag("--hash-only", options.hash_only, "Print the hash of the contacts and nothing else");
  add_examples(*command, {"kinesphere run paper1 --record paper1.ksr", "kinesphere replay paper1.ksr",
                          "kinesphere replay paper1.ksr --hash-only"});
  return command;
}

int replay(const ReplayOptions& options) {
  const std::string bytes = read_input(options.file);
  const auto started = std::chrono::steady_clock::now();
  const auto result = kinesphere::replay(std::as_bytes(std::span(bytes)));
  const std::chrono::duration<double> real_time = std::chrono::steady_clock::now() - started;
  if (!result && result.error().code == ErrorCode::diverged) {
    print_message("kinesphere: {}: {}\n", options.file, message_of(result.error()));
    return exit_disagreement;
  }
  if (!result) throw ProgramError(fmt::format("{}: {}", options.file, message_of(result.error())));
  if (options.hash_only) {
    print("{:016x}\n", result->contact_hash);
    return exit_fine;
  }
  Summary summary;
  summary.row("recording", options.file, fmt::format("{} bytes", grouped(bytes.size())));
  summary.row("simulated", fmt::format("{} s", number(result->simulated_time)),
              fmt::format("{} body-seconds, {} bytes each", number(result->body_time),
                          number(static_cast<double>(bytes.size()) / result->body_time)));
  summary.space();
  add_events(summary, *result,
             {.ends = result->counters.count(EventKind::contact_end) > 0, .internals = true});
  summary.row("probes", grouped(result->counters.probes), "answered from the recording");
  summary.space();
  summary.row("verdict", "the same to the last bit");
  summary.row("hash", fmt::format("{:016x}", result->contact_hash));
  add_speed(summary, result->simulated_time, real_time.count());
  print("{}", summary.text(output_has_colour()));
  return exit_fine;
}

}  // namespace kinesphere::program
