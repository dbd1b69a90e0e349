// The tracks of a watch, and their reports as the monitor takes them.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "formats/streams/source_report.hpp"
#include "watch/clock/report_clock.hpp"
#include "watch/tracks/rest.hpp"
#include "watch/tracks/track_classes.hpp"
#include "watch/tracks/track_map.hpp"
#include "watch/tracks/track_names.hpp"
#include "watch/watch_counts.hpp"
#include "watch/watch_settings.hpp"

namespace kinesphere::program {

/// Knows the tracks by their ids: which class each is in, where its latest report was, whether it is at rest.
/// Says which reports can be used, and counts the others.
class WatchedTracks {
 public:
  using Refuse = std::function<void(const std::string& reason)>;

  /// All arguments must outlive it. `refuse` receives why a report is malformed.
  WatchedTracks(const WatchSettings& settings, WatchCounts& counts, const ReportClock& clock, Refuse refuse);

  /// Adds the classes that the stream may say; the first call alone does so.
  void begin_classes(const SourceReport& report);
  /// Begins the map with the first report that can be used. Throws ProgramError naming a wrong option.
  void begin_map(const SourceReport& report);

  /// A report and its track.
  struct Arrival {
    const SourceReport& report;
    TrackId id = 0;
    NamedTrack* known = nullptr;  ///< null: it is the first one of its track
    Declared declared{};
    TrackReport on_map{};  ///< as the monitor takes it
  };
  /// Fills in the track and class of a report. Returns false if it does not say how far its track goes.
  bool recognise(Arrival& arrival);
  /// Counts a report that does not say how far its track goes. Throws ProgramError if none has been taken
  /// before (`is_first`).
  void refuse_without_velocity(bool is_first);
  /// Fills in the report on the map. Returns false for a report that cannot be used, or that adds a track
  /// where there is no room. Precondition: the map has begun.
  bool place(Arrival& arrival, bool has_room);
  /// Remembers a report that the monitor has taken. Returns true if its track was at rest and is no more.
  bool remember(Arrival& arrival);

  TrackNames& names() { return names_; }
  const TrackNames& names() const { return names_; }
  const TrackClasses& classes() const { return classes_; }
  const TrackMap& map() const { return map_; }
  /// True if both tracks are at rest.
  bool are_at_rest(TrackId first, TrackId second) const;
  bool has_rest() const { return rest_.speed > 0.0; }

  static void serialize(auto& self, auto& archive) {
    archive(self.classes_, self.names_, self.map_, self.has_map_);
    if constexpr (requires { self.go_on(); }) self.go_on();
  }

 private:
  /// Begins the map again, as serialize() has read it. Throws WrongInput for a class that is none.
  void go_on();
  bool is_usable(const Arrival& arrival, bool has_room);
  bool is_superseded(const Arrival& arrival) const;
  bool note_rest(const Arrival& arrival, bool is_first);

  const WatchSettings& settings_;
  WatchCounts& counts_;
  const ReportClock& clock_;
  Refuse refuse_;
  TrackClasses classes_;
  TrackNames names_;
  TrackMap map_;
  bool has_map_ = false;
  RestRule rest_;
};

}  // namespace kinesphere::program
