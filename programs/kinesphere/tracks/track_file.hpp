// Recorded motion from text files: who was where at which times.
#pragma once

#include <string>
#include <vector>

#include "tracks/reading_policy.hpp"
#include "tracks/recording.hpp"

namespace kinesphere::program {

struct NamedText {
  std::string file;
  std::string text;
};

/// The recording that all of the texts are together: an id goes on from one to the next. Throws ProgramError
/// naming file, line and column of what is wrong, or the option that is missing or wrong; also when there is
/// no track.
Recording parse_tracks(std::vector<NamedText> texts, const TrackOptions& options);
/// Plain or gzipped; "-" is standard input. Throws ProgramError naming a file that cannot be read.
std::vector<NamedText> read_texts(const std::vector<std::string>& files);
/// Both in one.
Recording read_tracks(const std::vector<std::string>& files, const TrackOptions& options);

}  // namespace kinesphere::program
