// What a watch warns of: a table of each thing, when it came first, and how often it was so.
#include "watch/output/warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/standard_output.hpp"
#include "watch/output/watch_report.hpp"

namespace kinesphere::program {

/// What rules look at.
struct WatchFacts {
  const WatchView& watch;
  const WatchCounts& counts;
  MonitorCounters monitor;
  std::uint64_t too_old;  ///< reports, since the last one that was taken
  bool is_recording;      ///< the stream was written before
  bool is_over = false;   ///< no more is read: the stream has ended, or the program was asked to stop
  bool is_end = false;    ///< the stream has ended
};

struct WarningRule {
  std::string_view what;
  bool (*is_so)(const WatchFacts& facts);  ///< null: it is so once it was so at all
  /// Returns how often it was so.
  std::uint64_t (*times)(const WatchFacts& facts);
  std::string_view text;  ///< may have {times} and {reports}; or
  std::string (*made)(const WatchFacts& facts) = nullptr;
};

namespace {

using Facts = WatchFacts;

/// Fewer reports say little, such as those before a clock is confirmed.
constexpr std::uint64_t least = 100;

std::uint64_t once(const Facts&) { return 1; }
std::uint64_t of_reports(const Facts& facts) { return facts.monitor.reports; }

std::uint64_t of_crowded(const Facts& facts) { return facts.counts.crowded + facts.counts.dropped; }
std::uint64_t of_ignored_heights(const Facts& facts) { return facts.counts.ignored_heights; }
std::uint64_t of_no_height(const Facts& facts) { return facts.counts.no_height; }
std::uint64_t of_too_old(const Facts& facts) { return facts.counts.stale; }
std::uint64_t of_ahead(const Facts& facts) { return facts.counts.ahead; }
std::uint64_t of_contradictions(const Facts& facts) { return facts.monitor.contradictions; }

/// Returns a separation on the earth without a unit that is less than positions may be off; null if none.
const NamedSeparation* small_separation(const Facts& facts) {
  const WatchSettings& settings = facts.watch.settings;
  if (!facts.watch.tracks.map().frame() || !settings.position_error.bound) return nullptr;
  for (const NamedSeparation& named : settings.separations)
    if (!named.has_unit && named.separation.horizontal < *settings.position_error.bound) return &named;
  return nullptr;
}
bool is_small(const Facts& facts) { return small_separation(facts) != nullptr; }
std::string small_text(const Facts& facts) {
  return fmt::format(
      "{} is in metres, and less than positions may be off ({:.4g} m), so that no two are certainly within "
      "it; another unit is said as in sphere:0.5NM",
      small_separation(facts)->name, *facts.watch.settings.position_error.bound);
}

std::uint64_t of_disorder(const Facts& facts) { return std::max(facts.monitor.late, facts.counts.behind); }
bool are_most_late(const Facts& facts) {
  return facts.monitor.late >= least && 2 * facts.monitor.late > facts.monitor.reports;
}
bool are_many_behind(const Facts& facts) {
  constexpr std::uint64_t fewest_at_end = 10;
  return facts.counts.behind >= (facts.is_end ? fewest_at_end : least) &&
         5 * facts.counts.behind > facts.monitor.reports;
}
bool is_disorder(const Facts& facts) { return are_most_late(facts) || are_many_behind(facts); }
std::string disorder_text(const Facts& facts) {
  if (are_most_late(facts))
    return "most reports are older than one before of their track, so that alerts may be missing: rows have "
           "to be in the order of their times";
  return fmt::format(
      "{} of {} reports are more than 5 s older than others before them, so that alerts may be missing: rows "
      "have to be in the order of their times, or the clocks of some tracks are wrong; tracks reads rows in "
      "any order",
      facts.counts.behind, facts.monitor.reports);
}

bool are_many_contradictory(const Facts& facts) {
  constexpr std::uint64_t fewest_refused = 10;
  return facts.monitor.contradictions >= fewest_refused &&
         5 * facts.monitor.contradictions > facts.monitor.reports;
}

bool lack_velocities(const Facts& facts) {
  const auto& separations = facts.watch.settings.separations;
  return facts.monitor.reports >= least && facts.counts.with_velocity == 0 &&
         std::any_of(separations.begin(), separations.end(),
                     [](const NamedSeparation& named) { return named.separation.look_ahead > 0.0; });
}

bool lacks_own(const Facts& facts) {
  constexpr std::uint64_t many = 1000;
  return !facts.watch.settings.own.empty() && facts.counts.of_own == 0 &&
         (facts.is_over || facts.monitor.reports >= many);
}

std::string own_text(const Facts& facts) {
  return fmt::format("--own {}: no report of this track was taken, so no pair is watched",
                     facts.watch.settings.own_as_given);
}

std::uint64_t of_unusable(const Facts& facts) {
  return facts.counts.unusable() + (facts.monitor.reports == 0 ? facts.counts.meant_to_be_left_out() : 0);
}

bool are_most_unusable(const Facts& facts) {
  return of_unusable(facts) >= least && of_unusable(facts) > facts.monitor.reports;
}
std::string unusable_text(const Facts& facts) {
  return fmt::format("most reports cannot be used: {} taken, {}", facts.monitor.reports,
                     reasons_text(facts.watch));
}

/// True if there was never a second track.
bool is_one_track(const Facts& facts) {
  const WatchCounts& counts = facts.counts;
  return facts.watch.tracks.names().size() == 1 && counts.crowded + counts.groups == 0 &&
         counts.events[static_cast<std::size_t>(MonitorEventKind::dropped)] == 0;
}
/// True for a file that has one report of each track.
bool is_one_moment(const Facts& facts) {
  return facts.is_recording && facts.monitor.reports > 1 && facts.counts.groups == 0 &&
         facts.monitor.reports == facts.watch.tracks.names().size();
}
/// Pairs that are not told as the stream has ended too early.
std::uint64_t of_undecided_bodies(const Facts& facts) { return facts.watch.desk.undecided_bodies(); }

/// What is warned of with any record, in the order in which it is told.
const WarningRule warning_rules[] = {
    {"crowd", nullptr, of_crowded,
     "there are more tracks than --most-tracks or more open pairs than --most-pairs: some tracks "
     "are not watched"},
    {"ignored_heights", nullptr, of_ignored_heights,
     "heights do not count, because the first report had none: say --dimensions 3, or 2"},
    {"no_height", nullptr, of_no_height,
     "some reports have no height: it counts as any, which leaves their pairs undecided"},
    {"too_old", [](const Facts& facts) { return facts.too_old >= least; }, of_too_old,
     "the last 100 reports are older than all others by more than --forget, and not taken: a clock was set "
     "back, or had been ahead, where a new start goes on with them; or the rows of a file are not in the "
     "order of their times, and have to be sorted"},
    {"small_separation", is_small, once, {}, small_text},
    {"disorder", is_disorder, of_disorder, {}, disorder_text},
    {"contradictions", are_many_contradictory, of_contradictions,
     "{times} of {reports} reports contradict those before, so that alerts may be wrong or missing: the "
     "errors (--position-error, --stamp-error) or limits (--acceleration, --largest-speed) are too small, "
     "units are wrong, or two tracks have one id"},
    {"no_velocity", lack_velocities,
     [](const Facts& facts) { return facts.monitor.reports - facts.counts.with_velocity; },
     "reports have no velocities (vx and vy, or speed and course), without which encounters are not "
     "predicted before they are near"},
    {"ahead", [](const Facts& facts) { return of_ahead(facts) >= least; }, of_ahead,
     "{times} reports are stamped ahead of all others by more than --leap, and not taken: the clock of their "
     "tracks is wrong"},
    {"no_own", lacks_own, once, {}, own_text},
    {"unusable", are_most_unusable, of_unusable, {}, unusable_text},
};

/// What is warned of at the end of the stream alone.
const WarningRule rules_at_end[] = {
    {"one_track", is_one_track, of_reports, "all reports are of one track, so no pair was watched"},
    {"one_moment", is_one_moment, of_reports,
     "it has one report of each track, as of one moment: alerts tell who is near then, and what is "
     "predicted from there"},
    {"undecided_bodies", nullptr, of_undecided_bodies,
     "{times} tracks that have just begun may be others under another id, and are not told as near to these: "
     "it ends before reports show it (--distinct-ids tells all)"},
};

std::string text_of(const WarningRule& rule, const Facts& facts) {
  if (rule.made != nullptr) return rule.made(facts);
  return fmt::format(fmt::runtime(rule.text), fmt::arg("times", rule.times(facts)),
                     fmt::arg("reports", facts.monitor.reports));
}

}  // namespace

Warnings::Warnings(const WatchView& watch, bool is_recording, bool is_quiet)
    : watch_(watch), is_recording_(is_recording), is_quiet_(is_quiet) {
  for (const WarningRule& rule : warning_rules) pending_.push_back(&rule);
}

void Warnings::look() {
  const auto& lines = watch_.counts.first_malformed;
  for (; complaints_ < lines.size(); ++complaints_)
    print(
        fmt::format("{}:{}: {}", watch_.settings.source, lines[complaints_].line, lines[complaints_].reason));
  look_by(facts());
}

void Warnings::look_at_end(bool has_ended) {
  WatchFacts facts = this->facts();
  facts.is_over = true;
  facts.is_end = has_ended;
  if (has_ended)
    for (const WarningRule& rule : rules_at_end) pending_.push_back(&rule);
  look_by(facts);
}

WatchFacts Warnings::facts() {
  const MonitorCounters monitor = watch_.counters();
  if (std::exchange(taken_before_, monitor.reports) != monitor.reports) too_old_before_ = watch_.counts.stale;
  return {.watch = watch_,
          .counts = watch_.counts,
          .monitor = monitor,
          .too_old = watch_.counts.stale - too_old_before_,
          .is_recording = is_recording_};
}

/// Warns by the rules that have not warned yet.
void Warnings::look_by(const WatchFacts& facts) {
  bool has_warned = false;
  for (const WarningRule*& rule : pending_) {
    if (rule->is_so != nullptr ? !rule->is_so(facts) : rule->times(facts) == 0) continue;
    const std::string text = text_of(*rule, facts);
    given_.push_back({rule, {rule->what, watch_.last_time(), text}});
    print(fmt::format("{}: {}", watch_.settings.source, text));
    rule = nullptr;
    has_warned = true;
  }
  if (has_warned) std::erase(pending_, nullptr);
}

void Warnings::add(const std::string& text) {
  given_.push_back({nullptr, {"format", watch_.last_time(), text}});
  print(text);
}

void Warnings::print(std::string_view text) const {
  if (!is_quiet_) print_message("kinesphere: warning: {}\n", text);
}

std::vector<Warning> Warnings::all() {
  const WatchFacts now = facts();
  std::vector<Warning> all;
  for (const auto& [rule, warning] : given_) {
    all.push_back(warning);
    if (rule != nullptr) all.back().times = rule->times(now);
  }
  return all;
}

}  // namespace kinesphere::program
