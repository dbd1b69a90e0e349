// Which reports of tracks can be used, and what is remembered of them.
#include "watch/tracks/watched_tracks.hpp"

#include <gtest/gtest.h>

#include "program/support.hpp"
#include "program/watch/stages.hpp"
#include "support/read_back.hpp"

namespace kinesphere::program::watched_tracks_test {
namespace {

/// Tracks behind a clock that all reports pass.
class Tracks : private ReportClock::Next {
 public:
  explicit Tracks(const WatchSettings& from)
      : settings(from),
        clock(settings, counts, *this),
        tracks(settings, counts, clock, [this](const std::string& reason) { refused = reason; }) {
    clock.machine_time_is(time_of(100.0));
  }

  /// Returns true if the report can be used; then it is remembered.
  bool take(const SourceReport& report, bool has_room = true) {
    WatchedTracks::Arrival arrival{.report = report};
    if (!tracks.recognise(arrival)) return false;
    if (tracks.names().size() == 0) tracks.begin_map(report);
    if (!tracks.place(arrival, has_room)) return false;
    got_under_way = tracks.remember(arrival);
    return true;
  }
  const NamedTrack& track(std::string_view id) const { return *tracks.names().find(track_id_of(id)); }

  const WatchSettings settings;
  WatchCounts counts;
  ReportClock clock;
  WatchedTracks tracks;
  std::string refused;
  bool got_under_way = false;

 private:
  void go_on() override {}
  void deliver(const SourceReport&) override {}
  void refuse(const std::string&) override {}
  bool has_several_tracks() const override { return false; }
};

TEST(WatchedTracks, CountsWhatCannotBeUsed) {
  Tracks watch(plane_settings());
  EXPECT_TRUE(watch.take(report_at("a", 100, 0, 1)));
  EXPECT_FALSE(watch.take(report_at("a", 100, 0, 1)));
  EXPECT_EQ(watch.counts.repeated, 1u);
  EXPECT_FALSE(watch.take(report_at("b", 100, 0, 1), false));
  EXPECT_EQ(watch.counts.crowded, 1u);
  EXPECT_TRUE(watch.take(report_at("a", 101, 1, 1), false)) << "it is there already";
  SourceReport geographic = report_at("a", 102, 2, 1);
  geographic.geographic = true;
  EXPECT_FALSE(watch.take(geographic));
  EXPECT_NE(watch.refused.find("x and y"), std::string::npos) << watch.refused;
}

TEST(WatchedTracks, NeedsAVelocityOrALargestSpeed) {
  WatchSettings settings = plane_settings();
  SourceReport report = report_at("a", 100, 0, 1);
  report.velocity.reset();
  EXPECT_TRUE(Tracks(settings).take(report));
  settings.classes = TrackClasses({.acceleration = ErrorBound(2.0)});
  Tracks watch(settings);
  EXPECT_FALSE(watch.take(report));
  watch.tracks.refuse_without_velocity(false);
  EXPECT_EQ(watch.counts.no_velocity, 1u);
  EXPECT_NE(error_of([&] { watch.tracks.refuse_without_velocity(true); }).find("--largest-speed"),
            std::string::npos);
}

TEST(WatchedTracks, RemembersTheLatestReport) {
  Tracks watch(plane_settings());
  SourceReport report = report_at("a", 100, 5, 1);
  report.name = " ANNA ";
  ASSERT_TRUE(watch.take(report));
  ASSERT_TRUE(watch.take(report_at("a", 99, 4, 1))) << "a late one";
  EXPECT_EQ(watch.track("a").name, "ANNA");
  EXPECT_EQ(watch.track("a").position.x, 5.0);
  EXPECT_EQ(watch.counts.with_velocity, 2u);
}

/// A class that a report changes counts from its time on.
TEST(WatchedTracks, AnOldReportDoesNotChangeTheClass) {
  WatchSettings settings = plane_settings();
  const std::size_t slow = settings.classes.add({.name = "slow", .limits = {ErrorBound(1), ErrorBound(2)}});
  Tracks watch(settings);
  ASSERT_TRUE(watch.take(report_at("a", 98, 0, 1)));
  SourceReport report = report_at("a", 100, 2, 1);
  report.ruled_class = slow;
  ASSERT_TRUE(watch.take(report));
  EXPECT_EQ(watch.track("a").declared.motion_class, slow);
  EXPECT_FALSE(watch.take(report_at("a", 99, 1, 1)));
  EXPECT_EQ(watch.counts.superseded, 1u);
}

TEST(WatchedTracks, GetsUnderWayFromRest) {
  WatchSettings settings = plane_settings();
  settings.rest_speed = 0.5;
  Tracks watch(settings);
  ASSERT_TRUE(watch.take(report_at("a", 100, 0, 0)));
  ASSERT_TRUE(watch.take(report_at("b", 100, 9, 0)));
  EXPECT_TRUE(watch.tracks.are_at_rest(track_id_of("a"), track_id_of("b")));
  ASSERT_TRUE(watch.take(report_at("b", 101, 9, 3)));
  EXPECT_TRUE(watch.got_under_way);
  EXPECT_FALSE(watch.tracks.are_at_rest(track_id_of("a"), track_id_of("b")));
}

TEST(WatchedTracks, GoOnFromASnapshot) {
  Tracks watch(plane_settings()), later(plane_settings());
  SourceReport report = report_at("a", 100, 5, 1);
  report.name = "ANNA";
  ASSERT_TRUE(watch.take(report));
  ASSERT_TRUE(watch.take(report_at("b", 100, 7, 1)));
  ASSERT_TRUE(read_back(watch.tracks, later.tracks));
  EXPECT_EQ(later.track("a").name, "ANNA");
  EXPECT_EQ(later.track("a").declared.position_by, "test");
  EXPECT_FALSE(later.take(report_at("b", 100, 7, 1))) << "it has come before";
  EXPECT_EQ(later.counts.repeated, 1u);
}

}  // namespace
}  // namespace kinesphere::program::watched_tracks_test
