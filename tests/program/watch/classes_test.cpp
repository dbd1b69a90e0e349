// Classes of tracks: by what a stream says, by --class, and when they change.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <queue>
#include <sstream>

#include "formats/fields/json_reading.hpp"
#include "kinesphere/random.hpp"
#include "program/formats/ais/ais_encoder.hpp"
#include "program/support.hpp"
#include "watch/tracks/class_rules.hpp"
#include "watch/watch.hpp"
#include "watch/watch_options.hpp"
#include "watch/watch_pipeline.hpp"

namespace kinesphere::program::classes_test {
namespace {

using Json = nlohmann::json;

/// A watch of the lines of a stream, as the program makes it from its options.
struct ClassWatch {
  explicit ClassWatch(StreamFormat format, WatchOptions options = {})
      : pipeline(settings_of(with_separation(options), format, "test"),
                 [this](std::uint64_t, std::string_view line) { alerts.push_back(Json::parse(line)); }) {
    const bool is_table = format == StreamFormat::csv || format == StreamFormat::ais;
    reader = make_ruled_format(make_format(format, options.choices), pipeline.view().settings.class_rules,
                               is_table);
  }
  static WatchOptions with_separation(WatchOptions options) {
    if (options.separations.empty()) options.separations = {"sphere:500"};
    if (options.only.empty()) options.only = {"within", "undecided", "tracks"};
    return options;
  }

  ClassWatch& read(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      pipeline.begin_record(++line_);
      reader->read({.text = line, .line = line_}, pipeline);
      pipeline.end_record();
    }
    return *this;
  }
  /// Returns the name of a track's class; empty for the default one, "none" if there is no such track.
  std::string class_of(const std::string& id) {
    // Nothing confirms the time of a few reports.
    if (!pipeline.view().pairs.monitor()) pipeline.finish();
    const NamedTrack* const track = pipeline.view().tracks.names().find(track_id_of(id));
    return track == nullptr ? "none" : pipeline.view().tracks.classes()[track->declared.motion_class].name;
  }
  /// Returns the times that a pair has turned undecided.
  std::uint64_t undecided() const { return pipeline.view().counts.turns.at(0).undecided; }

  std::vector<Json> alerts;
  WatchPipeline pipeline;
  std::unique_ptr<ReportFormat> reader;

 private:
  std::size_t line_ = 0;
};

constexpr double knots = 1.0 / knot;

/// A ship off the coast; speed in metres per second.
EncodedStation ship(std::uint32_t mmsi, double speed, int status, int ship_type = 0) {
  return {.mmsi = mmsi,
          .longitude = encoded_degrees(8.0 + 0.1 * (mmsi % 100)),
          .latitude = encoded_degrees(54.0),
          .speed = static_cast<int>(std::lround(10.0 * speed * knots)),
          .course = 900,
          .status = status,
          .ship_type = ship_type};
}
std::string at_time(const std::string& bits, int seconds) {
  return vdm(bits, std::to_string(1700000000 + seconds)) + "\n";
}

TEST(TrackClasses, AreThoseThatAisSays) {
  ClassWatch watch(StreamFormat::nmea);
  watch.read(at_time(class_a_message(ship(211000001, 0.2, 1)), 0))
      .read(at_time(class_a_message(ship(211000002, 0.2, 5)), 0))
      .read(at_time(class_a_message(ship(211000003, 4.0, 5)), 0))
      .read(at_time(class_a_message(ship(211000004, 0.2, 0)), 0))
      .read(at_time(class_b_message(ship(211000005, 0.0, 1)), 0));
  EXPECT_EQ(watch.class_of("211000001"), "vessel-at-rest") << "at anchor";
  EXPECT_EQ(watch.class_of("211000002"), "vessel-at-rest") << "moored";
  EXPECT_EQ(watch.class_of("211000003"), "") << "its speed contradicts its status";
  EXPECT_EQ(watch.class_of("211000004"), "") << "under way";
  EXPECT_EQ(watch.class_of("211000005"), "") << "no status";
  EncodedStation unknown = ship(211000006, 0.0, 1);
  unknown.speed = 1023;
  watch.read(at_time(class_a_message(unknown), 0));
  EXPECT_EQ(watch.class_of("211000006"), "") << "at anchor, and nothing confirms it";
  for (const auto& [mmsi, speed, status] : {std::tuple{211000007u, 15.0, 0}, {211000008u, 0.1, 5}})
    watch.read(at_time(static_message(ship(mmsi, speed, status, 40)), 0))
        .read(at_time(class_a_message(ship(mmsi, speed, status)), 0));
  EXPECT_EQ(watch.class_of("211000007"), "high-speed-craft");
  EXPECT_EQ(watch.class_of("211000008"), "vessel-at-rest") << "a ferry at its berth";
  watch.read(at_time(class_b_static_message(ship(211000009, 0, 0, 21)), 0))
      .read(at_time(class_b_message(ship(211000009, 30.0, 0)), 0))
      .read(at_time(search_aircraft_message(ship(111211001, 3.0, 0)), 0))
      .read(at_time(aid_to_navigation_message(ship(992110001, 0, 0)), 0));
  EncodedStation adrift = ship(992110002, 0, 0);
  adrift.off_position = 1;
  watch.read(at_time(aid_to_navigation_message(adrift), 0));
  EXPECT_EQ(watch.class_of("211000009"), "wing-in-ground");
  EXPECT_EQ(watch.class_of("111211001"), "search-aircraft");
  EXPECT_EQ(watch.class_of("992110001"), "aid-to-navigation");
  EXPECT_EQ(watch.class_of("992110002"), "") << "off its position";
  EXPECT_EQ(watch.pipeline.view().counts.malformed, 0u);
}

TEST(TrackClasses, AreThoseThatTablesOfAisSay) {
  ClassWatch numbers(StreamFormat::ais);
  numbers.read(
      "MMSI,BaseDateTime,LAT,LON,SOG,COG,VesselType,Status\n"
      "1,2023-01-01T00:00:00,54,8,0.1,10,70,1\n2,2023-01-01T00:00:00,54,8.1,20,10,40,0\n"
      "3,2023-01-01T00:00:00,54,8.2,0.1,10,,\n4,2023-01-01T00:00:00,54,8.3,9,10,70,1\n");
  EXPECT_EQ(numbers.class_of("1"), "vessel-at-rest");
  EXPECT_EQ(numbers.class_of("2"), "high-speed-craft");
  EXPECT_EQ(numbers.class_of("3"), "");
  EXPECT_EQ(numbers.class_of("4"), "");
  ClassWatch words(StreamFormat::ais);
  words.read(
      "# Timestamp,Type of mobile,MMSI,Latitude,Longitude,Navigational status,SOG,COG,Ship type\n"
      "01/01/2023 00:00:00,Class A,1,54,8,At anchor,0.1,10,Cargo\n"
      "01/01/2023 00:00:00,Class A,2,54,8.1,Under way using engine,20,10,HSC\n"
      "01/01/2023 00:00:00,SAR Airborne,3,54,8.2,Unknown value,90,10,\n"
      "01/01/2023 00:00:00,AtoN,4,54,8.3,Unknown value,,,\n");
  EXPECT_EQ(words.class_of("1"), "vessel-at-rest");
  EXPECT_EQ(words.class_of("2"), "high-speed-craft");
  EXPECT_EQ(words.class_of("3"), "search-aircraft");
  EXPECT_EQ(words.class_of("4"), "aid-to-navigation");
  // Without such columns there are no such classes, which would make the map larger.
  ClassWatch plain(StreamFormat::ais);
  plain.read("MMSI,BaseDateTime,LAT,LON,SOG,COG\n1,2023-01-01T00:00:00,54,8,0.1,10\n");
  EXPECT_EQ(plain.class_of("1"), "");
  EXPECT_EQ(plain.pipeline.view().tracks.classes().size(), 1u);
}

TEST(TrackClasses, AreThoseThatEmittersOfAdsBSay) {
  std::string aircraft;
  for (const char* category : {"A0", "A1", "A3", "A5", "A6", "A7", "B1", "B2", "B4", "B6", "B7", "C2", "C3"})
    aircraft += fmt::format(
        R"({}{{"hex": "{}", "category": "{}", "lat": 50, "lon": 8, "alt_baro": 9000, "gs": 20, "track": 9, "seen_pos": 0, "rc": 75, "nac_v": 2}})",
        aircraft.empty() ? "" : ", ", category, category);
  ClassWatch readsb(StreamFormat::readsb);
  readsb.read(R"({"now": 1700000000, "aircraft": [)" + aircraft + "]}\n");
  for (const auto& [category, name] : {std::pair{"A0", ""},
                                       {"A1", "light-aircraft"},
                                       {"A3", ""},
                                       {"A5", ""},
                                       {"A6", "high-performance"},
                                       {"A7", "rotorcraft"},
                                       {"B1", "glider"},
                                       {"B2", "balloon"},
                                       {"B4", "ultralight"},
                                       {"B6", "unmanned-aircraft"},
                                       {"B7", ""},
                                       {"C2", "ground-vehicle"},
                                       {"C3", "obstacle"}})
    EXPECT_EQ(readsb.class_of(category), name) << category;
  const auto wide = motion_class(MotionPreset::high_performance).limits,
             usual = motion_class(MotionPreset::airliner).limits;
  EXPECT_EQ(largest(wide.acceleration, usual.acceleration), wide.acceleration);
  EXPECT_EQ(largest(wide.largest_speed, usual.largest_speed), wide.largest_speed);

  ClassWatch opensky(StreamFormat::opensky);
  opensky.read(
      R"({"time": 1700000000, "states": [["a", "", "", 1700000000, 0, 8, 50, 3000, false, 90, 9, 0, null, 3000, "", false, 0, 8], )"
      R"(["b", "", "", 1700000000, 0, 8, 51, 3000, false, 90, 9, 0, null, 3000, "", false, 0, 4], )"
      R"(["c", "", "", 1700000000, 0, 8, 52, 3000, false, 90, 9, 0, null, 3000, "", false, 0]]})"
      "\n");
  EXPECT_EQ(opensky.class_of("a"), "rotorcraft");
  EXPECT_EQ(opensky.class_of("b"), "");
  EXPECT_EQ(opensky.class_of("c"), "");
}

TEST(TrackClasses, AreLeftOutOnRequest) {
  WatchOptions options;
  options.no_classes = true;
  options.classes = {"small-craft=type = 37"};
  ClassWatch watch(StreamFormat::nmea, options);
  watch.read(at_time(class_a_message(ship(211000001, 0.2, 1)), 0))
      .read(at_time(static_message(ship(211000002, 0, 0, 37)), 0))
      .read(at_time(class_a_message(ship(211000002, 9, 0)), 0));
  EXPECT_EQ(watch.class_of("211000001"), "");
  EXPECT_EQ(watch.class_of("211000002"), "small-craft");
  EXPECT_EQ(watch.pipeline.view().tracks.classes().size(), 2u);
}

/// A ship that swings at anchor keeps its class; a status that its speed has contradicted is not believed for
/// five minutes.
TEST(TrackClasses, ChangeWhenTheSpeedContradictsTheStatus) {
  ClassWatch watch(StreamFormat::nmea);
  int time = 0;
  const auto class_after = [&](double speed, int status, int seconds) {
    time += seconds;
    watch.read(at_time(class_a_message(ship(211000001, speed, status)), time));
    return watch.class_of("211000001");
  };
  EXPECT_EQ(class_after(0.6, 1, 0), "") << "too fast to be believed";
  EXPECT_EQ(class_after(0.4, 1, 60), "vessel-at-rest");
  for (const double speed : {0.6, 0.4, 0.65, 0.5, 0.6})
    EXPECT_EQ(class_after(speed, 1, 60), "vessel-at-rest") << speed;
  EXPECT_EQ(class_after(0.8, 1, 60), "");
  for (const double speed : {0.4, 0.0, 0.0}) EXPECT_EQ(class_after(speed, 1, 90), "") << speed;
  EXPECT_EQ(class_after(0.0, 1, 90), "vessel-at-rest");
  EXPECT_EQ(class_after(0.0, 0, 60), "") << "it is under way";
  EXPECT_EQ(class_after(0.0, 5, 60), "vessel-at-rest") << "no speed has contradicted this";
  EXPECT_EQ(watch.pipeline.view().counters().contradictions, 0u);
  std::vector<std::string> classes;
  for (const Json& alert : watch.alerts)
    if (alert["event"] == "reclassified") classes.push_back(alert["class"]);
  const std::string rest = "vessel-at-rest (acceleration: 0.05; speed: 1)",
                    any = "acceleration: 0.3; speed: 30";
  EXPECT_EQ(classes, (std::vector{rest, any, rest, any, rest}));
}

TEST(TrackClasses, AreNotChangedByLateReports) {
  ClassWatch watch(StreamFormat::ais);
  watch.read(
      "MMSI,BaseDateTime,LAT,LON,SOG,COG,Status\n1,2023-01-01T00:00:00,54,8,2,10,0\n"
      "1,2023-01-01T00:02:00,54,8,0,10,1\n1,2023-01-01T00:01:00,54,8,1,10,0\n"
      "1,2023-01-01T00:02:30,54,8,0,10,1\n1,2023-01-01T00:02:10,54,8,0,10,1\n"
      "1,2023-01-01T00:02:20,54,8,2,10,0\n1,2023-01-01T00:00:30,54,8,0,10,1\n");
  EXPECT_EQ(watch.class_of("1"), "vessel-at-rest");
  EXPECT_EQ(watch.pipeline.view().counts.superseded, 3u);
  EXPECT_EQ(watch.pipeline.view().counters().reports, 4u);
}

TEST(TrackClasses, AreThoseOfTheUser) {
  WatchOptions options;
  options.acceleration = "1";
  options.largest_speed = "10";
  options.position_error = "1";
  options.classes = {"drone=kind = quad and pace < 30", "0.3g,60kt:5=kind=plane", "drone=kind = hexa"};
  ClassWatch table(StreamFormat::csv, options);
  table.read(
      "id,time,x,y,vx,vy,velocity_error,kind,pace\na,0,0,0,1,0,1,quad,1\nb,0,9000,0,1,0,1,plane,1\n"
      "c,0,20000,0,1,0,1,hexa,90\nd,0,30000,0,1,0,1,quad,90\ne,0,40000,0,1,0,1,,\n");
  EXPECT_EQ(table.class_of("a"), "drone");
  EXPECT_EQ(table.class_of("b"), "0.3g,60kt:5");
  EXPECT_EQ(table.class_of("c"), "drone");
  EXPECT_EQ(table.class_of("d"), "");
  EXPECT_EQ(table.class_of("e"), "");
  const TrackClasses& classes = table.pipeline.view().tracks.classes();
  ASSERT_EQ(classes.size(), 3u) << "one of each name";
  EXPECT_EQ(classes.promise(0), "acceleration: 1; speed: 10");
  EXPECT_EQ(classes.promise(2), "0.3g,60kt:5 (acceleration: 2.942; speed: 30.87:5)");
  // Where there are no columns, fields of the report count.
  options.classes = {"5:2,=id = d2", "drone=speed >= 3"};
  ClassWatch lines(StreamFormat::jsonl, options);
  for (int k = 1; k <= 3; ++k)
    lines.read(fmt::format(
        R"({{"id": "d{}", "stamp": 0, "position": [{}, 0], "velocity": [{}, 0], "velocity_error": 1}})", k,
        9000 * k, k));
  EXPECT_EQ(lines.class_of("d1"), "");
  EXPECT_EQ(lines.class_of("d2"), "5:2,");
  EXPECT_EQ(lines.class_of("d3"), "drone");
  EXPECT_EQ(lines.pipeline.view().tracks.classes().promise(1), "5:2, (acceleration: 5:2; speed: any)");
}

class ClassOption : public ProgramTest {};

TEST_F(ClassOption, TakesIdsFromAFile) {
  const std::string file = write("ids.csv", "# drones\nD1,first\n\n d2 \r\n");
  WatchOptions options;
  options.acceleration = "1";
  options.position_error = options.velocity_error = "1";
  options.classes = {"drone=@" + file};
  ClassWatch watch(StreamFormat::jsonl, options);
  for (int k = 1; k <= 3; ++k)
    watch.read(
        fmt::format(R"({{"id": "d{}", "stamp": 0, "position": [{}, 0], "velocity": [1, 0]}})", k, 9000 * k));
  EXPECT_EQ(watch.class_of("d1"), "drone");
  EXPECT_EQ(watch.class_of("d2"), "drone");
  EXPECT_EQ(watch.class_of("d3"), "");
}

TEST_F(ClassOption, RefusesWrongInput) {
  const std::string line = R"({"id": "a", "stamp": 0, "position": [0, 0], "velocity": [1, 0]})";
  const std::string file = write("s.jsonl", line + "\n"), empty = write("empty", "# nothing\n");
  const std::string table = write("s.csv", "id,time,x,y,vx,vy\na,0,0,0,1,0\n");
  const auto refuses = [&](const std::string& given, std::initializer_list<std::string_view> parts,
                           const std::string& stream) {
    expect_wrong_input(stream +
                           " --separation sphere:5 --acceleration 1 --position-error 1 --velocity-error 1 "
                           "--class '" +
                           given + "'",
                       parts);
  };
  const std::string jsonl = "watch " + file, csv = "watch " + table;
  refuses("drone", {"--class", "CLASS=EXPRESSION", "'drone'"}, jsonl);
  refuses("drone=", {"--class", "CLASS=EXPRESSION"}, jsonl);
  refuses("zeppelin=id = a", {"--class", "balloon", "'zeppelin'"}, jsonl);
  refuses("5;2,3=id = a", {"--class", "5;2"}, jsonl);
  refuses("5kt,3=id = a", {"--class", "5kt"}, jsonl);
  refuses(",=id = a", {"--class", "expected a limit"}, jsonl);
  refuses("drone=kind = a", {"--class", "id, category, type, status, speed", "kind"}, jsonl);
  refuses("drone=kind = a", {"--class", "vx", "kind"}, csv);
  refuses("drone=id", {"--class", "one of = !="}, csv);
  refuses("drone=@" + path("missing"), {"missing"}, jsonl);
  refuses("drone=@" + empty, {"--class", "expected ids", "empty"}, jsonl);
}

/// Options that affect verdicts have to be the same.
TEST_F(ClassOption, IsThatOfTheSnapshot) {
  const std::string file = write("s.jsonl", R"({"id": "a", "stamp": 0, "position": [0, 0]})"
                                            "\n");
  const std::string command = "watch " + file +
                              " --separation sphere:5 --largest-speed 1 --position-error 1 --quiet "
                              "--snapshot '" +
                              path("state") + "'";
  EXPECT_EQ(run(command + " --class 'drone=id = a'").exit_code, 0);
  EXPECT_EQ(run(command + " --class 'drone=id = a'").exit_code, 0);
  expect_wrong_input(command + " --class 'drone=id = b'", {"--class", "drone=id = a"});
  expect_wrong_input(command + " --class 'drone=id = a' --no-classes", {"--no-classes"});
}

/// Alerts name the class of each track, also of the own track, whose classes are doubled.
TEST(TrackClasses, AreNamedByAlerts) {
  for (const char* own : {"", "1"}) {
    WatchOptions options;
    options.own = own;
    ClassWatch watch(StreamFormat::ais, options);
    watch.read(
        "MMSI,BaseDateTime,LAT,LON,SOG,COG,Status\n1,2023-01-01T00:00:00,54,8,0,10,1\n"
        "2,2023-01-01T00:00:00,54,8.0075,3,10,0\n3,2023-01-01T00:00:01,54.004,8,0,10,5\n");
    watch.pipeline.finish();
    ASSERT_EQ(watch.alerts.size(), 2u);
    const std::string rest = "vessel-at-rest (acceleration: 0.05; speed: 1)";
    for (const Json& alert : watch.alerts)
      EXPECT_EQ(alert["rests_on"]["both"],
                alert["second"] == "3" ? rest : "first: " + rest + "; second: acceleration: 0.3; speed: 30");
    const auto& definition = watch.pipeline.view().pairs.monitor()->definition();
    EXPECT_EQ(definition.classes.size(), *own == '\0' ? 2u : 4u);
    EXPECT_NEAR(definition.classes.back().largest_speed.horizontal(), 1.0, 0.01);
  }
}

TEST(TrackClasses, ContinueFromASnapshot) {
  WatchOptions options;
  options.classes = {"small-craft=category = B"};
  ClassWatch whole(StreamFormat::nmea, options);
  auto part = std::make_unique<ClassWatch>(StreamFormat::nmea, options);
  Random random(3);
  for (int k = 0; k < 400; ++k) {
    const auto mmsi = 211000000u + static_cast<std::uint32_t>(random.uniform(0.0, 12.0));
    EncodedStation s = ship(mmsi, random.uniform(0.0, 1.0), random.uniform(0.0, 1.0) < 0.7 ? 1 : 0);
    s.longitude = encoded_degrees(8.0 + 0.008 * (mmsi % 4));
    const std::string line = at_time(mmsi % 3 == 0 ? class_b_message(s) : class_a_message(s), 10 * k);
    whole.read(line);
    part->read(line);
    if (k % 37 != 0) continue;
    // One of the first is held: nothing confirms its time.
    auto later = std::make_unique<ClassWatch>(StreamFormat::nmea, options);
    later->pipeline.restore(part->pipeline.save());
    take_state(*part->reader, *later->reader);
    later->alerts = part->alerts;
    part = std::move(later);
  }
  EXPECT_EQ(part->alerts, whole.alerts);
  EXPECT_GT(whole.pipeline.view().counts.events[static_cast<std::size_t>(MonitorEventKind::reclassified)],
            50u);
  EXPECT_EQ(whole.class_of("211000002"), "small-craft");
}

/// Twenty ships at anchor, a kilometre from each other, that report every three minutes for an hour.
TEST(TrackClasses, LetAHarbourAtAnchorBeQuiet) {
  std::uint64_t undecided[2] = {};
  for (const int status : {0, 1}) {
    Random random(5);
    std::priority_queue<std::pair<int, int>, std::vector<std::pair<int, int>>, std::greater<>> due;
    for (int k = 0; k < 20; ++k) due.push({static_cast<int>(random.uniform(0.0, 180.0)), k});
    ClassWatch watch(StreamFormat::ais);
    watch.read("MMSI,BaseDateTime,LAT,LON,SOG,COG,Status\n");
    while (due.top().first < 3600) {
      const auto [time, k] = due.top();
      due.pop();
      due.push({time + 180, k});
      const double angle = random.uniform(0.0, 6.28), x = k % 5 * 1000.0 + 40.0 * std::cos(angle),
                   y = k / 5 * 1000.0 + 40.0 * std::sin(angle);
      watch.read(fmt::format("{},2023-01-01T{:02}:{:02}:{:02},{:.5f},{:.5f},0.1,10,{}\n", 100 + k,
                             time / 3600, time / 60 % 60, time % 60, 53.5 + y / 111200.0, 8.0 + x / 66300.0,
                             status));
    }
    undecided[status] = watch.undecided();
  }
  EXPECT_GT(undecided[0], 1000u);
  EXPECT_EQ(undecided[1], 0u);
}

/// A ship that anchors, swings, leaves and sails, and says so, or forgets to.
struct SeaShip {
  std::string id;
  Vec3 position{}, velocity{};
  enum class Phase { anchored, leaving, sailing, stopping } phase = Phase::anchored;
  int status = 1;
  enum class Crew { careful, never_sets, always_anchored } crew = Crew::careful;
  double next_change = 0.0, next_report = 0.0, course = 0.0, turn = 0.0;
  bool is_reported_moving = false;

  /// Accelerations: 0.02 at most while its class may be that of ships at rest, else 0.28. Unit: seconds.
  void go_on(double step) {
    Vec3 thrust{};
    const double speed = norm(velocity);
    const Vec3 ahead{std::cos(course), std::sin(course), 0.0};
    if (phase == Phase::anchored) thrust = Vec3{} - velocity * std::min(1.0, 0.02 / std::max(0.02, speed));
    if (phase == Phase::leaving) thrust = ahead * (is_reported_moving ? 0.2 : speed < 0.9 ? 0.02 : 0.0);
    if (phase == Phase::sailing) thrust = Vec3{-velocity.y, velocity.x, 0.0} * (turn / std::max(speed, 1.0));
    if (phase == Phase::stopping) thrust = velocity * (-0.28 / std::max(0.28, speed));
    position = position + velocity * step + thrust * (0.5 * step * step);
    velocity = velocity + thrust * step;
  }
};

/// No certain verdict is wrong while ships anchor and leave, also if some never set their status.
TEST(TrackClasses, KeepTheGuaranteeWhereShipsAnchorAndLeave) {
  constexpr double separation = 400.0, error = 10.0, velocity_error = 0.1, step = 1.0;
  WatchSettings settings{.separations = {parse_separation("sphere:400")},
                         .kinds = {.tracks = true},
                         .dimensions = 2,
                         .classes = TrackClasses(motion_class(MotionPreset::vessel).limits),
                         .position_error = {error, "test"},
                         .velocity_error = {velocity_error, "test"},
                         .silence = 210.0,
                         .forget = 600.0,
                         .window = 16.0,
                         .source = "test"};
  constexpr MotionPreset sayable[] = {MotionPreset::vessel_at_rest};
  WatchPipeline pipeline(settings, [](std::uint64_t, std::string_view) {});
  Random random(17);
  std::vector<SeaShip> ships(14);
  for (std::size_t k = 0; k < ships.size(); ++k) {
    SeaShip& each = ships[k];
    each.id = fmt::format("ship {}", k);
    each.position = {random.uniform(-1500.0, 1500.0), random.uniform(-1500.0, 1500.0), 0.0};
    each.next_change = random.uniform(0.0, 1200.0);
    each.next_report = random.uniform(0.0, 30.0);
    if (k % 4 == 1) each.crew = SeaShip::Crew::never_sets;
    if (k % 4 == 2) each.crew = SeaShip::Crew::always_anchored;
    if (each.crew == SeaShip::Crew::never_sets) each.status = 0;
  }
  struct Sent {
    double arrival;
    std::size_t ship;
    SourceReport report;
    bool operator<(const Sent& other) const { return arrival > other.arrival; }
  };
  std::priority_queue<Sent> sent;
  std::array<int, 3> verdicts{};
  int at_rest = 0;
  for (double time = 0.0; time < 4000.0; time += step) {
    for (std::size_t k = 0; k < ships.size(); ++k) {
      SeaShip& each = ships[k];
      each.go_on(step);
      const double speed = norm(each.velocity);
      if (each.phase == SeaShip::Phase::leaving && speed > 5.0) each.phase = SeaShip::Phase::sailing;
      if (each.phase == SeaShip::Phase::stopping && speed < 0.05) each.phase = SeaShip::Phase::anchored;
      if (each.phase == SeaShip::Phase::anchored && each.crew == SeaShip::Crew::careful && speed < 0.05)
        each.status = 1;
      if (time > each.next_change && each.phase == SeaShip::Phase::anchored) {
        each.phase = SeaShip::Phase::leaving;
        each.is_reported_moving = false;
        // Towards the others.
        each.course = std::atan2(-each.position.y, -each.position.x) + random.uniform(-0.6, 0.6);
        each.turn = random.uniform(-0.25, 0.25);
        each.next_change = time + random.uniform(200.0, 700.0);
        if (each.crew == SeaShip::Crew::careful && random.uniform(0.0, 1.0) < 0.5) each.status = 0;
      } else if (time > each.next_change && each.phase == SeaShip::Phase::sailing) {
        each.phase = SeaShip::Phase::stopping;
        each.next_change = time + random.uniform(500.0, 2000.0);
      }
      if (speed > 2.0 && each.crew == SeaShip::Crew::careful) each.status = 0;
      if (time < each.next_report) continue;
      each.next_report = time + (speed < 0.2 ? 30.0 : 3.0);
      const auto wrong = [&](double most) {
        const double angle = random.uniform(0.0, 6.28), length = most * random.uniform(0.0, 1.0);
        return Vec3{length * std::cos(angle), length * std::sin(angle), 0.0};
      };
      SourceReport report{.stamp = time_of(time)};
      report.arrival = time_of(time + random.uniform(0.0, 5.0));
      report.position = each.position + wrong(error);
      report.velocity = each.velocity + wrong(velocity_error);
      report.ground_speed = norm(*report.velocity);
      report.said_status = preset_of_status(each.status);
      report.sayable = sayable;
      sent.push({seconds_between({}, *report.arrival), k, report});
    }
    while (!sent.empty() && sent.top().arrival <= time) {
      Sent next = sent.top();
      sent.pop();
      SeaShip& each = ships[next.ship];
      next.report.id = each.id;
      pipeline.take(next.report);
      pipeline.end_record();
      // Such a report ends the class of ships at rest.
      if (*next.report.ground_speed > 0.7 || next.report.said_status != MotionPreset::vessel_at_rest)
        each.is_reported_moving = true;
    }
    pipeline.time_is(time_of(time), TimeKind::number);
    pipeline.end_record();
    if (std::fmod(time, 2.0) != 0.0 || pipeline.view().tracks.names().size() < ships.size()) continue;
    for (std::size_t a = 0; a < ships.size(); ++a) {
      const NamedTrack* const track = pipeline.view().tracks.names().find(track_id_of(ships[a].id));
      at_rest += track->declared.motion_class != 0 ? 1 : 0;
      for (std::size_t b = a + 1; b < ships.size(); ++b) {
        const Verdict verdict = pipeline.view()
                                    .pairs.monitor()
                                    ->answer(track_id_of(ships[a].id), track_id_of(ships[b].id))
                                    .value()
                                    .verdict;
        ++verdicts[static_cast<std::size_t>(verdict)];
        if (verdict == Verdict::undecided) continue;
        const double distance = norm(ships[a].position - ships[b].position);
        ASSERT_EQ(distance <= separation + 0.05, verdict == Verdict::within)
            << time << ": " << ships[a].id << " and " << ships[b].id << ", " << distance;
      }
    }
  }
  EXPECT_EQ(pipeline.view().counters().contradictions, 0u);
  EXPECT_GT(pipeline.view().counts.events[static_cast<std::size_t>(MonitorEventKind::reclassified)], 20u);
  EXPECT_GT(at_rest, 5000);
  EXPECT_GT(verdicts[static_cast<std::size_t>(Verdict::within)], 500);
  EXPECT_GT(verdicts[static_cast<std::size_t>(Verdict::apart)], 50'000);
}

}  // namespace
}  // namespace kinesphere::program::classes_test
