// Answers and events of a monitor, case by case.
#include "kinesphere/monitor/monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace kinesphere::monitor_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns a definition with one class of this limit, and one separation of 10.
MonitorDefinition definition(double acceleration_limit = 2.0) {
  return {.classes = {{.acceleration_limit = acceleration_limit}},
          .separations = {{0, 0, {Separation::sphere(10.0)}}}};
}

Monitor made(const MonitorDefinition& definition) { return Monitor::create(definition).value(); }

TrackReport at(double stamp, const Vec3& position, const Vec3& velocity = {}) {
  return {.timestamp = stamp, .state = {position, velocity}};
}

/// Expects an error with a message that names the cause.
template <class T>
void expect_refused(const Result<T>& result, ErrorCode code, const std::string& culprit) {
  ASSERT_FALSE(result) << culprit;
  EXPECT_EQ(result.error().code, code) << result.error().message;
  EXPECT_NE(result.error().message.find(culprit), std::string::npos) << result.error().message;
}

std::vector<MonitorEvent> all(MonitorEventRange events) {
  std::vector<MonitorEvent> list;
  for (const MonitorEvent& event : events) list.push_back(event);
  return list;
}

template <class Object>
concept HasEvents = requires(Object&& object) {
  static_cast<Object&&>(object).events(1.0);
};
static_assert(HasEvents<Monitor&> && !HasEvents<Monitor>, "a temporary monitor ends before the loop begins");

TEST(Monitor, TellsWhenTwoMayMeetAndWhenTheyCertainlyHave) {
  Monitor monitor = made(definition(0.0));
  monitor.report(1, at(0.0, {0, 0, 0})).value();
  monitor.report(2, at(0.0, {30, 0, 0}, {-5, 0, 0})).value();
  const auto events = all(monitor.events(20.0));
  // Only the tolerance is uncertain, so there is hardly a time without a certain verdict.
  ASSERT_GE(events.size(), 2u);
  EXPECT_NEAR(events.front().time, 4.0, 2e-3);
  EXPECT_EQ(events.front().verdict, Verdict::within);
  EXPECT_NEAR(events.back().time, 8.0, 2e-3);
  EXPECT_EQ(events.back().verdict, Verdict::apart);
  EXPECT_EQ(events.back().before, Verdict::within);
  EXPECT_EQ(events.back().since, events.front().time);
  EXPECT_TRUE(monitor.open_pairs().empty());
  EXPECT_EQ(monitor.time(), 20.0);
}

TEST(Monitor, LosesCertaintyAsTimePassesWithoutReports) {
  Monitor monitor = made(definition(2.0));
  monitor.report(1, at(0.0, {0, 0, 0})).value();
  monitor.report(2, at(0.0, {26, 0, 0})).value();
  // Each track may have come 1/2 2 t^2 nearer: 26 - 2 t^2 = 10.
  const auto events = all(monitor.events(20.0));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NEAR(events[0].time, std::sqrt(8.0), 2e-3);
  EXPECT_LE(events[0].time, std::sqrt(8.0));
  EXPECT_EQ(events[0].verdict, Verdict::undecided);
  const PairAnswer answer = monitor.answer(1, 2).value();
  EXPECT_EQ(answer.verdict, Verdict::undecided);
  EXPECT_EQ(answer.since, events[0].time);
  EXPECT_EQ(answer.ask_by, 20.0);
  EXPECT_EQ(answer.lower, 0.0);
  EXPECT_NEAR(answer.upper, 26.0 + 800.0, 1e-6);
  EXPECT_NEAR(answer.closest_distance, 26.0, 1e-9);
  EXPECT_EQ(answer.likely_time, infinity);

  // A report of each decides it.
  monitor.report(1, at(20.0, {0, 0, 0})).value();
  EXPECT_TRUE(all(monitor.events(20.0)).empty());
  monitor.report(2, at(20.0, {26, 0, 0})).value();
  const auto after = all(monitor.events(20.0));
  ASSERT_EQ(after.size(), 1u);
  EXPECT_EQ(after[0].verdict, Verdict::apart);
  EXPECT_EQ(after[0].since, events[0].time);
}

TEST(Monitor, SaysWhoseReportIsNeededAndByWhen) {
  MonitorDefinition one = definition(2.0);
  one.window = 16.0;
  Monitor monitor = made(one);
  monitor.report(1, at(0.0, {0, 0, 0})).value();
  all(monitor.events(1.0));
  monitor.report(2, at(1.0, {26, 0, 0})).value();
  all(monitor.events(1.0));
  const auto needs = monitor.needed(16.0);
  ASSERT_EQ(needs.size(), 1u);
  EXPECT_EQ(needs[0].track, 1u);  // the older one
  EXPECT_EQ(needs[0].other, 2u);
  // 1/2 2 (t^2 + (t - 1)^2) = 16
  const double due = 0.5 * (1.0 + std::sqrt(31.0));
  EXPECT_NEAR(needs[0].by, due, 1e-6);
  EXPECT_NEAR(monitor.answer(1, 2)->until, due, 1e-6);
  EXPECT_TRUE(monitor.needed(2.0).empty());
  EXPECT_EQ(all(monitor.events(needs[0].by - 1e-9)).size(), 0u);
  EXPECT_EQ(all(monitor.events(needs[0].by + 1e-6)).size(), 1u);
  EXPECT_EQ(monitor.needed(16.0).front().by, monitor.time());
}

TEST(Monitor, CountsTheErrorsOfEachReportByItself) {
  Monitor monitor = made(definition(0.0));
  TrackReport rough = at(0.0, {0, 0, 0});
  rough.position_error = 5.0;
  monitor.report(1, rough).value();
  monitor.report(2, at(0.0, {14, 0, 0})).value();
  auto events = all(monitor.events(0.0));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].verdict, Verdict::undecided);
  EXPECT_NEAR(monitor.answer(1, 2)->lower, 9.0, 1e-9);
  EXPECT_NEAR(monitor.answer(1, 2)->upper, 19.0, 1e-9);
  monitor.report(1, at(0.5, {0.5, 0, 0})).value();
  events = all(monitor.events(0.5));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].verdict, Verdict::apart);
  // A less exact report does not spoil earlier certainty.
  rough.timestamp = 0.75;
  monitor.report(1, rough).value();
  EXPECT_TRUE(all(monitor.events(2.0)).empty());
}

TEST(Monitor, AReportEndsNoCertainty) {
  Monitor monitor = made(definition(2.0));
  monitor.report(1, at(0.0, {0, 0, 0})).value();
  monitor.report(2, at(0.0, {5, 0, 0})).value();
  all(monitor.events(1.4));
  // Within until 5 + 2 1/2 2 t^2 = 10. By itself this report, which soon implies more than the first one,
  // would leave the pair open.
  TrackReport rough = at(1.4, {0, 0, 0});
  rough.position_error = 5.0;
  rough.plan = TrackReport::Plan{.acceleration = {}, .acceleration_limit = 0.0};
  monitor.report(1, rough).value();
  const auto events = all(monitor.events(5.0));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].before, Verdict::within);
  EXPECT_NEAR(events[0].time, std::sqrt(2.5), 2e-3);
}

TEST(Monitor, TakesReportsFromThePastInAnyOrder) {
  // Without acceleration the older report implies as much as the newer one, and is more exact.
  Monitor monitor = made(definition(0.0));
  TrackReport rough = at(3.0, {3, 0, 0}, {1, 0, 0});
  rough.position_error = 4.0;
  all(monitor.events(5.0));
  monitor.report(1, rough).value();
  monitor.report(2, at(5.0, {18, 0, 0}, {1, 0, 0})).value();
  auto events = all(monitor.events(5.0));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].verdict, Verdict::undecided);
  monitor.report(1, at(1.0, {1, 0, 0}, {1, 0, 0})).value();
  EXPECT_EQ(monitor.counters().late, 1u);
  events = all(monitor.events(5.0));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].verdict, Verdict::apart);
  monitor.report(1, rough).value();
  EXPECT_EQ(monitor.counters().reports, 3u);
  EXPECT_EQ(monitor.counters().repeated, 1u);
}

TEST(Monitor, TakesReportsFromTheFutureForWhatTheySayOfThePresent) {
  MonitorDefinition from_zero = definition(2.0);
  from_zero.start_time = 0.0;
  Monitor monitor = made(from_zero);
  monitor.report(1, at(3.0, {0, 0, 0})).value();
  monitor.report(2, at(3.0, {40, 0, 0})).value();
  // At time 0 each may be 9 away from its place at time 3.
  EXPECT_NEAR(monitor.track(1)->places[0].radius.total(), 9.0, 1e-6);
  const PairAnswer answer = monitor.answer(1, 2).value();
  EXPECT_EQ(answer.verdict, Verdict::apart);
  EXPECT_NEAR(answer.lower, 22.0, 1e-6);
}

TEST(Monitor, BelievesBothOfTwoReportsThatContradictEachOther) {
  Monitor monitor = made(definition(2.0));
  monitor.report(1, at(0.0, {0, 0, 0})).value();
  monitor.report(2, at(0.0, {1000, 0, 0})).value();
  all(monitor.events(1.0));
  monitor.report(1, at(1.0, {995, 0, 0})).value();
  auto events = all(monitor.events(1.0));
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].kind, MonitorEventKind::verdict);
  EXPECT_EQ(events[0].verdict, Verdict::undecided);
  EXPECT_EQ(events[1].kind, MonitorEventKind::contradiction);
  EXPECT_EQ(events[1].first, 1u);
  EXPECT_NEAR(events[1].position_excess, 994.0, 1e-6);
  EXPECT_EQ(monitor.track(1)->places.size(), 2u);

  // The report was an outlier.
  monitor.report(1, at(2.0, {0, 0, 0})).value();
  events = all(monitor.events(2.0));
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].verdict, Verdict::apart);
  EXPECT_EQ(events[1].kind, MonitorEventKind::resolved);
  EXPECT_EQ(monitor.track(1)->places.size(), 1u);

  // The report was right.
  monitor.report(1, at(3.0, {995, 0, 0})).value();
  all(monitor.events(3.0));
  monitor.report(1, at(3.5, {995, 0, 0})).value();
  monitor.report(2, at(3.5, {1000, 0, 0})).value();
  events = all(monitor.events(3.5));
  EXPECT_EQ(monitor.track(1)->places.size(), 1u);
  EXPECT_EQ(monitor.open_pairs().at(0).verdict, Verdict::within);
  EXPECT_EQ(monitor.counters().contradictions, 2u);
}

TEST(Monitor, FindsAContradictionInVelocities) {
  Monitor monitor = made(definition(2.0));
  monitor.report(1, at(0.0, {0, 0, 0})).value();
  all(monitor.events(1.0));
  monitor.report(1, at(1.0, {0, 0, 0}, {7, 0, 0})).value();
  const auto events = all(monitor.events(1.0));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, MonitorEventKind::contradiction);
  EXPECT_NEAR(events[0].velocity_excess, 5.0, 1e-9);
}

TEST(Monitor, TellsOfSilenceAndForgets) {
  MonitorDefinition one = definition();
  one.stale_after = 5.0;
  one.drop_after = 60.0;
  Monitor monitor = made(one);
  monitor.report(1, at(0.0, {0, 0, 0})).value();
  monitor.report(2, at(0.0, {5, 0, 0})).value();
  all(monitor.events(0.0));
  monitor.report(2, at(0.0, {5, 0, 0})).value();  // repeated: nothing new
  auto events = all(monitor.events(50.0));
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[1].kind, MonitorEventKind::stale);
  EXPECT_EQ(events[1].time, 5.0);
  EXPECT_EQ(events[2].first, 2u);
  EXPECT_TRUE(monitor.track(1)->stale);
  monitor.report(2, at(49.0, {5, 0, 0})).value();
  events = all(monitor.events(200.0));
  ASSERT_EQ(events.size(), 4u);
  EXPECT_EQ(events[0].kind, MonitorEventKind::resumed);
  EXPECT_EQ(events[1].kind, MonitorEventKind::stale);
  EXPECT_EQ(events[1].time, 54.0);
  EXPECT_EQ(events[2].kind, MonitorEventKind::dropped);
  EXPECT_EQ(events[2].first, 1u);
  EXPECT_EQ(events[2].time, 60.0);
  EXPECT_EQ(events[3].time, 109.0);
  EXPECT_EQ(monitor.size(), 0u);
  EXPECT_TRUE(monitor.open_pairs().empty());
}

TEST(Monitor, UsesTheLargestSpeedWhereThereIsNoVelocity) {
  Monitor monitor = made({.dimensions = 2,
                          .classes = {{.largest_speed = 3.0}},
                          .separations = {{0, 0, {Separation::sphere(10.0)}}}});
  TrackReport report = at(0.0, {0, 0, 50});
  report.velocity_error = infinity;
  monitor.report(1, report).value();
  report.state.position = {40, 0, -50};
  monitor.report(2, report).value();
  const auto events = all(monitor.events(10.0));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NEAR(events[0].time, 5.0, 1e-3);
}

TEST(Monitor, TheLargestSpeedCountsAfterSpeedingUp) {
  // Two tracks approach with an acceleration of 10 to a speed of 5: a way of 1/2 10 0.5^2 and 5 for each
  // second after the first half.
  Monitor monitor = made({.classes = {{.acceleration_limit = 10.0, .largest_speed = 5.0}},
                          .separations = {{0, 0, {Separation::sphere(10.0)}}}});
  monitor.report(1, at(0.0, {0, 0, 0})).value();
  monitor.report(2, at(0.0, {40, 0, 0})).value();
  const auto events = all(monitor.events(10.0));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NEAR(events[0].time, 0.5 + (15.0 - 1.25) / 5.0, 2e-3);
}

TEST(Monitor, APlanHoldsUntilItEnds) {
  Monitor monitor = made(definition(10.0));
  TrackReport report = at(0.0, {0, 0, 0});
  report.plan = TrackReport::Plan{.acceleration = {}, .acceleration_limit = 0.0, .valid_until = 4.0};
  monitor.report(1, report).value();
  report.state.position = {60, 0, 0};
  monitor.report(2, report).value();
  auto events = all(monitor.events(3.9));
  EXPECT_TRUE(events.empty());
  EXPECT_EQ(monitor.answer(1, 2)->until, 4.0);
  // From the end of the plan on the class's limit counts: 60 - 2 1/2 10 5 = 10.
  EXPECT_TRUE(all(monitor.events(4.1)).empty());
  events = all(monitor.events(7.0));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NEAR(events[0].time, 4.0 + std::sqrt(5.0), 2e-3);
  EXPECT_EQ(events[0].verdict, Verdict::undecided);
}

TEST(Monitor, AStampMayBeWrongByItsError) {
  Monitor monitor = made(definition(2.0));
  TrackReport report = at(0.0, {0, 0, 0}, {3, 4, 0});
  report.timestamp_error = 2.0;
  monitor.report(1, report).value();
  // 5 m/s for 2 s, and 1/2 2 2^2.
  EXPECT_NEAR(monitor.track(1)->places[0].radius.total(), 14.0, 1e-6);
}

TEST(Monitor, ACylinderHasTwoLimits) {
  Monitor monitor = made(
      {.classes = {{.acceleration_limit = 0.0}}, .separations = {{0, 0, {Separation::cylinder(10.0, 2.0)}}}});
  monitor.report(1, at(0.0, {0, 0, 0})).value();
  monitor.report(2, at(0.0, {30, 0, 10}, {-5, 0, -1})).value();
  const auto events = all(monitor.events(20.0));
  // Horizontally within from 4 to 8, vertically from 8 to 12: never within for more than a moment.
  for (const MonitorEvent& event : events) EXPECT_NEAR(event.time, 8.0, 3e-3);
  monitor.remove(2).value();
  monitor.report(2, at(20.0, {30, 0, 10}, {-5, 0, -1.25})).value();
  const auto more = all(monitor.events(40.0));
  ASSERT_GE(more.size(), 3u);
  EXPECT_EQ(more[0].kind, MonitorEventKind::dropped);
  EXPECT_NEAR(more[1].time, 26.4, 2e-3);
  EXPECT_NEAR(more.back().time, 28.0, 2e-3);
}

TEST(Monitor, ClassesMayHaveDifferentSeparationsOrNone) {
  Monitor monitor = made({.classes = {{.acceleration_limit = 0.0}, {.acceleration_limit = 0.0}},
                          .separations = {{0, 1, {Separation::sphere(20.0), Separation::sphere(5.0)}}}});
  TrackReport report = at(0.0, {0, 0, 0});
  for (TrackId id = 1; id <= 4; ++id) {
    report.track_class = id % 2;
    report.state.position.x = 3.0 * static_cast<double>(id);
    monitor.report(id, report).value();
  }
  const auto events = all(monitor.events(0.0));
  for (const MonitorEvent& event : events) EXPECT_EQ((event.first + event.second) % 2, 1u);
  // 1-2, 2-3, 3-4 at both levels, 1-4 at the outer one.
  EXPECT_EQ(monitor.open_pairs().size(), 7u);
  EXPECT_EQ(monitor.answer(1, 4, 1)->verdict, Verdict::apart);
  expect_refused(monitor.answer(1, 3), ErrorCode::out_of_range,
                 "no separation is watched between first, of class 1, and second, of class 1");
  expect_refused(monitor.answer(1, 4, 2), ErrorCode::out_of_range, "level must be less than 2");
}

// Polling.

TEST(Monitor, AsksTheOneOfWhomLessIsKnown) {
  Monitor monitor = made(definition(2.0));
  std::vector<TrackId> asked;
  const Poll poll = [&](std::span<const TrackId> ids, double time,
                        std::span<std::optional<TrackReport>> reports) {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      asked.push_back(ids[k]);
      reports[k] = at(time, {ids[k] == 1 ? 0.0 : 26.0, 0, 0});
    }
  };
  monitor.report(1, at(0.0, {0, 0, 0})).value();
  all(monitor.events(1.0, poll));
  monitor.report(2, at(1.0, {26, 0, 0})).value();
  EXPECT_TRUE(all(monitor.events(60.0, poll)).empty());
  ASSERT_GT(asked.size(), 20u);
  for (std::size_t k = 0; k < asked.size(); ++k) EXPECT_EQ(asked[k], 1 + k % 2);
  EXPECT_EQ(monitor.counters().polls, asked.size());
}

TEST(Monitor, WithoutAnAnswerAPairTurnsUndecided) {
  Monitor monitor = made(definition(2.0));
  int asked = 0;
  const Poll poll = [&](std::span<const TrackId>, double, std::span<std::optional<TrackReport>>) { ++asked; };
  monitor.report(1, at(0.0, {0, 0, 0})).value();
  monitor.report(2, at(0.0, {26, 0, 0})).value();
  const auto events = all(monitor.events(10.0, poll));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].verdict, Verdict::undecided);
  // Requested when it happened, at 2.8, and again at each window start, for both tracks.
  EXPECT_EQ(asked, 2 + 8);
}

TEST(Monitor, AfterABadAnswerOrAnExceptionItGoesOn) {
  Monitor monitor = made(definition(2.0));
  monitor.report(1, at(0.0, {0, 0, 0})).value();
  monitor.report(2, at(0.0, {26, 0, 0})).value();
  const Poll bad = [](std::span<const TrackId>, double time, std::span<std::optional<TrackReport>> reports) {
    for (auto& report : reports) report = at(time, {std::nan(""), 0, 0});
  };
  expect_refused(monitor.advance(10.0, bad), ErrorCode::not_finite, "report of track");
  const double stopped = monitor.time();
  const Poll throws = [](std::span<const TrackId>, double, std::span<std::optional<TrackReport>>) {
    throw std::runtime_error("radio silence");
  };
  EXPECT_THROW(static_cast<void>(monitor.advance(10.0, throws)), std::runtime_error);
  EXPECT_EQ(monitor.time(), stopped);
  EXPECT_EQ(all(monitor.events(10.0)).size(), 1u);
}

TEST(Monitor, CannotBeChangedByWhomItAsks) {
  Monitor monitor = made(definition(2.0));
  monitor.report(1, at(0.0, {0, 0, 0})).value();
  monitor.report(2, at(0.0, {26, 0, 0})).value();
  int asked = 0;
  const Poll poll = [&](std::span<const TrackId> ids, double time, std::span<std::optional<TrackReport>>) {
    ++asked;
    expect_refused(monitor.report(ids[0], at(time, {})), ErrorCode::probe_in_progress, "report");
    expect_refused(monitor.remove(ids[0]), ErrorCode::probe_in_progress, "remove");
    expect_refused(monitor.advance(time), ErrorCode::probe_in_progress, "advance");
    EXPECT_EQ(monitor.time(), time);
    EXPECT_TRUE(monitor.track(ids[0]));
  };
  all(monitor.events(5.0, poll));
  EXPECT_GT(asked, 0);
  monitor.report(1, at(5.0, {0, 0, 0})).value();
}

TEST(Monitor, NamesTheTracksOfACrowd) {
  Monitor monitor = Monitor::create({.classes = {{.acceleration_limit = 1.0}},
                                     .separations = {{0, 0, {Separation::sphere(10.0)}}}})
                        .value();
  const auto report = [&](TrackId id, double x) {
    monitor.report(id, {.timestamp = 0.0, .state = {{x, 0, 0}, {}}, .position_error = 1.0}).value();
  };
  // Five tracks at one spot make ten pairs, and two elsewhere one.
  for (TrackId id = 1; id <= 5; ++id) report(id, 0.1 * static_cast<double>(id));
  report(8, 1000.0);
  report(9, 1001.0);
  while (monitor.advance(0.0).value()) continue;
  EXPECT_EQ(monitor.open_pair_count(), 11u);
  EXPECT_TRUE(monitor.crowd(11).empty());
  EXPECT_EQ(monitor.crowd(7), std::vector<TrackId>{1});
  EXPECT_EQ(monitor.crowd(4), (std::vector<TrackId>{1, 2}));
  EXPECT_EQ(monitor.crowd(0).size(), 5u) << "four of the five, and one of the two";
  for (const TrackId id : monitor.crowd(4)) monitor.remove(id).value();
  EXPECT_EQ(monitor.open_pair_count(), 4u);
}

TEST(Monitor, ThatHasBeenMovedFromSaysSo) {
  Monitor monitor = made(definition(2.0));
  Monitor other = std::move(monitor);
  expect_refused(monitor.report(1, at(0.0, {})), ErrorCode::moved_from, "report");
  expect_refused(monitor.advance(1.0), ErrorCode::moved_from, "advance");
  EXPECT_THROW(static_cast<void>(monitor.time()), BadResult);
  EXPECT_THROW(static_cast<void>(monitor.save()), BadResult);
  monitor = std::move(other);
  EXPECT_EQ(monitor.time(), 0.0);
}

// Wrong use.

TEST(Monitor, RefusesWhatCannotBe) {
  expect_refused(Monitor::create({}), ErrorCode::out_of_range, "classes");
  expect_refused(Monitor::create({.dimensions = 1, .classes = {{.acceleration_limit = 1.0}}}),
                 ErrorCode::out_of_range, "dimensions");
  expect_refused(Monitor::create({.classes = {{}}}), ErrorCode::out_of_range, "classes");
  expect_refused(Monitor::create({.classes = {{.acceleration_limit = 1.0}},
                                  .separations = {{0, 1, {Separation::sphere(1.0)}}}}),
                 ErrorCode::out_of_range, "separations");
  expect_refused(Monitor::create({.classes = {{.acceleration_limit = 1.0}},
                                  .separations = {{0, 0, {Separation::sphere(0.0)}}}}),
                 ErrorCode::out_of_range, "separations");
  expect_refused(Monitor::create({.classes = {{.acceleration_limit = 1.0}}, .separations = {{0, 0, {}}}}),
                 ErrorCode::out_of_range, "levels");
  expect_refused(Monitor::create({.classes = {{.acceleration_limit = 1.0}},
                                  .separations = {{0, 0, {Separation::sphere(1.0)}}},
                                  .window = 0.0}),
                 ErrorCode::out_of_range, "window");

  Monitor monitor = made(definition());
  expect_refused(monitor.report(1, at(std::nan(""), {})), ErrorCode::not_finite, "report of track 1");
  expect_refused(monitor.report(1, at(0.0, {1e300, 0, 0})), ErrorCode::out_of_range, "report of track 1");
  TrackReport report = at(0.0, {});
  report.position_error = -1.0;
  expect_refused(monitor.report(1, report), ErrorCode::out_of_range, "report of track 1");
  report = at(0.0, {});
  report.velocity_error = infinity;
  expect_refused(monitor.report(1, report), ErrorCode::out_of_range, "report of track 1");
  report = at(0.0, {});
  report.track_class = 1;
  expect_refused(monitor.report(1, report), ErrorCode::out_of_range, "report of track 1");
  expect_refused(monitor.check_report(1, report), ErrorCode::out_of_range, "report: report of track 1");
  EXPECT_TRUE(monitor.check_report(1, at(0.0, {})));
  EXPECT_EQ(monitor.size(), 0u);
  expect_refused(monitor.remove(1), ErrorCode::unknown_body, "track 1");
  expect_refused(monitor.track(1), ErrorCode::unknown_body, "track 1");
  expect_refused(monitor.answer(1, 2), ErrorCode::unknown_body, "track 1");
  monitor.report(1, at(0.0, {})).value();
  expect_refused(monitor.answer(1, 1), ErrorCode::out_of_range, "second");
  static_cast<void>(all(monitor.events(1.0)));
  expect_refused(monitor.advance(0.5), ErrorCode::time_backwards, "until");
  expect_refused(monitor.advance(infinity), ErrorCode::not_finite, "until");
}

TEST(Silence, LeavesNothingBehindWhenItIsOver) {
  Monitor monitor = Monitor::create({.classes = {{.largest_speed = 1.0}},
                                     .separations = {{0, 0, {Separation::sphere(1.0)}}},
                                     .stale_after = 10.0,
                                     .drop_after = 1000.0})
                        .value();
  const auto size_after = [&](int cycles) {
    for (int k = 0; k < cycles; ++k) {
      const double stamp = monitor.time() + 20.0;
      for (const MonitorEvent& event : monitor.events(stamp)) EXPECT_EQ(event.kind, MonitorEventKind::stale);
      monitor.report(1, {.timestamp = stamp, .position_error = 0.1, .velocity_error = 1.0}).value();
      for (const MonitorEvent& event : monitor.events(stamp))
        EXPECT_EQ(event.kind, MonitorEventKind::resumed);
    }
    return monitor.save().size();
  };
  const std::size_t few = size_after(10);
  EXPECT_EQ(size_after(1000), few);
}

}  // namespace
}  // namespace kinesphere::monitor_test
