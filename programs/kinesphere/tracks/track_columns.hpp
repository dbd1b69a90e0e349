// Finds the columns of a recorded motion in a table, and the units of their numbers.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "tracks/column_names.hpp"
#include "tracks/projection.hpp"
#include "tracks/text_table.hpp"

namespace kinesphere::program {

/// The command line's hints about a recording; each may be absent.
struct TrackHints {
  std::string format;                ///< ucy, eth, pedpy, mosquito or table
  std::string columns;               ///< for example id=oldobject,time=3,x=4,y=5
  std::optional<double> frame_rate;  ///< frames per second: the time column counts frames
  std::string time_unit;             ///< s, ms, us, ns, min, h, d or frames
  std::string unit;                  ///< unit of lengths: m, km, cm, mm, ft, nmi; or deg
  std::string from;                  ///< plane, lonlat or utm:33N
};

struct TrackColumns {
  std::string format;  ///< recognised format
  std::size_t id = 0, time = 0, x = 0, y = 0;
  std::optional<std::size_t> z;  ///< none: the motion is plane

  TimeKind time_kind = TimeKind::number;  ///< number or frames, where the times turn out to be numbers
  TimeUnit time_unit{};                   ///< unit of numbers; its rate is that of frames
  bool time_unit_said = false;            ///< not only taken for seconds because the column is called time
  std::string time_problem;               ///< not empty: why numbers cannot be taken as times
  /// Frames are numbers of a film that was sampled 2.5 times a second: every tenth at 25 frames/s (UCY), or
  /// every sixth at 15 or tenth at 25 frames/s (ETH).
  enum class Film { none, ucy, eth } film = Film::none;

  bool geographic = false;            ///< x and y are longitude and latitude in degrees
  std::optional<double> length_unit;  ///< metres, where they are known
  std::optional<UtmZone> zone;
};

/// Returns the columns of the hints or, without such, of a known format or of the usual names. Does not
/// guess: throws ProgramError naming the option to give if something is ambiguous.
TrackColumns find_columns(const TextTable& table, const TrackHints& hints);

}  // namespace kinesphere::program
