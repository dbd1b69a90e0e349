// Serialization of the public structs of a monitor.
#pragma once

#include <cstdint>

#include "archive/fields.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "monitor/pair_records.hpp"

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
         drop_after, prediction_hold, share] = self;
  archive(dimensions, start_time, classes, separations, tolerance, time_resolution, window, stale_after,
          drop_after, prediction_hold, share);
}

void serialize(Some<MonitorCounters> auto& self, auto& archive) {
  auto& [reports, late, repeated, contradictions, polls, windows, searches, near_pairs, looks] = self;
  archive(reports, late, repeated, contradictions, polls, windows, searches, near_pairs, looks);
}

/// A PairRecord with the numbers of its tracks, as stored in a snapshot.
struct SavedRecord {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  PairRecord record{};

  static void serialize(auto& self, auto& archive) {
    auto& [first, second, record] = self;
    archive(first, second, record);
  }
};

}  // namespace kinesphere
