// The public calls of a monitor: checked, and handed on.
#include "kinesphere/monitor/monitor.hpp"

#include "input/input_check.hpp"
#include "monitor/check_monitor.hpp"
#include "monitor/engine.hpp"

namespace kinesphere {

std::string_view name_of(MonitorEventKind kind) {
  switch (kind) {
    case MonitorEventKind::verdict:
      return "verdict";
    case MonitorEventKind::contradiction:
      return "contradiction";
    case MonitorEventKind::resolved:
      return "resolved";
    case MonitorEventKind::silent:
      return "silent";
    case MonitorEventKind::heard:
      return "heard";
    case MonitorEventKind::left:
      return "left";
  }
  return "unknown";
}

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::apart:
      return "apart";
    case Verdict::undecided:
      return "undecided";
    case Verdict::within:
      return "within";
  }
  return "unknown";
}

Result<Monitor> Monitor::create(const MonitorDefinition& definition) {
  if (const Result<void> checked = check_monitor(definition); !checked) return checked.error();
  return Monitor(std::make_unique<Engine>(definition));
}

Monitor::Monitor(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}
Monitor::Monitor(Monitor&&) noexcept = default;
Monitor& Monitor::operator=(Monitor&&) noexcept = default;
Monitor::~Monitor() = default;

Result<void> Monitor::report(TrackId id, const TrackReport& report) { return engine_->report(id, report); }
Result<void> Monitor::remove(TrackId id) { return engine_->remove(id); }

Result<std::optional<MonitorEvent>> Monitor::advance(double until) {
  InputCheck check("advance");
  check.finite({"until"}, until)
      .require(until >= time(), ErrorCode::time_backwards, {"until"},
               "must not lie before the time of the monitor,", time(), until);
  if (check.error()) return *check.error();
  return engine_->advance(until, nullptr);
}

Result<std::optional<MonitorEvent>> Monitor::advance(double until, const Poll& poll) {
  InputCheck check("advance");
  check.finite({"until"}, until)
      .require(until >= time(), ErrorCode::time_backwards, {"until"},
               "must not lie before the time of the monitor,", time(), until)
      .require(static_cast<bool>(poll), ErrorCode::null_probe, {"poll"}, "must be a function", "empty");
  if (check.error()) return *check.error();
  return engine_->advance(until, &poll);
}

double Monitor::time() const { return engine_->time(); }
const MonitorDefinition& Monitor::definition() const { return engine_->definition(); }
const MonitorCounters& Monitor::counters() const { return engine_->counters(); }
std::vector<TrackId> Monitor::tracks() const { return engine_->tracks().ids(); }
std::size_t Monitor::size() const { return engine_->tracks().size(); }
bool Monitor::contains(TrackId id) const { return engine_->tracks().find(id).has_value(); }

Result<TrackView> Monitor::track(TrackId id) const {
  const auto number = engine_->tracks().find(id);
  if (!number)
    return Error{ErrorCode::unknown_body, "id", no_body, "track: there is no track " + std::to_string(id)};
  const Track& track = engine_->tracks()[*number];
  TrackView view{.id = id,
                 .track_class = track.track_class,
                 .stamp = track.knowledge.stamp(),
                 .silent = track.silent,
                 .places = {}};
  for (const Hypothesis& hypothesis : track.knowledge.hypotheses()) {
    const Claim& claim = Knowledge::tightest(hypothesis, time());
    view.places.push_back({claim.centre_at(time()), claim.velocity_at(time()), claim.radius_at(time())});
  }
  return view;
}

Result<PairAnswer> Monitor::answer(TrackId first, TrackId second, std::uint32_t level) const {
  return engine_->answer(first, second, level);
}
std::vector<OpenPair> Monitor::open_pairs() const { return engine_->open_pairs(); }
std::vector<ReportNeed> Monitor::needed(double until) const { return engine_->needed(until); }

std::vector<std::byte> Monitor::save() const { return engine_->save(); }

Result<Monitor> Monitor::restore(std::span<const std::byte> snapshot) {
  auto engine = Engine::restore(snapshot);
  if (!engine) return engine.error();
  return Monitor(std::move(*engine));
}

}  // namespace kinesphere
