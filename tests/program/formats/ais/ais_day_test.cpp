// A day of 100 ships with damaged sentences: each report that is not damaged is taken, and each approach
// told.
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <vector>

#include "geography/local_frame.hpp"
#include "kinesphere/random.hpp"
#include "program/formats/ais/ais_encoder.hpp"
#include "program/support.hpp"

namespace kinesphere::program::ais_day_test {
namespace {

constexpr int ships = 100, sailing = 60;
constexpr double day = 86'400.0, begin = 1'700'006'400.0;  // a midnight
constexpr double pi = 3.14159265358979323846;

/// A ship that lies still, sails straight on, and lies still again. Metres and seconds.
struct Voyage {
  EncodedStation station;
  bool is_class_b = false;
  Vec3 start{};
  double course = 0.0;  ///< radians from north
  double speed = 0.0, departure = day, duration = 0.0;

  /// Time in which the speed is reached, and lost: the acceleration is at most 0.18 m/s2.
  static constexpr double ramp = 60.0;

  double speed_at(double time) const {
    const double since = time - departure, left = departure + duration - time;
    if (since <= 0.0 || left <= 0.0) return 0.0;
    const double part = std::min({1.0, since / ramp, left / ramp});
    return speed * 0.5 * (1.0 - std::cos(pi * part));
  }
  double way_at(double time) const {
    // Integral of the speed during the first t seconds of a ramp.
    const auto ramped = [&](double t) { return 0.5 * speed * (t - ramp / pi * std::sin(pi * t / ramp)); };
    const double since = std::clamp(time - departure, 0.0, duration);
    if (since < ramp) return ramped(since);
    if (since <= duration - ramp) return ramped(ramp) + speed * (since - ramp);
    return speed * (duration - ramp) - ramped(duration - since);
  }
  Vec3 position_at(double time) const {
    return start + Vec3{std::sin(course), std::cos(course), 0.0} * way_at(time);
  }
  /// Interval of reports (ITU-R M.1371-5, table 1): 10 s under way, class B 30 s, 180 s at rest.
  double interval_at(double time) const { return speed_at(time) <= 0.0 ? 180.0 : is_class_b ? 30.0 : 10.0; }
};

/// Ships in pairs whose ways cross at a time, within 300 m or 5 km, and ships at anchor, ten of them near a
/// crossing.
std::vector<Voyage> make_voyages(Random& random) {
  std::vector<Voyage> voyages;
  for (int k = 0; k < ships; ++k) {
    Voyage voyage;
    voyage.station.mmsi = 211'000'001 + static_cast<std::uint32_t>(k);
    voyage.is_class_b = k % 3 == 0;
    voyage.station.accuracy = k % 2;
    voyage.station.bow = 20 + k;
    voyage.station.stern = 10;
    voyage.station.port = voyage.station.starboard = 6;
    const int pair = k / 2;
    const Vec3 crossing{9'000.0 * (pair % 6) - 22'000.0, 9'000.0 * (pair / 6 % 5) - 18'000.0, 0.0};
    if (k < sailing) {
      const double met = 12'000.0 + 2'000.0 * pair + 30.0;
      voyage.speed = random.uniform(3.0, 8.0);
      voyage.course = random.uniform(0.0, 2.0 * pi);
      voyage.duration = 2'400.0;
      voyage.departure = met - 1'200.0;
      const double off = k % 2 == 0 ? 0.0 : pair % 3 == 2 ? 5'000.0 : random.uniform(0.0, 300.0);
      voyage.start = crossing + Vec3{off, 0.0, 0.0};
      voyage.start = voyage.start - (voyage.position_at(met) - voyage.start);
    } else {
      const int other = k % 10;
      const Vec3 place = k < 70
                             ? Vec3{9'000.0 * (other % 6) - 22'000.0, 9'000.0 * (other / 6) - 18'000.0, 0.0}
                             : Vec3{9'000.0 * (k % 6) - 17'500.0, 9'000.0 * (k / 6 % 5) - 13'500.0, 0.0};
      voyage.start = place + Vec3{random.uniform(-250.0, 250.0), random.uniform(-250.0, 250.0), 0.0};
      voyage.station.status = 1;
    }
    voyages.push_back(voyage);
  }
  return voyages;
}

struct TimedLine {
  double time;
  std::string text;
  bool is_report;
};

/// Replaces a character, or cuts the line off.
std::string damaged_line(const std::string& line, Random& random) {
  std::string damaged = line;
  const auto at = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(line.size()) - 1e-6));
  if (random.uniform(0.0, 1.0) < 0.3) return line.substr(0, std::max<std::size_t>(1, at));
  damaged[at] = damaged[at] == 'Q' ? 'R' : 'Q';
  return damaged;
}

void add_lines(Voyage& voyage, const LocalFrame& map, Random& random, std::vector<TimedLine>& lines) {
  double statics_due = 0.0;
  for (double time = random.uniform(0.0, 180.0); time < day; time += voyage.interval_at(time)) {
    EncodedStation s = voyage.station;
    const double angle = random.uniform(0.0, 2.0 * pi), off = random.uniform(0.0, 9.0);
    const Vec3 seen = voyage.position_at(time) + Vec3{std::cos(angle), std::sin(angle), 0.0} * off;
    const Vec3 place = map.geographic(seen);
    s.longitude = encoded_degrees(place.x);
    s.latitude = encoded_degrees(place.y);
    const double knots = voyage.speed_at(time) * 3600.0 / 1852.0;
    s.speed = static_cast<int>(std::lround(10.0 * knots));
    if (s.speed > 0) s.course = static_cast<int>(std::lround(1800.0 / pi * voyage.course)) % 3600;
    s.second = static_cast<int>(begin + time) % 60;
    // It is received a little later, by a clock that counts whole seconds.
    const double received = time + random.uniform(0.0, 3.0);
    const std::string tag = tag_block(fmt::format("s:rx,c:{:.0f}", std::floor(begin + received)));
    const std::string bits = voyage.is_class_b ? class_b_message(s) : class_a_message(s);
    lines.push_back({received, tag + vdm(bits), true});
    if (time < statics_due) continue;
    statics_due = time + 360.0;
    if (voyage.is_class_b) {
      lines.push_back({received, tag + vdm(class_b_static_message(s)), false});
    } else {
      const int sequence = static_cast<int>(s.mmsi % 10);
      lines.push_back({received, tag + vdm_part(static_message(s), 1, 2, sequence), false});
      lines.push_back({received, tag + vdm_part(static_message(s), 2, 2, sequence), false});
    }
  }
}

enum class Told { apart, undecided, within };

class AisDay : public ProgramTest {};

TEST_F(AisDay, IsTakenAndToldWholly) {
#ifndef KINESPHERE_WITH_GEOGRAPHICLIB
  GTEST_SKIP() << "GeographicLib is not installed";
#endif
  Random random(42);
  std::vector<Voyage> voyages = make_voyages(random);
  const LocalFrame map(53.5, 8.0, 100e3, 0.0);
  std::vector<TimedLine> lines;
  for (Voyage& voyage : voyages) add_lines(voyage, map, random, lines);
  std::ranges::stable_sort(lines, {}, &TimedLine::time);
  std::string text;
  std::uint64_t whole = 0;
  for (const TimedLine& line : lines) {
    // The first line and the last one give the times of sentences with a damaged tag block beside them.
    const bool is_outer = &line == &lines.front() || &line == &lines.back();
    const bool is_damaged = random.uniform(0.0, 1.0) < 0.05 && !is_outer;
    const std::string written = is_damaged ? damaged_line(line.text, random) : line.text;
    // A sentence is taken if only its tag block is damaged.
    const std::string_view sentence = std::string_view(line.text).substr(line.text.find('!'));
    if (line.is_report && written.find(sentence) != std::string::npos) ++whole;
    text += written + "\n";
  }
  const std::string command = "watch '" + write("day.nmea", text) +
                              "' --separation sphere:500m --origin 53.5,8 --radius 100km --acceleration 0.2 "
                              "--quiet --summary '" +
                              path("summary.json") + "'";
  const ProgramRun run = this->run(command + " --only all");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json summary = nlohmann::json::parse(read_text(path("summary.json")));
  EXPECT_EQ(summary["reports"], whole) << summary.dump();
  EXPECT_EQ(summary["contradictions"], 0);

  // Verdicts are compared with the true distances each ten seconds.
  std::array<std::array<Told, ships>, ships> told{};
  std::set<std::pair<std::string, std::string>> near_pairs;
  std::istringstream alerts(run.out);
  std::string line;
  nlohmann::json alert;
  const auto next_alert = [&] {
    alert = std::getline(alerts, line) ? nlohmann::json::parse(line) : nlohmann::json();
  };
  next_alert();
  int near = 0, approaches = 0;
  std::array<std::array<bool, ships>, ships> was_near{};
  for (double time = 400.0; time < day - 400.0; time += 10.0) {
    for (; !alert.is_null() && alert["time"].get<double>() <= begin + time; next_alert()) {
      if (alert["event"] != "verdict") continue;
      const auto index = [&](const char* key) {
        return static_cast<std::size_t>(std::stoi(alert[key].get<std::string>()) - 211'000'001);
      };
      told[index("first")][index("second")] = alert["verdict"] == "apart"       ? Told::apart
                                              : alert["verdict"] == "undecided" ? Told::undecided
                                                                                : Told::within;
    }
    std::array<Vec3, ships> places;
    for (std::size_t k = 0; k < ships; ++k) places[k] = voyages[k].position_at(time);
    for (std::size_t a = 0; a < ships; ++a) {
      for (std::size_t b = a + 1; b < ships; ++b) {
        const double distance = norm(places[a] - places[b]);
        const bool is_near = distance < 499.9;
        if (is_near) {
          ++near;
          near_pairs.insert({std::to_string(211'000'001 + a), std::to_string(211'000'001 + b)});
          if (!was_near[a][b]) ++approaches;
          ASSERT_NE(told[a][b], Told::apart)
              << a << " and " << b << " at " << time << " are within " << distance;
        }
        was_near[a][b] = is_near;
        if (told[a][b] == Told::within) {
          ASSERT_LT(distance, 500.1) << a << " and " << b << " at " << time;
        }
      }
    }
  }
  EXPECT_GT(approaches, 20);

  // By default each of these pairs has alerts, and few.
  std::filesystem::remove(path("summary.json"));
  std::istringstream by_default(this->run(command).out);
  std::map<std::pair<std::string, std::string>, int> alerts_of;
  while (std::getline(by_default, line)) {
    alert = nlohmann::json::parse(line);
    if (alert.contains("second")) ++alerts_of[{alert["first"], alert["second"]}];
  }
  int in_all = 0;
  for (const auto& [pair, count] : alerts_of) in_all += count;
  RecordProperty("alerts", in_all);
  for (const auto& pair : near_pairs)
    EXPECT_TRUE(alerts_of.contains(pair)) << pair.first << " " << pair.second;
  EXPECT_LE(in_all, 3 * approaches) << near_pairs.size() << " pairs, " << alerts_of.size() << " with alerts";
  RecordProperty("reports", static_cast<int>(whole));
  RecordProperty("near", near);
}

}  // namespace
}  // namespace kinesphere::program::ais_day_test
