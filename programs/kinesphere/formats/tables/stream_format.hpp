// The formats of recordings and streams, and how their beginnings tell them apart.
#pragma once

#include <optional>
#include <string_view>

namespace kinesphere::program {

/// Tables are `csv`, and `ais` where their tracks are ships. `json` are JSON records in lines, and
/// `recording` is what is read as a whole; both have rows of a table. The others are messages.
enum class StreamFormat { readsb, sbs, opensky, ais, nmea, csv, jsonl, json, recording };
/// True for what a file shows as a recording, and not as the text of a table.
constexpr bool is_read_whole(StreamFormat format) {
  return format == StreamFormat::json || format == StreamFormat::recording;
}
constexpr bool is_table(StreamFormat format) {
  return format == StreamFormat::csv || format == StreamFormat::ais || is_read_whole(format);
}

/// Returns the first line that says something, which comments of one column do not: of JSON over several
/// lines, the lines up to the first with a key. Empty if it has not ended yet.
std::string_view first_line(std::string_view beginning);
/// Returns the format of a stream that begins with this text, its first line or a part of it; nothing if it
/// is ambiguous.
std::optional<StreamFormat> recognised_format(std::string_view beginning);

}  // namespace kinesphere::program
