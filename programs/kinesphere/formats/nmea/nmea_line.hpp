// A line with a sentence of AIS: IEC 61162-1 sentences VDM and VDO, tag blocks of IEC 61162-450.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "formats/fields/time_text.hpp"

namespace kinesphere::program {

/// A sentence !--VDM or !--VDO, which has a message of AIS or a part of it. Texts are parts of the line.
struct AisSentence {
  std::size_t count = 1;      ///< number of sentences of the message, 1 to 9
  std::size_t number = 1;     ///< of this sentence, 1 to count
  std::string_view sequence;  ///< links the sentences of a message: a digit, or empty
  std::string_view channel;   ///< of the radio: A, B, 1, 2, or empty
  std::string_view payload;
  std::size_t fill_bits = 0;  ///< number of bits at the end of the payload that do not count, 0 to 5
  bool is_own = false;        ///< VDO: of the ship that has the receiver
};

struct NmeaLine {
  std::optional<AisSentence> sentence;  ///< empty in a line with another sentence, or with none
  /// Time of receipt that the line gives: c of a tag block, else a time before the sentence, else the last
  /// field behind its checksum. Numbers are seconds since 1970; those of 1e11 or more are milliseconds.
  std::optional<TimeField> received;
  /// The time is that of the next line: the line is a tag block alone, or a sentence $PGHP of Gatehouse.
  bool is_of_next = false;
  std::string_view before;  ///< text before the sentence, and before its tag blocks
  std::string_view source;  ///< s of a tag block
  std::string_view group;   ///< the identifier of the group of lines, from g of a tag block
};

/// A sentence or tag block, with its checksum *hh behind it.
struct CheckedText {
  std::string_view content, behind;
  std::optional<unsigned> said;  ///< the checksum as it stands there
  unsigned sum = 0;              ///< the exclusive or of the content's characters
  bool is_printable = false;     ///< all of them are printable ASCII characters

  bool is_whole() const { return said == sum && is_printable; }
};
/// Splits a text that begins behind the sign of its sentence or tag block.
CheckedText split_checksum(std::string_view text);

/// Reads what precedes a sentence: a time, and tag blocks. What is damaged or unknown is passed over. Returns
/// the time, that of a tag block first.
std::optional<TimeField> read_head(std::string_view head, NmeaLine& line);

/// Longest payload of a sentence that is read, in characters. A sentence that keeps the standard has at most
/// 82 characters.
inline constexpr std::size_t longest_ais_payload = 1024;

/// Returns the size of the first line in a text: lines may end with CR alone, or have lost their ends, so
/// that a sentence begins behind the checksum of another. 0 for an empty text.
std::size_t first_line_in(std::string_view text);

/// Reads a line; blank ones and those that begin with # are empty. A damaged tag block, and other text before
/// the sentence, is passed over: then the line has no time. Throws MalformedRecord for a damaged sentence
/// that begins with !, and for a line without sentence and tag block.
NmeaLine parse_nmea_line(std::string_view line);

/// Returns true if the line looks like one of a stream of sentences: it has VDM or VDO, begins with a tag
/// block or another sentence, or is the end of one.
bool looks_like_nmea(std::string_view line);

/// Returns true if the text has VDM or VDO anywhere.
bool has_ais_sentence(std::string_view text);

/// A time of day.
struct LoggedClock {
  double second = 0.0;  ///< since midnight
  std::string text;     ///< as hh:mm:ss, with its decimals
};

/// Parses hhmmss with or without decimals; returns nothing for other text.
std::optional<LoggedClock> logged_clock(std::string_view digits);
/// Parses ddmmyy; returns nothing for other text and for days that do not exist.
std::optional<std::chrono::sys_days> logged_date(std::string_view digits);
/// Returns degrees of "ddmm.mmm" or "dddmm.mmm", negative in the south or west, as `hemisphere` says; nothing
/// for other text.
std::optional<double> degrees_and_minutes(std::string_view text, std::string_view hemisphere);

struct GpsFix {
  FileTime time{};                          ///< UTC, seconds since 1970
  double longitude = 0.0, latitude = 0.0;   ///< degrees
  std::optional<double> speed{}, course{};  ///< over ground: knots, degrees clockwise from north
};

/// Returns the fix of a line with a sentence RMC of any talker; nothing for another line, a wrong checksum,
/// and a receiver without a fix or a date.
std::optional<GpsFix> gps_fix_in(std::string_view line);

}  // namespace kinesphere::program
