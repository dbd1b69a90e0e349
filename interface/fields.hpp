// Generated from include/kinesphere.h by interface/generate.py: change the header, and run that.
// Each function calls visit("name", records.name...) for the fields that kinesphere.h and the library have in
// common. Lists, fields that may be missing, and parts of a record are left to the caller.
// clang-format off
#pragma once

namespace kinesphere::fields {

template <class Visit, class... Records>
constexpr void each_body_definition_field(Visit&& visit, Records&... records) {
  visit("solid", records.solid...);
  visit("contacts", records.contacts...);
  visit("sensor_class", records.sensor_class...);
  visit("radius", records.radius...);
  visit("acceleration_limit", records.acceleration_limit...);
  visit("position_error", records.position_error...);
  visit("velocity_error", records.velocity_error...);
  visit("mass", records.mass...);
  visit("planned_acceleration", records.planned_acceleration...);
  visit("position", records.position...);
  visit("velocity", records.velocity...);
  visit("filter", records.filter...);
  visit("user_data", records.user_data...);
}

template <class Visit, class... Records>
constexpr void each_motion_limits_field(Visit&& visit, Records&... records) {
  visit("acceleration_limit", records.acceleration_limit...);
  visit("position_error", records.position_error...);
  visit("velocity_error", records.velocity_error...);
  visit("planned_acceleration", records.planned_acceleration...);
}

template <class Visit, class... Records>
constexpr void each_world_definition_field(Visit&& visit, Records&... records) {
  visit("dimensions", records.dimensions...);
  visit("periodic", records.periodic...);
  visit("contact_tolerance", records.contact_tolerance...);
  visit("separation_distance", records.separation_distance...);
  visit("zeno_interval", records.zeno_interval...);
  visit("start_time", records.start_time...);
  visit("contacts", records.contacts...);
  visit("allow_overlap", records.allow_overlap...);
  visit("spread_window_starts", records.spread_window_starts...);
  visit("adopt_observed_limits", records.adopt_observed_limits...);
  visit("shear_rate", records.shear_rate...);
}

template <class Visit, class... Records>
constexpr void each_track_class_field(Visit&& visit, Records&... records) {
  visit("acceleration_limit", records.acceleration_limit...);
  visit("largest_speed", records.largest_speed...);
  visit("planned_acceleration", records.planned_acceleration...);
}

template <class Visit, class... Records>
constexpr void each_separation_field(Visit&& visit, Records&... records) {
  visit("shape", records.shape...);
  visit("horizontal", records.horizontal...);
  visit("vertical", records.vertical...);
  visit("look_ahead", records.look_ahead...);
  visit("modified_tau", records.modified_tau...);
}

template <class Visit, class... Records>
constexpr void each_monitor_definition_field(Visit&& visit, Records&... records) {
  visit("dimensions", records.dimensions...);
  visit("tolerance", records.tolerance...);
  visit("time_resolution", records.time_resolution...);
  visit("window", records.window...);
  visit("stale_after", records.stale_after...);
  visit("drop_after", records.drop_after...);
  visit("prediction_hold", records.prediction_hold...);
  visit("prediction_confirmation", records.prediction_confirmation...);
  visit("prediction_margin", records.prediction_margin...);
  visit("prediction_error_part", records.prediction_error_part...);
}

template <class Visit, class... Records>
constexpr void each_track_report_field(Visit&& visit, Records&... records) {
  visit("track_class", records.track_class...);
  visit("timestamp", records.timestamp...);
  visit("timestamp_error", records.timestamp_error...);
  visit("state", records.state...);
  visit("position_error", records.position_error...);
  visit("velocity_error", records.velocity_error...);
}

template <class Visit, class... Records>
constexpr void each_monitor_event_field(Visit&& visit, Records&... records) {
  visit("kind", records.kind...);
  visit("time", records.time...);
  visit("first", records.first...);
  visit("second", records.second...);
  visit("level", records.level...);
  visit("verdict", records.verdict...);
  visit("before", records.before...);
  visit("since", records.since...);
  visit("likely_time", records.likely_time...);
  visit("closest_time", records.closest_time...);
  visit("closest_distance", records.closest_distance...);
  visit("position_excess", records.position_excess...);
  visit("velocity_excess", records.velocity_excess...);
}

template <class Visit, class... Records>
constexpr void each_pair_answer_field(Visit&& visit, Records&... records) {
  visit("verdict", records.verdict...);
  visit("predicted", records.predicted...);
  visit("since", records.since...);
  visit("until", records.until...);
  visit("lower", records.lower...);
  visit("upper", records.upper...);
  visit("closest_distance", records.closest_distance...);
  visit("closest_time", records.closest_time...);
  visit("closest_horizontal", records.closest_horizontal...);
  visit("closest_vertical", records.closest_vertical...);
  visit("relative_speed", records.relative_speed...);
  visit("likely_time", records.likely_time...);
  visit("inevitable_by", records.inevitable_by...);
  visit("avoidable_until", records.avoidable_until...);
  visit("ask", records.ask...);
  visit("ask_by", records.ask_by...);
}

template <class Visit, class... Records>
constexpr void each_open_pair_field(Visit&& visit, Records&... records) {
  visit("first", records.first...);
  visit("second", records.second...);
  visit("level", records.level...);
  visit("verdict", records.verdict...);
  visit("since", records.since...);
}

template <class Visit, class... Records>
constexpr void each_predicted_pair_field(Visit&& visit, Records&... records) {
  visit("first", records.first...);
  visit("second", records.second...);
  visit("level", records.level...);
  visit("since", records.since...);
  visit("likely_time", records.likely_time...);
  visit("closest_time", records.closest_time...);
  visit("closest_distance", records.closest_distance...);
}

template <class Visit, class... Records>
constexpr void each_report_request_field(Visit&& visit, Records&... records) {
  visit("track", records.track...);
  visit("other", records.other...);
  visit("by", records.by...);
}

template <class Visit, class... Records>
constexpr void each_track_place_field(Visit&& visit, Records&... records) {
  visit("centre", records.centre...);
  visit("velocity", records.velocity...);
  visit("radius", records.radius...);
}

/// Returns a record whose fields are convert(field of `from`), and the others those of an empty one.
template <class To, class From, class Convert>
constexpr To make_event(const From& from, const Convert& convert) {
  return {
      .kind = convert(from.kind),
      .time = convert(from.time),
      .first = convert(from.first),
      .second = convert(from.second),
      .wall = convert(from.wall),
      .repeated = convert(from.repeated),
      .jammed = convert(from.jammed),
      .already_touching = convert(from.already_touching),
      .senses = convert(from.senses),
      .first_traits = convert(from.first_traits),
      .second_traits = convert(from.second_traits),
      .pair_state = convert(from.pair_state),
      .first_state = convert(from.first_state),
      .second_state = convert(from.second_state),
      .point = convert(from.point),
      .normal = convert(from.normal),
      .gap = convert(from.gap),
      .approach_speed = convert(from.approach_speed),
      .position_excess = convert(from.position_excess),
      .velocity_excess = convert(from.velocity_excess),
      .distance = convert(from.distance),
      .first_user_data = convert(from.first_user_data),
      .second_user_data = convert(from.second_user_data),
      .first_mass = convert(from.first_mass),
      .second_mass = convert(from.second_mass),
      .first_part = convert(from.first_part),
      .second_part = convert(from.second_part),
      .first_angular_velocity = convert(from.first_angular_velocity),
      .second_angular_velocity = convert(from.second_angular_velocity),
      .first_spin_gain = convert(from.first_spin_gain),
      .second_spin_gain = convert(from.second_spin_gain),
      .acceleration_limit = convert(from.acceleration_limit),
  };
}

}  // namespace kinesphere::fields
