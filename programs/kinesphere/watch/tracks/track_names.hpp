// The tracks of a watch, by their ids in the stream.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "formats/streams/known_names.hpp"
#include "formats/streams/source_report.hpp"
#include "kinesphere/monitor/monitor_event.hpp"
#include "number/id_index.hpp"
#include "watch/tracks/archived_report.hpp"
#include "watch/tracks/rest.hpp"
#include "watch/tracks/sighting.hpp"

namespace kinesphere::program {

/// Returns a number for an id, equal in every process. Two different ids have equal numbers once in 2^64
/// pairs; TrackNames detects it.
TrackId track_id_of(std::string_view text);

/// Declared::height_by of a track whose height may be any.
inline constexpr std::string_view unknown_height = "unknown";

/// What is declared of a track with a report.
struct Declared {
  std::size_t motion_class = 0;  ///< an index of TrackClasses
  /// Sources of the bounds.
  std::string_view position_by{}, height_by{}, velocity_by{}, climb_by{};

  static void serialize(auto& self, auto& archive) {
    auto& [motion_class, position_by, height_by, velocity_by, climb_by] = self;
    archive(motion_class);
    archive_texts(archive, position_by, height_by, velocity_by, climb_by);
  }
};

/// State of a track that the monitor does not hold.
struct NamedTrack {
  std::string text;
  std::string name;     ///< callsign or ship's name as shown_name() of the latest that came; empty: none came
  FileTime stamp{};     ///< timestamp of its latest report
  Vec3 position{};      ///< in the stream's own words
  double extent = 0.0;  ///< of its latest report
  Declared declared{};  ///< with its latest report
  /// Timestamp of the report that has changed the class; empty: none has.
  std::optional<FileTime> class_since{};
  /// Timestamp of the latest report that said that the craft is at rest, with a speed that contradicts it.
  std::optional<FileTime> contradicted_rest{};
  Sighting seen{};  ///< kept by SameBodies; without reports where it is not used, and of a group
  Rest rest{};
};

class TrackNames {
 public:
  /// Returns nullptr for an unknown track. The pointer is valid until a track is removed.
  const NamedTrack* find(TrackId id) const {
    const std::uint32_t number = numbers_.find(id);
    return number == IdIndex::none ? nullptr : &tracks_[number];
  }
  NamedTrack* find(TrackId id) { return const_cast<NamedTrack*>(std::as_const(*this).find(id)); }
  /// Returns the id as spelled in the stream; empty for a dropped track.
  const std::string& text(TrackId id) const;
  NamedTrack& add(TrackId id, std::string_view text);
  void remove(TrackId id);
  std::size_t size() const { return tracks_.size(); }
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const NamedTrack& track : tracks_) visit(track);
  }

  static void serialize(auto& self, auto& archive) {
    archive(self.tracks_);
    if constexpr (requires { self.index(); }) self.index();
  }

 private:
  /// Finds the numbers of tracks that have been read.
  void index();

  IdIndex numbers_;
  std::deque<NamedTrack> tracks_;
};

}  // namespace kinesphere::program
