// Public calls of a monitor: argument checks, then calls into the engine.
#include "kinesphere/monitor/monitor.hpp"

#include <array>

#include "input/input_check.hpp"
#include "kinesphere/limits.hpp"
#include "monitor/check_monitor.hpp"
#include "monitor/engine.hpp"

namespace kinesphere {

std::string_view name_of(MonitorEventKind kind) {
  constexpr std::array<std::string_view, 9> names{"verdict",       "predicted", "prediction_ended",
                                                  "contradiction", "resolved",  "stale",
                                                  "resumed",       "dropped",   "reclassified"};
  static_assert(names.size() == static_cast<std::size_t>(MonitorEventKind::reclassified) + 1);
  const auto index = static_cast<std::size_t>(kind);
  return index < names.size() ? names[index] : "unknown";
}

std::string_view name_of(Verdict verdict) {
  constexpr std::array<std::string_view, 3> names{"apart", "undecided", "within"};
  const auto index = static_cast<std::size_t>(verdict);
  return index < names.size() ? names[index] : "unknown";
}

Result<Monitor> Monitor::create(const MonitorDefinition& definition) {
  if (const Result<void> checked = check_monitor(definition); !checked) return checked.error();
  return Monitor(std::make_unique<Engine>(definition));
}

Monitor::Monitor(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}
Monitor::Monitor(Monitor&&) noexcept = default;
Monitor& Monitor::operator=(Monitor&&) noexcept = default;
Monitor::~Monitor() = default;

Monitor::Engine& Monitor::engine(const char* call) const {
  if (!engine_)
    throw BadResult(
        {ErrorCode::moved_from, "monitor", no_body, std::string(call) + ": the monitor has been moved from"});
  return *engine_;
}

Result<void> Monitor::check_idle(const char* call) const {
  if (!engine_)
    return Error{ErrorCode::moved_from, "monitor", no_body,
                 std::string(call) + ": the monitor has been moved from"};
  if (engine_->is_asking())
    return Error{ErrorCode::probe_in_progress, "monitor", no_body,
                 std::string(call) + ": a poll must not change the monitor that called it"};
  return {};
}

Result<void> Monitor::report(TrackId id, const TrackReport& report) {
  if (Result<void> idle = check_idle("report"); !idle) return idle;
  return engine_->report(id, report);
}

Result<void> Monitor::check_report(TrackId id, const TrackReport& report) const {
  return engine("check_report").check(id, report, "report");
}

Result<void> Monitor::remove(TrackId id) {
  if (Result<void> idle = check_idle("remove"); !idle) return idle;
  return engine_->remove(id);
}

Result<std::optional<MonitorEvent>> Monitor::advance(double until) { return go_on(until, nullptr); }

Result<std::optional<MonitorEvent>> Monitor::advance(double until, const Poll& poll) {
  if (!poll)
    return *InputCheck("advance")
                .require(false, ErrorCode::null_probe, {"poll"}, "must be a function", "empty")
                .error();
  return go_on(until, &poll);
}

Result<std::optional<MonitorEvent>> Monitor::go_on(double until, const Poll* poll) {
  if (const Result<void> idle = check_idle("advance"); !idle) return idle.error();
  const auto check = InputCheck("advance")
                         .within({"until"}, until, limits::largest_time)
                         .require(until >= time() || !engine_->has_started(), ErrorCode::time_backwards,
                                  {"until"}, "must not lie before the time of the monitor,", time(), until);
  if (check.error()) return *check.error();
  return engine_->advance(until, poll);
}

double Monitor::time() const { return engine("time").time(); }
const MonitorDefinition& Monitor::definition() const { return engine("definition").definition(); }
const MonitorCounters& Monitor::counters() const { return engine("counters").counters(); }
std::vector<TrackId> Monitor::tracks() const { return engine("tracks").tracks().ids(); }
std::size_t Monitor::size() const { return engine("size").tracks().size(); }
bool Monitor::contains(TrackId id) const { return engine("contains").tracks().find(id).has_value(); }

Result<TrackView> Monitor::track(TrackId id) const {
  const auto number = engine("track").tracks().find(id);
  if (!number)
    return Error{ErrorCode::unknown_body, "id", no_body, "track: there is no track " + std::to_string(id)};
  const KnownTrack& track = engine_->tracks()[*number];
  TrackView view{.id = id,
                 .track_class = track.track_class,
                 .timestamp = track.estimate.timestamp(),
                 .stale = track.stale,
                 .places = {}};
  for (const Hypothesis& hypothesis : track.estimate.hypotheses()) {
    const ReachableSet& set = TrackEstimate::tightest(hypothesis, time());
    view.places.push_back({set.centre_at(time()), set.velocity_at(time()), set.radius_at(time())});
  }
  return view;
}

Result<PairAnswer> Monitor::answer(TrackId first, TrackId second, std::uint32_t level) const {
  return engine("answer").answer(first, second, level);
}
std::vector<OpenPair> Monitor::open_pairs() const { return engine("open_pairs").open_pairs(); }
std::vector<PredictedPair> Monitor::predicted_pairs() const {
  return engine("predicted_pairs").predicted_pairs();
}
std::size_t Monitor::open_pair_count() const { return engine("open_pair_count").open_pair_count(); }
std::vector<TrackId> Monitor::crowd(std::size_t pairs) const { return engine("crowd").crowd(pairs); }
std::vector<ReportRequest> Monitor::needed(double until) const { return engine("needed").needed(until); }

std::vector<std::byte> Monitor::save() const { return engine("save").save(); }

Result<Monitor> Monitor::restore(std::span<const std::byte> snapshot) {
  auto engine = Engine::restore(snapshot);
  if (!engine) return engine.error();
  return Monitor(std::move(*engine));
}

}  // namespace kinesphere
