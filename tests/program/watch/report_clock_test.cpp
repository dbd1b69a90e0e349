// Which reports the clock of a watch lets pass, and when.
#include "watch/clock/report_clock.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "program/watch/stages.hpp"
#include "support/read_back.hpp"

namespace kinesphere::program::report_clock_test {
namespace {

/// A clock, and what passes it: "a@100".
class Clock : private ReportClock::Next {
 public:
  explicit Clock(const WatchSettings& from = plane_settings())
      : settings(from), clock(settings, counts, *this) {}

  Clock& take(std::string_view id, double time) {
    clock.take(report_at(id, time, 0.0, 1.0));
    return *this;
  }

  const WatchSettings settings;
  WatchCounts counts;
  ReportClock clock;
  std::string passed, refused;
  int moved = 0;

 private:
  void go_on() override { ++moved; }
  void deliver(const SourceReport& report) override {
    passed += fmt::format("{}@{} ", report.id, seconds_between({}, report.stamp));
  }
  void refuse(const std::string& reason) override { refused = reason; }
  bool has_several_tracks() const override { return passed.find("b@") != std::string::npos; }
};

TEST(ReportClock, HoldsTheFirstReportsUntilTheyConfirmEachOther) {
  Clock watch;
  watch.take("a", 100).take("b", 101);
  EXPECT_EQ(watch.passed, "");
  EXPECT_FALSE(watch.clock.has_begun());
  watch.take("a", 102);
  EXPECT_EQ(watch.passed, "a@100 b@101 a@102 ");
  EXPECT_EQ(watch.clock.first(), 100.0);
  EXPECT_EQ(watch.clock.now(), 102.0);
  EXPECT_EQ(watch.clock.age_of(time_of(99)), 3.0);
}

TEST(ReportClock, BeginsWithoutAWrongClock) {
  Clock watch;
  watch.take("a", 100).take("c", 5000).take("b", 101).take("a", 102);
  EXPECT_EQ(watch.passed, "a@100 b@101 a@102 ");
  EXPECT_EQ(watch.counts.ahead, 1u);
}

TEST(ReportClock, PassesAShortStreamAtItsEnd) {
  Clock watch;
  watch.take("a", 100).take("a", 101);
  watch.clock.finish();
  EXPECT_EQ(watch.passed, "a@100 a@101 ");
}

TEST(ReportClock, LeavesOutAWrongClockAndWhatIsTooOld) {
  Clock watch;
  watch.take("a", 100).take("b", 101).take("a", 102);
  watch.passed.clear();
  watch.take("c", 5000).take("a", 103).take("b", 60).take("b", 80);
  EXPECT_EQ(watch.passed, "a@103 b@80 ") << "--forget is 30 s";
  EXPECT_EQ(watch.counts.ahead, 1u);
  EXPECT_EQ(watch.counts.stale, 1u);
  EXPECT_EQ(watch.clock.now(), 103.0) << "it never goes back";
}

TEST(ReportClock, GoesOnWithALeapThatOthersConfirm) {
  Clock watch;
  watch.take("a", 100).take("b", 101).take("a", 102);
  watch.passed.clear();
  watch.take("a", 1000).take("b", 1001);
  EXPECT_EQ(watch.passed, "");
  watch.take("a", 1002);
  EXPECT_EQ(watch.passed, "a@1000 b@1001 a@1002 ");
  EXPECT_EQ(watch.counts.ahead, 0u);
}

TEST(ReportClock, GoesByArrivalsWhereTheStreamHasThem) {
  Clock watch;
  watch.clock.time_is(time_of(100), TimeKind::number);
  watch.take("a", 100);
  EXPECT_NE(watch.refused.find("expected a time of arrival of a"), std::string::npos) << watch.refused;
  EXPECT_FALSE(watch.clock.goes_by_stamps());
  WatchSettings settings = plane_settings();
  settings.clock = WatchSettings::Clock::stamps;
  Clock other(settings);
  other.clock.time_is(time_of(100), TimeKind::number);
  other.take("a", 7).take("b", 8).take("a", 9);
  EXPECT_EQ(other.passed, "a@7 b@8 a@9 ");
}

TEST(ReportClock, TakesTheTimeOfTheMachine) {
  WatchSettings settings = plane_settings();
  settings.clock = WatchSettings::Clock::machine;
  Clock watch(settings);
  watch.clock.machine_time_is(time_of(100));
  watch.take("a", 99);
  EXPECT_EQ(watch.passed, "a@99 ") << "nothing has to confirm it";
  watch.take("a", 200);
  EXPECT_EQ(watch.counts.ahead, 1u);
}

/// A snapshot keeps what is held back.
TEST(ReportClock, GoesOnFromASnapshot) {
  Clock whole, first, second;
  for (Clock* const watch : {&whole, &first}) watch->take("a", 100).take("b", 101);
  ASSERT_TRUE(read_back(first.clock, second.clock));
  for (Clock* const watch : {&whole, &second}) watch->take("a", 102).take("c", 5000).take("b", 103);
  EXPECT_EQ(second.passed, whole.passed);
  EXPECT_EQ(second.clock.now(), whole.clock.now());
}

}  // namespace
}  // namespace kinesphere::program::report_clock_test
