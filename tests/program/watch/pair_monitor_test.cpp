// What the monitor of a watch tells, and when: events, handovers, crowds that stand, limits.
#include "watch/monitor/pair_monitor.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "program/watch/stages.hpp"
#include "support/read_back.hpp"

namespace kinesphere::program::pair_monitor_test {
namespace {

/// A monitor with the stages before it, and what it tells: "predicted ", "dropped:handover " and so on.
class Pairs : private ReportClock::Next, private PairMonitor::Next {
 public:
  explicit Pairs(const WatchSettings& from = plane_settings())
      : settings(from),
        clock(settings, counts, *this),
        tracks(settings, counts, clock, [](const std::string&) {}),
        pairs(settings, counts, tracks, *this) {}

  Pairs& take(std::string_view id, double time, double x, double speed, double y = 0.0) {
    const SourceReport report = report_at(id, time, x, speed, y);
    clock.machine_time_is(time_of(time));
    WatchedTracks::Arrival arrival{.report = report};
    if (!tracks.recognise(arrival)) return *this;
    if (!pairs.monitor()) {
      tracks.begin_map(report);
      pairs.begin(clock.now());
    }
    const bool is_first = arrival.known == nullptr;
    if (!tracks.place(arrival, pairs.has_room())) return *this;
    std::string refusal;
    if (pairs.take(arrival, refusal) != PairMonitor::Taken::alone) return *this;
    tracks.remember(arrival);
    pairs.compare(arrival, is_first);
    pairs.release_due();
    pairs.settle();
    return *this;
  }

  const WatchSettings settings;
  WatchCounts counts;
  ReportClock clock;
  WatchedTracks tracks;
  PairMonitor pairs;
  std::string told;
  std::vector<TrackId> forgotten;

 private:
  void go_on() override {
    if (pairs.monitor()) pairs.go_on(clock.now());
  }
  void deliver(const SourceReport&) override {}
  void refuse(const std::string&) override {}
  bool has_several_tracks() const override { return false; }
  void tell(const MonitorEvent& event, const LeftFor& left_for) override {
    const bool is_undecided = event.kind == MonitorEventKind::verdict && event.verdict != Verdict::within;
    if (is_undecided) return;
    told += name_of(event.kind);
    if (event.kind == MonitorEventKind::dropped) told += fmt::format(":{}", left_for.reason);
    told += ' ';
  }
  void forget(TrackId track) override { forgotten.push_back(track); }
  void release(TrackId) override { told += "release "; }
  void hand_over(TrackId, const LeftFor& left_for) override { told += "to:" + left_for.later + ' '; }
  void tell_one_body(TrackId, TrackId) override { told += "one_body "; }
  void tell_group(const std::string&, std::size_t members) override {
    told += fmt::format("group:{} ", members);
  }
};

TEST(PairMonitor, PassesEventsOn) {
  Pairs watch;
  watch.take("a", 0, 0, 5).take("b", 0, 60, -5).take("a", 1, 5, 5).take("b", 1, 55, -5);
  EXPECT_EQ(watch.told, "predicted ");
  watch.take("a", 5, 25, 5).take("b", 5, 35, -5);
  EXPECT_NE(watch.told.find("verdict "), std::string::npos) << watch.told;
}

TEST(PairMonitor, ForgetsATrackThatIsSilent) {
  Pairs watch;
  watch.take("a", 0, 0, 1).take("b", 0, 1000, 1).take("b", 15, 1015, 1).take("b", 31, 1031, 1);
  EXPECT_EQ(watch.told, "stale stale resumed stale dropped:silence resumed ");
  EXPECT_EQ(watch.forgotten, std::vector<TrackId>{track_id_of("a")});
  EXPECT_EQ(watch.tracks.names().size(), 1u);
}

/// A track that begins where another ends goes on as it.
TEST(PairMonitor, HandsOver) {
  Pairs watch;
  for (int t = 0; t < 6; ++t) watch.take("a", t, t, 1).take("far", t, 1000 + t, 1);
  for (int t = 6; t < 12; ++t) watch.take("b", t, t, 1).take("far", t, 1000 + t, 1);
  EXPECT_NE(watch.told.find("to:b dropped:handover "), std::string::npos) << watch.told;
  EXPECT_EQ(watch.counts.handovers, 1u);
  WatchSettings distinct = plane_settings();
  distinct.has_distinct_ids = true;
  Pairs other(distinct);
  for (int t = 0; t < 6; ++t) other.take("a", t, t, 1);
  for (int t = 6; t < 12; ++t) other.take("b", t, t, 1);
  EXPECT_EQ(other.told.find("to:"), std::string::npos) << other.told;
}

TEST(PairMonitor, TellsTwoIdsOfOneBodyOnce) {
  Pairs watch;
  for (int t = 0; t < 20; ++t) watch.take("a", t, 10 * t, 10).take("a~", t, 10 * t, 10);
  EXPECT_EQ(watch.told.find("one_body "), watch.told.rfind("one_body ")) << watch.told;
  EXPECT_NE(watch.told.find("one_body "), std::string::npos);
  EXPECT_TRUE(watch.pairs.may_be_one(track_id_of("a"), track_id_of("a~")));
}

TEST(PairMonitor, ACrowdIsOneTrack) {
  Pairs watch;
  for (int t = 0; t < 3; ++t)
    for (int k = 0; k < 25; ++k) watch.take("c" + std::to_string(k), t, 2.0 + 0.01 * k, 0.0, 2.0);
  EXPECT_EQ(watch.told.find("group:20 "), watch.told.rfind("group:")) << watch.told;
  EXPECT_EQ(watch.pairs.monitor()->size(), 1u);
  EXPECT_GT(watch.counts.grouped, 10u);
}

TEST(PairMonitor, KeepsTheLimitsOfTracksAndPairs) {
  WatchSettings settings = plane_settings();
  settings.most_tracks = 3;
  Pairs few(settings);
  for (int k = 0; k < 5; ++k) few.take("t" + std::to_string(k), 0, 1000.0 * k, 1);
  EXPECT_EQ(few.pairs.monitor()->size(), 3u);
  EXPECT_EQ(few.counts.crowded, 2u);
  settings = plane_settings();
  settings.most_pairs = 10;
  settings.has_distinct_ids = true;
  Pairs near(settings);
  for (int t = 0; t < 3; ++t)
    for (int k = 0; k < 8; ++k) near.take("t" + std::to_string(k), t, 45.0 * k + 5 * t, 5, 45.0 * k);
  EXPECT_LE(near.pairs.monitor()->open_pair_count(), 10u);
}

TEST(PairMonitor, GoesOnFromASnapshot) {
  Pairs whole, first, later;
  const auto take = [](Pairs& watch, int from, int to) {
    for (int t = from; t < to; ++t)
      watch.take(t < 20 ? "a" : "b", t, t, 1).take("c", t, 100 - t, -1).take("d", t, t, 1, 1000.0);
  };
  take(whole, 0, 40);
  take(first, 0, 22);
  ASSERT_TRUE(read_back(first.clock, later.clock));
  ASSERT_TRUE(read_back(first.tracks, later.tracks));
  ASSERT_TRUE(read_back(first.pairs, later.pairs));
  take(later, 22, 40);
  EXPECT_EQ(first.told + later.told, whole.told);
  EXPECT_NE(whole.told.find("to:b "), std::string::npos) << whole.told;
}

/// A crowd that was silent for long is no group any more, also where a snapshot was made in between.
TEST(PairMonitor, KnowsTheGroupsOfASnapshot) {
  Pairs first, later;
  for (int t = 0; t < 3; ++t) {
    first.take("far", t, 5000 + t, 1);
    for (int k = 0; k < 25; ++k) first.take("c" + std::to_string(k), t, 2.0 + 0.01 * k, 0.0, 2.0);
  }
  ASSERT_TRUE(read_back(first.clock, later.clock));
  ASSERT_TRUE(read_back(first.tracks, later.tracks));
  ASSERT_TRUE(read_back(first.pairs, later.pairs));
  for (int t = 3; t < 36; ++t) later.take("far", t, 5000 + t, 1);
  later.take("c0", 36, 2.0, 0.0, 2.0);
  EXPECT_TRUE(later.pairs.monitor()->contains(track_id_of("c0"))) << later.told;
}

}  // namespace
}  // namespace kinesphere::program::pair_monitor_test
