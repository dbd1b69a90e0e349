// Files of what `kinesphere tracks` has found, by the ending of their names.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "output_file.hpp"
#include "simulation/tracks/approaches.hpp"
#include "table_file.hpp"
#include "tracks/recording.hpp"

namespace kinesphere::program {

/// Every approach: a table (.csv, .jsonl), or points on a map (.geojson). It is opened at once, so that a
/// long run is not in vain, and appears with commit(). Throws ProgramError as TableFile and OutputFile.
class ApproachFile {
 public:
  explicit ApproachFile(const std::string& path);

  /// Throws ProgramError if the file needs longitudes and latitudes and the recording has none.
  void check(const Recording& recording) const;
  void write(const std::vector<Approach>& approaches, const Recording& recording);
  void commit();

 private:
  void write_geojson(const std::vector<Approach>& approaches, const Recording& recording);

  std::optional<TableFile> table_;
  std::optional<OutputFile> geojson_;
};

/// What there was between two ids.
struct PairSummary {
  std::string first, second;  ///< ids
  std::uint64_t approaches = 0;
  double duration = 0.0;      ///< of all together
  ClosestApproach closest{};  ///< of all
};

/// The pair that came closest first.
std::vector<PairSummary> pairs_in(const std::vector<Approach>& approaches, const Recording& recording);

/// The columns of a table of pairs.
std::vector<std::string> pair_columns();
void write_pairs(TableFile& table, const std::vector<PairSummary>& pairs, const Recording& recording);

}  // namespace kinesphere::program
