#include "monitor/check_monitor.hpp"

#include <algorithm>
#include <cmath>

#include "input/input_check.hpp"
#include "kinesphere/limits.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

Result<void> check_monitor(const MonitorDefinition& definition) {
  InputCheck check("Monitor::create");
  check.require(definition.dimensions == 2 || definition.dimensions == 3, ErrorCode::out_of_range,
                {"dimensions"}, "must be 2 or 3", static_cast<double>(definition.dimensions));
  if (definition.start_time)
    check.finite({"start_time"}, *definition.start_time)
        .require(std::abs(*definition.start_time) <= limits::largest_time, ErrorCode::out_of_range,
                 {"start_time"}, "must lie within +-", limits::largest_time, *definition.start_time);
  check.positive({"tolerance"}, definition.tolerance)
      .require(definition.tolerance >= limits::least_contact_tolerance &&
                   definition.tolerance <= limits::largest_contact_tolerance,
               ErrorCode::out_of_range, {"tolerance"}, "must lie within the limits of a contact tolerance",
               definition.tolerance)
      .require(definition.stale_after > 0.0, ErrorCode::out_of_range, {"stale_after"}, "must be > 0",
               definition.stale_after)
      .require(definition.drop_after > 0.0, ErrorCode::out_of_range, {"drop_after"}, "must be > 0",
               definition.drop_after)
      .not_negative({"prediction_hold"}, definition.prediction_hold)
      .not_negative({"prediction_confirmation"}, definition.prediction_confirmation)
      .require(definition.prediction_confirmation <= limits::largest_time, ErrorCode::out_of_range,
               {"prediction_confirmation"}, "must be at most", limits::largest_time,
               definition.prediction_confirmation)
      .not_negative({"prediction_margin"}, definition.prediction_margin)
      .require(definition.prediction_margin <= 1.0, ErrorCode::out_of_range, {"prediction_margin"},
               "must be at most", 1.0, definition.prediction_margin)
      .not_negative({"prediction_error_part"}, definition.prediction_error_part)
      .require(definition.prediction_error_part <= 1.0, ErrorCode::out_of_range, {"prediction_error_part"},
               "must be at most", 1.0, definition.prediction_error_part)
      .require(definition.prediction_hold <= limits::largest_time, ErrorCode::out_of_range,
               {"prediction_hold"}, "must be at most", limits::largest_time, definition.prediction_hold)
      .require(!definition.classes.empty(), ErrorCode::out_of_range, {"classes"}, "must name at least one",
               definition.classes.size());
  const auto duration = [&check](std::string_view part, double value) {
    check.positive({part}, value)
        .require(value >= limits::least_time, ErrorCode::out_of_range, {part}, "must be at least",
                 limits::least_time, value)
        .require(value <= limits::largest_time, ErrorCode::out_of_range, {part}, "must be at most",
                 limits::largest_time, value);
  };
  duration("time_resolution", definition.time_resolution);
  duration("window", definition.window);
  const Shard& share = definition.shard;
  check
      .require(share.of > 0, ErrorCode::out_of_range, {.argument = "shard", .part = "of"}, "must be > 0",
               share.of)
      .require(share.count > 0, ErrorCode::out_of_range, {.argument = "shard", .part = "count"},
               "must be > 0", share.count)
      .require(share.count <= share.of && share.first <= share.of - share.count, ErrorCode::out_of_range,
               {.argument = "shard", .part = "first"}, "must be, with count, at most", share.of, share.first);
  const auto limit = [&check](const Subject& subject, const ErrorBound& error, double most) {
    for (const double value : {error.horizontal(), error.vertical(), error.total()})
      check.require(value >= 0.0, ErrorCode::out_of_range, subject, "must be >= 0", value)
          .require(value <= most || value == infinity, ErrorCode::out_of_range, subject,
                   "must be infinite or at most", most, value);
  };
  for (std::size_t k = 0; k < definition.classes.size(); ++k) {
    const TrackClass& one = definition.classes[k];
    const auto subject = [k](std::string_view part) {
      return Subject{.argument = "classes", .part = part, .part_number = k};
    };
    limit(subject("acceleration_limit"), one.acceleration_limit, limits::largest_acceleration);
    limit(subject("largest_speed"), one.largest_speed, limits::largest_speed);
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
    const auto length = [&](std::string_view part, double value) {
      check.positive(subject(part), value)
          .require(value >= definition.tolerance && value <= definition.tolerance * limits::largest_length,
                   ErrorCode::out_of_range, subject(part), "must be between 1 and 2^41 tolerances", value);
    };
    for (const Separation& level : rule.levels) {
      length("horizontal", level.horizontal);
      if (definition.dimensions == 3) length("vertical", level.vertical);
      check.not_negative(subject("look_ahead"), level.look_ahead)
          .require(level.look_ahead <= limits::largest_time, ErrorCode::out_of_range, subject("look_ahead"),
                   "must be at most", limits::largest_time, level.look_ahead);
      check.not_negative(subject("modified_tau"), level.modified_tau)
          .require(level.modified_tau <= limits::largest_time, ErrorCode::out_of_range,
                   subject("modified_tau"), "must be at most", limits::largest_time, level.modified_tau)
          .require(level.modified_tau == 0.0 || level.shape == Separation::Shape::well_clear,
                   ErrorCode::out_of_range, subject("modified_tau"), "must be 0 without the shape well_clear",
                   level.modified_tau);
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

}  // namespace kinesphere
