// The files that `kinesphere view` shows, in the form that its page requests.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracks/reading_policy.hpp"

namespace kinesphere::program {

struct OpenedFile {
  std::string name;     ///< for a person: without its folder; of several files the first, and how many more
  std::string content;  ///< served bytes
};

/// Empty, or a recording, or tables.
struct OpenedFiles {
  std::optional<OpenedFile> recording;  ///< recording of a world, unpacked if it was gzipped
  std::optional<OpenedFile> tracks;     ///< tables of positions, as track_table() makes of them

  /// {"recording": name or null, "tracks": name or null}
  std::string index() const;
};

/// Reads a recording of a world or else tables of positions, and prints warnings about the latter.
/// `reading_option` is the name of an option about tables that was given, or empty. Throws ProgramError
/// naming the cause: an unreadable file, a recording that cannot be repeated or is not alone, a table that
/// `kinesphere tracks` refuses or that is too long for a browser, an option without a table.
OpenedFiles open_files(const std::vector<std::string>& files, const TrackOptions& reading,
                       const std::string& reading_option);

}  // namespace kinesphere::program
