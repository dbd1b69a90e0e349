// Writes the results of `kinesphere tracks`, in the format of the file name's ending.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/output_file.hpp"
#include "base/table_file.hpp"
#include "number/infinity.hpp"
#include "simulation/tracks/approaches.hpp"
#include "simulation/tracks/post_encroachment.hpp"
#include "simulation/tracks/time_to_collision.hpp"
#include "tracks/approach_map.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

double horizontal_distance(const ClosestApproach& closest);
double vertical_distance(const ClosestApproach& closest);

/// Columns that not all approaches have.
struct ApproachColumns {
  bool by_cylinder = false;  ///< the horizontal and the vertical distance
  bool has_errors = false;   ///< whether an approach is certain
};

/// Every approach, as a table (.csv, .jsonl) or as points on a map (.geojson, .gpx, .kml). The constructor
/// opens the file, so that a wrong path fails before a long run; the file appears with commit(). Throws
/// ProgramError like TableFile and OutputFile.
class ApproachFile {
 public:
  ApproachFile(const std::string& path, const ApproachColumns& chosen);

  /// Throws ProgramError if the file needs longitudes and latitudes and the track set has none.
  void check(const TrackSet& track_set) const;
  void write(const std::vector<Approach>& approaches, const TrackSet& track_set);
  void commit();

 private:
  ApproachColumns chosen_;
  std::optional<TableFile> table_;
  std::optional<MapFormat> map_format_;
  std::optional<OutputFile> map_;
};

/// The approaches of two ids, summed up.
struct PairSummary {
  std::string first, second;  ///< ids
  std::uint64_t approaches = 0;
  double duration = 0.0;      ///< sum of the durations
  ClosestApproach closest{};  ///< closest of all approaches
  LeastTimeToCollision to_collision{};
  PostEncroachment encroachment{0.0, infinity};
  double deceleration = 0.0;  ///< that avoids a crash (rectangles alone); 0 if none is needed
  double time_of_deceleration = 0.0;
};

/// Returns the pairs, the one with the closest approach first. Their times to collision and post-encroachment
/// times are found if the track set has sizes.
std::vector<PairSummary> pairs_in(const std::vector<Approach>& approaches, const TrackSet& track_set,
                                  const Motion& motion);

/// Writes a table of pairs; with sizes also the times to collision and the post-encroachment times.
void write_pairs(TableFile& table, const std::vector<PairSummary>& pairs, const TrackSet& track_set);

}  // namespace kinesphere::program
