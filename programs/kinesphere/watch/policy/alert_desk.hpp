// What a watch tells of the events of its monitor.
#pragma once

#include <optional>
#include <string>

#include "watch/monitor/pair_monitor.hpp"
#include "watch/policy/alert_policy.hpp"
#include "watch/tracks/watched_tracks.hpp"
#include "watch/watch_counts.hpp"
#include "watch/watch_settings.hpp"

namespace kinesphere::program {

/// A track that was lost in an encounter.
struct LostTrack {
  double time = 0.0;
  TrackId track = 0;
  AlertPolicy::Key key{};
  const Encounter& encounter;  ///< with a loss
  LeftFor left_for{};          ///< "stale", "dropped" or "handover"
};

/// Passes on, of what happens to pairs and tracks, what the policy chooses (AlertPolicy), with the areas, the
/// share and the pairs that are held back: of ids that may be one body, and of tracks at rest.
class AlertDesk final : public PairMonitor::Next {
 public:
  /// Receives the alerts, in the order of their times, with the share of each. The monitor is at their time.
  class Next {
   public:
    virtual ~Next() = default;
    virtual void write_event(std::uint64_t share, const MonitorEvent& event, const LeftFor& left_for) = 0;
    virtual void write_lost(std::uint64_t share, const LostTrack& lost) = 0;
    virtual void write_one_body(std::uint64_t share, double time, TrackId first, TrackId second) = 0;
    virtual void write_group(std::uint64_t share, double time, const std::string& name,
                             std::size_t tracks) = 0;
    virtual void write_refused(std::uint64_t share, const AlertPolicy::Refused& refused) = 0;
  };

  /// All arguments must outlive it.
  AlertDesk(const WatchSettings& settings, WatchCounts& counts, const WatchedTracks& tracks,
            const PairMonitor& pairs, Next& next);

  void tell(const MonitorEvent& event, const LeftFor& left_for) override;
  void forget(TrackId track) override { policy_.forget(track); }
  void release(TrackId track) override;
  void hand_over(TrackId former, const LeftFor& left_for) override;
  void tell_one_body(TrackId former, TrackId later) override;
  void tell_group(const std::string& name, std::size_t tracks) override;
  /// Tells of the encounters of a track that has entered an area.
  void enter_area(TrackId track);
  /// Tells how many alerts were too many, at the end of the stream.
  void finish();

  /// Returns the number of pairs that are not told because reports have not shown yet whether they are one
  /// body.
  std::size_t undecided_bodies() const;

  static void serialize(auto& self, auto& archive) {
    archive(self.policy_);
    if constexpr (requires { self.policy_.forget(0); }) self.check();
  }

 private:
  /// Throws WrongInput for encounters that have been read and cannot be.
  void check() const;
  const Monitor& monitor() const { return *pairs_.monitor(); }
  AlertFate fate_of(MonitorEvent& event);
  std::optional<AlertFate> hold_of(const MonitorEvent& event) const;
  std::optional<AlertFate> hold_of(TrackId first, TrackId second) const;
  bool is_in_area(TrackId track) const;
  bool is_in_area(const AlertPolicy::Key& pair) const;
  void count_and_write(MonitorEvent event, const LeftFor& left_for);
  void tell_lost(const MonitorEvent& event);
  void tell_lost(TrackId track, const AlertPolicy::Key& key, const Encounter& encounter,
                 const LeftFor& left_for);
  void write_event(const MonitorEvent& event, const LeftFor& left_for = {});
  /// Counts an alert of a track, or of a pair with this lower one, and returns its share.
  std::uint64_t begin_alert(TrackId lower);
  void note_loss(const AlertPolicy::Key& key, Encounter& encounter) const;
  void write_refused(double time);

  const WatchSettings& settings_;
  WatchCounts& counts_;
  const WatchedTracks& tracks_;
  const PairMonitor& pairs_;
  Next& next_;
  AlertPolicy policy_;
};

}  // namespace kinesphere::program
