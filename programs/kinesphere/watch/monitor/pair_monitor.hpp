// The monitor of a watch, and the pairs that are none: crowds that stand, and ids of one body.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"
#include "watch/monitor/same_bodies.hpp"
#include "watch/monitor/track_groups.hpp"
#include "watch/tracks/watched_tracks.hpp"
#include "watch/watch_counts.hpp"
#include "watch/watch_settings.hpp"

namespace kinesphere::program {

/// Why a track is no longer watched.
struct LeftFor {
  std::string_view reason{};  ///< "silence", "crowd", "group", "dissolved", "handover"
  std::string later{};        ///< of a handover: the id of the track that goes on as this one
};

/// Passes reports on to the monitor, and its events to what comes behind, at their times. Tracks that stand
/// in a crowd are one track for the monitor (TrackGroups); a track that goes on under another id is removed
/// (SameBodies).
class PairMonitor {
 public:
  /// What comes behind the monitor. The monitor is at the time of what is told.
  class Next {
   public:
    virtual ~Next() = default;
    /// Receives an event. `left_for`: why the track of a `dropped` was removed.
    virtual void tell(const MonitorEvent& event, const LeftFor& left_for) = 0;
    /// A track has left, and nothing more is told of it.
    virtual void forget(TrackId track) = 0;
    /// Pairs of a track may be held back no more (is_one_body(), or at rest).
    virtual void release(TrackId track) = 0;
    /// A track is removed, as another one goes on as it.
    virtual void hand_over(TrackId former, const LeftFor& left_for) = 0;
    /// Two tracks are one body under two ids.
    virtual void tell_one_body(TrackId former, TrackId later) = 0;
    /// A group of so many tracks has begun.
    virtual void tell_group(const std::string& name, std::size_t tracks) = 0;
  };

  /// All arguments must outlive it.
  PairMonitor(const WatchSettings& settings, WatchCounts& counts, WatchedTracks& tracks, Next& next);

  /// Begins once the tracks have a map, at this time.
  void begin(double start_time);
  /// Empty before that. The functions behind need it.
  const std::optional<Monitor>& monitor() const { return monitor_; }
  /// Moves time on to `now`, but never back.
  void go_on(double now);
  /// Passes on all events that are certain at the present time.
  void settle() { advance(monitor_->time()); }
  /// True if the limits allow another track.
  bool has_room() const;
  /// What has become of a report.
  enum class Taken {
    alone,     ///< its track is one of the monitor's
    in_group,  ///< its track is in a group
    refused,   ///< the monitor refuses it (`refusal`)
  };
  Taken take(const WatchedTracks::Arrival& arrival, std::string& refusal);
  /// Compares the body of a report that was taken with others, after the tracks have remembered it.
  /// `is_first`: the first one of its track.
  void compare(const WatchedTracks::Arrival& arrival, bool is_first);
  /// Pairs of a track will be held back no more, with release_due().
  void release_later(TrackId track) { to_release_.push_back(track); }
  /// Moves on to what the latest report has changed, and releases the tracks that are to be.
  void release_due();

  /// True if two tracks may be one body.
  bool may_be_one(TrackId first, TrackId second) const {
    return bodies_ && bodies_->may_be_one(first, second);
  }
  /// Returns the pairs of which reports have not shown yet whether they are one body.
  std::vector<SameBodies::Change::Pair> undecided() const;

  static void serialize(auto& self, auto& archive) {
    constexpr bool reads = requires { self.monitor_.reset(); };
    std::vector<std::byte> monitor;
    if (self.monitor_) monitor = self.monitor_->save();
    archive(monitor);
    if (monitor.empty()) return;
    if constexpr (reads) self.restore(monitor);
    archive(*self.groups_, self.group_tracks_, self.next_forgetting_);
    if (self.bodies_) archive(*self.bodies_);
    if constexpr (reads) self.check();
  }

 private:
  void restore(const std::vector<std::byte>& monitor);
  /// Throws WrongInput unless all tracks that have been read are those of the monitor.
  void check() const;
  void begin_bodies();
  TrackGroups::Cutting cutting() const;
  void advance(double until);
  void give_up_until(double time);
  void drop_crowd();
  void remove(TrackId track, const LeftFor& left_for);
  void leave(TrackId track);
  void release_from(TrackId later);
  bool is_in_group(const WatchedTracks::Arrival& arrival, std::optional<TrackGroups::Cell>& group);
  void report_group(const TrackGroups::Cell& group, const WatchedTracks::Arrival& arrival);
  void end_group(const TrackGroups::Cell& group);
  std::string group_name(const TrackGroups::Cell& group) const;

  const WatchSettings& settings_;
  WatchCounts& counts_;
  WatchedTracks& tracks_;
  Next& next_;
  std::optional<Monitor> monitor_;
  std::optional<SameBodies> bodies_;                   ///< with the monitor, unless each id counts as a body
  std::optional<TrackGroups> groups_;                  ///< with the monitor
  std::map<TrackId, TrackGroups::Cell> group_tracks_;  ///< the tracks that stand for groups
  double next_forgetting_ = 0.0;        ///< time at which what is stale in groups and bodies is forgotten
  std::map<TrackId, LeftFor> removed_;  ///< why tracks were removed whose events are still to come
  std::vector<TrackId> to_release_;
};

}  // namespace kinesphere::program
