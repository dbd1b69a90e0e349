// The public calls of a monitor: checked, and handed on.
#include "kinesphere/monitor/monitor.hpp"

#include <cmath>

#include "input/input_check.hpp"
#include "kinesphere/limits.hpp"
#include "monitor/engine.hpp"

namespace kinesphere {
namespace {

Result<void> check_definition(const MonitorDefinition& definition) {
  InputCheck check("Monitor::create");
  check.require(definition.dimensions == 2 || definition.dimensions == 3, ErrorCode::out_of_range,
                {"dimensions"}, "must be 2 or 3", static_cast<double>(definition.dimensions));
  check.finite({"start_time"}, definition.start_time)
      .require(std::abs(definition.start_time) <= limits::largest_time, ErrorCode::out_of_range,
               {"start_time"}, "must lie within +-", limits::largest_time, definition.start_time)
      .positive({"tolerance"}, definition.tolerance)
      .require(definition.tolerance >= limits::least_contact_tolerance &&
                   definition.tolerance <= limits::largest_contact_tolerance,
               ErrorCode::out_of_range, {"tolerance"}, "must lie within the limits of a contact tolerance",
               definition.tolerance)
      .positive({"time_resolution"}, definition.time_resolution)
      .positive({"window"}, definition.window)
      .require(definition.silence_after > 0.0, ErrorCode::out_of_range, {"silence_after"}, "must be > 0",
               definition.silence_after)
      .require(definition.forget_after > 0.0, ErrorCode::out_of_range, {"forget_after"}, "must be > 0",
               definition.forget_after)
      .require(!definition.classes.empty(), ErrorCode::out_of_range, {"classes"}, "must name at least one",
               definition.classes.size());
  const auto limit = [&check](const Subject& subject, const Spread& spread) {
    for (const double value : {spread.horizontal(), spread.vertical(), spread.total()})
      check.require(value >= 0.0, ErrorCode::out_of_range, subject, "must be >= 0", value);
  };
  for (std::size_t k = 0; k < definition.classes.size(); ++k) {
    const TrackClass& one = definition.classes[k];
    const auto subject = [k](std::string_view part) {
      return Subject{.argument = "classes", .part = part, .part_number = k};
    };
    limit(subject("acceleration_limit"), one.acceleration_limit);
    limit(subject("largest_speed"), one.largest_speed);
    check.within(subject("planned_acceleration"), one.planned_acceleration, limits::largest_acceleration);
    check.require(std::isfinite(one.acceleration_limit.total()) || std::isfinite(one.largest_speed.total()),
                  ErrorCode::out_of_range, subject("acceleration_limit"),
                  "must be finite where largest_speed is not", one.acceleration_limit.total());
  }
  for (std::size_t k = 0; k < definition.separations.size(); ++k) {
    const SeparationRule& rule = definition.separations[k];
    const auto subject = [k](std::string_view part) {
      return Subject{.argument = "separations", .part = part, .part_number = k};
    };
    for (const std::size_t of : {rule.first_class, rule.second_class})
      check.require(of < definition.classes.size(), ErrorCode::out_of_range, subject("class"),
                    "must be less than the number of classes", definition.classes.size(), of);
    for (const Separation& level : rule.levels) {
      check.positive(subject("horizontal"), level.horizontal);
      if (definition.dimensions == 3) check.positive(subject("vertical"), level.vertical);
      check.require(
          definition.tolerance <= level.horizontal &&
              (definition.dimensions == 2 || definition.tolerance < level.vertical) &&
              std::max(level.horizontal, level.vertical) <= definition.tolerance * limits::largest_length,
          ErrorCode::out_of_range, subject("horizontal"), "must be between 1 and 2^41 tolerances",
          level.horizontal);
    }
    for (std::size_t other = 0; other < k; ++other) {
      const SeparationRule& before = definition.separations[other];
      check.require(std::minmax(rule.first_class, rule.second_class) !=
                        std::minmax(before.first_class, before.second_class),
                    ErrorCode::out_of_range, subject("class"), "must be other ones than those of separations",
                    other, k);
    }
  }
  return check.result();
}

}  // namespace

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
  if (const Result<void> checked = check_definition(definition); !checked) return checked.error();
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

}  // namespace kinesphere
