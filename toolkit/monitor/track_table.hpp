// Tracks of a monitor, by number and by id.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "kinesphere/monitor/monitor_event.hpp"
#include "monitor/track_estimate.hpp"
#include "number/id_index.hpp"

namespace kinesphere {

struct KnownTrack {
  TrackId id = 0;
  std::size_t track_class = 0;
  bool present = false;
  bool stale = false;
  double stay = 0.0;  ///< for how long its next regions are to contain it (time, > 0)
  double own = 0.0;   ///< it is in its regions until this time
  /// When it becomes stale or, if it is stale, is dropped.
  double silent_at = 0.0;
  TrackEstimate estimate{};
  std::vector<std::uint32_t> open;  ///< Numbers of the tracks with which this one has an open pair.
};

class TrackTable {
 public:
  std::size_t size() const { return numbers_.size(); }
  /// Returns an upper limit: all track numbers are less than this.
  std::uint32_t numbers() const { return static_cast<std::uint32_t>(tracks_.size()); }
  KnownTrack& operator[](std::uint32_t number) { return tracks_[number]; }
  const KnownTrack& operator[](std::uint32_t number) const { return tracks_[number]; }
  std::optional<std::uint32_t> find(TrackId id) const {
    const std::uint32_t number = numbers_.find(id);
    return number == IdIndex::none ? std::nullopt : std::optional(number);
  }

  std::uint32_t add(TrackId id, std::size_t track_class) {
    std::uint32_t number = numbers();
    if (free_.empty()) {
      tracks_.emplace_back();
    } else {
      number = free_.back();
      free_.pop_back();
    }
    numbers_.add(id, number);
    KnownTrack& track = tracks_[number];
    track.id = id;
    track.track_class = track_class;
    track.present = true;
    return number;
  }
  void remove(std::uint32_t number) {
    numbers_.remove(tracks_[number].id);
    tracks_[number] = {};
    free_.push_back(number);
  }
  std::vector<TrackId> ids() const {
    std::vector<TrackId> ids;
    ids.reserve(size());
    for (const KnownTrack& track : tracks_)
      if (track.present) ids.push_back(track.id);
    std::sort(ids.begin(), ids.end());
    return ids;
  }

  static void serialize(auto& self, auto& archive) {
    auto& [tracks, free, numbers] = self;
    archive(tracks, free);
  }
  /// Rebuilds the lookup by id of a restored table. Returns false if the table is invalid.
  bool index() {
    numbers_.clear();
    for (std::uint32_t number = 0; number < tracks_.size(); ++number) {
      const KnownTrack& track = tracks_[number];
      if (track.present && !numbers_.add(track.id, number)) return false;
    }
    std::vector<bool> seen(tracks_.size(), false);
    for (const std::uint32_t number : free_) {
      if (number >= tracks_.size() || tracks_[number].present || seen[number]) return false;
      seen[number] = true;
    }
    return numbers_.size() + free_.size() == tracks_.size();
  }

 private:
  std::vector<KnownTrack> tracks_;
  std::vector<std::uint32_t> free_;
  IdIndex numbers_;
};

}  // namespace kinesphere
