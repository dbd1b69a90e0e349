// Reads files of any format as samples: ids, times and positions in the files' own numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "formats/fields/time_text.hpp"
#include "formats/streams/report_format.hpp"
#include "formats/tables/table_head.hpp"
#include "kinesphere/vec3.hpp"
#include "tracks/reading_policy.hpp"
#include "tracks/scene_check.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

/// A row or message of one of the files, for messages.
struct Place {
  std::uint32_t file = 0;
  int line = 0;  ///< from 1
};

struct RawSample {
  FileTime time;
  Vec3 position;  ///< in the units of the file; z is NaN where only others have a height
  Place place;
  bool on_ground = false;           ///< without a height
  std::optional<double> heading{};  ///< as the file has it
};

/// The samples of one id.
struct RawTrack {
  std::string id;
  std::vector<RawSample> samples;  ///< in the order of the rows
  double radius = 0.0;             ///< of a disc that covers the body (metres); 0 where no size is known
  double length = 0.0, width = 0.0, height = 0.0;  ///< the largest of all rows (metres)
  std::size_t forward = 0, backward = 0;           ///< rows that are later, or earlier, than the row before
  Place first_backward;                            ///< row
  bool is_joined = false;                          ///< --same names it, so that its rows may be in any order
  std::size_t placeless = 0;                       ///< rows and messages that have no time or no position
  /// A row without a position whose time counts. Times of rows that MissingPolicy::skip leaves out do not: a
  /// receiver without a fix may write any.
  struct Placeless {
    FileTime time;
    Place place;
  };
  std::vector<Placeless> timed_placeless;
};

class RawTrackSet {
 public:
  /// `options` must outlive it.
  /// Throws ProgramError naming a wrong option.
  RawTrackSet(const TrackOptions& options, bool several_files);

  /// Adds a file: a table, a recording of another kind, or messages. Throws ProgramError naming file,
  /// line and column of an error. Damaged messages, and those without a position, are counted.
  void read(const std::string& text, const std::string& file);
  /// Returns the scale of the times. Precondition: all files have been read. Throws ProgramError if the frame
  /// numbers do not fit the format.
  TimeScale time_scale() const;

  /// Of messages, columns that say what these have.
  const TableColumns& columns() const { return columns_; }
  /// The head of the first file; of messages its name alone.
  const TableHead& head() const { return head_; }
  const std::vector<RawTrack>& tracks() const { return tracks_; }
  const ReadCounts& counts() const { return counts_; }
  /// Returns "file:line".
  std::string name(const Place& place) const;
  /// Throws ProgramError if two files have an id at the same times, which may be two bodies.
  void ask_about_ids() const;
  /// Throws ProgramError if --same or --ignore names an id that has not come.
  void ask_about_identities() const {
    identities_.ask_about_unknown(tracks_.empty() ? std::string() : tracks_.front().id);
  }
  /// Throws ProgramError if the files have scenes that may not belong together.
  void ask_about_scenes() const { scenes_.ask(head_.file); }
  /// Increments the tally.
  void count(Tally& tally, const Place& place) const;

 private:
  class FileReader;

  StreamFormat format_of(std::string_view text, const std::string& file) const;
  static void refuse_other_kinds(std::string_view text, const std::string& file);
  /// Notes the body of a file. Throws ProgramError if another file has the same.
  void add_file_id(const std::string& id);
  /// Makes clock times of the last file go on behind midnight. Throws ProgramError naming a row of which the
  /// day is unclear.
  void pass_clocks_through_midnights();
  /// Takes the columns of a file; all files have the units and the kind of times of the first. Throws
  /// ProgramError naming the file.
  void add_columns(const TableColumns& columns, const std::string& file);

  const TrackOptions& options_;
  bool several_files_;
  Identities identities_;
  std::vector<std::string> files_;
  TableColumns columns_;
  TableHead head_;
  /// Kind of the first time; empty before it.
  std::optional<TimeKind> time_kind_;
  Place first_time_;
  std::vector<RawTrack> tracks_;
  std::unordered_map<std::string, std::size_t> track_of_;
  std::optional<bool> passed_midnight_;   ///< by clock times
  std::optional<double> ground_;          ///< --ground, in metres or, without a unit, in the unit of heights
  std::optional<std::size_t> id_column_;  ///< of ids that may be other bodies in other files
  std::unordered_map<std::string, std::string> file_of_;  ///< of the bodies that are called like their file
  ReadCounts counts_;
  SceneCheck scenes_;
};

}  // namespace kinesphere::program
