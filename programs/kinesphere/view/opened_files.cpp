// The files that `kinesphere view` shows, in the form that its page requests.
#include "view/opened_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <utility>

#include "base/escaped_text.hpp"
#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "kinesphere/recording.hpp"
#include "recording/step.hpp"
#include "tracks/reading_summary.hpp"
#include "tracks/track_file.hpp"
#include "view/track_table.hpp"

namespace kinesphere::program {
namespace {

std::string name_without_folder(const std::string& file) {
  return std::filesystem::path(file).filename().string();
}

/// True for a recording of any version, complete or damaged.
bool is_recording(const NamedText& file) {
  const auto& mark = recording_envelope.mark;
  const auto bytes = std::as_bytes(std::span(file.text));
  return bytes.size() >= mark.size() &&
         std::ranges::equal(bytes.first(mark.size()), std::as_bytes(std::span(mark)));
}

OpenedFile opened_recording(NamedText file) {
  const auto replay = Replay::open(std::as_bytes(std::span(file.text)));
  if (!replay) throw ProgramError(fmt::format("{}: {}", file.file, message_of(replay.error())));
  return {name_without_folder(file.file), std::move(file.text)};
}

OpenedFile opened_tracks(std::vector<NamedText> files, const TrackOptions& reading) {
  std::string name = name_without_folder(files.front().file);
  if (files.size() > 1) name += fmt::format(" and {} more", files.size() - 1);
  const TrackSet recording = parse_tracks(std::move(files), reading);
  for (const std::string& warning : warnings_of(recording))
    print_message("kinesphere: warning: {}\n", warning);
  std::string table = track_table(recording, name);
  return {std::move(name), std::move(table)};
}

std::string name_or_null(const std::optional<OpenedFile>& file) {
  return file ? json_text(file->name) : "null";
}

}  // namespace

std::string OpenedFiles::index() const {
  return fmt::format("{{\"recording\": {}, \"tracks\": {}}}\n", name_or_null(recording),
                     name_or_null(tracks));
}

OpenedFiles open_files(const std::vector<std::string>& files, const TrackOptions& reading,
                       const std::string& reading_option) {
  if (files.empty()) {
    if (reading_option.empty()) return {};
    throw ProgramError(
        fmt::format("{}: expected only with a table of positions, but no FILE is given", reading_option));
  }
  std::vector<NamedText> texts = read_texts(files);
  const auto recording = std::ranges::find_if(texts, is_recording);
  if (recording == texts.end()) return {.tracks = opened_tracks(std::move(texts), reading)};
  if (texts.size() > 1) {
    throw ProgramError(
        fmt::format("{}: expected no other file with the recording of a world, but got {} files",
                    recording->file, texts.size()));
  }
  if (!reading_option.empty()) {
    throw ProgramError(
        fmt::format("{}: expected only with a table of positions, but {} is the recording of a world",
                    reading_option, recording->file));
  }
  return {.recording = opened_recording(std::move(*recording))};
}

}  // namespace kinesphere::program
