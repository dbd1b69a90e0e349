// Reads recorded motion from text files.
#pragma once

#include <string>
#include <vector>

#include "tracks/reading_policy.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

struct NamedText {
  std::string file;
  std::string text;
};

/// Returns one track set of all texts: an id continues from one text to the next. Throws ProgramError naming
/// file, line and column of an error, or a missing or wrong option; also if there is no track.
TrackSet parse_tracks(std::vector<NamedText> texts, const TrackOptions& options);
/// Reads plain or gzipped files; "-" is standard input. Throws ProgramError naming a file that cannot be
/// read.
std::vector<NamedText> read_texts(const std::vector<std::string>& files);
/// Calls read_texts() and parse_tracks().
TrackSet read_tracks(const std::vector<std::string>& files, const TrackOptions& options);

}  // namespace kinesphere::program
