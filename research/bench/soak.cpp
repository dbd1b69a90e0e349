#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "base/program_error.hpp"
#include "base/progress.hpp"
#include "base/standard_output.hpp"
#include "base/validators.hpp"
#include "research/bench/commands.hpp"
#include "research/monitoring/soak.hpp"
#include "scenes/summary.hpp"

namespace kinesphere::program {
namespace {

struct SoakOptions {
  SoakSettings settings;
  bool write = false;  ///< write the reports, for `kinesphere watch`
  std::string alerts;  ///< file with the alerts of `kinesphere watch` on these reports
};

/// Lines of output for each line that is cut off; fewer would test the reader more and the monitor less.
constexpr std::uint64_t lines_between_malformed = 1000;

int write_reports(const SoakSettings& settings) {
  FaultyReports reports(settings.faults);
  std::string line;
  std::uint64_t malformed = 0;
  for (std::uint64_t k = 0; k < settings.reports; ++k) {
    const auto [time, track, report] = reports.next();
    const auto& [position, velocity] = report.state;
    line = fmt::format(
        R"({{"id":"{}","stamp":{},"arrival":{},"position":[{},{},{}],"velocity":[{},{},{}],"position_error":{},)"
        R"("velocity_error":{},"stamp_error":{}}})",
        track, report.timestamp, time, position.x, position.y, position.z, velocity.x, velocity.y, velocity.z,
        report.position_error.total(), report.velocity_error.total(), report.timestamp_error);
    // The cut-off line is an extra one: the whole report follows it.
    if (k % lines_between_malformed == lines_between_malformed / 2) {
      ++malformed;
      write_output(line.substr(0, line.size() / 2) + "\n");
    }
    write_output(line + "\n");
  }
  finish_output();
  print_message("{} reports, {} malformed lines, {} repeated, {} outliers, {} swapped, {} gaps\n",
                reports.counts().reports, malformed, reports.counts().repeated, reports.counts().outliers,
                reports.counts().swapped, reports.counts().gaps);
  return exit_fine;
}

Verdict verdict_named(const std::string& name) {
  for (const Verdict verdict : {Verdict::apart, Verdict::undecided, Verdict::within})
    if (name == name_of(verdict)) return verdict;
  throw ProgramError(fmt::format("expected a verdict, but got '{}'", name));
}

/// Returns the track of a name. Tracks of the soak are numbered from 0.
TrackId track_named(const std::string& name, std::uint64_t tracks) {
  TrackId id = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), id);
  if (error != std::errc{} || end != name.data() + name.size() || id >= tracks)
    throw ProgramError(fmt::format(
        "expected a track from 0 to {}, but got '{}': is --tracks that of --write?", tracks - 1, name));
  return id;
}

/// Returns the verdict of an alert; nothing for an alert of another kind. `end` is the time of the last
/// report. Throws ProgramError.
std::optional<MonitorEvent> verdict_of(const std::string& line, const SoakSettings& settings, double end) {
  const nlohmann::json alert = nlohmann::json::parse(line);
  if (alert.at("event") != "verdict") return std::nullopt;
  const double time = alert.at("time");
  if (time < 0.0 || time > end)
    throw ProgramError(
        fmt::format("expected a time from 0 to {}, when the last report comes in, but got {}: are the other "
                    "options those of --write?",
                    number(end), number(time)));
  return MonitorEvent{.time = time,
                      .kind = MonitorEventKind::verdict,
                      .first = track_named(alert.at("first"), settings.faults.tracks),
                      .second = track_named(alert.at("second"), settings.faults.tracks),
                      .verdict = verdict_named(alert.at("verdict")),
                      .before = verdict_named(alert.at("before"))};
}

struct ReadAlerts {
  std::uint64_t lines = 0;
  /// Sorted by time. In the file, only the lines of one pair have to be: several watches that share the pairs
  /// write between each other's lines.
  std::vector<MonitorEvent> verdicts;
};

/// Reads the alerts. Throws ProgramError with the number of a line that is no alert of the soak.
ReadAlerts read_alerts(const std::string& path, const SoakSettings& settings, double end) {
  std::ifstream file(path);
  if (!file) throw ProgramError(path + " cannot be read");
  ReadAlerts read;
  std::string line;
  while (std::getline(file, line)) {
    ++read.lines;
    const auto fail = [&](const char* why) {
      throw ProgramError(fmt::format("{}:{}: {}", path, read.lines, why));
    };
    try {
      if (const auto verdict = verdict_of(line, settings, end)) read.verdicts.push_back(*verdict);
    } catch (const nlohmann::json::exception&) {
      fail("expected an alert of kinesphere watch");
    } catch (const ProgramError& error) {
      fail(error.what());
    }
  }
  std::stable_sort(read.verdicts.begin(), read.verdicts.end(),
                   [](const MonitorEvent& one, const MonitorEvent& other) { return one.time < other.time; });
  return read;
}

void add_rows(Summary& summary, const VerdictCounts& found, const SoakSettings& settings) {
  summary.row("approaches", grouped(found.approaches),
              fmt::format("nearer than {}", number(settings.distance)));
  summary.row("  missed", grouped(found.missed), "told to be apart at some time");
  summary.row("warnings", grouped(found.warnings), "of pairs that were apart before");
  summary.row("wrongly within", grouped(found.wrongly_within));
}

int exit_code_of(const VerdictCounts& found) {
  return found.missed == 0 && found.wrongly_within == 0 ? exit_fine : exit_disagreement;
}

int compare_alerts(const SoakOptions& options) {
  const SoakSettings& settings = options.settings;
  FaultyReports reports(settings.faults);
  double end = 0.0;
  VerdictCheck check(settings.faults, reports.motion(), settings.distance, settings.tolerance);
  for (std::uint64_t k = 0; k < settings.reports; ++k) end = reports.next().time;
  const ReadAlerts alerts = read_alerts(options.alerts, settings, end);
  check.compare(end, alerts.verdicts);
  Summary summary;
  summary.row("alerts", grouped(alerts.lines));
  add_rows(summary, check.counts(), settings);
  fmt::print("{}", summary.text());
  return exit_code_of(check.counts());
}

int bench_soak(const SoakOptions& options) {
  if (options.write) return write_reports(options.settings);
  if (!options.alerts.empty()) return compare_alerts(options);
  const SoakSettings& settings = options.settings;
  Progress progress(0.0, static_cast<double>(settings.reports));
  const Soak result =
      soak(settings, [&](std::uint64_t reports) { progress.show(static_cast<double>(reports)); });
  const auto& [reports, repeated, outliers, swapped, gaps] = result.faults;
  const auto part = [all = double(result.faults.reports)](std::uint64_t count) {
    return percent(double(count), all);
  };
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
  add_rows(summary, result.verdicts, settings);
  summary.row("open in the end", grouped(result.open));
  summary.space();
  summary.row("looks", number(double(result.counters.rechecks) / double(reports)),
              fmt::format("for each report, and {} tracks found near one",
                          number(double(result.counters.near_pairs) / double(reports))));
  summary.row("monitor", number(1e6 * result.monitor_seconds / double(reports)), "us for each report");
  summary.row(
      "memory", grouped(result.memory / 1024),
      fmt::format("kB in the end, {} after a quarter; with the truth", grouped(result.memory_early / 1024)));
  fmt::print("{}", summary.text());
  return exit_code_of(result.verdicts);
}

}  // namespace

Command add_soak(CLI::App& app) {
  const auto options = std::make_shared<SoakOptions>();
  SoakSettings& settings = options->settings;
  CLI::App* const command = app.add_subcommand(
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
  CLI::Option* const write = command->add_flag(
      "--write", options->write,
      "Only write the reports to standard output, some lines cut off, for `kinesphere watch`");
  command
      ->add_option(
          "--alerts", options->alerts,
          "Only compare the alerts of `kinesphere watch` with the truth; the other options as in --write")
      ->excludes(write);
  return {command, [options] { return bench_soak(*options); }};
}

}  // namespace kinesphere::program
