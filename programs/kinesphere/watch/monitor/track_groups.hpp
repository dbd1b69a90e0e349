// Groups of tracks that stand at one place, so many that their pairs would cost more than they say: a full
// hangar, or senders without a position of their own that all send the same one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "archive/archive.hpp"
#include "kinesphere/monitor/monitor_event.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere::program {

/// Space is cut into cells. A cell in which `least_members` tracks stand is a group, until fewer than half as
/// many are left.
class TrackGroups {
 public:
  static constexpr std::size_t least_members = 20;

  struct Cutting {
    double edge = 0.0;    ///< horizontal edge of a cell (length, > 0)
    double height = 0.0;  ///< vertical edge (length, > 0); 0: cells have any height
    double slow = 0.0;    ///< a track that is not faster than this stands (length / time)
  };
  explicit TrackGroups(const Cutting& cutting) : cutting_(cutting) {}

  using Cell = std::array<std::int64_t, 3>;
  Vec3 centre_of(const Cell& cell) const;
  const Cutting& cutting() const { return cutting_; }

  /// What a report changes.
  struct Outcome {
    std::optional<Cell> group;      ///< the group that the track now is in
    std::vector<TrackId> joined;    ///< the tracks that were alone and are in that group now
    bool is_new = false;            ///< the group is new
    std::optional<Cell> dissolved;  ///< the group that the track has left, if it is none any more
  };
  /// Takes a report of a track. `speed` is empty where the report has none: such a track stands if it is
  /// exactly where the latest one of its cell was. Cost: O(log tracks) but for a group that begins.
  Outcome take(TrackId track, const Vec3& position, const std::optional<double>& speed, double time);
  /// Returns true, once in each period of this length, for the report of a group's member.
  bool is_due(const Cell& group, double time, double period);
  /// Ends a group. Its members are alone until their next reports. Cost: O(members).
  void dissolve(const Cell& group);
  /// Forgets the tracks whose latest report is older than `time`, and returns the groups that end by that.
  /// Cost: O(tracks).
  std::vector<Cell> forget_before(double time);
  /// Returns the number of tracks that stand.
  std::size_t size() const { return standing_.size(); }
  bool contains(TrackId track) const { return standing_.contains(track); }
  bool is_group(const Cell& cell) const {
    const auto place = places_.find(cell);
    return place != places_.end() && place->second.is_group;
  }

  static void serialize(auto& self, auto& archive) {
    std::map<TrackId, Standing> standing(self.standing_.begin(), self.standing_.end());
    archive(self.places_, standing);
    if constexpr (requires { self.standing_.clear(); }) {
      self.standing_ = {standing.begin(), standing.end()};
      self.check();
    }
  }

 private:
  struct Place {
    std::set<TrackId> tracks;
    Vec3 latest{};
    bool is_group = false;
    double reported = 0.0;  ///< time of the last report for which is_due() was true
  };
  struct Standing {
    Cell cell{};
    double time = 0.0;
  };
  std::optional<Cell> cell_of(const Vec3& position) const;
  std::optional<Cell> leave(TrackId track);
  /// Throws WrongInput unless each standing track is in its cell, and no other is.
  void check() const;

  Cutting cutting_;
  std::map<Cell, Place> places_;
  std::unordered_map<TrackId, Standing> standing_;
};

}  // namespace kinesphere::program
