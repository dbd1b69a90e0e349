// Which events of a monitor `kinesphere watch` writes: at most three for each encounter, areas, a cap, tracks
// that are lost.
#include "watch/policy/alert_policy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "kinesphere/random.hpp"
#include "program/support.hpp"
#include "support/read_back.hpp"

namespace kinesphere::program::alert_policy_test {
namespace {

using Json = nlohmann::json;
using Kind = MonitorEventKind;

constexpr std::uint64_t any_number = std::numeric_limits<std::uint64_t>::max();

MonitorEvent verdict(double time, Verdict before, Verdict after) {
  return {.time = time, .kind = Kind::verdict, .first = 1, .second = 2, .verdict = after, .before = before};
}
MonitorEvent prediction(double time, bool begins) {
  const Kind kind = begins ? Kind::predicted : Kind::prediction_ended;
  return {.time = time, .kind = kind, .first = 1, .second = 2, .since = time};
}

/// Events of one pair as a monitor emits them, whatever the order.
std::vector<MonitorEvent> random_events(Random& random, int count) {
  std::vector<MonitorEvent> events;
  Verdict now = Verdict::apart;
  bool predicted = false;
  for (int k = 0; k < count; ++k) {
    if (random.uniform() < 0.3) {
      events.push_back(prediction(k, predicted = !predicted));
      continue;
    }
    const auto next = static_cast<Verdict>((static_cast<int>(now) + (random.uniform() < 0.5 ? 1 : 2)) % 3);
    events.push_back(verdict(k, now, next));
    now = next;
  }
  return events;
}

TEST(AlertPolicy, AnEncounterHasThreeAlertsAtMostAndNoneIsMissed) {
  constexpr std::uint64_t seed = 11;
  Random random(seed);
  for (int run = 0; run < 200; ++run) {
    SCOPED_TRACE(fmt::format("seed {}, run {}", seed, run));
    AlertPolicy policy({}, any_number);
    bool predicted = false, within = false;
    int written = 0;
    for (MonitorEvent event : random_events(random, 60)) {
      const bool is_verdict = event.kind == Kind::verdict;
      const bool begins = is_verdict ? event.verdict == Verdict::within : event.kind == Kind::predicted;
      const bool was_on = predicted || within;
      if (!is_verdict) predicted = begins;
      if (is_verdict && event.verdict != Verdict::undecided) within = begins;
      const bool is_written = policy.take(event, true) == AlertFate::written;
      if (!was_on) written = 0;
      written += is_written ? 1 : 0;
      ASSERT_LE(written, 3);
      if (begins && !was_on) {
        ASSERT_TRUE(is_written) << "the begin of an encounter";
      }
      const bool ends = was_on && !predicted && !within;
      if (ends) {
        ASSERT_TRUE(is_written) << "the end of an encounter";
      }
    }
  }
}

TEST(AlertPolicy, TellsTheEndOfWhatItHasTold) {
  AlertPolicy policy({}, any_number);
  const auto fate = [&policy](MonitorEvent event) { return policy.take(event, true); };
  EXPECT_EQ(fate(verdict(0, Verdict::apart, Verdict::undecided)), AlertFate::undecided);
  EXPECT_EQ(fate(prediction(1, true)), AlertFate::written);
  EXPECT_EQ(fate(verdict(2, Verdict::undecided, Verdict::within)), AlertFate::written);
  EXPECT_EQ(fate(verdict(3, Verdict::within, Verdict::undecided)), AlertFate::encounter);
  EXPECT_EQ(fate(verdict(4, Verdict::undecided, Verdict::within)), AlertFate::encounter);
  EXPECT_EQ(fate(prediction(5, false)), AlertFate::encounter);
  EXPECT_EQ(fate(verdict(6, Verdict::within, Verdict::undecided)), AlertFate::encounter);
  MonitorEvent end = verdict(7, Verdict::undecided, Verdict::apart);
  EXPECT_EQ(policy.take(end, true), AlertFate::written);
  EXPECT_EQ(end.before, Verdict::within) << "as alerts have told";
  EXPECT_EQ(end.since, 2.0);
  EXPECT_TRUE(policy.encounters_of(1).empty());
}

TEST(AlertPolicy, CountsWhatItRefusesBySecond) {
  AlertPolicy policy({}, 2);
  EXPECT_TRUE(policy.has_room(7.2));
  EXPECT_TRUE(policy.has_room(7.2));
  EXPECT_FALSE(policy.has_room(7.5));
  EXPECT_FALSE(policy.has_room(7.9));
  EXPECT_FALSE(policy.refused_before(7.9));
  EXPECT_TRUE(policy.has_room(9.5));
  const auto refused = policy.refused_before(9.5);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->since, 7.0);
  EXPECT_EQ(refused->alerts, 2u);
  EXPECT_FALSE(policy.refused_before(100.0)) << "once";
}

std::vector<std::byte> bytes_of(const AlertPolicy& policy) {
  ByteWriter writer;
  writer(policy);
  return writer.take();
}

TEST(AlertPolicy, ASnapshotGoesOnAlike) {
  constexpr std::uint64_t seed = 12;
  Random random(seed);
  for (int run = 0; run < 50; ++run) {
    SCOPED_TRACE(fmt::format("seed {}, run {}", seed, run));
    AlertPolicy whole({}, 1), first({}, 1), second({}, 1);
    const std::vector<MonitorEvent> events = random_events(random, 40);
    for (std::size_t k = 0; k < events.size(); ++k) {
      MonitorEvent one = events[k], other = one;
      if (k == 20) {
        ASSERT_TRUE(read_back(first, second));
      }
      const bool is_in_area = k % 3 > 0;
      ASSERT_EQ(whole.take(one, is_in_area), (k < 20 ? first : second).take(other, is_in_area));
    }
    EXPECT_EQ(bytes_of(whole), bytes_of(second));
  }
}

/// Reports of tracks that go straight on, one each second.
class WatchPolicy : public ProgramTest {
 protected:
  struct Path {
    const char* id;
    double x, y, vx, vy;
    int last = 60;  ///< its latest report
  };
  static std::string reports(const std::vector<Path>& paths, int seconds = 60) {
    std::string text = "id,time,x,y,vx,vy\n";
    for (int t = 0; t <= seconds; ++t)
      for (const Path& path : paths)
        if (t <= path.last)
          text += fmt::format("{},{},{},{},{},{}\n", path.id, t, path.x + path.vx * t, path.y + path.vy * t,
                              path.vx, path.vy);
    return text;
  }
  std::vector<Json> alerts(const std::string& stream, const std::string& options) {
    const ProgramRun result = run("watch " + write("s.csv", stream) +
                                  " --acceleration 0.5 --largest-speed 40 --position-error 1 "
                                  "--velocity-error 0.1 --unit m --quiet " +
                                  options + " --summary '" + path("summary.json") + "'");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    summary_ = Json::parse(read_text(path("summary.json")));
    std::filesystem::remove(path("summary.json"));
    std::vector<Json> lines;
    std::istringstream text(result.out);
    for (std::string line; std::getline(text, line);) lines.push_back(Json::parse(line));
    return lines;
  }
  static std::string events(const std::vector<Json>& lines) {
    std::string text;
    for (const Json& line : lines)
      text += (line["event"] == "verdict" ? line["verdict"] : line["event"]).get<std::string>() + " ";
    return text;
  }
  Json summary_;
};

TEST_F(WatchPolicy, ByDefaultAnEncounterIsToldAheadAndOnce) {
  const std::string stream = reports({{"a", -300, 0, 10, 0}, {"b", 300, 5, -10, 0}, {"c", 0, 900, 0, 1}});
  const auto lines = alerts(stream, "--separation sphere:50 --hold 5");
  EXPECT_EQ(events(lines), "predicted within prediction_ended ") << Json(lines).dump(1);
  // Closest at 30, ten seconds of look-ahead.
  EXPECT_NEAR(lines[0]["time"].get<double>(), 20.0, 1.0);
  EXPECT_EQ(lines[0]["first"], "a");
  EXPECT_EQ(lines[0]["second"], "b");
  EXPECT_GT(summary_["held_back_undecided"], 0);
  EXPECT_EQ(summary_["separations"][0]["within"], 1) << "counts are those of all verdicts";
  EXPECT_EQ(events(alerts(stream, "--separation sphere:50 --look-ahead 0")), "within apart ");
  EXPECT_EQ(events(alerts(stream, "--separation sphere:50:0")), "within apart ");
  const auto ahead = alerts(stream, "--separation sphere:50 --look-ahead 25s --only predicted --hold 5");
  EXPECT_NEAR(ahead.at(0)["time"].get<double>(), 5.0, 1.0);
  EXPECT_EQ(events(alerts(stream, "--separation sphere:50 --look-ahead 0 --only all")),
            "undecided within undecided apart ");
}

TEST_F(WatchPolicy, ATrackThatIsLostInAnEncounterIsTold) {
  const std::string stream =
      reports({{"a", -300, 0, 10, 0, 25}, {"b", 300, 5, -10, 0}, {"c", 0, 900, 0, 1, 25}});
  const auto lines = alerts(stream, "--separation sphere:50 --silence 3 --forget 10 --hold 30");
  ASSERT_EQ(events(lines), "predicted within lost lost ") << Json(lines).dump(1);
  EXPECT_EQ(lines[2]["track"], "a");
  EXPECT_EQ(lines[2]["reason"], "stale");
  EXPECT_EQ(lines[2]["second"], "b");
  EXPECT_TRUE(lines[2]["predicted"].get<bool>());
  EXPECT_NEAR(lines[2]["closest_time"].get<double>(), 30.0, 0.5);
  EXPECT_NEAR(lines[2]["closest_distance"].get<double>(), 5.0, 0.5);
  EXPECT_EQ(lines[3]["reason"], "dropped");
  EXPECT_EQ(lines[3]["closest_time"], lines[2]["closest_time"]);
  EXPECT_EQ(summary_["lost"], 2);
}

TEST_F(WatchPolicy, AnAreaTellsWhoIsInItAndWhoComesIn) {
  // Two pairs that stay together: one passes through the area, the other is elsewhere.
  const std::string stream = reports({{"a", -300, 0, 10, 0},
                                      {"b", -300, 20, 10, 0},  //
                                      {"c", -300, 900, 10, 0},
                                      {"d", -300, 920, 10, 0}});
  const auto lines = alerts(stream, "--separation sphere:50 --area 0,0,100");
  ASSERT_EQ(events(lines), "within ") << Json(lines).dump(1);
  EXPECT_EQ(lines[0]["first"], "a");
  EXPECT_NEAR(lines[0]["time"].get<double>(), 20.0, 1.0);
  EXPECT_LT(lines[0]["since"], 5.0) << "it began outside";
  EXPECT_GT(summary_["held_back_elsewhere"], 0);
  EXPECT_EQ(alerts(stream, "--separation sphere:50 --area 0,0,100 --area 0,910,5km").size(), 2u);
  for (const char* area : {"0,0", "0,0,-1", "a,b,3", "1,2,3kt"})
    expect_wrong_input("watch " + path("s.csv") +
                           " --separation sphere:5 --acceleration 1 --position-error 1 --velocity-error 1 "
                           "--area " +
                           area,
                       {"--area"});
}

TEST_F(WatchPolicy, ACapSaysWhatItHoldsBack) {
  std::vector<Path> paths;
  std::vector<std::string> ids;
  for (int k = 0; k < 15; ++k) ids.push_back(fmt::format("t{:02}", k));
  for (const std::string& id : ids)
    // So far from each other that no two may be one body.
    paths.push_back({id.c_str(), 3.0 * static_cast<double>(paths.size()), 0, 3, 0});
  const auto lines = alerts(reports(paths, 5), "--separation sphere:50 --most-alerts 10 --only within");
  ASSERT_EQ(lines.size(), 11u);
  EXPECT_EQ(lines[10]["event"], "held_back");
  EXPECT_EQ(lines[10]["alerts"], 15 * 14 / 2 - 10);
  EXPECT_EQ(lines[10]["since"], 0);
  EXPECT_EQ(summary_["held_back_as_too_many"], 95);
}

TEST_F(WatchPolicy, TextOfTheStreamAddsNoLinesToTextAlerts) {
  std::string stream;
  for (const char* track :
       {R"("id": "a\nb", "name": "\u001b[2JEvil\n00:00:00Z  within")", R"("id": "c\r\nd")"})
    stream += fmt::format("{{{}, \"stamp\": 1, \"position\": [0, 0, 0], \"velocity\": [0, 0, 0]}}\n", track);
  const ProgramRun result =
      run("watch " + write("s.jsonl", stream) +
          " --separation sphere:50 --acceleration 1 --position-error 1 --velocity-error 1 "
          "--look-ahead 0 --text --quiet");
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
  EXPECT_EQ(result.out.find_first_of("\x1b\r"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("Evil"), std::string::npos) << result.out;
}

TEST(AlertPolicy, KnowsTheEncountersOfEachTrack) {
  constexpr std::uint64_t seed = 13;
  Random random(seed);
  AlertPolicy policy({}, any_number);
  std::set<std::pair<TrackId, TrackId>> on;
  for (int k = 0; k < 3000; ++k) {
    MonitorEvent event = prediction(k, random.uniform() < 0.6);
    event.first = static_cast<TrackId>(random.uniform(0.0, 9.0));
    event.second = event.first + 1 + static_cast<TrackId>(random.uniform(0.0, 9.0));
    const std::pair pair{event.first, event.second};
    if (event.kind == Kind::predicted)
      on.insert(pair);
    else
      on.erase(pair);
    policy.take(event, true);
    const auto gone = static_cast<TrackId>(random.uniform(0.0, 500.0));
    policy.forget(gone);
    std::erase_if(on, [gone](const auto& each) { return each.first == gone || each.second == gone; });
    for (TrackId track = 0; track < 20; ++track)
      ASSERT_EQ(policy.encounters_of(track).size(),
                static_cast<std::size_t>(std::count_if(
                    on.begin(), on.end(),
                    [track](const auto& each) { return each.first == track || each.second == track; })))
          << "seed " << seed << ", event " << k << ", track " << track;
  }
}

/// A hangar: 60 tracks that stand at one place; another one comes near.
TEST_F(WatchPolicy, TracksThatStandAtOnePlaceAreAGroup) {
  std::vector<std::string> ids;
  for (int k = 0; k < 60; ++k) ids.push_back(fmt::format("t{:02}", k));
  std::vector<Path> paths;
  for (const std::string& id : ids) paths.push_back({id.c_str(), 3.0, 4.0, 0, 0});
  paths.push_back({"visitor", -300, 4, 10, 0});
  paths.push_back({"own", 3, 4, 0, 0});
  const auto lines = alerts(reports(paths), "--separation sphere:50 --hold 5 --only within,predicted");
  std::set<std::string> others;
  int groups = 0, with_members = 0;
  for (const Json& line : lines) {
    if (line["event"] == "group") {
      ++groups;
      EXPECT_EQ(line["tracks"], 20);
      continue;
    }
    if (line["first"] == "visitor" || line["second"] == "visitor")
      others.insert((line["first"] == "visitor" ? line["second"] : line["first"]).get<std::string>());
    else
      ++with_members;
  }
  EXPECT_EQ(groups, 1);
  // Pairs of the first nineteen.
  EXPECT_LE(with_members, 19 * 18 / 2);
  EXPECT_EQ(others.size(), 1u) << Json(others).dump();
  EXPECT_TRUE(others.begin()->starts_with("group at ")) << *others.begin();
  EXPECT_GT(summary_["grouped"], 1000);
  // The own track is in no group, and meets one.
  const auto own = alerts(reports(paths), "--separation sphere:50 --own own --only within");
  std::set<std::string> meets;
  for (const Json& line : own)
    if (line.contains("second")) meets.insert(line["first"].get<std::string>());
  EXPECT_TRUE(meets.contains(*others.begin())) << Json(meets).dump();
  EXPECT_LE(meets.size(), 22u);
}

}  // namespace
}  // namespace kinesphere::program::alert_policy_test
