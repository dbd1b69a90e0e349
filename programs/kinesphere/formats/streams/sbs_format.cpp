// SBS-1 BaseStation messages, as dump1090 and readsb send them on port 30003. A message has either the
// position, the velocity or the callsign of an aircraft; this format joins them.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/number_text.hpp"
#include "formats/fields/units.hpp"
#include "formats/streams/known_names.hpp"
#include "formats/streams/report_format.hpp"
#include "formats/tables/row_splitter.hpp"

namespace kinesphere::program {
namespace {

/// Places of fields.
namespace sbs {
constexpr std::size_t message = 0, type = 1, hex = 4, made_date = 6, made_time = 7, logged_date = 8,
                      logged_time = 9, callsign = 10, altitude = 11, speed = 12, course = 13, latitude = 14,
                      longitude = 15, climb = 16, count = 17, on_ground = 21;
}

class SbsFormat final : public RememberingFormat<SbsFormat> {
 public:
  explicit SbsFormat(FormatChoices choices) : choices_(std::move(choices)) { row_.set_separator(','); }

  void read(const Record& record, ReportSink& sink) override {
    if (!record.is_whole) throw MalformedRecord("expected a whole line, but it is too long or cut off");
    row_.begin(record.text);
    row_.read(fields_);
    const std::string_view message = fields_[sbs::message];
    for (const std::string_view other : {"SEL", "ID", "AIR", "STA", "CLK"})
      if (message == other) return;
    if (message != "MSG")
      throw MalformedRecord(
          fmt::format("expected a message of SBS (MSG,...), but got '{}'", message.substr(0, 20)));
    if (fields_.size() < sbs::count)
      throw MalformedRecord(fmt::format("expected 22 fields, but got {}", fields_.size()));
    const std::string_view type = fields_[sbs::type];
    const bool is_position = type == "2" || type == "3", is_velocity = type == "4";
    if (!fields_[sbs::hex].empty() && !fields_[sbs::callsign].empty())
      callsigns_.set(fields_[sbs::hex], fields_[sbs::callsign]);
    if (!is_position && !is_velocity) return;
    if (fields_[sbs::hex].empty()) throw MalformedRecord("expected the address of an aircraft (field 5)");
    TimeField made = time_at(sbs::made_date, sbs::made_time);
    TimeField logged = time_at(sbs::logged_date, sbs::logged_time);
    if (record.read_at) {
      const std::int64_t zone = zone_of(logged.time, *record.read_at);
      made.time.whole -= zone;
      logged.time.whole -= zone;
    }
    forget_old(logged.time);
    if (is_velocity) return keep_velocity(made.time);
    if (fields_[sbs::latitude].empty() || fields_[sbs::longitude].empty())
      return sink.pass_over(Passed::no_position);
    sink.take(report_at(made, logged.time));
  }

  static void serialize(auto& self, auto& archive) { archive(self.velocities_, self.callsigns_); }

 private:
  struct Velocity {
    FileTime time;
    Vec3 velocity;
    bool has_climb = false;
    double velocity_spread = 0.0;
  };

  /// Returns the seconds by which the receiver's zone is ahead of UTC, a multiple of a quarter of an hour:
  /// receivers write local times. 0 for messages that were not logged within a minute of being read.
  static std::int64_t zone_of(const FileTime& logged, const FileTime& read_at) {
    constexpr double quarter = 900.0, farthest = 14 * 3600.0, soon = 60.0;
    const double ahead = seconds_between(read_at, logged);
    const double zone = quarter * std::round(ahead / quarter);
    return std::abs(zone) <= farthest && std::abs(ahead - zone) <= soon ? static_cast<std::int64_t>(zone) : 0;
  }

  TimeField time_at(std::size_t date, std::size_t clock) {
    text_.assign(fields_[date]);
    std::replace(text_.begin(), text_.end(), '/', '-');
    text_ += 'T';
    text_ += fields_[clock];
    const auto parsed = parse_date_time(text_);
    if (!parsed)
      throw MalformedRecord(
          fmt::format("expected a date and a time (fields {} and {}), but got '{}' and '{}'", date + 1,
                      clock + 1, fields_[date], fields_[clock]));
    return {parsed->time, TimeKind::date};
  }
  double number_at(std::size_t place, const char* what) const {
    if (const auto number = parse_number(fields_[place])) return *number;
    throw MalformedRecord(
        fmt::format("expected a number as {} (field {}), but got '{}'", what, place + 1, fields_[place]));
  }

  /// Returns nothing for an empty field.
  std::optional<double> number_if_any(std::size_t place, const char* what, double unit) const {
    return fields_[place].empty() ? std::nullopt : std::optional(number_at(place, what) * unit);
  }
  void set_velocity_here(SourceReport& report) const {
    set_velocity(report, number_if_any(sbs::speed, "a speed", knot),
                 number_if_any(sbs::course, "a course", 1.0),
                 number_if_any(sbs::climb, "a climb", foot / 60.0));
  }
  void keep_velocity(const FileTime& time) {
    SourceReport here;
    set_velocity_here(here);
    if (here.velocity)
      velocities_[std::string(fields_[sbs::hex])] = {time, *here.velocity, here.has_climb,
                                                     here.velocity_spread};
  }

  SourceReport report_at(const TimeField& made, const FileTime& logged) {
    SourceReport report{
        .id = fields_[sbs::hex], .stamp = made.time, .arrival = logged, .time_kind = made.kind};
    report.name = callsigns_.name_of(report.id);
    report.geographic = true;
    report.position = {number_at(sbs::longitude, "a longitude"), number_at(sbs::latitude, "a latitude"), 0.0};
    if (!is_place(report.position.x, report.position.y))
      throw MalformedRecord(
          fmt::format("expected a latitude and a longitude (fields 15 and 16), but got {} and {}",
                      report.position.y, report.position.x));
    report.has_height = !fields_[sbs::altitude].empty();
    if (report.has_height) report.position.z = number_at(sbs::altitude, "an altitude") * foot;
    report.on_ground = fields_.size() > sbs::on_ground && fields_[sbs::on_ground] == "-1";
    // Some receivers send both in one message.
    set_velocity_here(report);
    if (report.velocity) return report;
    text_.assign(report.id);
    if (const auto known = velocities_.find(text_); known != velocities_.end()) {
      const double age = std::abs(seconds_between(known->second.time, made.time));
      if (age <= choices_.velocity_age) {
        report.velocity = known->second.velocity;
        report.has_climb = known->second.has_climb;
        report.velocity_spread = known->second.velocity_spread;
        // One of the two is 0.
        report.ground_speed = std::hypot(report.velocity->x, report.velocity->y) + report.velocity_spread;
        report.velocity_age = age;
      }
    }
    return report;
  }

  /// Drops velocities that are too old for any further report. Runs from time to time, so its cost is small.
  void forget_old(const FileTime& now) {
    if (++messages_ % 65536 != 0) return;
    std::erase_if(velocities_, [&](const auto& entry) {
      return std::abs(seconds_between(entry.second.time, now)) > choices_.velocity_age + 60.0;
    });
  }

  FormatChoices choices_;
  RowSplitter row_;
  std::vector<std::string_view> fields_;
  std::string text_;
  std::unordered_map<std::string, Velocity> velocities_;
  KnownNames callsigns_;
  std::uint64_t messages_ = 0;
};

}  // namespace

std::unique_ptr<ReportFormat> make_sbs_format(const FormatChoices& choices) {
  return std::make_unique<SbsFormat>(choices);
}

}  // namespace kinesphere::program
