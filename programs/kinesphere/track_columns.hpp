// Which columns of a table hold a recorded motion.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "text_table.hpp"

namespace kinesphere::program {

/// What the command line says about a recording; all of it may be left open.
struct TrackHints {
  std::string columns;               ///< as in id=oldobject,time=3,x=4,y=5
  std::optional<double> frame_rate;  ///< frames per second, when the time column counts frames
};

struct TrackColumns {
  std::string format;  ///< what the table was recognised as
  std::size_t id = 0, time = 0, x = 0, y = 0;
  std::optional<std::size_t> z;  ///< none: the motion is plane
  double frame_rate = 1.0;       ///< time = value / frame_rate
};

/// The columns that the hints name or, without such, those of a format that is known: UCY obsmat, PedPy,
/// mosquito tracks, or any table with columns id, time (or frame), x, y and perhaps z. Throws ProgramError.
TrackColumns find_columns(const TextTable& table, const TrackHints& hints);

}  // namespace kinesphere::program
