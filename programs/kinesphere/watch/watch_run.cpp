// One run of a watch: a stream that is read to its end, or until the program is asked to stop.
#include "watch/watch_run.hpp"

#include <fmt/format.h>

#include "program_error.hpp"
#include "watch/file_source.hpp"
#include "watch/nats/nats_streams.hpp"
#include "watch/watch_options.hpp"

namespace kinesphere::program {
namespace {

FileTime machine_time() {
  using namespace std::chrono;
  const auto since_1970 = system_clock::now().time_since_epoch();
  const auto whole = floor<seconds>(since_1970);
  return {whole.count(), duration<double>(since_1970 - whole).count()};
}

std::optional<WatchSnapshot> snapshot_of(const WatchOptions& options) {
  if (options.snapshot.empty()) return std::nullopt;
  auto snapshot = read_snapshot(options.snapshot);
  if (!snapshot) return std::nullopt;
  check_options(options.snapshot, snapshot->options, given_options(options));
  if (!options.format.empty() && options.format != snapshot->format)
    throw ProgramError(fmt::format("--format: expected it as it was for the snapshot {}, {}, but got {}",
                                   options.snapshot, snapshot->format, options.format));
  return snapshot;
}

std::unique_ptr<ReportSource> source_of(const WatchOptions& options, const StopSignals& stop,
                                        const std::optional<WatchSnapshot>& snapshot) {
  const StreamPlace* const from = snapshot ? &snapshot->place : nullptr;
  if (is_nats_address(options.file))
    return make_nats_source(parse_nats_address(options.file, "FILE"), stop, options.clock == "arrival", from);
  return std::make_unique<FileSource>(options.file, stop, from);
}

std::unique_ptr<AlertOutput> alerts_of(const WatchOptions& options, const StopSignals& stop,
                                       const std::optional<WatchSnapshot>& snapshot) {
  if (options.alerts.empty()) return make_alert_lines();
  if (is_nats_address(options.alerts))
    return make_nats_alerts(parse_nats_address(options.alerts, "--alerts"), stop);
  const bool goes_on = snapshot && snapshot->alerts == options.alerts;
  return make_alert_file(options.alerts, goes_on ? snapshot->alert_bytes : 0);
}

/// Reads until the stream's first line has come in, and says what it is.
StreamFormat format_of(const WatchOptions& options, const std::optional<WatchSnapshot>& snapshot,
                       ReportSource& source, RecordCutter& cutter, const StopSignals& stop) {
  const std::string& said = snapshot ? snapshot->format : options.format;
  if (!said.empty()) return stream_format_named(said).value();
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

}  // namespace

WatchRun::WatchRun(const WatchOptions& options)
    : options_(options),
      begun_from_(snapshot_of(options)),
      source_(source_of(options, stop_, begun_from_)),
      format_(format_of(options, begun_from_, *source_, cutter_, stop_)),
      alerts_(alerts_of(options, stop_, begun_from_)),
      watcher_(settings_of(options, format_, source_->name()),
               [this](std::uint64_t share, std::string_view line) { alerts_->write(share, line); }),
      reader_(make_format(format_, choices_of(options))),
      snapshot_interval_(snapshot_interval(options)) {
  cutter_.set_kind(records_of(format_));
  if (begun_from_) {
    try {
      watcher_.restore(begun_from_->watcher);
      // What another stream begins with is not what this one began with.
      if (begun_from_->place.stream == source_->name()) {
        reader_->restore(begun_from_->reader);
        cutter_.begin_at(begun_from_->line);
      }
    } catch (const nlohmann::json::exception&) {
      throw ProgramError(
          fmt::format("{}: expected a snapshot of kinesphere watch, but it is none", options.snapshot));
    }
    complaints_ = watcher_.counts().first_malformed.size();
    begun_from_.reset();
  }
  if (!options.serve) return;
  server_ = std::make_unique<StateServer>(watcher_, *options.serve);
  fmt::print(stderr, "kinesphere: the map is at {} (beside it: state.json, metrics)\n", server_->address());
}

void WatchRun::run() {
  const bool by_machine = watcher_.settings().clock == WatchSettings::Clock::machine;
  // So often alerts come by the passing of time alone.
  const std::chrono::milliseconds patience(by_machine ? 50 : 1000);
  bool has_ended = false;
  // What has come in is taken, even when the program is asked to stop meanwhile.
  take();
  while (!has_ended && !stop_.asked()) {
    std::string_view text;
    const auto outcome = source_->next(patience, text);
    has_ended = outcome == ReportSource::Outcome::end;
    if (outcome == ReportSource::Outcome::text) {
      cutter_.feed(text);
      take();
    }
    const bool is_later = source_->has_clock() ? outcome == ReportSource::Outcome::text
                                               : outcome == ReportSource::Outcome::quiet;
    if (by_machine && is_later) pass_time();
    if (std::chrono::steady_clock::now() - last_snapshot_ > snapshot_interval_) keep_snapshot();
  }
  // A later run reads what may not be whole again.
  keep_snapshot();
  if (has_ended) {
    if (const auto last = cutter_.rest()) read(*last);
  }
  // A stream that others read, too, goes on.
  if (!has_ended && source_->has_clock()) return;
  const auto guard = guarded();
  watcher_.finish();
  flush();
}

std::unique_lock<StateServer> WatchRun::guarded() {
  return server_ ? std::unique_lock(*server_) : std::unique_lock<StateServer>();
}

void WatchRun::take() {
  while (const auto record = cutter_.next()) read(*record);
}

void WatchRun::read(const Record& record) {
  const auto guard = guarded();
  if (watcher_.settings().clock == WatchSettings::Clock::machine) watcher_.machine_time_is(now());
  watcher_.begin_record(record.line);
  const std::uint64_t malformed = watcher_.counts().malformed;
  try {
    reader_->read(record, watcher_);
  } catch (const MalformedRecord& error) {
    watcher_.refuse(error.what());
  }
  watcher_.end_record();
  flush();
  if (watcher_.counts().malformed > malformed) complain();
}

void WatchRun::pass_time() {
  const auto guard = guarded();
  watcher_.machine_time_is(now());
  watcher_.end_record();
  flush();
}

FileTime WatchRun::now() const { return source_->has_clock() ? source_->arrival() : machine_time(); }

void WatchRun::flush() { alerts_->flush(source_->position()); }

void WatchRun::complain() {
  const auto& lines = watcher_.counts().first_malformed;
  for (; complaints_ < lines.size() && !options_.quiet; ++complaints_)
    fmt::print(stderr, "kinesphere: warning: {}:{}: {}\n", source_->name(), lines[complaints_].line,
               lines[complaints_].reason);
}

void WatchRun::keep_snapshot() {
  if (options_.snapshot.empty()) return;
  WatchSnapshot snapshot{.options = given_options(options_),
                         .format = std::string(name_of(format_)),
                         .place = source_->place(cutter_.waiting().size()),
                         .line = cutter_.line(),
                         .reader = reader_->save(),
                         .watcher = watcher_.save(),
                         .alerts = options_.alerts,
                         .alert_bytes = alerts_->sync()};
  write_snapshot(options_.snapshot, snapshot);
  last_snapshot_ = std::chrono::steady_clock::now();
}

}  // namespace kinesphere::program
