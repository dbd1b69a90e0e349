// Logs of receivers of satellite navigation: sentences RMC, GGA, GNS and ZDA of NMEA 0183.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/field_text.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/nmea/nmea_line.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/tables/row_reader.hpp"

namespace kinesphere::program {
namespace {

/// Where the fields of a sentence are; 0: it has none of the kind.
struct GpsSentence {
  std::string_view name;
  std::size_t place, validity, height, date, speed;  ///< the course stands behind the speed
  std::string_view invalid;  ///< its place does not count with one of these letters alone
};
constexpr GpsSentence gps_sentences[] = {{"RMC", 3, 2, 0, 9, 7, "V"},
                                         {"GGA", 2, 6, 9, 0, 0, "0"},
                                         {"GNS", 2, 6, 9, 0, 0, "N"},
                                         {"ZDA", 0, 0, 0, 2, 0, ""}};

/// Returns the sentence that begins at a $; null for another one.
const GpsSentence* gps_sentence(std::string_view text) {
  if (text.size() < 7 || text[6] != ',') return nullptr;
  const auto found = std::ranges::find(gps_sentences, text.substr(3, 3), &GpsSentence::name);
  return found == std::end(gps_sentences) ? nullptr : found;
}

/// Returns the time as a table has it: 2024-01-31T12:30:15.5Z.
std::string logged_time(std::chrono::sys_days day, const LoggedClock& clock) {
  const std::chrono::year_month_day date(day);
  return fmt::format("{:04}-{:02}-{:02}T{}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), clock.text);
}

/// What the sentences of one time of day say.
struct LoggedFix {
  std::string source, talker;
  std::set<std::string_view> sentences;
  LoggedClock clock{};
  std::optional<std::chrono::sys_days> day;
  std::string longitude, latitude, height;
  std::string speed, course;  ///< knots, degrees
  std::size_t line = 0;
};

class GpsReader {
 public:
  explicit GpsReader(const RecordingText& recording) : lines_(recording.text), file_(recording.file) {}

  RowTable read() {
    while (const auto line = lines_.next()) {
      for (std::size_t at = line->find('$'); at != std::string_view::npos; at = line->find('$', at + 1)) {
        if (const GpsSentence* const sentence = gps_sentence(line->substr(at)))
          read_sentence(*sentence, line->substr(0, at), line->substr(at + 1));
      }
    }
    std::vector<LoggedFix> fixes = whole_fixes();
    if (fixes.empty())
      throw ProgramError(
          fmt::format("{}: expected sentences RMC, GGA or GNS with a valid position, but of those that it "
                      "has {} have a wrong checksum and {} have no position",
                      file_, damaged_, invalid_));
    return table_of(fixes);
  }

 private:
  [[noreturn]] void fail(std::string_view expected, std::size_t field, std::string_view got) const {
    throw ProgramError(fmt::format("{}:{}: expected {} (field {} of the sentence), but got {}", file_,
                                   lines_.line(), expected, field + 1, shown_field(got)));
  }

  void read_sentence(const GpsSentence& sentence, std::string_view head, std::string_view text) {
    const CheckedText split = split_checksum(text);
    // Without checksums a sentence that was cut off cannot be told from a whole one.
    has_checksums_ = has_checksums_.value_or(split.said.has_value());
    if (*has_checksums_ && !split.is_whole()) {
      if (damaged_++ == 0) first_damaged_ = lines_.line();
      return;
    }
    std::vector<std::string_view> fields = fields_of(split.content, ',');
    fields.resize(std::max<std::size_t>(fields.size(), 15));
    const bool is_invalid = sentence.validity > 0 && fields[sentence.validity].find_first_not_of(
                                                         sentence.invalid) == std::string_view::npos;
    // Receivers without a fix leave the fields empty.
    if (is_invalid || fields[1].empty()) {
      ++invalid_;
      return;
    }
    LoggedFix fix{.sentences = {sentence.name}, .line = lines_.line()};
    fix.talker = fields[0].substr(0, 2);
    const auto clock = logged_clock(fields[1]);
    if (!clock) fail("a time of day, hhmmss", 1, fields[1]);
    fix.clock = *clock;
    read_source(head, fix);
    read_day(sentence, fields, fix);
    read_place(sentence, fields, fix);
    if (const std::size_t at = sentence.speed; at > 0 && parse_number(fields[at])) {
      fix.speed = fields[at];
      if (parse_number(fields[at + 1])) fix.course = fields[at + 1];
    }
    note_talker(fix);
    fixes_.push_back(std::move(fix));
  }

  /// The lines of a group have the source of its first one.
  void read_source(std::string_view head, LoggedFix& fix) {
    NmeaLine line;
    if (const auto received = read_head(head, line)) {
      const double since_midnight = static_cast<double>(received->time.whole) - fix.clock.second;
      fix.day = std::chrono::sys_days(std::chrono::days(std::lround(since_midnight / 86'400.0)));
    }
    fix.source = line.source;
    if (!line.group.empty() && line.group == group_ && fix.source.empty()) fix.source = group_source_;
    group_ = line.group;
    group_source_ = fix.source;
  }

  void read_day(const GpsSentence& sentence, const std::vector<std::string_view>& fields,
                LoggedFix& fix) const {
    const std::size_t at = sentence.date;
    if (at == 0 || fields[at].empty()) return;
    // The year of ZDA has four digits.
    const bool is_zda = sentence.place == 0;
    const std::string digits =
        is_zda ? fmt::format("{}{}{}", fields[at], fields[at + 1],
                             fields[at + 2].substr(std::min<std::size_t>(2, fields[at + 2].size())))
               : std::string(fields[at]);
    fix.day = logged_date(digits);
    if (!fix.day) fail("a date, ddmmyy", at, fields[at]);
  }

  void read_place(const GpsSentence& sentence, const std::vector<std::string_view>& fields,
                  LoggedFix& fix) const {
    if (const std::size_t at = sentence.place; at > 0) {
      const auto latitude = degrees_and_minutes(fields[at], fields[at + 1]);
      const auto longitude = degrees_and_minutes(fields[at + 2], fields[at + 3]);
      if (!latitude || std::abs(*latitude) > 90.0 || fields[at + 1].find_first_of("NS") != 0)
        fail("a latitude, ddmm.mm and N or S", at, fmt::format("{},{}", fields[at], fields[at + 1]));
      if (!longitude || std::abs(*longitude) > 180.0 || fields[at + 3].find_first_of("EW") != 0)
        fail("a longitude, dddmm.mm and E or W", at + 2,
             fmt::format("{},{}", fields[at + 2], fields[at + 3]));
      fix.latitude = fmt::format("{}", *latitude);
      fix.longitude = fmt::format("{}", *longitude);
    }
    if (const std::size_t at = sentence.height; at > 0 && !fields[at].empty()) {
      if (!parse_number(fields[at])) fail("a height", at, fields[at]);
      fix.height = fields[at];
    }
  }

  /// Two talkers that send one sentence for one time are two receivers; a receiver that begins to use more
  /// satellites goes on as another talker.
  void note_talker(const LoggedFix& fix) {
    auto& [second, talker] = last_of_[{fix.source, *fix.sentences.begin()}];
    if (!talker.empty() && talker != fix.talker && second == fix.clock.second) apart_.insert(fix.source);
    second = fix.clock.second;
    talker = fix.talker;
  }

  std::string id_of(const LoggedFix& fix) const {
    const std::string source = fix.source.empty() ? id_of_file(file_) : fix.source;
    return apart_.contains(fix.source) ? fmt::format("{} {}", source, fix.talker) : source;
  }

  /// Joins the sentences of one time. Sets the days.
  std::vector<LoggedFix> whole_fixes() {
    std::vector<LoggedFix> whole;
    std::map<std::string, std::vector<std::size_t>> of_body;
    for (LoggedFix& fix : fixes_) {
      std::vector<std::size_t>& own = of_body[id_of(fix)];
      LoggedFix* const last = own.empty() ? nullptr : &whole[own.back()];
      const bool is_same_time = last != nullptr && last->clock.second == fix.clock.second;
      const std::string_view sentence = *fix.sentences.begin();
      // The same sentence with another place is that of another receiver, and a duplicate.
      if (is_same_time && (!last->sentences.contains(sentence) ||
                           (last->longitude == fix.longitude && last->latitude == fix.latitude))) {
        last->sentences.insert(sentence);
        if (last->longitude.empty())
          std::tie(last->longitude, last->latitude) = {fix.longitude, fix.latitude};
        if (last->height.empty()) last->height = fix.height;
        if (last->speed.empty()) std::tie(last->speed, last->course) = {fix.speed, fix.course};
        if (!last->day || sentence == "RMC") last->day = fix.day ? fix.day : last->day;
        continue;
      }
      own.push_back(whole.size());
      whole.push_back(std::move(fix));
    }
    for (const auto& [id, own] : of_body) set_days(id, own, whole);
    std::erase_if(whole, [](const LoggedFix& fix) { return fix.longitude.empty(); });
    return whole;
  }

  /// Gives the fixes of a body the days that others of it say.
  void set_days(const std::string& id, const std::vector<std::size_t>& own, std::vector<LoggedFix>& all) {
    const auto first = std::ranges::find_if(own, [&](std::size_t k) { return all[k].day.has_value(); });
    const bool has_days = first != own.end();
    if (std::exchange(has_days_, has_days).value_or(has_days) != has_days)
      throw ProgramError(fmt::format(
          "{}: expected a date (RMC or ZDA) for all receivers or for none, unlike for {}", file_, id));
    constexpr double half_a_day = 43'200.0;
    std::chrono::sys_days day = has_days ? *all[*first].day : std::chrono::sys_days{};
    if (has_days && all[own.front()].clock.second > all[*first].clock.second + half_a_day)
      day -= std::chrono::days(1);
    // A clock that falls by half a day or more has passed midnight.
    std::optional<double> before;
    for (const std::size_t k : own) {
      const double second = all[k].clock.second;
      if (all[k].day)
        day = *all[k].day;
      else if (before && second < *before - half_a_day)
        day += std::chrono::days(1);
      all[k].day = day;
      before = second;
    }
  }

  RowTable table_of(const std::vector<LoggedFix>& fixes) const {
    RowTable table("NMEA 0183", {"id", "time", "lon", "lat", "speed_kt", "course", "alt"});
    for (const LoggedFix& fix : fixes) {
      const double midnight = 86'400.0 * static_cast<double>(fix.day->time_since_epoch().count());
      table.add_row(
          fix.line, id_of(fix),
          *has_days_ ? logged_time(*fix.day, fix.clock) : fmt::format("{}", midnight + fix.clock.second),
          fix.longitude, fix.latitude, fix.speed, fix.course, fix.height);
    }
    table.use_heights_of_all(file_);
    table.is_one_body = std::ranges::all_of(
        fixes, [&](const LoggedFix& fix) { return fix.source.empty() && !apart_.contains(""); });
    if (!*has_days_)
      table.warnings.push_back(fmt::format(
          "{}: its sentences have no date (RMC, ZDA), so that times are seconds since midnight UTC", file_));
    for (const std::string& source : apart_)
      table.warnings.push_back(fmt::format(
          "{}: several talkers of {} have places at one time: they count as receivers of their own", file_,
          source.empty() ? "the file" : source));
    if (invalid_ > 0)
      table.warnings.push_back(
          fmt::format("{}: sentences without a valid position are left out: {}", file_, invalid_));
    if (damaged_ > 0)
      table.warnings.push_back(
          fmt::format("{}:{}: a wrong checksum (so many damaged sentences are left out: {})", file_,
                      first_damaged_, damaged_));
    return table;
  }

  LineCutter lines_;
  const std::string& file_;
  std::vector<LoggedFix> fixes_;
  std::optional<bool> has_checksums_, has_days_;
  std::size_t damaged_ = 0, first_damaged_ = 0, invalid_ = 0;
  std::string group_, group_source_;
  /// The last time and talker of each sentence of a source.
  std::map<std::pair<std::string, std::string_view>, std::pair<double, std::string>> last_of_;
  std::set<std::string> apart_;  ///< sources of several receivers
};

}  // namespace

bool is_gps_log(std::string_view text) {
  const std::string_view head = text.substr(0, 4096);
  for (std::size_t at = head.find('$'); at != std::string_view::npos; at = head.find('$', at + 1))
    if (gps_sentence(head.substr(at)) != nullptr) return !has_ais_sentence(text);
  return false;
}

RowTable read_gps_log(const RecordingText& recording) { return GpsReader(recording).read(); }

}  // namespace kinesphere::program
