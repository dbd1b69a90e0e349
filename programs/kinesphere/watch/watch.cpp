// `kinesphere watch`: reports certain facts about the separation of tracks in a stream.
#include "watch/watch.hpp"

#include <fmt/format.h>

#include <chrono>

#include "base/ascii_text.hpp"
#include "base/chart.hpp"
#include "base/output_file.hpp"
#include "base/output_paths.hpp"
#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "watch/nats/nats_address.hpp"
#include "watch/output/watch_report.hpp"
#include "watch/source/tcp_source.hpp"
#include "watch/source/udp_source.hpp"
#include "watch/watch_loop.hpp"

namespace kinesphere::program {

namespace {

/// Throws ProgramError for options that do not go together, before anything is opened.
void check(const WatchOptions& options) {
  // Not left to CLI11, which would say so before it names a misspelled option.
  if (options.separations.empty())
    throw ProgramError(
        "--separation: expected it, as sphere:50 or cylinder:5NM:1000ft: how near is too near (see --help)");
  if (!options.more_files.empty())
    throw ProgramError(fmt::format(
        "expected one stream, but got {} and {}: join them in the order of their times, as sort -m does with "
        "lines that begin with a time; kinesphere tracks {} {} --distance LENGTH reads several recordings",
        options.file, options.more_files.front(), shell_word(options.file),
        shell_word(options.more_files.front())));
  const OutputPath outputs[] = {{"--summary", options.summary},
                                {"--snapshot", options.snapshot},
                                {"--plot", options.plot},
                                {"--alerts", is_nats_address(options.alerts) ? "" : options.alerts}};
  require_svg_name(options.plot);
  const bool is_file = options.file != "-" && !is_nats_address(options.file) &&
                       !is_udp_address(options.file) && !is_tcp_address(options.file);
  const std::string inputs[] = {is_file ? options.file : ""};
  check_outputs(outputs, inputs);
}

/// Throws ProgramError for a stream of which most reports could not be used.
void check_end(const WatchLoop& watch) {
  const WatchView& view = watch.view();
  const std::uint64_t taken = view.counters().reports;
  if (view.counts.stale > taken && taken > 0 && watch.is_file())
    throw ProgramError(fmt::format(
        "{}: expected rows in the order of their times, but {} of {} reports are older than others "
        "before them by more than --forget, and were not taken: sort them first; tracks reads "
        "rows in any order",
        view.settings.source, view.counts.stale, view.counts.stale + taken));
  if (taken > 0) return;
  if (const std::string reasons = reasons_text(view); !reasons.empty())
    throw ProgramError(fmt::format(
        "{}: expected reports of format {} that can be used, but there are none: {}{}", view.settings.source,
        watch.format_name(), reasons,
        view.counts.first_malformed.empty() ? "" : "; " + view.counts.first_malformed.front().reason));
}

}  // namespace

int watch(const WatchOptions& options) {
  check(options);
  std::optional<OutputFile> summary, plot;
  if (!options.summary.empty()) summary.emplace(options.summary);
  if (!options.plot.empty()) plot.emplace(options.plot);
  WatchLoop watch(options);
  const WatchView& view = watch.view();
  const auto started = std::chrono::steady_clock::now();
  const auto conclude = [&] {
    watch.close();
    const std::vector<Warning> warnings = watch.warnings();
    const WatchEnd end{
        .format = watch.format_name(),
        .warnings = warnings,
        .real_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count()};
    if (!options.quiet) write_message(watch_summary_text(view, end));
    if (plot) {
      plot->write(watch.plot());
      plot->commit();
    }
    if (!summary) return;
    summary->write(watch_summary_json(view, end));
    summary->commit();
  };
  try {
    watch.run();
  } catch (const ProgramError&) {
    // An error that stops the watch at its first report leaves no summary.
    if (view.counters().reports > 0 || view.counts.malformed > 0) conclude();
    throw;
  }
  conclude();
  check_end(watch);
  return exit_fine;
}

}  // namespace kinesphere::program
