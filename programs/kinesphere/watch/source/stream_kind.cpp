// Which format a stream has, by its first text.
#include "watch/source/stream_kind.hpp"

#include <fmt/format.h>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"
#include "formats/nmea/nmea_line.hpp"
#include "formats/recordings/file_kind.hpp"
#include "formats/recordings/recording_kinds.hpp"

namespace kinesphere::program {

using Nature = ReportSource::Nature;

std::optional<StreamFormat> StreamKind::of(std::string_view beginning, bool has_ended) {
  // The first line may be one long document; its beginning is sufficient.
  constexpr std::size_t enough = 4096;
  // Sentences of AIS may come behind a log of a receiver of GPS.
  const bool may_be_log = source_.nature() != Nature::live && is_gps_log(beginning.substr(0, enough));
  if (!may_be_log || has_ended) return of_beginning(beginning, has_ended || beginning.size() > enough);
  if (has_ais_sentence(beginning.substr(examined_))) return StreamFormat::nmea;
  examined_ = beginning.rfind('\n') + 1;
  return std::nullopt;
}

/// `is_enough`: no more comes, or none is needed.
std::optional<StreamFormat> StreamKind::of_beginning(std::string_view beginning, bool is_enough) const {
  if (beginning.starts_with("\xEF\xBB\xBF")) beginning.remove_prefix(3);
  if (beginning.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    if (is_enough) throw ProgramError(fmt::format("{}: expected reports, but it is empty", source_.name()));
    return std::nullopt;
  }
  if (first_line(beginning).empty() && !is_enough) return std::nullopt;
  const std::string other_kind = other_file_kind(beginning);
  const auto shown = recognised_format(beginning);
  // Noise of a line may have zero bytes, too.
  const bool has_zeros = beginning.find('\0') != std::string_view::npos;
  if (has_zeros && (!other_kind.empty() || !shown)) refuse(other_kind.empty() ? "not text" : other_kind);
  const auto format = format_of_text(beginning, hints_);
  if (format == StreamFormat::recording) return of_recording(beginning, shown);
  const bool is_certain = format == StreamFormat::json || !hints_.columns.empty();
  if (format && (is_certain || !is_table(*format))) return format;
  // Some other files look like tables.
  if (!other_kind.empty() && (format || is_enough)) refuse(other_kind);
  return format || !is_enough ? format : StreamFormat::csv;
}

/// Returns the format in which a recording is read, which is as a whole unless it is a live stream.
std::optional<StreamFormat> StreamKind::of_recording(std::string_view beginning,
                                                     const std::optional<StreamFormat>& shown) const {
  const bool is_live = source_.nature() == Nature::live;
  // Of a service that is asked again and again, each list is read when it comes.
  const bool is_pipe_of_now = source_.nature() == Nature::unknown && by_arrival_;
  if (is_json_list(beginning) && (is_live || is_pipe_of_now)) return StreamFormat::json;
  if (!is_live) return StreamFormat::recording;
  // Sentences of AIS may follow those of a receiver of GPS.
  if (shown == StreamFormat::nmea) return shown;
  refuse(fmt::format("{}, which is read as a whole: from a file, or a pipe that ends",
                     recording_kind_of(beginning, hints_)->name));
}

void StreamKind::refuse(std::string_view kind) const {
  throw ProgramError(fmt::format("{}: expected a stream of reports, but it is {}", source_.name(), kind));
}

}  // namespace kinesphere::program
