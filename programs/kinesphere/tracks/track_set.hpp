// A track set of real motion after it was read.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/fields/time_scale.hpp"
#include "kinesphere/motion/recorded_tracks.hpp"
#include "simulation/tracks/rectangles.hpp"
#include "tracks/coordinates.hpp"

namespace kinesphere::program {

struct RecordedTrack {
  std::string id;                    ///< spelled like in the file; 3.0 and 3.000000e+00 are 3
  std::vector<TrackSample> samples;  ///< at least 2, by time
  double radius = 0.0;               ///< of a disc or sphere around the body; 0 for a point
  /// Times before the first and after the last sample until which the body is there, too (--outside).
  std::optional<double> reaches_back_to, reaches_on_to;
  RestingEnds rests;    ///< at these ends the body rests, and stays
  RectangleBody shape;  ///< of a track set with rectangles

  /// When the body is there, in seconds.
  double from() const { return reaches_back_to.value_or(samples.front().time); }
  double until() const { return reaches_on_to.value_or(samples.back().time); }
};

/// What is known of an id, and how much of it became tracks.
struct Presence {
  std::string id;
  /// Seconds: from its first to its last row whose time is known, whatever becomes of these; first > last if
  /// there is none.
  double first = 0.0, last = 0.0;
  std::size_t samples = 0;                  ///< at different times, and rows without a time or a position
  std::size_t used = 0;                     ///< samples in tracks
  std::size_t first_track = 0, tracks = 0;  ///< its tracks follow each other
};

/// An id that begins where and when another one ends: one body under two ids.
struct Handover {
  std::size_t from = 0, to = 0;  ///< numbers of their presences
  double time = 0.0;             ///< of the first sample of the id that begins
  double distance = 0.0;         ///< from there to where the other one was, or would have been
};

/// Count of dropped items, and where the first ones stand.
struct Tally {
  std::size_t count = 0;
  std::vector<std::string> first_places;  ///< at most 3: "line 7" or, with several files, "b.csv:7"
};

/// What was read, and what was left out of it.
struct ReadCounts {
  std::size_t rows = 0;               ///< rows and messages in all files
  Tally filtered;                     ///< rows that --where leaves out
  Tally ignored;                      ///< rows and messages of ids that --ignore names
  Tally on_ground;                    ///< aircraft on the ground without a height, with --ground or left out
  Tally missing;                      ///< rows and messages without a time or a position
  Tally malformed;                    ///< damaged messages
  Tally repeated;                     ///< messages with a sample that their id has sent before
  std::vector<std::string> warnings;  ///< of the formats, one line each
};

/// A track set in seconds and lengths from its own origins; `times` and `coordinates` convert them to the
/// file's.
struct TrackSet : ReadCounts {
  std::string format;  ///< recognised format
  TimeScale times;
  DateOrder dates = DateOrder::unknown;  ///< order of dates such as 03/04/2025
  double frame_rate = 0.0;               ///< frames per second; 0 where no frames are counted
  Coordinates coordinates;
  bool in_metres = false;             ///< unit of lengths; if false, it is unknown
  bool has_heights = false;           ///< the files have a column of heights
  bool has_sizes = false;             ///< sizes were asked for
  bool has_rectangles = false;        ///< of bodies with a size; they are discs or spheres otherwise
  std::string headings;               ///< of rectangles: where they come from, for the summary
  bool is_plane = false;              ///< nothing leaves the plane z = 0
  std::vector<RecordedTrack> tracks;  ///< without interruption, by the first sample's place in the file
  std::vector<Presence> presences;    ///< one for each id, in the order of the tracks
  std::vector<Handover> handovers;    ///< by time; none if approaches of such ids are to count
  std::string ground;  ///< height of aircraft on the ground that send none; empty where they are left out
  Outside outside = Outside::vanish;
  std::string filter;               ///< the rows that count (--where); empty for all
  std::vector<std::string> unused;  ///< names, or numbers from 1, of columns that are not read
  std::size_t samples = 0;          ///< in all tracks
  std::size_t left_out = 0;         ///< samples that were alone between two gaps
  Tally duplicates;                 ///< samples of an id that already has one at that time
  Tally echoes;                     ///< samples that a second receiver has passed on later
  Tally too_fast;                   ///< samples that --max-speed left out
  double sample_interval = 0;       ///< the median, over all ids
  /// The smallest and the largest gap limit of the ids, in seconds; a longer time between two samples cuts a
  /// track.
  double smallest_max_gap = 0, largest_max_gap = 0;
};

}  // namespace kinesphere::program
