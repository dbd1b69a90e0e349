// One run of a watch: its loop, until the stream ends or the program is asked to stop.
#include "watch/watch_loop.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <random>
#include <utility>

#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "watch/nats/nats_streams.hpp"
#include "watch/tracks/class_rules.hpp"
#include "watch/watch_options.hpp"

namespace kinesphere::program {
namespace {

using Outcome = ReportSource::Outcome;
using Nature = ReportSource::Nature;

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
  const std::string& then = snapshot->reader.format;
  if (!format_named(then)) refuse_snapshot(options.snapshot);
  if (!said.empty() && format_named(said) != format_named(then))
    throw ProgramError(fmt::format("--format: expected it as it was for the snapshot {}, {}, but got {}",
                                   options.snapshot, then, said));
  return snapshot;
}

/// Returns the name by which a later run recognises the destination of alerts.
std::string alerts_name(const WatchOptions& options) {
  if (options.alerts.empty()) return {};
  if (is_nats_address(options.alerts)) return parse_nats_address(options.alerts, "--alerts").name;
  return std::filesystem::absolute(options.alerts).lexically_normal().string();
}

/// Returns a word for the origin of alerts: equal for all readers of one stream with equal settings, whatever
/// their shares; unique if the stream cannot be read again.
std::string alerts_origin(const WatchOptions& options, const Shard& share, const ReportSource& source) {
  const auto identity = source.identity();
  const bool is_the_same = options.clock != "arrival" || source.has_clock();
  if (!identity || !is_the_same) {
    std::random_device random;
    return fmt::format("{:08x}{:08x}", random(), random());
  }
  std::string text = fmt::format("{}\n{}", *identity, share.of);
  for (const auto& [option, given] : given_options(options))
    if (option != "--share") text += fmt::format("\n{} {}", option, given);
  return fmt::format("{:016x}", track_id_of(text));
}

/// The format if the program was asked to stop before the text showed it: it needs no options.
constexpr StreamFormat any_format = StreamFormat::readsb;

}  // namespace

WatchLoop::WatchLoop(const WatchOptions& options)
    : options_(options),
      begun_from_(snapshot_of(options)),
      reader_(options, stop_, begun_from_ ? &begun_from_->reader : nullptr),
      pipeline_(
          settings_of(options, reader_.format().value_or(any_format), reader_.source().name()),
          [this](std::uint64_t share, std::string_view line) { alerts_->write(share, line); },
          !options.plot.empty()),
      by_machine_(view().settings.clock == WatchSettings::Clock::machine),
      warnings_(view(), is_file(), options.quiet),
      snapshot_interval_(snapshot_interval(options)) {
  if (reader_.format() == StreamFormat::recording && reader_.source().nature() == Nature::unknown &&
      !options.quiet)
    print_message("kinesphere: {} is read as a whole: alerts come once it has ended\n",
                  reader_.source().name());
  go_on();
  if (options.serve) server_ = std::make_unique<StateServer>(view(), *options.serve);
  alerts_ = open_alerts();
  begun_from_.reset();
  if (server_)
    print_message("kinesphere: the map is at {} (beside it: state.json, metrics)\n", server_->address());
}

/// Begins with the stream, from the snapshot if there is one.
void WatchLoop::go_on() {
  const ReaderState* const from = begun_from_ ? &begun_from_->reader : nullptr;
  const StreamFormat format = reader_.format().value_or(any_format);
  const auto with_rules = [&](std::unique_ptr<ReportFormat> reader) {
    return make_ruled_format(std::move(reader), view().settings.class_rules, is_table(format));
  };
  try {
    if (begun_from_) pipeline_.restore(begun_from_->pipeline);
    warnings_.pass_over_malformed();
    reader_.begin(format, with_rules, from, !view().pairs.monitor());
  } catch (const WrongInput&) {
    refuse_snapshot(options_.snapshot);
  }
}

std::unique_ptr<AlertOutput> WatchLoop::open_alerts() const {
  const ReportSource& source = reader_.source();
  if (options_.alerts.empty()) return make_alert_lines();
  if (is_nats_address(options_.alerts))
    return make_nats_alerts(parse_nats_address(options_.alerts, "--alerts"), stop_, options_.quiet,
                            alerts_origin(options_, view().settings.share, source));
  if (!begun_from_) return make_alert_file(options_.alerts, std::nullopt);
  const bool reads_again = begun_from_->reader.place.stream == source.name() && source.identity();
  return make_alert_file(options_.alerts, ToldBefore{.place = begun_from_->alerts_place,
                                                     .was_here = begun_from_->alerts == alerts_name(options_),
                                                     .is_told_again = reads_again});
}

void WatchLoop::run() {
  // Interval of alerts that are due to the passing of time alone.
  const std::chrono::milliseconds patience(by_machine_ ? 50 : 1000);
  // A later run continues from here, with the present file of alerts.
  if (view().pairs.monitor()) keep_snapshot();
  // Text that has arrived is processed even if the program is asked to stop meanwhile.
  read_all();
  bool has_ended = false;
  while (!has_ended && !stop_.asked()) {
    const Outcome outcome = reader_.next(patience);
    has_ended = outcome == Outcome::end;
    read_all();
    const Outcome later = reader_.source().has_clock() ? Outcome::text : Outcome::quiet;
    if (by_machine_ && outcome == later) pass_time();
    if (is_time_for_snapshot()) keep_snapshot();
  }
  // A later run reads a record that may be incomplete again.
  keep_snapshot();
  // A shared stream continues after this reader stops.
  if (has_ended || !reader_.source().has_clock()) finish(has_ended);
}

void WatchLoop::finish(bool has_ended) {
  if (has_ended)
    if (const auto last = reader_.rest()) read(*last);
  {
    const auto guard = guarded();
    if (has_ended) reader_.finish(pipeline_);
    pipeline_.finish();
  }
  for (const std::string& warning : pipeline_.take_warnings()) warnings_.add(warning);
  warnings_.look_at_end(has_ended);
  alerts_->flush(reader_.position());
}

std::unique_lock<StateServer> WatchLoop::guarded() {
  return server_ ? std::unique_lock(*server_) : std::unique_lock<StateServer>();
}

void WatchLoop::read_all() {
  while (const auto record = reader_.record()) read(*record);
}

void WatchLoop::read(Record record) {
  const std::uint64_t position = reader_.position(record.behind);
  {
    const auto guard = guarded();
    if (by_machine_) pipeline_.machine_time_is(now());
    // A pipe is live if it is said to be.
    const Nature nature = reader_.source().nature();
    if (nature == Nature::live || (by_machine_ && nature == Nature::unknown)) record.read_at = now();
    pipeline_.begin_record(record.line);
    try {
      reader_.read(record, pipeline_);
    } catch (const WrongInput& error) {
      pipeline_.refuse(error.what());
    }
    pipeline_.end_record();
  }
  // A request for the state does not wait for a server that takes alerts.
  alerts_->flush(position);
  for (const std::string& warning : pipeline_.take_warnings()) warnings_.add(warning);
  warnings_.look();
}

void WatchLoop::pass_time() {
  {
    const auto guard = guarded();
    pipeline_.machine_time_is(now());
    pipeline_.end_record();
  }
  alerts_->flush(reader_.position());
}

FileTime WatchLoop::now() const {
  const ReportSource& source = reader_.source();
  return source.has_clock() ? source.arrival() : machine_time();
}

bool WatchLoop::is_time_for_snapshot() const {
  // The first snapshot is written as soon as there is a state: a later run then continues from earlier
  // alerts, and an unwritable path fails at once.
  if (!last_snapshot_) return view().pairs.monitor().has_value();
  return std::chrono::steady_clock::now() - *last_snapshot_ > snapshot_interval_;
}

void WatchLoop::keep_snapshot() {
  last_snapshot_ = std::chrono::steady_clock::now();
  if (options_.snapshot.empty() || !reader_.format()) return;
  write_snapshot(options_.snapshot, {.options = given_options(options_),
                                     .reader = reader_.state(),
                                     .pipeline = pipeline_.save(),
                                     .alerts = alerts_name(options_),
                                     .alerts_place = alerts_->sync()});
  last_snapshot_ = std::chrono::steady_clock::now();
}

}  // namespace kinesphere::program
