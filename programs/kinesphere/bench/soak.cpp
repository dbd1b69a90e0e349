#include "bench/soak.hpp"

#include <fmt/format.h>

#include <limits>

#include "program_error.hpp"
#include "progress.hpp"
#include "summary.hpp"
#include "validators.hpp"

namespace kinesphere::program {

void add_bench_soak_command(CLI::App& bench, SoakSettings& settings) {
  CLI::App* const command = bench.add_subcommand(
      "soak", "Feed a monitor with faulty reports for long, and hold it against the truth");
  command->add_option("--reports", settings.reports, "How many come in")
      ->check(whole_number(1'000'000'000'000, 1))
      ->capture_default_str();
  command->add_option("--tracks", settings.faults.tracks, "How many report")
      ->check(whole_number(10'000'000, 2))
      ->capture_default_str();
  command->add_option("--distance", settings.distance, "Which separation is watched (length)")
      ->check(finite_number() & CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--width", settings.faults.width, "Of the square in which tracks begin (length)")
      ->check(finite_number() & CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--seed", settings.faults.seed, "Of all random numbers")
      ->check(whole_number(std::numeric_limits<std::uint64_t>::max()))
      ->capture_default_str();
}

int bench_soak(const SoakSettings& settings) {
  Progress progress(0.0, static_cast<double>(settings.reports));
  const Soak result =
      soak(settings, [&](std::uint64_t reports) { progress.show(static_cast<double>(reports)); });
  const auto& [reports, repeated, outliers, swapped, gaps] = result.faults;
  const auto part = [&](std::uint64_t count) { return percent(double(count), double(reports)); };
  Summary summary;
  summary.row("reports", grouped(reports),
              fmt::format("of {} tracks in {} s", grouped(settings.faults.tracks), number(result.time)));
  summary.row("  late", grouped(result.counters.late), part(result.counters.late));
  summary.row("  repeated", grouped(repeated), part(repeated));
  summary.row("  outliers", grouped(outliers), part(outliers));
  summary.row("  swapped", grouped(swapped), part(swapped));
  summary.row("gaps", grouped(gaps), "in which a track was silent");
  summary.row("contradictions", grouped(result.counters.contradictions), "that the monitor has seen");
  summary.space();
  summary.row("approaches", grouped(result.approaches),
              fmt::format("nearer than {}", number(settings.distance)));
  summary.row("  missed", grouped(result.missed), "told to be apart at some time");
  summary.row("warnings", grouped(result.warnings), "of pairs that were apart before");
  summary.row("wrongly within", grouped(result.wrongly_within));
  summary.row("open in the end", grouped(result.open));
  summary.space();
  summary.row("looks", number(double(result.counters.looks) / double(reports)),
              fmt::format("for each report, and {} tracks found near one",
                          number(double(result.counters.near_pairs) / double(reports))));
  summary.row("monitor", number(1e6 * result.monitor_seconds / double(reports)), "us for each report");
  summary.row(
      "memory", grouped(result.memory / 1024),
      fmt::format("kB in the end, {} after a quarter; with the truth", grouped(result.memory_early / 1024)));
  fmt::print("{}", summary.text());
  return result.missed == 0 && result.wrongly_within == 0 ? exit_fine : exit_disagreement;
}

}  // namespace kinesphere::program
