// Selects the events of a monitor that are written as alerts: few for each encounter of two tracks.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "archive/archive.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "watch/watch_settings.hpp"

namespace kinesphere::program {

/// Whether an event is written, or why it is not.
enum class AlertFate {
  written,
  undecided,   ///< the verdict changes between apart and undecided, which is not asked for
  of_track,    ///< it is about a single track, which is not asked for
  other_kind,  ///< another kind that is not asked for
  encounter,   ///< another alert of the same encounter tells it
  same_body,   ///< the two may be one body under two ids (SameBodies)
  at_rest,     ///< both are at rest (RestRule), and have been told once
  elsewhere,   ///< neither track is in an area (--area)
  too_many,    ///< there were too many alerts in this second (--most-alerts)
};
inline constexpr std::size_t alert_fates = 9;

/// Two tracks at one separation, from the event that they come within it until it is over: until they are no
/// longer predicted to, and, if they certainly were within it, are certainly apart.
struct Encounter {
  bool predicted = false;
  bool within = false;  ///< it was certain, and `apart` has not been since
  double predicted_since = 0.0, within_since = 0.0;
  /// An alert has told `predicted`, or that it certainly is within.
  bool predicted_told = false, within_told = false;
  bool is_told() const { return predicted_told || within_told; }
  /// When one of the two became stale: the closest approach that was expected then.
  struct Loss {
    double closest_time, closest_distance;
  };
  std::optional<Loss> loss{};
  bool silence_told = false;  ///< an alert has told that one of the two became stale
  bool is_elsewhere = false;  ///< its begin is not told because neither track was in an area
  bool is_held = false;       ///< nothing is told of it until release()
};

/// The policy. If changes of `undecided` are asked for, every event of a kind that is asked for is written.
/// Otherwise an encounter has at most three alerts: that it is predicted, unless it is within already; that
/// it certainly is within; and that it is over.
///
/// Apart from AlertFate::too_many, the fate of an event depends on the events of its pair alone. So the
/// shards of a watch write the same alerts as a watch of all pairs.
class AlertPolicy {
 public:
  struct Key {
    TrackId first = 0, second = 0;
    std::uint32_t level = 0;
    friend auto operator<=>(const Key&, const Key&) = default;
  };

  AlertPolicy(const AlertKinds& kinds, std::uint64_t most_alerts) : kinds_(kinds), most_(most_alerts) {}

  /// Takes the next event of a pair. `is_in_area`: one of its tracks is in an area, or there are no areas.
  /// `held`: the fate of all events of the pair from now on, until release(); of two at rest, of all but the
  /// first one. Where the event is written, `before` and `since` of a verdict are set to what alerts have
  /// told.
  AlertFate take(MonitorEvent& event, bool is_in_area, std::optional<AlertFate> held = std::nullopt);
  /// Events of a pair are told again or, if it is `held` further, once. Returns the event that tells what has
  /// changed for the reader meanwhile, if one is due. Precondition: there is this encounter, and it is held.
  std::optional<MonitorEvent> release(const Key& key, double time, bool is_in_area, bool held = false);
  /// Returns the events that tell of encounters of a track which begin for the reader when the track enters
  /// an area. Cost: O(log(encounters) + encounters of the track).
  std::vector<MonitorEvent> enter_area(TrackId track, double time);
  /// Returns the encounters of a track, and those that were over while they were held and told before. Cost:
  /// O(log(encounters) + encounters of the track).
  std::vector<Key> encounters_of(TrackId track) const;
  /// Calls visit(key) for each encounter.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const auto& [key, encounter] : encounters_) visit(key);
  }
  /// Precondition: there is this encounter.
  Encounter& encounter(const Key& key) { return encounters_.at(key); }
  /// Ends the encounters of a track without an event. Cost: O(log(encounters)) for each of them.
  void forget(TrackId track);

  /// Counts one more alert at this time. Returns false if there are too many in its second.
  bool has_room(double time);
  /// Alerts that has_room() has refused in one second.
  struct Refused {
    double since = 0.0;
    std::uint64_t alerts = 0;
  };
  /// Returns, once, what has been refused in a second that is over at this time.
  std::optional<Refused> refused_before(double time);

  static void serialize(auto& self, auto& archive) {
    archive(self.encounters_, self.second_, self.written_, self.refused_);
    if constexpr (requires { self.by_track_.clear(); })
      for (const auto& [key, encounter] : self.encounters_)
        self.by_track_.insert({{key.first, key}, {key.second, key}});
  }

 private:
  AlertFate fate_of(const MonitorEvent& event, const Encounter& encounter) const;
  MonitorEvent begin_of(const Key& key, Encounter& encounter, double time) const;
  void put(const Key& key, const Encounter& encounter);
  void erase(const Key& key);

  AlertKinds kinds_;
  std::uint64_t most_;  ///< alerts per second
  std::map<Key, Encounter> encounters_;
  std::set<std::pair<TrackId, Key>> by_track_;  ///< the keys of encounters_, by each of their two tracks
  double second_ = 0.0;                         ///< begin of the second that is counted
  std::uint64_t written_ = 0;                   ///< in that second
  Refused refused_;
};

}  // namespace kinesphere::program
