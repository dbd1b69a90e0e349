#include "monitor/check_monitor.hpp"

#include <algorithm>
#include <cmath>

#include "input/input_check.hpp"
#include "kinesphere/limits.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

void require_duration(InputCheck& check, std::string_view argument, double value) {
  check.positive({argument}, value)
      .require(value >= limits::least_time, ErrorCode::out_of_range, {argument}, "must be at least",
               limits::least_time, value)
      .require(value <= limits::largest_time, ErrorCode::out_of_range, {argument}, "must be at most",
               limits::largest_time, value);
}

void require_shard(InputCheck& check, const Shard& shard) {
  check
      .require(shard.of > 0, ErrorCode::out_of_range, {.argument = "shard", .part = "of"}, "must be > 0",
               shard.of)
      .require(shard.count > 0, ErrorCode::out_of_range, {.argument = "shard", .part = "count"},
               "must be > 0", shard.count)
      .require(shard.count <= shard.of && shard.first <= shard.of - shard.count, ErrorCode::out_of_range,
               {.argument = "shard", .part = "first"}, "must be, with count, at most", shard.of, shard.first);
}

void require_limit(InputCheck& check, const Subject& subject, const ErrorBound& limit, double most) {
  for (const double value : {limit.horizontal(), limit.vertical(), limit.total()})
    check.require(value >= 0.0, ErrorCode::out_of_range, subject, "must be >= 0", value)
        .require(value <= most || value == infinity, ErrorCode::out_of_range, subject,
                 "must be infinite or at most", most, value);
}

void require_class(InputCheck& check, const TrackClass& one, std::size_t number) {
  const auto subject = [=](std::string_view part) {
    return Subject{.argument = "classes", .part = part, .part_number = number};
  };
  require_limit(check, subject("acceleration_limit"), one.acceleration_limit, limits::largest_acceleration);
  require_limit(check, subject("largest_speed"), one.largest_speed, limits::largest_speed);
  check.within(subject("planned_acceleration"), one.planned_acceleration, limits::largest_acceleration)
      .require(std::isfinite(one.acceleration_limit.total()) || std::isfinite(one.largest_speed.total()),
               ErrorCode::out_of_range, subject("acceleration_limit"),
               "must be finite where largest_speed is not", one.acceleration_limit.total());
}

void require_rule(InputCheck& check, const MonitorDefinition& definition, std::size_t number) {
  const SeparationRule& rule = definition.separations[number];
  const auto subject = [=](std::string_view part) {
    return Subject{.argument = "separations", .part = part, .part_number = number};
  };
  for (const std::size_t of : {rule.first_class, rule.second_class})
    check.require(of < definition.classes.size(), ErrorCode::out_of_range, subject("class"),
                  "must be less than the number of classes", definition.classes.size(), of);
  check.require(!rule.levels.empty(), ErrorCode::out_of_range, subject("levels"), "must name at least one",
                rule.levels.size());
  const auto length = [&](std::string_view part, double value) {
    check.positive(subject(part), value)
        .require(value >= definition.tolerance && value <= definition.tolerance * limits::largest_length,
                 ErrorCode::out_of_range, subject(part), "must be between 1 and 2^41 tolerances", value);
  };
  for (const Separation& level : rule.levels) {
    length("horizontal", level.horizontal);
    if (definition.dimensions == 3) length("vertical", level.vertical);
    check.from_zero_to(subject("look_ahead"), level.look_ahead, limits::largest_time)
        .from_zero_to(subject("modified_tau"), level.modified_tau, limits::largest_time)
        .require(level.modified_tau == 0.0 || level.shape == Separation::Shape::well_clear,
                 ErrorCode::out_of_range, subject("modified_tau"), "must be 0 without the shape well_clear",
                 level.modified_tau);
  }
  const auto pair_of = [](const SeparationRule& of) { return std::minmax(of.first_class, of.second_class); };
  for (std::size_t other = 0; other < number; ++other)
    check.require(pair_of(rule) != pair_of(definition.separations[other]), ErrorCode::out_of_range,
                  subject("class"), "must be other ones than those of separations", other, number);
}

}  // namespace

Result<void> check_monitor(const MonitorDefinition& definition) {
  InputCheck check("Monitor::create");
  check.require(definition.dimensions == 2 || definition.dimensions == 3, ErrorCode::out_of_range,
                {"dimensions"}, "must be 2 or 3", static_cast<double>(definition.dimensions));
  if (definition.start_time) check.within({"start_time"}, *definition.start_time, limits::largest_time);
  check.positive({"tolerance"}, definition.tolerance)
      .require(definition.tolerance >= limits::least_contact_tolerance &&
                   definition.tolerance <= limits::largest_contact_tolerance,
               ErrorCode::out_of_range, {"tolerance"}, "must lie within the limits of a contact tolerance",
               definition.tolerance)
      .require(definition.stale_after > 0.0, ErrorCode::out_of_range, {"stale_after"}, "must be > 0",
               definition.stale_after)
      .require(definition.drop_after > 0.0, ErrorCode::out_of_range, {"drop_after"}, "must be > 0",
               definition.drop_after)
      .from_zero_to({"prediction_hold"}, definition.prediction_hold, limits::largest_time)
      .from_zero_to({"prediction_confirmation"}, definition.prediction_confirmation, limits::largest_time)
      .from_zero_to({"prediction_margin"}, definition.prediction_margin, 1.0)
      .from_zero_to({"prediction_error_part"}, definition.prediction_error_part, 1.0)
      .require(!definition.classes.empty(), ErrorCode::out_of_range, {"classes"}, "must name at least one",
               definition.classes.size());
  require_duration(check, "time_resolution", definition.time_resolution);
  require_duration(check, "window", definition.window);
  require_shard(check, definition.shard);
  for (std::size_t k = 0; k < definition.classes.size(); ++k) require_class(check, definition.classes[k], k);
  for (std::size_t k = 0; k < definition.separations.size(); ++k) require_rule(check, definition, k);
  return check.result();
}

}  // namespace kinesphere
