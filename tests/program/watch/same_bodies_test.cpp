// Ids of `kinesphere watch` that may be one body: tracks that go on under another id, and echoes. What is
// true comes from the paths of the bodies, which the program does not know.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/random.hpp"
#include "program/support.hpp"

namespace kinesphere::program::same_bodies_test {
namespace {

using Json = nlohmann::json;

constexpr double separation = 20.0, position_error = 1.0, velocity_error = 0.3;
const std::string promises =
    " --separation sphere:20 --acceleration 5 --largest-speed 30 --position-error 1 --velocity-error 0.3 "
    "--look-ahead 0 ";

/// Returns a report with an error of its position.
std::string line_of(const std::string& id, double stamp, const State& state, Random& random) {
  const Vec3 position = state.position + 0.99 * position_error * random.point_in_ball();
  const Vec3 velocity = state.velocity + 0.99 * velocity_error * random.point_in_ball();
  return Json{{"id", id},
              {"stamp", stamp},
              {"position", {position.x, position.y, position.z}},
              {"velocity", {velocity.x, velocity.y, velocity.z}}}
             .dump() +
         "\n";
}

class SameBodiesWatch : public ProgramTest {
 protected:
  /// Returns the alerts of a run that must succeed.
  std::vector<Json> alerts(const std::string& stream, const std::string& options = "") {
    const ProgramRun result = run("watch " + write("s.jsonl", stream) + promises + options +
                                  " --quiet --summary '" + path("summary.json") + "'");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    summary_ = Json::parse(read_text(path("summary.json")));
    std::filesystem::remove(path("summary.json"));
    std::vector<Json> alerts;
    std::istringstream text(result.out);
    for (std::string line; std::getline(text, line);) alerts.push_back(Json::parse(line));
    return alerts;
  }
  /// Returns the alerts as `TIME EVENT FIRST SECOND`, each time in tenths of seconds.
  std::string told(const std::string& stream, const std::string& options = "") {
    std::string text;
    for (const Json& alert : alerts(stream, options)) {
      const std::string event = alert["event"] == "verdict" ? alert["verdict"].get<std::string>()
                                                            : alert["event"].get<std::string>();
      text += fmt::format("{:.1f} {} {} {}\n", alert["time"].get<double>(), event,
                          alert.value("first", alert.value("track", "")), alert.value("second", ""));
    }
    return text;
  }
  Json summary_;
};

/// Drones on ellipses, some of which cross; each changes its id after `period` seconds, which is infinite for
/// none.
struct Swarm {
  int drones = 24;
  double period = 12.0, seconds = 120.0;
  std::uint64_t seed = 1;

  /// A drone's path in a row of places 90 m apart; every fourth one visits its neighbour's.
  State at(int drone, double time) const {
    const double turn = 0.2 + 0.01 * (drone % 5), phase = turn * time + drone;
    const double reach = drone % 4 == 0 ? 85.0 : 25.0;
    return {{90.0 * drone + reach * std::cos(phase), 20.0 * std::sin(phase), 50.0},
            {-reach * turn * std::sin(phase), 20.0 * turn * std::cos(phase), 0.0}};
  }
  std::string id(int drone, double time) const {
    if (!std::isfinite(period)) return fmt::format("{}-0", drone);
    return fmt::format("{}-{}", drone, static_cast<int>((time + 1.7 * drone) / period));
  }
  std::string stream() const {
    Random random(seed);
    std::string text;
    for (int second = 0; second < seconds; ++second)
      for (int drone = 0; drone < drones; ++drone) {
        const double time = second + drone / 32.0;
        text += line_of(id(drone, time), time, at(drone, time), random);
      }
    return text;
  }
  /// Returns the pairs of drones that come nearer than a distance for three seconds at least.
  std::set<std::pair<int, int>> pairs_within(double distance, double lasting) const {
    std::set<std::pair<int, int>> pairs;
    constexpr double step = 0.1;
    for (int a = 0; a < drones; ++a)
      for (int b = a + 1; b < drones; ++b) {
        double since = 0.0;
        for (double time = 0.0; time < seconds - 1.0; time += step) {
          since = norm(at(a, time).position - at(b, time).position) < distance ? since + step : 0.0;
          if (since > lasting) pairs.insert({a, b});
        }
      }
    return pairs;
  }
};

std::pair<int, int> drones_of(const Json& alert) {
  const auto drone = [&](const char* key) { return std::stoi(alert[key].get<std::string>()); };
  return std::minmax(drone("first"), drone("second"));
}

TEST_F(SameBodiesWatch, DronesThatChangeTheirIdsAreToldOfAsIfTheyKeptThem) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Swarm swarm{.seed = seed};
    std::set<std::pair<int, int>> told;
    for (const Json& alert : alerts(swarm.stream(), "--only within")) {
      EXPECT_NE(drones_of(alert).first, drones_of(alert).second) << alert;
      if (alert["verdict"] == "within") told.insert(drones_of(alert));
    }
    const auto certain = swarm.pairs_within(separation - 6.0, 3.0);
    const auto possible = swarm.pairs_within(separation + 0.1, 0.0);
    EXPECT_GE(certain.size(), 5u);
    EXPECT_TRUE(std::includes(told.begin(), told.end(), certain.begin(), certain.end())) << "seed " << seed;
    EXPECT_TRUE(std::includes(possible.begin(), possible.end(), told.begin(), told.end())) << "seed " << seed;
    // Each drone changes its id nine or ten times; only those of the last seconds are not handed over yet.
    EXPECT_GE(summary_["handovers"], 24 * 9);
    EXPECT_LE(summary_["tracks"], 24 + 8);
    EXPECT_EQ(summary_["contradictions"], 0);
  }
}

TEST_F(SameBodiesWatch, NothingIsTakenForAnotherWhereIdsStay) {
  const Swarm swarm{.period = std::numeric_limits<double>::infinity()};
  const std::string stream = swarm.stream();
  EXPECT_EQ(told(stream), told(stream, "--distinct-ids"));
  EXPECT_EQ(summary_["handovers"], 0);
}

/// Returns a stream of bodies that report each second from and until their times.
struct Body {
  std::string id;
  State state;
  double from = 0.0, until = 20.0;
};
std::string stream_of(std::vector<Body> bodies, double interval = 1.0) {
  Random random(5);
  std::vector<std::pair<double, std::string>> lines;
  for (const Body& body : bodies)
    for (double time = body.from; time <= body.until; time += interval) {
      State state = body.state;
      state.position += state.velocity * time;
      lines.emplace_back(time, line_of(body.id, time, state, random));
    }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string text;
  for (const auto& [time, line] : lines) text += line;
  return text;
}

const Vec3 here{0, 0, 50}, fast{12, 0, 0}, still{};

TEST_F(SameBodiesWatch, WhatBeginsNearATrackThatGoesOnIsAnotherBody) {
  // At 5.5 it might be `old` under another id, which reports again at 6.
  EXPECT_EQ(told(stream_of({{"old", {here, still}}, {"young", {{2, 0, 50}, still}, 5.5}})),
            "6.0 within old young\n");
  EXPECT_GT(summary_["held_back_of_one_body"], 0);
  // So it is of two that move together for a while.
  EXPECT_EQ(told(stream_of({{"old", {here, fast}, 0, 6},
                            {"old", {{-12, 2, 50}, {14, 0, 0}}, 7, 9},
                            {"young", {{2, 0, 50}, fast}, 5.5, 9}})),
            "8.0 within old young\n");
  // Another place or velocity is certain at once.
  EXPECT_EQ(told(stream_of({{"old", {here, fast}}, {"young", {{15, 0, 50}, fast}, 5.5}})),
            "5.5 within old young\n");
  EXPECT_EQ(told(stream_of({{"old", {here, still}}, {"young", {{3, 66, 50}, {0, -12, 0}}, 5.5, 5.6}})),
            "5.5 within old young\n");
}

TEST_F(SameBodiesWatch, AnIdThatReportsAgainIsTheBodyThatItWas) {
  // `old` is silent for eight of its intervals, and goes on: `young` had been taken for it meanwhile.
  std::vector<Body> bodies{{"old", {here, still}, 0, 10}, {"young", {{3, 0, 50}, still}, 11.5, 30}};
  EXPECT_EQ(told(stream_of(bodies)), "");
  EXPECT_EQ(summary_["handovers"], 1);
  bodies.push_back({"old", {here, still}, 18, 30});
  EXPECT_EQ(told(stream_of(bodies)), "18.0 within old young\n");
}

TEST_F(SameBodiesWatch, AnEncounterGoesOnUnderTheOtherId) {
  const std::vector<Body> bodies{{"old", {here, still}, 0, 10},
                                 {"new", {here, still}, 11, 30},
                                 {"other", {{10, 0, 50}, still}, 0.5, 30}};
  EXPECT_EQ(told(stream_of(bodies)), "0.5 within old other\n11.0 within new other\n13.0 lost old other\n");
  const auto lines = alerts(stream_of(bodies), "--only lost,within,tracks");
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[2]["reason"], "handover");
  EXPECT_EQ(lines[2]["goes_on_as"], "new");
  EXPECT_EQ(lines[3]["event"], "dropped");
  EXPECT_EQ(lines[3]["goes_on_as"], "new");
  EXPECT_NE(run("watch " + path("s.jsonl") + promises + "--text --quiet")
                .out.find("13  lost       old and other: old goes on as new; closest "),
            std::string::npos);
}

TEST_F(SameBodiesWatch, TheOwnTrackIsNeverGivenUp) {
  const std::vector<Body> bodies{{"own", {here, still}, 0, 10}, {"new", {{2, 0, 50}, still}, 11, 30}};
  EXPECT_EQ(told(stream_of(bodies), "--only within"), "");
  EXPECT_EQ(told(stream_of(bodies), "--own own --only within"), "13.0 within new own\n");
  EXPECT_EQ(summary_["handovers"], 0);
}

TEST_F(SameBodiesWatch, SaysWhatItsEndLeavesOpen) {
  const std::string open = "1 tracks that have just begun may be others under another id";
  std::vector<Body> bodies{{"old", {here, still}, 0, 10}, {"new", {{2, 0, 50}, still}, 10.5, 10.5}};
  EXPECT_EQ(told(stream_of(bodies)), "");
  EXPECT_NE(run("watch " + path("s.jsonl") + promises).err.find(open), std::string::npos);
  EXPECT_EQ(run("watch " + path("s.jsonl") + promises + "--distinct-ids").err.find(open), std::string::npos);
  bodies.back().until = 20;
  EXPECT_EQ(told(stream_of(bodies)), "");
  EXPECT_EQ(run("watch " + path("s.jsonl") + promises).err.find(open), std::string::npos);
  // A track that may be anywhere says nothing of another one.
  write("far.jsonl", stream_of({{"old", {here, still}, 0, 0}, {"new", {{2, 0, 50}, still}, 9, 9}}));
  EXPECT_NE(run("watch " + path("far.jsonl") +
                " --separation sphere:20:10s --acceleration 5 --position-error 1 --velocity-error 0.3" +
                " --text --quiet")
                .out.find("predicted"),
            std::string::npos);
}

TEST_F(SameBodiesWatch, CanBeSwitchedOff) {
  const std::string stream = stream_of({{"old", {here, still}, 0, 10}, {"new", {{3, 0, 50}, still}, 11, 30}});
  EXPECT_EQ(told(stream), "");
  EXPECT_EQ(told(stream, "--distinct-ids").substr(0, 20), "11.0 within new old\n");
  // Who asks for all that is certain gets it of all ids.
  EXPECT_NE(told(stream, "--only undecided,within").find("11.0 within new old\n"), std::string::npos);
}

TEST_F(SameBodiesWatch, AnotherPlaceOrVelocityIsAnotherBody) {
  const auto handovers = [&](const State& begin) {
    told(stream_of({{"old", {here, still}, 0, 10},
                    {"new", {begin.position - 11.0 * begin.velocity, begin.velocity}, 11, 20}}));
    return summary_["handovers"];
  };
  EXPECT_EQ(handovers({{3, 0, 50}, still}), 1);
  EXPECT_EQ(handovers({{3, 0, 50}, {4, 0, 0}}), 1) << "it may have gained that speed in a second";
  EXPECT_EQ(handovers({{3, 0, 50}, {8, 0, 0}}), 0);
  EXPECT_EQ(handovers({{12, 0, 50}, still}), 0);
  EXPECT_EQ(handovers({{0, 0, 61}, still}), 0);
}

TEST_F(SameBodiesWatch, AnEchoIsToldOnce) {
  // Two receivers of one sender: the place is the same within the errors.
  const std::vector<Body> bodies{{"craft", {here, fast}, 0, 30}, {"~craft", {{0.5, 0, 50}, fast}, 5.5, 30}};
  EXPECT_EQ(told(stream_of(bodies)), "8.5 one_body craft ~craft\n");
  EXPECT_EQ(summary_["one_bodies"], 1);
  EXPECT_EQ(told(stream_of(bodies), "--own craft"), "8.5 one_body craft ~craft\n");
  EXPECT_EQ(told(stream_of(bodies), "--distinct-ids"), "5.5 within craft ~craft\n");
  EXPECT_NE(run("watch " + path("s.jsonl") + promises + "--text --quiet")
                .out.find("8.5  one body   craft and ~craft:"),
            std::string::npos);
}

/// Ships at rest report every three minutes, and of a ship whose limits are wide one lost report says little.
TEST_F(SameBodiesWatch, AShipOfWhichAReportIsLostIsStillThere) {
  std::string text = "MMSI,BaseDateTime,LAT,LON,SOG,COG\n";
  const auto add = [&](int id, int second, double latitude) {
    text += fmt::format("{},2026-03-01T12:{:02}:{:02},{:.4f},9.0000,0.2,0\n", id, second / 60, second % 60,
                        latitude);
  };
  for (int second = 0; second <= 700; second += 20) {
    if (second % 180 == 0 && second < 400) add(211000001, second, 53.5);
    if (second >= 400) add(211000002, second, 53.5027);
    add(211000003, second, 53.6);
  }
  const ProgramRun result = run("watch " + write("ais.csv", text) + " --separation sphere:0.5NM --summary '" +
                                path("summary.json") + "'");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const Json summary = Json::parse(read_text(path("summary.json")));
  EXPECT_EQ(summary["handovers"], 0);
  EXPECT_EQ(summary["tracks"], 3);
}

TEST_F(SameBodiesWatch, TwoThatSeemedOneAreToldWhenTheyPart) {
  // From 15 s on they are 8 m apart.
  const std::vector<Body> bodies{{"a", {here, fast}, 0, 30},
                                 {"b", {{0.5, 0, 50}, fast}, 5.5, 15},
                                 {"b", {{8.5, 0, 50}, fast}, 16.5, 30}};
  EXPECT_EQ(told(stream_of(bodies)), "8.5 one_body a b\n16.5 within a b\n");
}

}  // namespace
}  // namespace kinesphere::program::same_bodies_test
