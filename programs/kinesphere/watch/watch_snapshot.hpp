// The state of a watch in a file, from which a later run continues.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "watch/output/alert_output.hpp"
#include "watch/source/stream_reader.hpp"

namespace kinesphere::program {

/// Options that influence verdicts, and their given values.
using GivenOptions = std::vector<std::pair<std::string, std::string>>;

struct WatchSnapshot {
  GivenOptions options;
  ReaderState reader;
  std::vector<std::byte> pipeline;  ///< WatchPipeline::save()
  std::string alerts;               ///< destination: the absolute path of a file, or an address
  AlertsPlace alerts_place{};
};

/// Replaces the file atomically. Throws ProgramError naming the file.
void write_snapshot(const std::string& path, WatchSnapshot snapshot);
/// Returns nothing if there is no such file. Throws ProgramError naming a file that is damaged or not a
/// snapshot.
std::optional<WatchSnapshot> read_snapshot(const std::string& path);
/// Throws ProgramError naming an option with another value than before.
void check_options(const std::string& path, const GivenOptions& then, const GivenOptions& now);
/// Says of a file that it is a snapshot, but of nothing that can be.
[[noreturn]] void refuse_snapshot(const std::string& path);

}  // namespace kinesphere::program
