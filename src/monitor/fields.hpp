// Serialization of the public structs of a monitor.
#pragma once

#include "archive/fields.hpp"
#include "kinesphere/monitor/monitor.hpp"

namespace kinesphere {

void serialize(Some<TrackClass> auto& self, auto& archive) {
  auto& [acceleration_limit, planned_acceleration, largest_speed] = self;
  archive(acceleration_limit, planned_acceleration, largest_speed);
}

void serialize(Some<SeparationRule> auto& self, auto& archive) {
  auto& [first_class, second_class, levels] = self;
  archive(first_class, second_class, levels);
}

void serialize(Some<Shard> auto& self, auto& archive) {
  auto& [of, first, count] = self;
  archive(of, first, count);
}

void serialize(Some<MonitorDefinition> auto& self, auto& archive) {
  auto& [dimensions, start_time, classes, separations, tolerance, time_resolution, window, stale_after,
         drop_after, prediction_hold, prediction_confirmation, prediction_margin, prediction_error_part,
         share] = self;
  archive(dimensions, start_time, classes, separations, tolerance, time_resolution, window, stale_after,
          drop_after, prediction_hold, prediction_confirmation, prediction_margin, prediction_error_part,
          share);
}

void serialize(Some<MonitorCounters> auto& self, auto& archive) {
  auto& [reports, late, repeated, contradictions, polls, windows, searches, near_pairs, looks] = self;
  archive(reports, late, repeated, contradictions, polls, windows, searches, near_pairs, looks);
}

}  // namespace kinesphere
