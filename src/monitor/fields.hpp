// Serialization of the public structs of a monitor.
#pragma once

#include <cstdint>

#include "archive/fields.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "monitor/pair_records.hpp"

namespace kinesphere {

template <Some<TrackClass> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [acceleration_limit, planned_acceleration, largest_speed] = self;
  archive(acceleration_limit, planned_acceleration, largest_speed);
}

template <Some<SeparationRule> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [first_class, second_class, levels] = self;
  archive(first_class, second_class, levels);
}

template <Some<Shard> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [of, first, count] = self;
  archive(of, first, count);
}

template <Some<MonitorDefinition> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [dimensions, start_time, classes, separations, tolerance, time_resolution, window, stale_after,
         drop_after, share] = self;
  archive(dimensions, start_time, classes, separations, tolerance, time_resolution, window, stale_after,
          drop_after, share);
}

template <Some<MonitorCounters> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [reports, late, repeated, contradictions, polls, windows, searches, near_pairs, looks] = self;
  archive(reports, late, repeated, contradictions, polls, windows, searches, near_pairs, looks);
}

/// A PairRecord with the numbers of its tracks, as stored in a snapshot.
struct SavedRecord {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  PairRecord record{};

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [first, second, record] = self;
    archive(first, second, record);
  }
};

}  // namespace kinesphere
