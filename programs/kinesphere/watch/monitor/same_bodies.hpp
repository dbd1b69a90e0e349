// Which ids may be one body: an id that goes on where another one ends, and two ids of one sender.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "archive/archive.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "watch/monitor/latest_places.hpp"
#include "watch/tracks/track_names.hpp"

namespace kinesphere::program {

/// A track that begins where another one may be, within what its class and all errors allow, is *linked* to
/// it: the two may be one body. A link ends in one of three ways.
///
/// - The earlier track stays silent for three of its intervals between reports. Then the later one goes on as
///   it: a handover.
/// - The earlier one reports again at another place or velocity: the two are two bodies. So they are, too,
///   where it reports again and they do not move, as a velocity of 0 says little.
/// - It reports again at the same place and velocity, within all errors, and so do both again: they are told
///   as one body under two ids, and stay linked as long as that holds.
///
/// Only the first report of a track makes a link: two that were apart before are never linked. Results depend
/// on the reports alone, so that all shards of a watch have equal ones.
class SameBodies {
 public:
  struct Limits {
    /// A track begins no farther than this from where the earlier one would be straight on (lengths).
    double horizontal = 0.0, vertical = 0.0;
    double fastest = 0.0;  ///< largest speed of all classes, in the plane; may be infinite
    double silence = 0.0;  ///< age at which a track is stale
    /// Tracks report about as often whatever they do: else each of them may be silent until it is stale.
    bool has_steady_rate = true;
    TrackId own = 0;  ///< is never given up; 0: none
  };
  /// `names` must outlive it.
  SameBodies(const Limits& limits, TrackNames& names);

  /// What a report changes.
  struct Change {
    std::vector<TrackId> parted{};  ///< the later one of each two that are not one body, as is certain now
    struct Pair {
      TrackId former = 0, later = 0;
    };
    std::optional<Pair> one_body{};  ///< two that are one body under two ids, told once
  };
  /// Takes a report of a track that the monitor has taken, too. `seen`: of the track, in the names.
  /// `is_first`: of its track. Cost: O(1), for a first one O(tracks that may be near).
  Change take(TrackId track, Sighting& seen, const TrackReport& report, bool is_first,
              const Monitor& monitor);

  /// The earlier one of a link has been silent for so long that it is given up.
  struct GivenUp {
    TrackId former = 0, later = 0;
    /// The later one goes on as it. False for the own track, and for one that may be silent though it has not
    /// ended, in a place larger than the separation: these count as two bodies.
    bool is_handover = false;
  };
  /// Returns the next link that has to be given up by this time, which is over then.
  std::optional<GivenUp> give_up(double time, const Monitor& monitor);
  /// Returns when the next link has to be given up; +infinity if none.
  double next_time() const;
  /// Call it before a track leaves the names. Returns the later one of two that have parted by that; 0: none.
  TrackId remove(TrackId track);
  /// Returns true for two tracks that may be one body.
  bool may_be_one(TrackId a, TrackId b) const;
  /// Returns the linked tracks of which no report has shown yet whether they are one body.
  std::vector<Change::Pair> undecided() const;
  /// Returns the track that is linked to this one and began later; 0: none.
  TrackId later_of(TrackId track) const;
  /// Forgets the ids that were given up before this time, which then may be linked again.
  void forget_before(double time);

  /// Archives the state that is not in the names. It is read once, with these names.
  static void serialize(auto& self, auto& archive) {
    archive(self.fastest_, self.given_up_);
    if constexpr (requires { self.given_up_.clear(); }) self.go_on();
  }

 private:
  /// Finds the places and links of the names.
  void go_on();
  bool is_linked_well(TrackId track) const;
  Sighting* find(TrackId track);
  const Sighting* find(TrackId track) const;
  void note(TrackId track, Sighting& seen, const TrackReport& report, bool is_first);
  void link(TrackId track, const TrackReport& report, const Monitor& monitor);
  void part(TrackId later);
  void schedule(TrackId later);
  void unschedule(TrackId later);
  void compare(TrackId later, const TrackReport& report, TrackId other, const Monitor& monitor,
               Change& change);
  bool may_be(const TrackReport& report, TrackId other, const Monitor& monitor) const;
  bool is_known_well(TrackId track, const Monitor& monitor) const;
  bool is_moving(const TrackReport& report, TrackId other) const;
  bool goes_back_to(TrackId track, TrackId earlier) const;

  Limits limits_;
  TrackNames& names_;
  LatestPlaces places_;
  double fastest_ = 0.0;                      ///< of all tracks so far, in the plane
  std::set<std::pair<double, TrackId>> due_;  ///< when which later track's link is given up
  std::map<TrackId, double> given_up_;        ///< ids that others have gone on as, and when
};

}  // namespace kinesphere::program
