// Tracks at rest in `kinesphere watch`: a harbour in which boats pass moored ones, leave and come, and the
// truth of who met whom is known.
#include "watch/tracks/rest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "kinesphere/random.hpp"
#include "program/support.hpp"
#include "support/test_size.hpp"

namespace kinesphere::program::rest_test {
namespace {

using Json = nlohmann::json;
using Pair = std::pair<std::string, std::string>;

TEST(RestRule, NeedsATimeOfSlownessAndOnePlace) {
  const RestRule rule{.speed = 0.5, .room = 50.0, .time = 180.0};
  Rest rest;
  EXPECT_FALSE(rule.take(rest, {}, 0.4, 0.0, true));
  EXPECT_TRUE(rest.is_at_rest) << "slow from its first report on";
  EXPECT_FALSE(rule.take(rest, {49, 0, 0}, 0.5, 10.0, false));
  EXPECT_TRUE(rest.is_at_rest);
  EXPECT_TRUE(rule.take(rest, {49, 0, 0}, 0.6, 20.0, false));
  EXPECT_FALSE(rest.is_at_rest) << "faster";
  EXPECT_FALSE(rule.take(rest, {49, 0, 0}, 0.1, 30.0, false));
  EXPECT_FALSE(rule.take(rest, {49, 0, 0}, 0.1, 209.0, false));
  EXPECT_FALSE(rest.is_at_rest) << "not for so long";
  EXPECT_FALSE(rule.take(rest, {49, 0, 0}, 0.1, 210.0, false));
  EXPECT_TRUE(rest.is_at_rest);
  EXPECT_TRUE(rule.take(rest, {100, 0, 0}, 0.1, 220.0, false)) << "it drifts away";
  EXPECT_FALSE(rule.take(rest, {100, 0, 0}, std::nullopt, 500.0, false)) << "an unknown speed";
  EXPECT_FALSE(rest.is_at_rest);
  Rest moving;
  EXPECT_FALSE((RestRule{.speed = 0.0, .room = 50.0}).take(moving, {}, 0.0, 0.0, true));
  EXPECT_FALSE(moving.is_at_rest) << "none is at rest";
}

/// Boats in a harbour, in metres and seconds.
struct Boat {
  std::string id;
  double x = 0.0, y = 0.0;
  double speed = 0.0;              ///< along x
  double from = 0.0, until = 1e9;  ///< when it moves; before and after it is moored, or
  double swing = 0.0;              ///< half of the way that it swings to and fro at anchor
  bool is_passing = false;         ///< not there

  double gone(double time) const { return speed * (std::clamp(time, from, until) - from); }
  double place(double time) const { return x + gone(time) + swing * std::sin(time / 400.0 + x); }
  bool is_moving(double time) const { return speed != 0.0 && time >= from && time <= until; }
  bool is_there(double time) const { return !is_passing || is_moving(time); }
};

constexpr double hours = 2.0, separation = 300.0;

/// Two rows of moored boats beside a channel, and boats at anchor that swing across the separation. Others
/// pass through it, some leave, and some come in.
std::vector<Boat> harbour(Random& random) {
  std::vector<Boat> boats;
  for (int k = 0; k < 40; ++k)
    boats.push_back({std::to_string(211000000 + k), 140.0 * (k % 20), k < 20 ? 0.0 : 260.0});
  // Boats at anchor.
  for (int k = 0; k < 8; ++k)
    boats.push_back({std::to_string(211000400 + k), 300.0 * k, 900.0, 0.0, 0.0, 0.0, 28.0});
  for (int k = 0; k < 12; ++k) {
    const bool is_eastward = k % 2 == 0;
    const double speed = random.uniform(2.0, 6.0) * (is_eastward ? 1.0 : -1.0);
    boats.push_back({std::to_string(211000100 + k), is_eastward ? -4000.0 : 6000.0,
                     random.uniform(90.0, 170.0), speed, 500.0 * k, 500.0 * k + 9000.0 / std::abs(speed), 0.0,
                     true});
  }
  for (int k = 0; k < 3; ++k) {
    boats.push_back({std::to_string(211000200 + k), 400.0 + 700.0 * k, -60.0, -3.0, 3000.0 + 900.0 * k});
    boats.push_back({std::to_string(211000300 + k), -5000.0, 320.0, 4.0, 1000.0 * k,
                     1000.0 * k + (5300.0 + 700.0 * k) / 4.0});
  }
  return boats;
}

class Harbour : public ProgramTest {
 protected:
  /// Returns a table of AIS in which moored boats report every three minutes, and say that they are up to
  /// half a knot fast, and others report every ten seconds.
  static std::string table(const std::vector<Boat>& boats, Random& random) {
    constexpr double metres = 111320.0, latitude = 53.5, longitude = 9.0, knot = 1852.0 / 3600.0;
    const double across = metres * std::cos(latitude * 3.14159265358979 / 180.0);
    std::string text = "MMSI,BaseDateTime,LAT,LON,SOG,COG\n";
    for (int second = 0; second < 3600 * hours; ++second)
      for (std::size_t k = 0; k < boats.size(); ++k) {
        const Boat& boat = boats[k];
        const bool moves = boat.is_moving(second);
        if (!boat.is_there(second) || (second + 7 * static_cast<int>(k)) % (moves ? 10 : 180) != 0) continue;
        const Vec3 error = 8.0 * random.point_in_ball();
        text += fmt::format(
            "{},2026-03-01T{:02}:{:02}:{:02},{:.7f},{:.7f},{:.1f},{:.0f}\n", boat.id, 12 + second / 3600,
            second / 60 % 60, second % 60, latitude + (boat.y + error.y) / metres,
            longitude + (boat.place(second) + error.x) / across,
            moves ? std::abs(boat.speed) / knot : random.uniform(0.0, 0.5), boat.speed >= 0.0 ? 90.0 : 270.0);
      }
    return text;
  }
  /// Returns how many times pairs are nearer than a distance while one of them moves, and at the begin. Two
  /// times that are less than two minutes apart are one.
  static std::map<Pair, int> met(const std::vector<Boat>& boats, double distance) {
    std::map<Pair, int> times;
    for (const Boat& one : boats)
      for (const Boat& other : boats) {
        double last = -1e9;
        for (double time = 0.0; one.id < other.id && time < 3600.0 * hours; time += 10.0) {
          const bool is_met = one.is_there(time) && other.is_there(time) &&
                              (time == 0.0 || one.is_moving(time) || other.is_moving(time)) &&
                              std::hypot(one.place(time) - other.place(time), one.y - other.y) < distance;
          if (!is_met) continue;
          if (time > last + 120.0) ++times[{one.id, other.id}];
          last = time;
        }
      }
    return times;
  }
  /// Returns how many alerts each pair has, but for those of lost tracks.
  std::map<Pair, int> told(const std::string& options) {
    const ProgramRun result = run("watch " + path("ais.csv") + " --separation sphere:300m " + options +
                                  " --quiet --summary '" + path("summary.json") + "'");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    summary_ = Json::parse(read_text(path("summary.json")));
    std::filesystem::remove(path("summary.json"));
    std::map<Pair, int> alerts;
    std::istringstream text(result.out);
    for (std::string line; std::getline(text, line);)
      if (const Json alert = Json::parse(line); alert["event"] != "lost")
        ++alerts[{alert["first"], alert["second"]}];
    return alerts;
  }
  Json summary_;
};

TEST_F(Harbour, TellsOfAllThatMeetAndOnceOfThoseThatLieThere) {
  for (std::uint64_t seed = 1; seed <= rounds_of(2u); ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    Random random(seed);
    const std::vector<Boat> boats = harbour(random);
    write("ais.csv", table(boats, random));
    const auto certain = met(boats, separation - 20.0);
    // Errors may make one encounter of two, and two of one.
    auto possible = met(boats, separation + 60.0);
    for (const auto& [pair, times] : met(boats, separation + 120.0))
      possible[pair] = std::max(possible[pair], times);
    // What moves may be predicted to go farther than it does.
    const auto may_meet = [&](const Pair& pair) {
      return std::any_of(boats.begin(), boats.end(), [&](const Boat& boat) {
        return boat.speed != 0.0 && (boat.id == pair.first || boat.id == pair.second);
      });
    };
    EXPECT_GT(certain.size(), 400u);
    const auto alerts = told("");
    for (const auto& [pair, times] : certain)
      EXPECT_TRUE(alerts.contains(pair)) << pair.first << " " << pair.second;
    int lying = 0;
    for (const auto& [pair, count] : alerts) {
      const bool is_moving = may_meet(pair);
      EXPECT_LE(count, is_moving ? 3 * std::max(1, possible[pair]) : 1) << pair.first << " " << pair.second;
      if (!is_moving) ++lying;
    }
    EXPECT_GT(lying, 80);
    EXPECT_GT(summary_["held_back_at_rest"], 10);
    if (seed > 1) continue;
    // All are told to who asks for them: those that swing to and fro, again and again.
    const int told_at_rest = summary_["alerts"];
    told("--rest 0");
    EXPECT_GT(summary_["alerts"], told_at_rest + 20);
    EXPECT_EQ(summary_["held_back_at_rest"], 0);
    told("--only within,undecided");
    EXPECT_EQ(summary_["held_back_at_rest"], 0);
  }
}

TEST_F(Harbour, IsKnownAgainAfterAStop) {
  Random random(4);
  const std::string text = table(harbour(random), random);
  const std::string options = " --separation sphere:300m --quiet ";
  const ProgramRun whole = run("watch " + write("ais.csv", text) + options);
  std::string parts;
  for (int part = 1; part <= 6; ++part) {
    write("ais.csv", text.substr(0, text.size() * static_cast<std::size_t>(part) / 6));
    parts += run("watch " + path("ais.csv") + options + "--snapshot '" + path("state") + "'").out;
  }
  EXPECT_TRUE(parts == whole.out);
  EXPECT_GT(std::count(parts.begin(), parts.end(), '\n'), 500);
}

TEST_F(Harbour, TellsWhatHasChangedWhenABoatGetsUnderWay) {
  const std::string head = "id,time,x,y,vx,vy\n";
  const auto stream = [&](const std::string& later) {
    std::string text = head;
    for (int time = 0; time <= 400; time += 10)
      text += fmt::format("a,{0},0,0,0,0\nb,{0},30,0,0.1,0\n", time);
    return text + later;
  };
  const auto events = [&](const std::string& text, const std::string& options) {
    const ProgramRun result = run(
        "watch " + write("s.csv", text) +
        " --separation sphere:100 --acceleration 1 --position-error 2 --velocity-error 0.5 --look-ahead 0 "
        "--distinct-ids --text --quiet " +
        options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  };
  EXPECT_EQ(events(stream(""), "--rest 0.3"), "0  within     a and b: sphere:100, now 30\n");
  // What ended while they were at rest is over when one of them moves.
  std::string swings = head + "a,0,0,0,0,0\nb,0,80,0,0.6,0\n";
  for (int time = 10; time <= 600; time += 10)
    swings +=
        fmt::format("a,{0},0,0,0,0\nb,{0},{1},0,0.2,0\n", time, time < 200 || time / 100 == 4 ? 85 : 105);
  const std::string begin = "0  within     a and b: sphere:100, now 80\n";
  EXPECT_EQ(events(swings, "--rest 0.3"), begin);
  EXPECT_EQ(events(swings + "a,610,0,0,0,0\nb,610,130,0,3,0\n", "--rest 0.3"),
            begin + "610  over       a and b: sphere:100, now 130\n");
  EXPECT_EQ(events(swings + "a,610,0,0,0,0\nb,610,80,0,-3,0\n", "--rest 0.3"), begin) << "it was told before";
}

TEST_F(Harbour, TellsOfTwoAtRestThatMightHaveBeenOneBody) {
  std::string text = "id,time,x,y,vx,vy\n";
  for (int time = 0; time <= 60; time += 10) {
    text += fmt::format("a,{},0,0,0,0\n", time);
    if (time >= 20) text += fmt::format("b,{},2,0,0,0\n", time + 5);
  }
  const ProgramRun result = run("watch " + write("s.csv", text) +
                                " --separation sphere:100 --acceleration 0.1 --position-error 2 "
                                "--velocity-error 0.1 --look-ahead 0 --rest 0.3 --text --quiet");
  EXPECT_EQ(result.out, "30  within     a and b: sphere:100, now 2 (0 to 7.75)\n") << result.err;
}

TEST_F(Harbour, RefusesAWrongSpeed) {
  write("s.csv", "id,time,x,y\na,0,0,0\n");
  for (const char* wrong : {"-1", "3m", "x"})
    expect_wrong_input("watch " + path("s.csv") +
                           " --separation sphere:5 --largest-speed 1 --position-error 1 " + "--rest=" + wrong,
                       {"--rest"});
}

}  // namespace
}  // namespace kinesphere::program::rest_test
