// What is declared of the tracks and reports of a format, where neither the stream nor an option says it.
#include "watch/format_defaults.hpp"

#include "watch/tracks/motion_classes.hpp"

namespace kinesphere::program {
namespace {

/// 92.6 m and 10 m/s (95 % of errors) are the requirements of 14 CFR 91.227 and (EU) 1207/2011 for mandatory
/// ADS-B (NACp 8, NACv 1); 75 m is the altimeter error that ICAO Doc 9574 allows, and half of 25 ft is the
/// resolution of height reports.
FormatDefaults of_aircraft() {
  constexpr double declared = 2.5;
  const MotionLimits limits = motion_class(MotionPreset::airliner).limits;
  return {.acceleration = limits.acceleration,
          .largest_speed = limits.largest_speed,
          .position_error = declared * 92.6,
          .height_error = 75.0 + 12.5 * foot,
          .velocity_error = declared * 10.0,
          .climb_error = declared * 50.0 * foot,
          .stamp_error = 0.6,
          .velocity_age = 2.0,
          .silence = 15.0,
          .forget = 60.0,
          .window = 1.0,
          .look_ahead = 60.0};
}

FormatDefaults of_vessels() {
  constexpr double declared = 2.5;
  const MotionLimits limits = motion_class(MotionPreset::vessel).limits;
  return {.dimensions = 2,
          .acceleration = limits.acceleration,
          .largest_speed = limits.largest_speed,
          .position_error = declared * 10.0,
          .height_error = 0.0,
          .velocity_error = declared * 0.5,
          .climb_error = 0.0,
          .stamp_error = 1.0,
          .silence = 210.0,
          .forget = 600.0,
          .window = 16.0,
          .look_ahead = 60.0,
          .rest_speed = 0.5,
          .has_steady_rate = false};
}

/// Sentences of AIS say whether a position is within 10 m or worse. 100 m (95 %) is what IMO MSC.112(73) asks
/// of ships' receivers of GPS; since GPS is no longer degraded on purpose it is declared to contain all
/// errors.
FormatDefaults of_stations() {
  FormatDefaults defaults = of_vessels();
  defaults.position_error = 100.0;
  return defaults;
}

}  // namespace

FormatDefaults defaults_of(StreamFormat format) {
  switch (format) {
    case StreamFormat::readsb:
    case StreamFormat::sbs:
      return of_aircraft();
    case StreamFormat::opensky: {
      FormatDefaults defaults = of_aircraft();
      // Timestamps are whole seconds, of snapshots about ten seconds apart.
      defaults.stamp_error = 1.0;
      defaults.silence = 30.0;
      defaults.forget = 120.0;
      defaults.window = 8.0;
      return defaults;
    }
    case StreamFormat::ais:
      return of_vessels();
    case StreamFormat::nmea:
      return of_stations();
    case StreamFormat::csv:
    case StreamFormat::jsonl:
    case StreamFormat::json:
    case StreamFormat::recording:
      break;
  }
  return {.geographic = false};
}

}  // namespace kinesphere::program
