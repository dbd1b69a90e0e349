// The tracks of a watch by their ids in the stream.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

#include "kinesphere/monitor/monitor_event.hpp"
#include "watch/source_report.hpp"

namespace kinesphere::program {

/// A number for an id: the same in every process and at every time. Those of two ids that differ are the same
/// once in 2^64 times; TrackNames finds it out.
TrackId track_id_of(std::string_view text);

/// What the watch knows of a track besides the monitor.
struct NamedTrack {
  std::string text;
  FileTime stamp{};  ///< of its latest report
  Vec3 position{};   ///< in the stream's own words
  /// What declares the bounds of its latest report.
  std::string_view position_by, height_by, velocity_by, climb_by;
};

class TrackNames {
 public:
  NamedTrack* find(TrackId id) {
    const auto at = names_.find(id);
    return at == names_.end() ? nullptr : &at->second;
  }
  const NamedTrack* find(TrackId id) const {
    const auto at = names_.find(id);
    return at == names_.end() ? nullptr : &at->second;
  }
  /// As it was spelled; empty for one that has left.
  const std::string& text(TrackId id) const;
  NamedTrack& add(TrackId id, std::string_view text);
  void remove(TrackId id) { names_.erase(id); }
  std::size_t size() const { return names_.size(); }
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const auto& [id, track] : names_) visit(track);
  }

 private:
  std::unordered_map<TrackId, NamedTrack> names_;
};

}  // namespace kinesphere::program
