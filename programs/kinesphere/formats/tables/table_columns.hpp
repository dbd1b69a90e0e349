// Finds the columns of a recording or stream in a table, and the units of their numbers.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "formats/fields/time_text.hpp"
#include "formats/tables/column_names.hpp"
#include "formats/tables/table_head.hpp"

namespace kinesphere::program {

/// The command line's hints about a table; each may be absent.
struct ColumnHints {
  std::string format;                ///< a preset (presets.hpp), or table
  std::string columns;               ///< for example id=oldobject,time=3:ms,lon=4,lat=5
  std::optional<double> frame_rate;  ///< frames per second: the time column counts frames
  std::string time_unit;             ///< s, ms, us, ns, min, h, d or frames
  std::string unit;                  ///< unit of lengths without one; or deg
  std::string positions;             ///< plane, lonlat or utm:33N
  std::string where;                 ///< rows that count
  DateOrder dates = DateOrder::unknown;
  bool sizes = false;  ///< length, width and heading are read
};

/// What is read: positions alone, or also velocities, errors and times of arrival.
enum class ColumnUse { positions, reports };

struct Column {
  std::size_t place = 0;
  double unit = 1.0;  ///< metres, metres per second, seconds or degrees of one unit of its numbers
  bool has_unit = false;
  std::string said_unit{};  ///< behind its colon in --columns; empty: none
};

struct TableColumns {
  std::string format;             ///< recognised format
  bool has_named_fields = false;  ///< the file is no table: messages name fields instead of columns
  std::array<std::optional<Column>, quantity_count> of{};
  const std::optional<Column>& operator[](Quantity quantity) const {
    return of[static_cast<std::size_t>(quantity)];
  }
  std::optional<Column>& operator[](Quantity quantity) { return of[static_cast<std::size_t>(quantity)]; }

  TimeKind time_kind = TimeKind::number;  ///< number or frames, where the times turn out to be numbers
  TimeUnit time_unit{};                   ///< unit of numbers; its rate is that of frames
  bool time_unit_said = false;            ///< not only taken for seconds because the column is called time
  bool times_are_clocks = false;          ///< times of day without a date count from midnight
  std::string time_problem;               ///< not empty: why numbers cannot be taken as times
  std::string height_advice;              ///< how to say the unit of heights
  std::string time_advice;                ///< how to leave the column of dates out
  std::string file_advice;                ///< how to say that each file is one body
  DateOrder dates = DateOrder::unknown;
  /// Frames are numbers of a film that was sampled 2.5 times a second: every tenth at 25 frames/s (UCY), or
  /// every sixth at 15 or tenth at 25 frames/s (ETH).
  enum class Film { none, ucy, eth } film = Film::none;

  bool geographic = false;      ///< x and y are longitude and latitude
  bool in_metres = false;       ///< the unit of lengths is known
  bool positions_said = false;  ///< an option, a name or a preset says whether positions are degrees
  /// Where on a body its position is, as a preset says.
  enum class Place { middle, front, upper_left } place = Place::middle;
  bool heading_is_from_x = false;  ///< headings are counterclockwise from the x axis, as a preset says
  /// Columns of a quaternion that turns the x axis to where a body points: w, x, y, z.
  std::optional<std::array<std::size_t, 4>> rotation;
  bool is_ais = false;           ///< speeds of 102.3 kt and courses of 360 degrees are unknown
  std::string where;             ///< rows that count, by the preset and by --where
  bool id_is_file = false;       ///< the file has one body, called like it
  bool has_own_heights = false;  ///< heights in the file are those of the bodies themselves
  bool has_own_origin = false;   ///< times or places count from the start of each body
  /// Bodies with a pair of columns each, or three; empty where each row is one body.
  struct Body {
    std::string id;
    std::size_t x, y;
    std::optional<std::size_t> z;
  };
  std::vector<Body> bodies;
  /// Columns with E or W, and with N or S, where degrees are without a sign.
  std::optional<std::size_t> east_or_west, north_or_south;
  std::optional<std::size_t> nanoseconds;  ///< column with the rest of whole seconds
  std::vector<std::size_t> unused;         ///< columns that are not read
  bool decimal_comma = false;

  /// Columns of x and y: longitude and latitude if geographic.
  const Column& x() const { return *(*this)[geographic ? Quantity::longitude : Quantity::x]; }
  const Column& y() const { return *(*this)[geographic ? Quantity::latitude : Quantity::y]; }
  const std::optional<Column>& z() const { return (*this)[Quantity::z]; }
};

/// Returns the columns of the hints or, without such, of a known format or of the usual names. Does not
/// guess: throws ProgramError naming the option to give if something is ambiguous.
TableColumns find_columns(const TableHead& head, const ColumnHints& hints, ColumnUse use);

}  // namespace kinesphere::program
