// Sentences of AIS (VDM and VDO), as receivers write them.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "formats/fields/field_text.hpp"
#include "formats/fields/units.hpp"
#include "formats/nmea/ais_message.hpp"
#include "formats/nmea/nmea_line.hpp"
#include "formats/streams/known_names.hpp"
#include "formats/streams/report_format.hpp"
#include "formats/streams/sentence_assembler.hpp"

namespace kinesphere::program {
namespace {

/// Error of the time of a position, in seconds, where the station says no second of it (receivers of
/// satellite navigation on ships give a position each second, and 30 s leave room for a late one), and for a
/// message 27 that says that its position was less than 5 s old.
constexpr double unknown_second = 30.0, prompt = 6.0;
/// Steps of message 27. The standard does not say whether stations round or cut off, so a whole step counts:
/// 1/10 minute of latitude and of longitude, 1 knot, 1 degree.
constexpr double coarse_step = 185.2, coarse_speed = knot, coarse_course = 3.14159265358979323846 / 180.0;

/// Returns the time with this UTC second that is closest to the arrival, from 50 s before it to 10 s after
/// it: messages come late, clocks of receivers are off by a little.
FileTime time_with_second(const FileTime& arrival, int second) {
  constexpr std::int64_t minute = 60, most_ahead = 10;
  std::int64_t late = ((arrival.whole - second) % minute + minute) % minute;
  if (late >= minute - most_ahead) late -= minute;
  return {arrival.whole - late, 0.0};
}

/// Presets that messages may say.
constexpr MotionPreset nmea_presets[] = {MotionPreset::vessel_at_rest, MotionPreset::high_speed_craft,
                                         MotionPreset::wing_in_ground, MotionPreset::aid_to_navigation,
                                         MotionPreset::search_aircraft};

class NmeaFormat final : public RememberingFormat<NmeaFormat> {
 public:
  explicit NmeaFormat(FormatChoices choices)
      : choices_(std::move(choices)),
        accuracy_bound_(10.0 * choices_.containment),
        accuracy_declaration_(fmt::format("{:g} times the 10 m of the accuracy flag", choices_.containment)) {
  }

  void read(const Record& record, ReportSink& sink) override {
    if (!record.is_whole) throw MalformedRecord("expected a whole line, but it is too long or cut off");
    Record each = record;
    std::string_view rest = record.text;
    while (const std::size_t size = first_line_in(rest)) {
      each.text = rest.substr(0, size);
      rest.remove_prefix(size);
      try {
        read_line(each, sink);
      } catch (const MalformedRecord& error) {
        if (rest.empty()) throw;
        sink.refuse(record.line, error.what());
      }
    }
  }

  void finish(ReportSink& sink) override {
    assembler_.finish(sink);
    if (!untimed_.empty() && !latest_) fail_without_times();
    for (const Untimed& each : untimed_) refuse_without_time(each.line, sink);
    untimed_.clear();
    if (!has_sentences_)
      throw UnusableStream(
          "expected sentences of AIS (!AIVDM or !AIVDO of any talker), but the stream has none ($GPRMC and "
          "$GPGGA of receivers of GPS are read from a file, or a pipe that ends, without --format)");
  }

  static void serialize(auto& self, auto& archive) {
    archive(self.assembler_, self.sizes_, self.names_, self.types_, self.group_, self.group_time_,
            self.announced_, self.has_sentences_, self.latest_, self.untimed_);
  }

 private:
  /// A message without time of receipt, and the line that ended it.
  struct Untimed {
    AisBits bits;
    std::size_t line = 0;
  };

  void read_line(const Record& record, ReportSink& sink) {
    NmeaLine line = parse_nmea_line(record.text);
    const auto fix = line.sentence ? std::nullopt : gps_fix_in(record.text);
    // The clock of a log whose lines have no times.
    if (fix && !line.received && !record.read_at)
      line.received = TimeField{fix->time, latest_ ? latest_->kind : TimeKind::utc};
    find_time(line, record, sink);
    if (fix && !choices_.own_by_gps.empty()) report_own(*fix, *line.received, sink);
    if (!line.sentence) return;
    has_sentences_ = true;
    if (line.sentence->is_own && !choices_.own_by_gps.empty()) return;
    const auto whole = assembler_.add(line, record.line, sink);
    if (!whole) return;
    if (!line.received && before_first_.empty()) before_first_ = line.before;
    if (whole->received)
      take(whole->bits, *whole->received, 0.0, sink);
    else
      keep_untimed(whole->bits, record.line, sink);
  }

  /// Gives the line the time of its group or of the line before it if it has none of its own, else that at
  /// which it was read.
  void find_time(NmeaLine& line, const Record& record, ReportSink& sink) {
    if (!line.group.empty()) {
      if (line.group != group_) {
        group_ = line.group;
        group_time_.reset();
      }
      if (line.received) group_time_ = line.received;
      if (!line.received) line.received = group_time_;
    }
    if (line.is_of_next) {
      announced_ = line.received;
      return;
    }
    if (line.sentence) {
      if (!line.received) line.received = announced_;
      announced_.reset();
    }
    if (!line.received && record.read_at) line.received = TimeField{*record.read_at, TimeKind::number};
    if (!line.received) return;
    settle_untimed(*line.received, sink);
    latest_ = line.received;
  }

  /// Takes messages without time, at the time of the next sentence that has one, if that comes soon enough
  /// after the one before: then the UTC second is unique for messages that were less than 20 s on their way.
  void settle_untimed(const TimeField& next, ReportSink& sink) {
    constexpr double longest_gap = 30.0;
    const double gap = latest_ ? std::abs(seconds_between(latest_->time, next.time)) : longest_gap + 1.0;
    const std::vector<Untimed> all = std::exchange(untimed_, {});
    for (const Untimed& each : all) {
      if (gap <= longest_gap)
        take(each.bits, next, gap, sink);
      else
        refuse_without_time(each.line, sink);
    }
  }

  void keep_untimed(const AisBits& bits, std::size_t line, ReportSink& sink) {
    const auto message = ais_message_of(bits);
    if (!message) return;
    if (!message->position) return take_ship(*message);
    // A recording may begin in the middle of a group.
    constexpr std::size_t most_at_begin = 10, most = 1000;
    if (untimed_.size() == most) return refuse_without_time(line, sink);
    untimed_.push_back({bits, line});
    if (!latest_ && untimed_.size() == most_at_begin) fail_without_times();
  }

  static void refuse_without_time(std::size_t line, ReportSink& sink) {
    sink.refuse(line, "expected a time of receipt, in this line or in others around it");
  }
  [[noreturn]] void fail_without_times() const {
    const std::string before = before_first_.empty()
                                   ? ""
                                   : fmt::format(
                                         " that is read (before the first stands {}, no date and clock as in "
                                         "2024-01-31T12:30:15Z and no seconds since 1970)",
                                         shown_field(before_first_));
    throw UnusableStream(fmt::format(
        "expected the time at which each sentence was received, but there is none{}: record it in a tag "
        "block (\\c:1700000000*5F\\!AIVDM...) or before the sentence; what comes from a receiver right now "
        "can be read from udp://, a device, or standard input with --clock arrival",
        before));
  }

  /// `received`: the time of receipt, or at most `earlier` seconds after it.
  void take(const AisBits& bits, const TimeField& received, double earlier, ReportSink& sink) {
    const auto message = ais_message_of(bits);
    if (!message) return;
    take_ship(*message);
    if (message->position) report(*message, *message->position, received, earlier, sink);
  }

  /// Remembers what a message says about the ship itself.
  void take_ship(const AisMessage& message) {
    if (!message.name.empty()) names_.set(fmt::format("{:09}", message.mmsi), message.name);
    if (message.ship_type > 0) types_.set(message.mmsi, message.ship_type);
    const double radius = message.dimensions ? message.dimensions->radius() : 0.0;
    if (radius > 0.0) sizes_.set(message.mmsi, radius);
  }

  void report(const AisMessage& message, const AisPosition& position, const TimeField& received,
              double earlier, ReportSink& sink) {
    if (!position.longitude || !position.latitude) return sink.pass_over(Passed::no_position);
    if (!has_bound(position)) return sink.pass_over(Passed::no_bound);
    id_ = fmt::format("{:09}", message.mmsi);
    SourceReport report{
        .id = id_, .stamp = received.time, .arrival = received.time, .time_kind = received.kind};
    if (position.second)
      report.stamp = time_with_second(received.time, *position.second);
    else
      report.stamp_error = earlier + (position.is_prompt ? prompt : unknown_second);
    report.geographic = true;
    report.position = {*position.longitude, *position.latitude, 0.0};
    if (position.is_accurate && position.origin == AisPosition::Origin::sensor)
      report.position_error = DeclaredError{accuracy_bound_, accuracy_declaration_};
    report.name = names_.name_of(id_);
    report.extent = sizes_.value_of(message.mmsi);
    if (position.is_coarse) report.extent += std::hypot(coarse_step, coarse_step);
    add_velocity(position, report);
    add_class(message, position, report);
    sink.take(report);
  }

  void report_own(const GpsFix& fix, const TimeField& received, ReportSink& sink) const {
    // As those of the others, by the clock of the receipt, which may be wrong by minutes.
    FileTime stamp = time_with_second(received.time, static_cast<int>(fix.time.whole % 60));
    stamp.fraction = fix.time.fraction;
    SourceReport report{.id = choices_.own_by_gps,
                        .stamp = stamp,
                        .arrival = received.time,
                        .time_kind = received.kind,
                        .geographic = true,
                        .position = {fix.longitude, fix.latitude, 0.0}};
    report.sayable = nmea_presets;
    set_velocity(report, fix.speed ? std::optional(*fix.speed * knot) : std::nullopt, fix.course,
                 std::nullopt);
    sink.take(report);
  }

  /// Returns false for a position that no sensor gave, unless an option says how far off it may be. That of
  /// an aid to navigation may be surveyed.
  bool has_bound(const AisPosition& position) const {
    if (position.origin == AisPosition::Origin::sensor || choices_.position_error_is_said) return true;
    return position.station == AisStation::aid_to_navigation &&
           position.origin == AisPosition::Origin::manual;
  }

  void add_class(const AisMessage& message, const AisPosition& position, SourceReport& report) {
    report.sayable = nmea_presets;
    const int type = types_.value_of(message.mmsi);
    if (position.station == AisStation::search_aircraft)
      report.said_kind = MotionPreset::search_aircraft;
    else if (position.station != AisStation::aid_to_navigation)
      report.said_kind = preset_of_ship_type(type);
    else if (!position.is_off_position)
      report.said_kind = MotionPreset::aid_to_navigation;
    if (position.status) report.said_status = preset_of_status(*position.status);
    type_text_ = type > 0 ? fmt::format("{}", type) : "";
    status_text_ = position.status ? fmt::format("{}", *position.status) : "";
    report.craft_type = type_text_;
    report.status = status_text_;
    report.category = category_of(position.station);
  }
  static std::string_view category_of(AisStation station) {
    constexpr std::string_view names[] = {"A", "B", "search aircraft", "aid to navigation"};
    return names[static_cast<std::size_t>(station)];
  }

  static void add_velocity(const AisPosition& position, SourceReport& report) {
    // An aid to navigation is fixed or moored; its message has no speed.
    const auto speed =
        position.station == AisStation::aid_to_navigation ? std::optional(0.0) : position.speed;
    if (!speed) return;
    set_velocity(report, *speed * knot, position.course, std::nullopt);
    if (position.is_coarse) report.velocity_spread += coarse_speed + coarse_course * *speed * knot;
  }

  FormatChoices choices_;
  double accuracy_bound_;
  std::string accuracy_declaration_;
  SentenceAssembler assembler_;
  RecentValues<std::uint32_t, double> sizes_;  ///< radii of ships, in metres
  RecentValues<std::uint32_t, int> types_;     ///< types of ship and cargo
  KnownNames names_;
  std::string id_, type_text_, status_text_;
  // The group of lines of the latest tag block that has one, and its time.
  std::string group_;
  std::optional<TimeField> group_time_;
  std::optional<TimeField> announced_;  ///< of the next line, from one before it
  bool has_sentences_ = false;
  std::string before_first_;         ///< text before the first sentence without a time
  std::optional<TimeField> latest_;  ///< time of receipt of the latest sentence that has one
  std::vector<Untimed> untimed_;     ///< since then, in their order
};

}  // namespace

std::unique_ptr<ReportFormat> make_nmea_format(const FormatChoices& choices) {
  return std::make_unique<NmeaFormat>(choices);
}

}  // namespace kinesphere::program
