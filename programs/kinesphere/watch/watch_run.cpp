// One run of a watch, until the stream ends or the program is asked to stop.
#include "watch/watch_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "formats/nmea/nmea_line.hpp"
#include "formats/recordings/file_kind.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "watch/class_rules.hpp"
#include "watch/file_source.hpp"
#include "watch/nats/nats_streams.hpp"
#include "watch/tcp_source.hpp"
#include "watch/udp_source.hpp"
#include "watch/watch_options.hpp"
#include "watch/watch_report.hpp"

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
  const std::string& said = options.choices.hints.format;
  if (!said.empty() && format_named(said) != format_named(snapshot->format))
    throw ProgramError(fmt::format("--format: expected it as it was for the snapshot {}, {}, but got {}",
                                   options.snapshot, snapshot->format, said));
  return snapshot;
}

/// Says how to read from an address of a kind that other programs read.
void refuse_address(const std::string& file) {
  if (file.starts_with("http://") || file.starts_with("https://"))
    throw ProgramError(fmt::format(
        "{}: expected a file, -, or an address tcp://, udp:// or nats://: say while sleep 1; do curl "
        "-s {}; done | kinesphere watch --clock arrival -",
        file, shell_word(file)));
}

std::unique_ptr<ReportSource> source_of(const WatchOptions& options, const StopSignals& stop,
                                        const std::optional<WatchSnapshot>& snapshot) {
  const StreamPlace* const from = snapshot ? &snapshot->place : nullptr;
  if (is_udp_address(options.file))
    return make_udp_source(parse_udp_address(options.file), stop, options.quiet);
  if (is_tcp_address(options.file))
    return make_tcp_source(parse_tcp_address(options.file), stop, options.quiet, from);
  if (is_nats_address(options.file))
    return make_nats_source(parse_nats_address(options.file, "FILE"), stop, options.clock == "arrival",
                            options.quiet, from);
  refuse_address(options.file);
  return std::make_unique<FileSource>(options.file, stop, from);
}

/// Returns the name by which a later run recognises the destination of alerts.
std::string alerts_name(const WatchOptions& options) {
  if (options.alerts.empty()) return {};
  if (is_nats_address(options.alerts)) return parse_nats_address(options.alerts, "--alerts").name;
  return std::filesystem::absolute(options.alerts).lexically_normal().string();
}

/// Returns a word for the origin of alerts: equal for all readers of one stream with equal settings, whatever
/// their shares; unique if the stream cannot be read again.
std::string alerts_origin(const WatchOptions& options, const WatchSettings& settings,
                          const ReportSource& source) {
  const auto identity = source.identity();
  const bool is_the_same = settings.clock != WatchSettings::Clock::machine || source.has_clock();
  if (!identity || !is_the_same) {
    std::random_device random;
    return fmt::format("{:08x}{:08x}", random(), random());
  }
  std::string text = fmt::format("{}\n{}", *identity, settings.share.of);
  for (const auto& [option, given] : given_options(options))
    if (option != "--share") text += fmt::format("\n{} {}", option, given);
  return fmt::format("{:016x}", track_id_of(text));
}

/// Returns the format of a stream with this beginning; nothing while more text may tell. `is_enough`: no more
/// comes, or none is needed. Throws ProgramError for what is no stream of reports.
std::optional<StreamFormat> format_by(std::string_view beginning, const WatchOptions& options,
                                      const ReportSource& source, bool is_enough) {
  if (beginning.starts_with("\xEF\xBB\xBF")) beginning.remove_prefix(3);
  if (beginning.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    if (is_enough) throw ProgramError(fmt::format("{}: expected reports, but it is empty", source.name()));
    return std::nullopt;
  }
  if (first_line(beginning).empty() && !is_enough) return std::nullopt;
  const auto refuse = [&](std::string_view kind) {
    throw ProgramError(fmt::format("{}: expected a stream of reports, but it is {}", source.name(), kind));
  };
  const std::string other_kind = other_file_kind(beginning);
  const auto shown = recognised_format(beginning);
  // Noise of a line may have zero bytes, too.
  const bool has_zeros = beginning.find('\0') != std::string_view::npos;
  if (has_zeros && (!other_kind.empty() || !shown)) refuse(other_kind.empty() ? "not text" : other_kind);
  const ColumnHints& hints = options.choices.hints;
  const auto format = format_of_text(beginning, hints);
  if (format == StreamFormat::recording) {
    const bool is_live = source.nature() == ReportSource::Nature::live;
    // Of a service that is asked again and again, each list is read when it comes.
    const bool is_pipe_of_now =
        source.nature() == ReportSource::Nature::unknown && options.clock == "arrival";
    if (is_json_list(beginning) && (is_live || is_pipe_of_now)) return StreamFormat::json;
    if (!is_live) return format;
    // Sentences of AIS may follow those of a receiver of GPS.
    if (shown == StreamFormat::nmea) return shown;
    refuse(fmt::format("{}, which is read as a whole: from a file, or a pipe that ends",
                       recording_kind_of(beginning, hints)->name));
  }
  const bool is_certain = format == StreamFormat::json || !hints.columns.empty();
  if (format && (is_certain || !is_table(*format))) return format;
  // Some other files look like tables.
  if (!other_kind.empty() && (format || is_enough)) refuse(other_kind);
  return format || !is_enough ? format : StreamFormat::csv;
}

/// Reads until the text shows its format, and returns it; nothing if the program is asked to stop before.
std::optional<StreamFormat> format_of(const WatchOptions& options,
                                      const std::optional<WatchSnapshot>& snapshot, ReportSource& source,
                                      RecordCutter& cutter, const StopSignals& stop) {
  const std::string& said = snapshot ? snapshot->format : options.choices.hints.format;
  if (!said.empty()) return format_named(said).value();
  // The first line may be one long document; its beginning is sufficient.
  constexpr std::size_t enough = 4096;
  std::size_t examined = 0;
  for (bool has_ended = false; !stop.asked();) {
    const std::string_view waiting = cutter.waiting();
    // A log of a receiver of GPS, behind which sentences of AIS may come.
    const bool may_be_log =
        source.nature() != ReportSource::Nature::live && is_gps_log(waiting.substr(0, enough));
    if (may_be_log && !has_ended) {
      if (has_ais_sentence(waiting.substr(examined))) return StreamFormat::nmea;
      examined = waiting.rfind('\n') + 1;
    } else if (const auto format =
                   format_by(waiting, options, source, has_ended || waiting.size() > enough)) {
      return format;
    }
    std::string_view text;
    const auto outcome = source.next(std::chrono::milliseconds(1000), text);
    has_ended = outcome == ReportSource::Outcome::end;
    if (outcome == ReportSource::Outcome::text) cutter.feed(text);
    if (outcome == ReportSource::Outcome::cut) {
      cutter.rest();
      examined = 0;
    }
  }
  return std::nullopt;
}

std::unique_ptr<ReportFormat> reader_of(const WatchOptions& options, StreamFormat format,
                                        const ReportSource& source, const StopSignals& stop,
                                        const std::vector<ClassRule>& class_rules) {
  FormatChoices choices = options.choices;
  choices.is_stopped = [&stop] { return stop.asked(); };
  choices.source = source.name();
  choices.position_error_is_said = !options.position_error.empty();
  if (same_name(options.own, "gps")) choices.own_by_gps = options.own;
  return make_ruled_format(make_format(format, choices), class_rules, is_table(format));
}

}  // namespace

WatchRun::WatchRun(const WatchOptions& options)
    : options_(options),
      begun_from_(snapshot_of(options)),
      source_(source_of(options, stop_, begun_from_)),
      known_format_(format_of(options, begun_from_, *source_, cutter_, stop_)),
      // This format needs no options.
      format_(known_format_.value_or(StreamFormat::readsb)),
      watcher_(settings_of(options, format_, source_->name()),
               [this](std::uint64_t share, std::string_view line) { alerts_->write(share, line); }),
      reader_(reader_of(options, format_, *source_, stop_, watcher_.settings().class_rules)),
      snapshot_interval_(snapshot_interval(options)) {
  cutter_.set_kind(records_of(format_));
  if (format_ == StreamFormat::recording && source_->nature() == ReportSource::Nature::unknown &&
      !options.quiet)
    print_message("kinesphere: {} is read as a whole: alerts come once it has ended\n", source_->name());
  if (begun_from_) go_on_from(*begun_from_);
  put_in_order();
  if (options.serve) server_ = std::make_unique<StateServer>(watcher_, *options.serve);
  alerts_ = open_alerts();
  begun_from_.reset();
  if (server_)
    print_message("kinesphere: the map is at {} (beside it: state.json, metrics)\n", server_->address());
}

/// Puts the reports of a file in order that is read from its begin, in times of its own. Only reports that
/// have no times of arrival can be in another order.
void WatchRun::put_in_order() {
  const bool may_be_grouped = format_ == StreamFormat::csv || format_ == StreamFormat::ais ||
                              format_ == StreamFormat::json || format_ == StreamFormat::jsonl;
  const bool has_own_times = watcher_.settings().clock != WatchSettings::Clock::machine;
  if (!may_be_grouped || !has_own_times || watcher_.monitor() || !is_file()) return;
  auto ordered = make_ordered_format(std::move(reader_), source_->name());
  ordered_ = ordered.get();
  reader_ = std::move(ordered);
}

void WatchRun::go_on_from(const WatchSnapshot& snapshot) {
  try {
    watcher_.restore(snapshot.watcher);
    // The begin of another stream differs from the saved one.
    if (snapshot.place.stream == source_->name()) {
      reader_->restore(snapshot.reader);
      cutter_.begin_at(snapshot.line);
    }
  } catch (const nlohmann::json::exception&) {
    throw ProgramError(
        fmt::format("{}: expected a snapshot of kinesphere watch, but it is none", options_.snapshot));
  }
  complaints_ = watcher_.counts().first_malformed.size();
}

std::unique_ptr<AlertOutput> WatchRun::open_alerts() const {
  if (options_.alerts.empty()) return make_alert_lines();
  if (is_nats_address(options_.alerts))
    return make_nats_alerts(parse_nats_address(options_.alerts, "--alerts"), stop_, options_.quiet,
                            alerts_origin(options_, watcher_.settings(), *source_));
  if (!begun_from_) return make_alert_file(options_.alerts, std::nullopt);
  const bool reads_again = begun_from_->place.stream == source_->name() && source_->identity();
  return make_alert_file(options_.alerts, ToldBefore{.place = begun_from_->alerts_place,
                                                     .was_here = begun_from_->alerts == alerts_name(options_),
                                                     .is_told_again = reads_again});
}

std::string_view WatchRun::format_name() const {
  if (!known_format_) return "unknown";
  return reader_->title().empty() ? name_of(format_) : reader_->title();
}

void WatchRun::run() {
  const bool by_machine = watcher_.settings().clock == WatchSettings::Clock::machine;
  // Interval of alerts that are due to the passing of time alone.
  const std::chrono::milliseconds patience(by_machine ? 50 : 1000);
  bool has_ended = false;
  // A later run continues from here, with the present file of alerts.
  if (watcher_.monitor()) keep_snapshot();
  // Text that has arrived is processed even if the program is asked to stop meanwhile.
  take();
  while (!has_ended && !stop_.asked()) {
    std::string_view text;
    const auto outcome = source_->next(patience, text);
    has_ended = outcome == ReportSource::Outcome::end;
    if (outcome == ReportSource::Outcome::text) {
      cutter_.feed(text);
      take();
    }
    if (outcome == ReportSource::Outcome::cut) take_cut_off();
    const bool is_later = source_->has_clock() ? outcome == ReportSource::Outcome::text
                                               : outcome == ReportSource::Outcome::quiet;
    if (by_machine && is_later) pass_time();
    if (is_time_for_snapshot()) keep_snapshot();
  }
  // A later run reads a record that may be incomplete again.
  keep_snapshot();
  if (has_ended) {
    if (const auto last = cutter_.rest()) read(*last);
    finish();
  }
  // A shared stream continues after this reader stops.
  if (!has_ended && source_->has_clock()) return;
  {
    const auto guard = guarded();
    watcher_.finish();
  }
  warn_of_own();
  if (has_ended) {
    warn();
    warn_of_disorder();
    warn_of_one_track();
    warn_of_one_moment();
    warn_of_undecided_bodies();
  }
  alerts_->flush(source_->position(cutter_.waiting().size()));
}

std::unique_lock<StateServer> WatchRun::guarded() {
  return server_ ? std::unique_lock(*server_) : std::unique_lock<StateServer>();
}

void WatchRun::take() {
  while (const auto record = cutter_.next()) read(*record);
  if (!source_->has_whole_records()) return;
  if (const auto cut_off = cutter_.rest()) read(*cut_off);
}

void WatchRun::take_cut_off() {
  auto record = cutter_.rest();
  if (!record) return;
  // A row whose last number lacks digits looks whole; an object shows its end.
  record->is_whole = record->is_whole && record->text.ends_with('}');
  read(*record);
}

void WatchRun::finish() {
  const auto guard = guarded();
  try {
    reader_->finish(watcher_);
  } catch (const UnusableStream& error) {
    throw ProgramError(fmt::format("{}: {}", source_->name(), error.what()));
  }
}

void WatchRun::read(Record record) {
  const std::uint64_t position = source_->position(record.behind);
  const std::uint64_t malformed = watcher_.counts().malformed;
  {
    const auto guard = guarded();
    const bool by_machine = watcher_.settings().clock == WatchSettings::Clock::machine;
    if (by_machine) watcher_.machine_time_is(now());
    // A pipe is live if it is said to be.
    const auto nature = source_->nature();
    if (nature == ReportSource::Nature::live || (by_machine && nature == ReportSource::Nature::unknown))
      record.read_at = now();
    watcher_.begin_record(record.line);
    try {
      reader_->read(record, watcher_);
    } catch (const WrongInput& error) {
      watcher_.refuse(error.what());
    } catch (const UnusableStream& error) {
      throw ProgramError(fmt::format("{}: {}", source_->name(), error.what()));
    }
    watcher_.end_record();
  }
  // A request for the state does not wait for a server that takes alerts.
  alerts_->flush(position);
  if (watcher_.counts().malformed > malformed) complain();
  warn();
}

void WatchRun::pass_time() {
  {
    const auto guard = guarded();
    watcher_.machine_time_is(now());
    watcher_.end_record();
  }
  alerts_->flush(source_->position(cutter_.waiting().size()));
}

FileTime WatchRun::now() const { return source_->has_clock() ? source_->arrival() : machine_time(); }

void WatchRun::complain() {
  const auto& lines = watcher_.counts().first_malformed;
  for (; complaints_ < lines.size() && !options_.quiet; ++complaints_)
    print_message("kinesphere: warning: {}:{}: {}\n", source_->name(), lines[complaints_].line,
                  lines[complaints_].reason);
}

void WatchRun::warn_once(bool& has_warned, std::string_view warning) {
  if (std::exchange(has_warned, true) || options_.quiet) return;
  print_message("kinesphere: warning: {}: {}\n", source_->name(), warning);
}

/// Warns, once of each, of what keeps tracks or pairs from being watched.
void WatchRun::warn() {
  const WatchCounts& counts = watcher_.counts();
  if (counts.crowded + counts.dropped > 0)
    warn_once(
        has_warned_of_crowds_,
        "there are more tracks than --most-tracks or more open pairs than --most-pairs: some tracks are "
        "not watched");
  for (const std::string& warning : watcher_.take_warnings())
    if (!options_.quiet) print_message("kinesphere: warning: {}\n", warning);
  if (watcher_.ignores_heights())
    warn_once(has_warned_of_plane_,
              "heights do not count, because the first report had none: say --dimensions 3, or 2");
  if (counts.no_height > 0)
    warn_once(has_warned_of_heights_,
              "some reports have no height: it counts as any, which leaves their pairs undecided");
  // Fewer reports say little, such as those before a clock is confirmed.
  constexpr std::uint64_t least = 100;
  const std::uint64_t taken = watcher_.monitor_counters().reports;
  if (std::exchange(taken_before_, taken) != taken) stale_before_ = counts.stale;
  if (counts.stale - stale_before_ >= least)
    warn_once(
        has_warned_of_clock_,
        fmt::format(
            "the last {} reports are older than all others by more than --forget, and not taken: a clock "
            "was set back, or had been ahead, where a new start goes on with them; or the rows of a file are "
            "not in the order of their times, and have to be sorted",
            least));
  warn_of_small_separations();
  warn_of_doubtful_reports();
  constexpr std::uint64_t many = 1000;
  if (taken >= many) warn_of_own();
  const std::uint64_t unusable = counts.unusable() + (taken == 0 ? counts.meant_to_be_left_out() : 0);
  if (!has_warned_of_unusable_ && unusable >= least && unusable > taken)
    warn_once(has_warned_of_unusable_,
              fmt::format("most reports cannot be used: {} taken, {}", taken, reasons_text(watcher_)));
}

/// Warns of a separation on the earth without a unit that is less than positions may be off.
void WatchRun::warn_of_small_separations() {
  const auto& bound = watcher_.settings().position_error.bound;
  if (!watcher_.frame() || !bound) return;
  for (const NamedSeparation& named : watcher_.settings().separations)
    if (!named.has_unit && named.separation.horizontal < *bound)
      warn_once(
          has_warned_of_small_,
          fmt::format(
              "{} is in metres, and less than positions may be off ({:.4g} m), so that no two are certainly "
              "within it; another unit is said as in sphere:0.5NM",
              named.name, *bound));
}

/// Warns, once of each, of reports that make alerts doubtful.
void WatchRun::warn_of_doubtful_reports() {
  const WatchCounts& counts = watcher_.counts();
  const MonitorCounters monitor = watcher_.monitor_counters();
  constexpr std::uint64_t least = 100, least_contradictions = 10;
  if (monitor.late >= least && 2 * monitor.late > monitor.reports)
    warn_once(
        has_warned_of_order_,
        "most reports are older than one before of their track, so that alerts may be missing: rows have "
        "to be in the order of their times");
  if (counts.behind >= least) warn_of_disorder();
  if (monitor.contradictions >= least_contradictions && 5 * monitor.contradictions > monitor.reports)
    warn_once(
        has_warned_of_contradictions_,
        fmt::format(
            "{} of {} reports contradict those before, so that alerts may be wrong or missing: the errors "
            "(--position-error, --stamp-error) or limits (--acceleration, --largest-speed) are too small, "
            "units are wrong, or two tracks have one id",
            monitor.contradictions, monitor.reports));
  const auto& separations = watcher_.settings().separations;
  const bool looks_ahead =
      std::any_of(separations.begin(), separations.end(),
                  [](const NamedSeparation& named) { return named.separation.look_ahead > 0.0; });
  if (monitor.reports >= least && counts.with_velocity == 0 && looks_ahead)
    warn_once(has_warned_of_velocities_,
              "reports have no velocities (vx and vy, or speed and course), without which encounters are not "
              "predicted before they are near");
  if (counts.ahead >= least)
    warn_once(
        has_warned_of_ahead_,
        fmt::format("{} reports are stamped ahead of all others by more than --leap, and not taken: the "
                    "clock of their tracks is wrong",
                    counts.ahead));
}

/// Warns of reports that are older than others before them, as in a file in which one track stands behind the
/// other.
void WatchRun::warn_of_disorder() {
  const WatchCounts& counts = watcher_.counts();
  const std::uint64_t taken = watcher_.monitor_counters().reports;
  constexpr std::uint64_t fewest = 10;
  if (counts.behind >= fewest && 5 * counts.behind > taken)
    warn_once(
        has_warned_of_order_,
        fmt::format("{} of {} reports are more than 5 s older than others before them, so that alerts may "
                    "be missing: rows have to be in the order of their times, or the clocks of some "
                    "tracks are wrong; tracks reads rows in any order",
                    counts.behind, taken));
}

/// Warns if there was never a second track.
void WatchRun::warn_of_one_track() {
  const WatchCounts& counts = watcher_.counts();
  const bool is_one = watcher_.names().size() == 1 && counts.crowded + counts.groups == 0 &&
                      counts.events[static_cast<std::size_t>(MonitorEventKind::dropped)] == 0;
  if (is_one && !options_.quiet)
    print_message("kinesphere: warning: {}: all reports are of one track, so no pair was watched\n",
                  source_->name());
}

/// Warns of a file that has one report of each track.
void WatchRun::warn_of_one_moment() {
  const std::uint64_t reports = watcher_.monitor_counters().reports;
  const bool is_one = source_->nature() == ReportSource::Nature::recording && reports > 1 &&
                      reports == watcher_.names().size() && watcher_.counts().groups == 0;
  if (is_one && !options_.quiet)
    print_message(
        "kinesphere: warning: {}: it has one report of each track, as of one moment: alerts tell who is near "
        "then, and what is predicted from there\n",
        source_->name());
}

/// Warns of pairs that are not told as the stream has ended too early.
void WatchRun::warn_of_undecided_bodies() {
  const std::size_t pairs = watcher_.undecided_bodies();
  if (pairs > 0 && !options_.quiet)
    print_message(
        "kinesphere: warning: {}: {} tracks that have just begun may be others under another id, and are not "
        "told as near to these: it ends before reports show it (--distinct-ids tells all)\n",
        source_->name(), pairs);
}

/// Warns if the own track is none of the stream's so far.
void WatchRun::warn_of_own() {
  if (options_.own.empty() || watcher_.counts().of_own > 0) return;
  warn_once(has_warned_of_own_,
            fmt::format("--own {}: no report of this track was taken, so no pair is watched", options_.own));
}

bool WatchRun::is_time_for_snapshot() const {
  // The first snapshot is written as soon as there is a state: a later run then continues from earlier
  // alerts, and an unwritable path fails at once.
  if (!last_snapshot_) return watcher_.monitor().has_value();
  return std::chrono::steady_clock::now() - *last_snapshot_ > snapshot_interval_;
}

void WatchRun::keep_snapshot() {
  last_snapshot_ = std::chrono::steady_clock::now();
  if (options_.snapshot.empty() || !known_format_) return;
  // A later run reads again what is kept back.
  const bool is_at_begin = ordered_ != nullptr && ordered_->keeps_all();
  WatchSnapshot snapshot{
      .options = given_options(options_),
      .format = std::string(name_of(format_)),
      .place = source_->place(is_at_begin ? source_->position(0) : cutter_.waiting().size()),
      .line = is_at_begin ? RecordCutter::Line{} : cutter_.line(),
      .reader = reader_->save(),
      .watcher = watcher_.save(),
      .alerts = alerts_name(options_),
      .alerts_place = alerts_->sync()};
  write_snapshot(options_.snapshot, std::move(snapshot));
  last_snapshot_ = std::chrono::steady_clock::now();
}

}  // namespace kinesphere::program
