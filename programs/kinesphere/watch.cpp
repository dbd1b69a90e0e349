// `kinesphere watch`: what is certain about the separation of tracks that a stream reports.
#include "watch.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>

#include "output_file.hpp"
#include "output_paths.hpp"
#include "program_error.hpp"
#include "standard_output.hpp"
#include "validators.hpp"
#include "watch/file_source.hpp"
#include "watch/record_cutter.hpp"
#include "watch/state_server.hpp"
#include "watch/stop_signals.hpp"
#include "watch/watch_options.hpp"
#include "watch/watch_report.hpp"
#include "watch/watcher.hpp"

namespace kinesphere::program {
namespace {

/// Alerts go out when what they rest upon has been taken.
class AlertOutput {
 public:
  void write(std::string_view line) {
    write_output(line);
    is_open_ = true;
  }
  void flush() {
    if (is_open_) finish_output();
    is_open_ = false;
  }

 private:
  bool is_open_ = false;
};

FileTime machine_time() {
  using namespace std::chrono;
  const auto since_1970 = system_clock::now().time_since_epoch();
  const auto whole = floor<seconds>(since_1970);
  return {whole.count(), duration<double>(since_1970 - whole).count()};
}

/// Reads until the stream's first line has come in, and says what it is.
StreamFormat format_of(const WatchOptions& options, ReportSource& source, RecordCutter& cutter,
                       const StopSignals& stop) {
  if (!options.format.empty()) return *stream_format_named(options.format);
  bool has_ended = false;
  std::string_view text;
  // A first line of one document may be long: its beginning says enough.
  constexpr std::size_t enough = 4096;
  while (!has_ended && !stop.asked()) {
    const std::string_view waiting = cutter.waiting();
    const std::size_t begin = waiting.find_first_not_of(" \t\r\n");
    if (begin != std::string_view::npos &&
        (waiting.find('\n', begin) != std::string_view::npos || waiting.size() > enough))
      break;
    const auto outcome = source.next(std::chrono::milliseconds(1000), text);
    has_ended = outcome == ReportSource::Outcome::end;
    if (outcome == ReportSource::Outcome::text) cutter.feed(text);
  }
  // By the columns that an option names it is a table.
  if (!options.choices.columns.empty()) return StreamFormat::csv;
  const std::string_view beginning = cutter.waiting();
  if (const auto format = recognised_format(beginning)) return *format;
  if (stop.asked()) return StreamFormat::jsonl;
  if (beginning.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw ProgramError(fmt::format("{}: expected reports, but it is empty", source.name()));
  if (beginning.find("!AIVDM") != std::string_view::npos ||
      beginning.find("!AIVDO") != std::string_view::npos)
    throw ProgramError(fmt::format(
        "{}: raw NMEA of AIS is not read: decode it first, with gpsdecode for example (docs/watch.md)",
        source.name()));
  throw ProgramError(fmt::format("{}: expected one of the formats {}: say which with --format", source.name(),
                                 stream_format_names));
}

FormatChoices choices_of(const WatchOptions& options) {
  FormatChoices choices = options.choices;
  choices.position_error_is_said = !options.position_error.empty();
  return choices;
}

/// A stream that is read to its end.
class Watch {
 public:
  explicit Watch(const WatchOptions& options)
      : options_(options),
        source_(std::make_unique<FileSource>(options.file, stop_)),
        format_(format_of(options, *source_, cutter_, stop_)),
        watcher_(settings_of(options, format_, source_->name()),
                 [this](std::string_view line) { output_.write(line); }),
        reader_(make_format(format_, choices_of(options))) {
    cutter_.set_kind(records_of(format_));
    if (!options.serve) return;
    server_ = std::make_unique<StateServer>(watcher_, *options.serve);
    fmt::print(stderr, "kinesphere: {}state.json and {}metrics\n", server_->address(), server_->address());
  }

  void run() {
    const bool by_machine = watcher_.settings().clock == WatchSettings::Clock::machine;
    // So often alerts come by the passing of time alone.
    const std::chrono::milliseconds patience(by_machine ? 50 : 1000);
    bool has_ended = false;
    for (;;) {
      // What has come in is taken, even when the program is asked to stop meanwhile.
      while (const auto record = cutter_.next()) read(*record);
      if (has_ended || stop_.asked()) break;
      std::string_view text;
      const auto outcome = source_->next(patience, text);
      has_ended = outcome == ReportSource::Outcome::end;
      if (outcome == ReportSource::Outcome::text) cutter_.feed(text);
      if (by_machine && outcome == ReportSource::Outcome::quiet) pass_time();
    }
    if (has_ended) {
      if (const auto last = cutter_.rest()) read(*last);
    }
    const auto guard = guarded();
    watcher_.finish();
    output_.flush();
  }

  const Watcher& watcher() const { return watcher_; }
  StreamFormat format() const { return format_; }
  /// No more is served.
  void close() { server_.reset(); }

 private:
  /// Holds off whoever asks for the state.
  std::unique_lock<StateServer> guarded() {
    return server_ ? std::unique_lock(*server_) : std::unique_lock<StateServer>();
  }

  void read(const Record& record) {
    const auto guard = guarded();
    if (watcher_.settings().clock == WatchSettings::Clock::machine) watcher_.machine_time_is(machine_time());
    watcher_.begin_record(record.line);
    const std::uint64_t malformed = watcher_.counts().malformed;
    try {
      reader_->read(record, watcher_);
    } catch (const MalformedRecord& error) {
      watcher_.refuse(error.what());
    }
    watcher_.end_record();
    output_.flush();
    if (watcher_.counts().malformed > malformed) complain();
  }

  void pass_time() {
    const auto guard = guarded();
    watcher_.machine_time_is(machine_time());
    watcher_.end_record();
    output_.flush();
  }

  void complain() {
    const auto& lines = watcher_.counts().first_malformed;
    for (; complaints_ < lines.size() && !options_.quiet; ++complaints_)
      fmt::print(stderr, "kinesphere: warning: {}:{}: {}\n", source_->name(), lines[complaints_].line,
                 lines[complaints_].reason);
  }

  const WatchOptions& options_;
  StopSignals stop_;
  std::unique_ptr<ReportSource> source_;
  RecordCutter cutter_;
  StreamFormat format_;
  AlertOutput output_;
  Watcher watcher_;
  std::unique_ptr<ReportFormat> reader_;
  std::unique_ptr<StateServer> server_;
  std::size_t complaints_ = 0;
};

}  // namespace

CLI::App* add_watch_command(CLI::App& program, WatchOptions& options) {
  CLI::App* command = program.add_subcommand(
      "watch", "Tell what is certain about the separation of tracks in a stream of reports");
  command->footer("docs/watch.md explains the formats, the alerts, and what is certain about them.");
  command->add_option("FILE", options.file, "The stream, plain or gzipped; - for standard input")
      ->capture_default_str();
  command
      ->add_option(
          "--separation", options.separations,
          "What is watched for, once or several times: sphere:50, cylinder:5NM:1000ft, ellipsoid:5NM:1000ft")
      ->required()
      ->expected(1)
      ->take_all()
      ->type_name("SHAPE");
  command
      ->add_option("--format", options.format, "The format, where the stream's first line does not show it")
      ->check(CLI::Validator(
          [](const std::string& text) {
            return stream_format_named(text)
                       ? std::string()
                       : fmt::format("expected one of {}, but got '{}'", stream_format_names, text);
          },
          "", "format"))
      ->type_name(stream_format_names);
  command
      ->add_option("--columns", options.choices.columns,
                   "Of csv: where what is, by name or number from 1, and its unit: "
                   "id=...,time=...,lat=...,alt=NAME:ft")
      ->type_name("LIST");
  command->add_option("--dimensions", options.dimensions, "2 or 3; else as the format has heights or not")
      ->check(CLI::Range(2, 3));
  const auto measure = [command](const std::string& name, std::string& value, const std::string& description,
                                 const char* type, const char* group) {
    command->add_option(name, value, description)->type_name(type)->group(group);
  };
  const char* const promises = "What tracks promise";
  measure("--acceleration", options.acceleration,
          "No acceleration is larger: one number, or horizontal:vertical", "NUMBER[:NUMBER]", promises);
  measure("--largest-speed", options.largest_speed, "No speed is larger: one number, or horizontal:vertical",
          "NUMBER[:NUMBER]", promises);
  measure("--silence", options.silence, "A track of which nothing is heard for so long is told of", "TIME",
          promises);
  measure("--forget", options.forget, "A track of which nothing is heard for so long leaves", "TIME",
          promises);
  const char* const errors = "How far off reports are at most";
  command
      ->add_option("--containment", options.choices.containment,
                   "So many times an accuracy of 95 % (nac_p, nac_v, gva) is declared to contain all errors")
      ->check(finite_number())
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str()
      ->group(errors);
  measure("--position-error", options.position_error,
          "Where the stream has none: one number, or horizontal:vertical", "NUMBER[:NUMBER]", errors);
  measure("--velocity-error", options.velocity_error,
          "Where the stream has none: one number, or horizontal:vertical", "NUMBER[:NUMBER]", errors);
  measure("--stamp-error", options.stamp_error, "Where the stream has none", "TIME", errors);
  command
      ->add_option_function<std::string>(
          "--position-bound",
          [&options](const std::string& text) {
            options.choices.position_bound = text == "nac_p"
                                                 ? FormatChoices::PositionBound::accuracy
                                                 : FormatChoices::PositionBound::containment_radius;
          },
          "Of readsb: which of the two bounds positions, where there are both")
      ->check(CLI::IsMember({"rc", "nac_p"}))
      ->default_str("rc")
      ->group(errors);
  command
      ->add_option_function<std::string>(
          "--altitude",
          [&options](const std::string& text) {
            options.choices.altitude = text == "geometric" ? FormatChoices::Altitude::geometric
                                                           : FormatChoices::Altitude::barometric;
          },
          "Of aircraft: which altitude is their height")
      ->check(CLI::IsMember({"barometric", "geometric"}))
      ->default_str("barometric")
      ->group(errors);
  const char* const map = "Latitudes and longitudes";
  measure("--origin", options.origin, "The middle of the map; the first position when not given", "LAT,LON",
          map);
  measure("--radius", options.radius, "Reports from farther off are not taken; 500 km when not given",
          "LENGTH", map);
  const char* const reading = "Reading";
  command
      ->add_option("--clock", options.clock,
                   "What time it is: as the stream tells, its stamps, or this machine's clock")
      ->check(CLI::IsMember({"stream", "stamps", "arrival"}))
      ->capture_default_str()
      ->group(reading);
  measure("--leap", options.leap,
          "A time that is ahead by more is not believed unless others confirm it; 60 s when not given",
          "TIME", reading);
  command
      ->add_option("--most-malformed", options.most_malformed,
                   "More malformed lines end it; any number when not given")
      ->check(whole_number(std::uint64_t{1} << 53))
      ->group(reading);
  command->add_option("--summary", options.summary, "Write the summary to this file, as JSON")
      ->type_name("FILE");
  command
      ->add_option("--serve", options.serve,
                   "Serve the state and metrics on this port of 127.0.0.1; 0 for any that is free")
      ->check(CLI::Range(0, 65535))
      ->type_name("PORT");
  command->add_flag("--quiet", options.quiet, "No summary and no warnings on standard error");
  return command;
}

int watch(const WatchOptions& options) {
  const OutputPath outputs[] = {{"--summary", options.summary}};
  const std::string inputs[] = {options.file == "-" ? "" : options.file};
  check_outputs(outputs, inputs);
  Watch watch(options);
  std::optional<OutputFile> summary;
  if (!options.summary.empty()) summary.emplace(options.summary);
  const auto started = std::chrono::steady_clock::now();
  const auto conclude = [&] {
    watch.close();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    const std::string_view format = name_of(watch.format());
    if (!options.quiet) fmt::print(stderr, "{}", watch_summary_text(watch.watcher(), format, seconds));
    if (!summary) return;
    summary->write(watch_summary_json(watch.watcher(), format, seconds));
    summary->commit();
  };
  try {
    watch.run();
  } catch (const ProgramError&) {
    // What a wrong option stops at the first report has no summary.
    if (watch.watcher().monitor_counters().reports > 0 || watch.watcher().counts().malformed > 0) conclude();
    throw;
  }
  conclude();
  const WatchCounts& counts = watch.watcher().counts();
  if (counts.malformed > 0 && watch.watcher().monitor_counters().reports == 0)
    throw ProgramError(fmt::format("{}: expected reports of format {}, but there are none, and {} malformed",
                                   watch.watcher().settings().source, name_of(watch.format()),
                                   counts.malformed));
  return exit_fine;
}

}  // namespace kinesphere::program
