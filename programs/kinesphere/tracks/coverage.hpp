// What of a recording was looked at for approaches, and what was not.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tracks/approach_choice.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

/// An id that lost samples on the way to its tracks.
struct LostSamples {
  std::string id;
  std::size_t lost = 0, samples = 0;
};

/// A span of seconds of the track set in which an id was present but not in a track.
struct Hole {
  std::string id;
  double from = 0.0, until = 0.0;
};

/// Two ids are present together from when both have had their first row until one of them has its last
/// (Presence). They are looked at while both have a track. Ids that the choice leaves out, and times outside
/// its window, do not count.
struct Coverage {
  std::vector<LostSamples> without_track;  ///< ids that lost all of their samples
  std::vector<LostSamples> thinned;        ///< ids that lost a tenth or more of them, the largest part first
  std::uint64_t pairs = 0;                 ///< present together, an id of one row at an instant
  std::uint64_t pairs_never_looked_at = 0;
  std::vector<std::pair<std::string, std::string>> first_never_looked_at;  ///< at most 3 of these pairs
  double together = 0.0;   ///< seconds in which pairs are present together, summed over the pairs
  double looked_at = 0.0;  ///< those of them in which the pair is looked at
  Hole largest;            ///< hole that costs most of the difference; of no length if there is none

  /// At least 0, whatever the rounding.
  double not_looked_at() const { return largest.from < largest.until ? together - looked_at : 0.0; }
  bool is_complete() const {
    return without_track.empty() && pairs_never_looked_at == 0 && not_looked_at() <= 0;
  }
};

/// Cost: O(tracks log tracks), and O(ids) for each id that is present without a track at some time.
Coverage coverage_of(const TrackSet& track_set, const ApproachFilter& filter);

}  // namespace kinesphere::program
