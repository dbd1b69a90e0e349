// Which alerts a watch writes, with their shares: areas, tracks that are lost, what is held back.
#include "watch/policy/alert_desk.hpp"

#include <gtest/gtest.h>

#include "formats/fields/wrong_input.hpp"
#include "program/watch/stages.hpp"
#include "watch/watch_pipeline.hpp"

namespace kinesphere::program::alert_desk_test {
namespace {

/// Returns settings whose alerts are text: "12.0  within     a and b: ...".
WatchSettings text_settings() {
  WatchSettings settings = plane_settings();
  settings.text = true;
  return settings;
}

/// The stages of a watch, and the alerts that come out of them.
class Told {
 public:
  explicit Told(const WatchSettings& settings = text_settings())
      : pipeline(settings, [this](std::uint64_t share, std::string_view line) {
          alerts += line;
          shares.push_back(share);
        }) {}

  Told& take(std::string_view id, double time, double x, double speed, double y = 0.0) {
    pipeline.take(report_at(id, time, x, speed, y));
    pipeline.end_record();
    return *this;
  }
  /// Returns how often the alerts have a word.
  int count(std::string_view word) const {
    int count = 0;
    for (std::size_t at = alerts.find(word); at != std::string::npos; at = alerts.find(word, at + 1)) ++count;
    return count;
  }

  WatchPipeline pipeline;
  std::string alerts;
  std::vector<std::uint64_t> shares;
};

/// Two that meet at 10 s, and pass each other.
Told& meet(Told& watch, int from = 0, int to = 30) {
  for (int t = from; t < to; ++t) watch.take("a", t, 10 * t, 10).take("b", t, 200 - 10 * t, -10, 5);
  return watch;
}

TEST(AlertDesk, TellsAnEncounterInThreeAlerts) {
  Told watch;
  meet(watch);
  EXPECT_EQ(watch.count("predicted  a and b"), 1) << watch.alerts;
  EXPECT_EQ(watch.count("within     a and b"), 1) << watch.alerts;
  EXPECT_EQ(watch.count("over       a and b"), 1) << watch.alerts;
  EXPECT_EQ(watch.pipeline.view().counts.alerts, 3u);
  EXPECT_EQ(watch.shares, (std::vector<std::uint64_t>{0, 0, 0}));
}

TEST(AlertDesk, TellsOnlyOfItsShare) {
  const TrackId lower = std::min(track_id_of("a"), track_id_of("b"));
  for (std::uint64_t first = 0; first < 4; ++first) {
    WatchSettings settings = text_settings();
    settings.share = {.of = 4, .first = first, .count = 1};
    Told watch(settings);
    meet(watch);
    EXPECT_EQ(watch.shares.size(), lower % 4 == first ? 3u : 0u);
    for (const std::uint64_t share : watch.shares) EXPECT_EQ(share, first);
  }
}

/// Several watches share the alerts about single tracks, too.
TEST(AlertDesk, TellsOfEachTrackInOneShare) {
  int stale = 0;
  for (std::uint64_t first = 0; first < 4; ++first) {
    WatchSettings settings = text_settings();
    settings.kinds.tracks = true;
    settings.share = {.of = 4, .first = first, .count = 1};
    Told watch(settings);
    meet(watch, 0, 5);
    for (int t = 5; t < 20; ++t) watch.take("far", t, 5000 + t, 1);
    stale += watch.count("stale          a");
  }
  EXPECT_EQ(stale, 1);
}

TEST(AlertDesk, TellsOfAnAreaFromWhenATrackEntersIt) {
  WatchSettings settings = text_settings();
  settings.areas = {{.first = 100.0, .second = 0.0, .radius = 30.0}};
  Told other(settings);
  meet(other, 0, 7);
  EXPECT_EQ(other.alerts, "");
  EXPECT_GT(other.pipeline.view().counts.fates[static_cast<std::size_t>(AlertFate::elsewhere)], 0u);
  meet(other, 7, 12);
  EXPECT_EQ(other.count("a and b"), 2) << other.alerts;
}

TEST(AlertDesk, TellsThatATrackIsLostInAnEncounter) {
  Told watch;
  meet(watch, 0, 6);
  for (int t = 6; t < 60; ++t) watch.take("a", t, 10 * t, 10);
  EXPECT_EQ(watch.count("lost       a and b: b is stale; closest "), 1) << watch.alerts;
  EXPECT_EQ(watch.count("lost       a and b: b was dropped"), 1) << watch.alerts;
  EXPECT_EQ(watch.pipeline.view().counts.lost, 2u);
  WatchSettings settings = text_settings();
  settings.kinds.lost = false;
  Told quiet(settings);
  meet(quiet, 0, 6);
  for (int t = 6; t < 60; ++t) quiet.take("a", t, 10 * t, 10);
  EXPECT_EQ(quiet.count("lost"), 0) << quiet.alerts;
}

/// An encounter goes on under another id, which is told.
TEST(AlertDesk, TellsOfAHandoverInAnEncounter) {
  Told watch;
  meet(watch, 0, 6);
  for (int t = 6; t < 14; ++t) watch.take("a", t, 10 * t, 10).take("c", t, 200 - 10 * t, -10, 5);
  EXPECT_EQ(watch.count("lost       a and b: b goes on as c"), 1) << watch.alerts;
  EXPECT_EQ(watch.count("dropped"), 0) << watch.alerts;
}

TEST(AlertDesk, HoldsBackWhatMayBeOneBody) {
  Told watch;
  for (int t = 0; t < 8; ++t)
    watch.take("far", t, 5000 + t, 1).take("a", t, 10 * t, 10).take("b", t, 10 * t, 10);
  EXPECT_EQ(watch.count("a and b: sphere"), 0) << watch.alerts;
  EXPECT_EQ(watch.count("one body   a and b"), 1) << watch.alerts;
  EXPECT_GT(watch.pipeline.view().counts.fates[static_cast<std::size_t>(AlertFate::same_body)], 0u);
  // They part: now it is told that they are near.
  for (int t = 8; t < 12; ++t) watch.take("a", t, 80 + 2 * (t - 8), 2).take("b", t, 80 + 15 * (t - 8), 15);
  EXPECT_GE(watch.count("a and b: sphere"), 1) << watch.alerts;
}

TEST(AlertDesk, TwoAtRestAreToldOnce) {
  WatchSettings settings = text_settings();
  settings.rest_speed = 0.5;
  Told watch(settings);
  for (int t = 0; t < 40; ++t) watch.take("a", t, 0, 0).take("b", t, 20 + 0.1 * (t % 2), 0);
  EXPECT_EQ(watch.count("a and b"), 1) << watch.alerts;
}

TEST(AlertDesk, SaysHowManyWereTooMany) {
  WatchSettings settings = text_settings();
  settings.most_alerts = 1;
  settings.has_distinct_ids = true;
  Told watch(settings);
  for (int t = 0; t < 3; ++t)
    for (int k = 0; k < 5; ++k) watch.take(std::string(1, static_cast<char>('a' + k)), t, 10 * t + k, 10);
  watch.pipeline.finish();
  EXPECT_GE(watch.count("held back"), 1) << watch.alerts;
  const WatchCounts& counts = watch.pipeline.view().counts;
  EXPECT_GT(counts.fates[static_cast<std::size_t>(AlertFate::too_many)], 0u);
}

/// A snapshot may be sound, and have encounters of tracks that it does not have.
TEST(AlertDesk, RefusesEncountersOfNobody) {
  const WatchSettings settings = text_settings();
  AlertPolicy policy({}, 10);
  MonitorEvent event{.kind = MonitorEventKind::predicted, .first = 1, .second = 2};
  policy.take(event, true);
  Told watch;
  meet(watch, 0, 3);
  const WatchView& view = watch.pipeline.view();
  WatchCounts counts;
  const auto alerts = make_text_alerts(view, [](std::uint64_t, std::string_view) {});
  AlertDesk desk(settings, counts, view.tracks, view.pairs, *alerts);
  ByteWriter writer;
  writer(policy);
  ByteReader reader(writer.bytes());
  EXPECT_THROW(reader(desk), WrongInput);
}

}  // namespace
}  // namespace kinesphere::program::alert_desk_test
