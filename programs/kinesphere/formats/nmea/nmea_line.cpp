// A line with a sentence of AIS: IEC 61162-1 sentences VDM and VDO, tag blocks of IEC 61162-450.
#include "formats/nmea/nmea_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/fields/wrong_input.hpp"
#include "formats/nmea/ais_message.hpp"

namespace kinesphere::program {
namespace {

constexpr bool is_capital_or_digit(char c) { return ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9'); }

/// Returns the value of a hexadecimal digit; -1 for another character.
constexpr int hex_digit(char c) {
  if ('0' <= c && c <= '9') return c - '0';
  const char lower = lower_case(c);
  return 'a' <= lower && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// Returns the digit from `least` to `most` that is the whole text; nothing for other text.
std::optional<std::size_t> digit_in(std::string_view text, char least, char most) {
  if (text.size() != 1 || text[0] < least || text[0] > most) return std::nullopt;
  return static_cast<std::size_t>(text[0] - '0');
}

/// Returns the content of a sentence, and moves `text` behind its checksum. Throws MalformedRecord.
std::string_view checked_sentence(std::string_view& text) {
  const CheckedText split = split_checksum(text);
  if (!split.said)
    throw MalformedRecord("expected * and a checksum of two hexadecimal digits behind the sentence");
  if (*split.said != split.sum)
    throw MalformedRecord(
        fmt::format("expected the checksum {:02X} behind the sentence, but got {:02X}: it is damaged",
                    split.sum, *split.said));
  if (!split.is_printable) throw MalformedRecord("expected printable ASCII characters in the sentence");
  text = split.behind;
  return split.content;
}

/// Returns the time of receipt that a text spells: a date, or a number of seconds or milliseconds since 1970,
/// at least 1e8 s (1973); nothing for other text.
std::optional<TimeField> time_of_receipt(std::string_view text) {
  constexpr std::int64_t least = 100'000'000, least_milliseconds = 100'000'000'000;
  auto field = time_field(text);
  if (!field || field->kind != TimeKind::number) return field;
  FileTime& time = field->time;
  if (time.whole < least || time.whole >= 1000 * least_milliseconds) return std::nullopt;
  if (time.whole >= least_milliseconds)
    time = {time.whole / 1000, (static_cast<double>(time.whole % 1000) + time.fraction) / 1000.0};
  return field;
}

/// Returns the text without what may stand around a time: brackets, quotes and separators.
std::string_view without_marks(std::string_view text) {
  constexpr std::string_view marks = " \t\r,;:\"'()[]<>|";
  text.remove_prefix(std::min(text.find_first_not_of(marks), text.size()));
  return text.substr(0, text.find_last_not_of(marks) + 1);
}

AisSentence sentence_of(std::string_view content) {
  std::array<std::string_view, 7> fields;
  const auto count = std::ranges::count(content, ',') + 1;
  if (count != std::ssize(fields))
    throw MalformedRecord(fmt::format("expected 7 fields of a sentence of AIS, but got {}", count));
  std::string_view rest = content;
  for (std::string_view& field : fields) field = take_part(rest, ',');
  const auto of = digit_in(fields[1], '1', '9'), number = digit_in(fields[2], '1', '9');
  const auto fill_bits = digit_in(fields[6], '0', '5');
  if (!of || !number || *number > *of)
    throw MalformedRecord(fmt::format(
        "expected the number of sentences and that of this one (fields 2 and 3), but got '{}' and '{}'",
        fields[1], fields[2]));
  if (!fill_bits)
    throw MalformedRecord(fmt::format("expected 0 to 5 fill bits (field 7), but got '{}'", fields[6]));
  if (fields[3].size() > 1 || fields[4].size() > 1)
    throw MalformedRecord(
        fmt::format("expected a sequence identifier and a channel (fields 4 and 5), but got '{}' and '{}'",
                    fields[3], fields[4]));
  if (fields[5].empty() || fields[5].size() > longest_ais_payload)
    throw MalformedRecord(fmt::format("expected 1 to {} characters of a message (field 6), but got {}",
                                      longest_ais_payload, fields[5].size()));
  if (!is_six_bit_text(fields[5]))
    throw MalformedRecord("expected characters from 0 to W and ` to w as the message (field 6)");
  return {*of, *number, fields[3], fields[4], fields[5], *fill_bits, fields[0].ends_with("VDO")};
}

/// Returns the time of PGHP,1,YEAR,MONTH,DAY,HOUR,MINUTE,SECOND,MILLISECOND,...; nothing for other text.
std::optional<TimeField> time_of_pghp(std::string_view content) {
  const auto fields = fields_of(content, ',');
  if (fields.size() < 9 || fields[1] != "1") return std::nullopt;
  std::size_t numbers[7] = {};
  for (std::size_t k = 0; k < std::size(numbers); ++k) {
    const auto number = count_in(fields[k + 2]);
    if (!number) return std::nullopt;
    numbers[k] = *number;
  }
  const auto [year, month, day, hour, minute, second, millisecond] = numbers;
  const auto date = parse_date_time(fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}", year, month, day,
                                                hour, minute, second, millisecond));
  return date ? std::optional(TimeField{date->time, TimeKind::number}) : std::nullopt;
}

/// Returns where !--VDM or !--VDO of any talker begins in the text; npos if it has none.
std::size_t ais_sentence_in(std::string_view text) {
  for (std::size_t at = text.find('!'); at != std::string_view::npos; at = text.find('!', at + 1)) {
    const std::string_view sentence = text.substr(at);
    if (sentence.size() < 7 || sentence[6] != ',') continue;
    const std::string_view formatter = sentence.substr(3, 3);
    if (formatter == "VDM" || formatter == "VDO") return at;
  }
  return std::string_view::npos;
}

/// Returns true for the end of a sentence, with which a stream may begin: fields, and a checksum at the end.
bool ends_sentence(std::string_view text) {
  const std::size_t star = text.rfind('*');
  return star != std::string_view::npos && star + 3 == text.size() && hex_digit(text[star + 1]) >= 0 &&
         hex_digit(text[star + 2]) >= 0 && text.substr(0, star).find(',') != std::string_view::npos;
}

/// Returns true if the text begins with $ or !, five capitals or digits or more, and a comma.
bool begins_sentence(std::string_view text) {
  if (text.empty() || (text[0] != '$' && text[0] != '!')) return false;
  const std::size_t comma = text.find(',');
  return comma != std::string_view::npos && comma > 4 &&
         std::ranges::all_of(text.substr(1, comma - 1), is_capital_or_digit);
}

/// Reads a line without VDM and VDO. Throws MalformedRecord if it is none of a stream of sentences.
NmeaLine line_without_ais(std::string_view text) {
  NmeaLine line;
  const std::size_t end = text.find_last_of('\\') + 1;
  std::string_view sentence = trimmed(text.substr(end));
  if (sentence.empty() && split_checksum(text.substr(1)).is_whole()) {
    line.received = read_head(text, line);
    line.is_of_next = true;
  } else if (sentence.starts_with("$PGHP,")) {
    sentence.remove_prefix(1);
    line.received = time_of_pghp(checked_sentence(sentence));
    line.is_of_next = true;
  } else if (!begins_sentence(sentence)) {
    throw MalformedRecord(
        fmt::format("expected a sentence of AIS (!AIVDM,...), but got '{}'", text.substr(0, 40)));
  } else if (sentence.starts_with('!')) {
    sentence.remove_prefix(1);
    checked_sentence(sentence);
  }
  return line;
}

/// Returns the number of two digits at a place; -1 where there are none.
int two_digits(std::string_view text, std::size_t at) {
  if (text.size() < at + 2) return -1;
  const char tens = text[at], ones = text[at + 1];
  const bool are_digits = '0' <= tens && tens <= '9' && '0' <= ones && ones <= '9';
  return are_digits ? 10 * (tens - '0') + (ones - '0') : -1;
}

}  // namespace

CheckedText split_checksum(std::string_view text) {
  const std::size_t star = std::min(text.find('*'), text.size());
  const std::string_view digits = text.substr(std::min(star + 1, text.size()), 2);
  CheckedText result{.content = text.substr(0, star), .behind = text.substr(std::min(star + 3, text.size()))};
  const int high = digits.size() == 2 ? hex_digit(digits[0]) : -1;
  const int low = digits.size() == 2 ? hex_digit(digits[1]) : -1;
  if (high >= 0 && low >= 0) result.said = static_cast<unsigned>(16 * high + low);
  for (const char c : result.content) result.sum ^= static_cast<unsigned char>(c);
  result.is_printable = std::ranges::all_of(result.content, [](char c) { return ' ' <= c && c <= '~'; });
  return result;
}

std::optional<TimeField> read_head(std::string_view head, NmeaLine& line) {
  line.before = trimmed(head.substr(0, head.find('\\')));
  std::optional<TimeField> received = time_of_receipt(without_marks(line.before));
  for (std::size_t begin = head.find('\\'); begin < head.size();) {
    const std::size_t end = head.find('\\', begin + 1);
    if (end == std::string_view::npos) break;
    const CheckedText tag = split_checksum(head.substr(begin + 1, end - begin - 1));
    begin = head.find('\\', end + 1);
    if (!tag.is_whole()) continue;
    for (std::string_view fields = tag.content; !fields.empty();) {
      const std::string_view field = take_part(fields, ',');
      if (field.size() < 2 || field[1] != ':') continue;
      const std::string_view value = field.substr(2);
      if (field[0] == 'c') received = time_of_receipt(value);
      if (field[0] == 's') line.source = value;
      // Number in the group - lines in the group - identifier of the group.
      if (field[0] == 'g') line.group = value.substr(value.rfind('-') + 1);
    }
  }
  return received;
}

std::size_t first_line_in(std::string_view text) {
  const std::size_t end = std::min(text.find('\r'), text.size());
  const std::string_view line = text.substr(0, end);
  const std::size_t first = ais_sentence_in(line);
  const std::size_t star = first == line.npos ? line.npos : line.find('*', first);
  constexpr std::size_t of_checksum = 3;
  if (star != line.npos && star + of_checksum < line.size()) {
    const std::size_t behind = star + of_checksum;
    const std::size_t next = ais_sentence_in(line.substr(behind));
    // A tag block or a time may stand before it.
    if (next != line.npos) {
      const std::size_t tag = line.find('\\', behind);
      return std::min(tag, behind + next);
    }
  }
  return std::min(end + 1, text.size());
}

NmeaLine parse_nmea_line(std::string_view text) {
  text = trimmed(text);
  if (text.empty() || text[0] == '#') return {};
  const std::size_t begin = ais_sentence_in(text);
  if (begin == std::string_view::npos) return line_without_ais(text);
  NmeaLine line;
  std::string_view rest = text.substr(begin + 1);
  line.sentence = sentence_of(checked_sentence(rest));
  line.received = read_head(text.substr(0, begin), line);
  if (const std::size_t comma = rest.rfind(','); !line.received && comma != std::string_view::npos)
    line.received = time_of_receipt(without_marks(rest.substr(comma + 1)));
  return line;
}

bool has_ais_sentence(std::string_view text) { return ais_sentence_in(text) != std::string_view::npos; }

bool looks_like_nmea(std::string_view line) {
  line = trimmed(line);
  if (begins_sentence(line) || ends_sentence(line) || has_ais_sentence(line)) return true;
  // A tag block in a line of its own, or before a sentence of another kind.
  const std::size_t end = line.starts_with('\\') ? line.find('\\', 1) : std::string_view::npos;
  return end != std::string_view::npos && line.substr(0, end).find('*') != std::string_view::npos;
}

std::optional<LoggedClock> logged_clock(std::string_view digits) {
  const int hour = two_digits(digits, 0), minute = two_digits(digits, 2), second = two_digits(digits, 4);
  if (hour < 0 || hour > 23 || minute < 0 || minute > 59 || second < 0 || second > 60) return std::nullopt;
  const std::string_view decimals = digits.substr(6);
  if (!decimals.empty() && (decimals.size() < 2 || decimals.front() != '.' ||
                            decimals.find_first_not_of("0123456789", 1) != std::string_view::npos))
    return std::nullopt;
  const double fraction = decimals.empty() ? 0.0 : *parse_number("0" + std::string(decimals));
  return LoggedClock{3600.0 * hour + 60.0 * minute + second + fraction,
                     fmt::format("{:02}:{:02}:{:02}{}", hour, minute, second, decimals)};
}

std::optional<std::chrono::sys_days> logged_date(std::string_view digits) {
  const int day = two_digits(digits, 0), month = two_digits(digits, 2), year = two_digits(digits, 4);
  if (digits.size() != 6 || day < 0 || month < 0 || year < 0) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(year_of_two_digits(year)),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  return date.ok() ? std::optional(std::chrono::sys_days(date)) : std::nullopt;
}

std::optional<double> degrees_and_minutes(std::string_view text, std::string_view hemisphere) {
  const auto number = parse_number(text);
  const std::size_t letter = std::string_view("NESW").find(hemisphere);
  if (!number || *number < 0.0 || hemisphere.size() != 1 || letter == std::string_view::npos)
    return std::nullopt;
  const double whole = std::floor(*number / 100.0), minutes = *number - 100.0 * whole;
  if (!(minutes < 60.0)) return std::nullopt;
  const double degrees = whole + minutes / 60.0;
  return letter < 2 ? degrees : -degrees;
}

std::optional<GpsFix> gps_fix_in(std::string_view line) {
  const std::size_t begin = line.find('$');
  if (begin == std::string_view::npos || line.size() < begin + 7 || line.substr(begin + 3, 4) != "RMC,")
    return std::nullopt;
  const CheckedText split = split_checksum(line.substr(begin + 1));
  if (split.said && !split.is_whole()) return std::nullopt;
  // Time, validity, latitude and N or S, longitude and E or W, speed, course, date.
  const auto fields = fields_of(split.content, ',');
  if (fields.size() < 10 || fields[2] != "A") return std::nullopt;
  const auto clock = logged_clock(fields[1]);
  const auto day = logged_date(fields[9]);
  const auto latitude = degrees_and_minutes(fields[3], fields[4]);
  const auto longitude = degrees_and_minutes(fields[5], fields[6]);
  if (!clock || !day || !latitude || !longitude || std::abs(*latitude) > 90.0 || std::abs(*longitude) > 180.0)
    return std::nullopt;
  const double whole = std::floor(clock->second);
  return GpsFix{
      .time = {86'400 * std::int64_t{day->time_since_epoch().count()} + static_cast<std::int64_t>(whole),
               clock->second - whole},
      .longitude = *longitude,
      .latitude = *latitude,
      .speed = parse_number(fields[7]),
      .course = parse_number(fields[8])};
}

}  // namespace kinesphere::program
