// Predictions of a monitor, against paths that are sampled finely; and tracks that change their class.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/random.hpp"
#include "support/test_size.hpp"

namespace kinesphere::prediction_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int samples = 150;

TrackReport at(double time, const Vec3& position, const Vec3& velocity = {}, std::size_t track_class = 0) {
  TrackReport report{.timestamp = time, .state = {position, velocity}};
  report.track_class = track_class;
  return report;
}

/// Returns the events of predictions and of classes.
std::vector<MonitorEvent> predictions_of(MonitorEventRange events) {
  std::vector<MonitorEvent> found;
  for (const MonitorEvent& event : events)
    if (event.kind == MonitorEventKind::predicted || event.kind == MonitorEventKind::prediction_ended ||
        event.kind == MonitorEventKind::reclassified)
      found.push_back(event);
  return found;
}

MonitorDefinition definition(double hold = 0.0) {
  return {.classes = {{.acceleration_limit = 10.0}},
          .separations = {{0, 0, {Separation::sphere(10.0, 20.0)}}},
          .prediction_hold = hold};
}

TEST(Predictions, TellAnApproachAheadByItsLookAheadTime) {
  Monitor monitor = Monitor::create(definition()).value();
  monitor.report(1, at(0.0, {0, 0, 0})).value();
  monitor.report(2, at(0.0, {100, 6, 0}, {-2, 0, 0})).value();
  // Closest at 50, and within 10 where |x| <= 8: from 46 to 54.
  auto events = predictions_of(monitor.events(29.9));
  EXPECT_TRUE(events.empty());
  EXPECT_FALSE(monitor.answer(1, 2)->predicted);
  events = predictions_of(monitor.events(40.0));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, MonitorEventKind::predicted);
  EXPECT_NEAR(events[0].time, 30.0, 2e-3);
  EXPECT_EQ(std::pair(events[0].first, events[0].second), std::pair(TrackId{1}, TrackId{2}));
  EXPECT_NEAR(events[0].likely_time, 46.0, 1e-9);
  EXPECT_NEAR(events[0].closest_time, 50.0, 1e-9);
  EXPECT_NEAR(events[0].closest_distance, 6.0, 1e-9);
  EXPECT_TRUE(monitor.answer(1, 2)->predicted);
  ASSERT_EQ(monitor.predicted_pairs().size(), 1u);
  EXPECT_EQ(monitor.predicted_pairs()[0].since, events[0].time);
  events = predictions_of(monitor.events(60.0));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, MonitorEventKind::prediction_ended);
  EXPECT_NEAR(events[0].time, 54.0, 2e-3);
  EXPECT_NEAR(events[0].since, 30.0, 2e-3);
  EXPECT_TRUE(monitor.predicted_pairs().empty());
}

/// The first report ends the prediction, and the second one at the same time begins it anew.
TEST(Predictions, OfOneInstantAreToldInTheOrderInWhichTheyBecameTrue) {
  MonitorDefinition agile = definition();
  agile.classes[0].acceleration_limit = 50.0;
  Monitor monitor = Monitor::create(agile).value();
  monitor.report(1, at(0.0, {0, 0, 0}, {10, 0, 0})).value();
  monitor.report(2, at(0.0, {300, 0, 0}, {-10, 0, 0})).value();
  ASSERT_EQ(predictions_of(monitor.events(1.0)).size(), 1u);
  monitor.report(1, at(1.0, {10, 0, 0}, {0, 20, 0})).value();
  monitor.report(2, at(1.0, {290, 0, 0}, {-19.6, 20, 0})).value();
  const auto events = predictions_of(monitor.events(1.0));
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].kind, MonitorEventKind::prediction_ended);
  EXPECT_EQ(events[1].kind, MonitorEventKind::predicted);
  EXPECT_EQ(monitor.predicted_pairs().size(), 1u);
}

TEST(Predictions, AreThoseOfTheLatestReports) {
  Monitor monitor = Monitor::create(definition()).value();
  monitor.report(1, at(0.0, {0, 0, 0})).value();
  monitor.report(2, at(0.0, {100, 0, 0}, {-5, 0, 0})).value();
  EXPECT_EQ(predictions_of(monitor.events(1.0)).size(), 1u);
  monitor.report(2, at(1.0, {95, 0, 0}, {-5, 1.5, 0})).value();
  const auto events = predictions_of(monitor.events(1.0));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, MonitorEventKind::prediction_ended);
  EXPECT_EQ(events[0].likely_time, infinity);
  // A dropped track has no further events.
  monitor.report(2, at(1.0, {95, 0, 0}, {-5, 0, 0})).value();
  monitor.remove(2).value();
  for (const MonitorEvent& event : monitor.events(30.0))
    EXPECT_NE(event.kind, MonitorEventKind::prediction_ended);
  EXPECT_TRUE(monitor.predicted_pairs().empty());
}

TEST(Predictions, HoldOnWhileReportsWaver) {
  for (const double hold : {0.0, 3.0}) {
    Monitor monitor = Monitor::create(definition(hold)).value();
    monitor.report(1, at(0.0, {0, 0, 0})).value();
    std::size_t changes = 0;
    for (int k = 0; k < 10; ++k) {
      changes += predictions_of(monitor.events(k)).size();
      // Every other report says that the two pass at 12.
      const double y = k % 2 == 0 ? 9.0 : 12.0;
      monitor.report(2, at(k, {100.0 - 5.0 * k, y, 0}, {-5, 0, 0})).value();
    }
    changes += predictions_of(monitor.events(9.9)).size();
    EXPECT_EQ(changes, hold > 0.0 ? 1u : 10u);
    // The last report that saw them near was replaced at 9.
    const auto events = predictions_of(monitor.events(60.0));
    EXPECT_EQ(events.size(), hold > 0.0 ? 1u : 0u);
    for (const MonitorEvent& event : events) EXPECT_NEAR(event.time, 12.0, 2e-3);
  }
}

TEST(Predictions, BeginOnceTheyAreConfirmed) {
  MonitorDefinition made = definition(2.0);
  made.prediction_confirmation = 3.0;
  Monitor monitor = Monitor::create(made).value();
  monitor.report(1, at(0.0, {0, 0, 0})).value();
  // One report of a course that leads near, and others of one that does not.
  monitor.report(2, at(0.0, {100, 0, 0}, {-5, 0, 0})).value();
  EXPECT_TRUE(predictions_of(monitor.events(1.0)).empty());
  monitor.report(2, at(1.0, {95, 0, 0}, {-5, 3, 0})).value();
  for (const double time : {2.0, 4.0}) {
    EXPECT_TRUE(predictions_of(monitor.events(time)).empty());
    monitor.report(2, at(time, {100 - 5 * time, 0, 0}, {-5, 0, 0})).value();
  }
  monitor = Monitor::restore(monitor.save()).value();
  auto events = predictions_of(monitor.events(6.0));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NEAR(events[0].time, 5.0, 2e-3) << "three after 2";
  // A break begins the time anew.
  monitor.report(3, at(6.0, {0, 460, 0}, {0, -5, 0})).value();
  monitor.report(4, at(6.0, {0, 420, 0})).value();
  EXPECT_TRUE(predictions_of(monitor.events(8.0)).empty());
  monitor.report(3, at(8.0, {0, 450, 0}, {0, 1, 0})).value();
  EXPECT_TRUE(predictions_of(monitor.events(8.5)).empty());
  monitor.report(3, at(8.5, {0, 450.5, 0}, {0, -3, 0})).value();
  EXPECT_TRUE(predictions_of(monitor.events(11.4)).empty());
  EXPECT_EQ(predictions_of(monitor.events(11.6)).size(), 1u);
}

TEST(Predictions, AMarginKeepsWhoHoversAtTheSeparation) {
  for (const double margin : {0.0, 0.1}) {
    MonitorDefinition made = definition();
    made.prediction_margin = margin;
    Monitor monitor = Monitor::create(made).value();
    monitor.report(1, at(0.0, {0, 0, 0})).value();
    std::size_t changes = 0;
    for (int k = 0; k < 10; ++k) {
      changes += predictions_of(monitor.events(k)).size();
      monitor.report(2, at(k, {k % 2 == 0 ? 9.5 : 10.5, 0, 0}, {0, 0, 0})).value();
    }
    EXPECT_EQ(changes, margin > 0.0 ? 1u : 9u);
    EXPECT_EQ(predictions_of(monitor.events(9.0)).size(), margin > 0.0 ? 0u : 1u);
    EXPECT_TRUE(predictions_of(monitor.events(10.0)).empty());
    monitor.report(2, at(10.0, {12, 0, 0}, {0, 0, 0})).value();
    EXPECT_EQ(predictions_of(monitor.events(10.0)).size(), margin > 0.0 ? 1u : 0u) << "beyond the margin";
    // What begins a prediction is the separation itself.
    monitor.report(2, at(10.0, {10.5, 0, 0}, {0, 0, 0})).value();
    EXPECT_TRUE(predictions_of(monitor.events(11.0)).empty());
    // It ends by time alone when the two leave the enlarged separation.
    monitor.report(2, at(11.0, {9, 0, 0}, {1, 0, 0})).value();
    const auto events = predictions_of(monitor.events(20.0));
    ASSERT_EQ(events.size(), 2u);
    EXPECT_NEAR(events[1].time, 11.0 + (10.0 * (1.0 + margin) - 9.0), 2e-3);
  }
}

TEST(Predictions, MayCountTheErrorsOfPositions) {
  for (const bool counts : {false, true}) {
    MonitorDefinition made = definition();
    made.separations = {{0, 0, {Separation::ellipsoid(10.0, 5.0, 20.0)}}};
    made.prediction_error_part = counts ? 0.5 : 0.0;
    Monitor monitor = Monitor::create(made).value();
    TrackReport first = at(0.0, {0, 0, 0}), second = at(0.0, {12.5, 0, 0}, {0, 0, 0});
    first.position_error = 2.0;
    second.position_error = 4.0;
    monitor.report(1, first).value();
    monitor.report(2, second).value();
    EXPECT_EQ(predictions_of(monitor.events(0.0)).size(), counts ? 1u : 0u);
    // Heights count twice, and so do their errors.
    TrackReport third = at(0.0, {0, 0, 500}), fourth = at(0.0, {0, 0, 507.5}, {0, 0, 0});
    third.position_error = ErrorBound::cylinder(0.0, 2.0);
    fourth.position_error = ErrorBound::cylinder(0.0, 4.0);
    monitor.report(3, third).value();
    monitor.report(4, fourth).value();
    EXPECT_EQ(predictions_of(monitor.events(0.0)).size(), counts ? 1u : 0u);
    fourth.state = {{0, 0, 508.5}, {0, 0, 0}};
    fourth.timestamp = 1.0;
    EXPECT_TRUE(predictions_of(monitor.events(1.0)).empty());
    monitor.report(4, fourth).value();
    EXPECT_EQ(predictions_of(monitor.events(1.0)).size(), counts ? 1u : 0u) << "beyond them it has ended";
  }
}

/// Ratio of the distance to the separation: at most 1 within it.
double gauge(const Separation& separation, const Vec3& offset, int dimensions) {
  const double flat = std::hypot(offset.x, offset.y) / separation.horizontal;
  const double upright = dimensions == 2 ? 0.0 : std::abs(offset.z) / separation.vertical;
  return separation.shape == Separation::Shape::cylinder ? std::max(flat, upright)
                                                         : std::hypot(flat, upright);
}

TEST(Predictions, AgreeWithSampledPaths) {
  const int runs = rounds_of(12);
  std::size_t seen = 0, predicted_count = 0;
  for (int run = 0; run < runs; ++run) {
    SCOPED_TRACE(run);
    Random random = Random::at(11, 0, static_cast<std::uint32_t>(run));
    const int dimensions = 2 + run % 2;
    const double speed = run % 3 == 0 ? 1.0 : 20.0;
    const MonitorDefinition made{
        .dimensions = dimensions,
        .classes = {{.acceleration_limit = 1e5}, {.acceleration_limit = 1e5}},
        .separations = {{0, 0, {Separation::sphere(8.0, 4.0), Separation::cylinder(5.0, 3.0, 1.0)}},
                        {0, 1, {Separation::ellipsoid(6.0, 2.0, 0.5), Separation::sphere(3.0)}}},
        .window = 0.25};
    Monitor monitor = Monitor::create(made).value();
    struct Known {
      double time;
      State state;
      std::size_t track_class;
    };
    std::map<TrackId, Known> tracks;
    std::set<std::tuple<TrackId, TrackId, std::uint32_t>> told;
    double time = 0.0;
    for (int step = 0; step < 150; ++step) {
      const TrackId id = random.bits() % 24;
      if (random.bits() % 40 == 0 && tracks.contains(id)) {
        monitor.remove(id).value();
        tracks.erase(id);
        std::erase_if(told,
                      [&](const auto& key) { return std::get<0>(key) == id || std::get<1>(key) == id; });
      } else {
        const auto known = tracks.find(id);
        State state{30.0 * random.point_in_ball(), speed * random.point_in_ball()};
        if (known != tracks.end() && random.bits() % 4 != 0)
          state.position =
              known->second.state.position + known->second.state.velocity * (time - known->second.time);
        if (dimensions == 2) state.position.z = state.velocity.z = 0.0;
        TrackReport report = at(time, state.position, state.velocity, id % 2);
        report.velocity_error = 100.0;
        report.position_error = 100.0;
        monitor.report(id, report).value();
        tracks[id] = {time, state, id % 2};
      }
      time += random.bits() % 8 == 0 ? 2.0 * random.uniform() : 0.05 * random.uniform();
      for (const MonitorEvent& event : monitor.events(time)) {
        const std::tuple key{event.first, event.second, event.level};
        if (event.kind == MonitorEventKind::predicted) {
          EXPECT_TRUE(told.insert(key).second);
        } else if (event.kind == MonitorEventKind::prediction_ended) {
          EXPECT_EQ(told.erase(key), 1u);
        }
      }
      for (const auto& [a, first] : tracks)
        for (const auto& [b, second] : tracks) {
          // clang++ 14 cannot capture structured bindings.
          const auto &one = first, &other = second;
          if (b <= a || (one.track_class == 1 && other.track_class == 1)) continue;
          const auto& rule = made.separations[one.track_class != other.track_class ? 1 : 0];
          for (std::uint32_t level = 0; level < rule.levels.size(); ++level) {
            const Separation& separation = rule.levels[level];
            const bool is_predicted = told.contains({a, b, level});
            EXPECT_EQ(is_predicted, monitor.answer(a, b, level)->predicted);
            if (separation.look_ahead == 0.0) {
              EXPECT_FALSE(is_predicted);
              continue;
            }
            const auto offset_at = [&](double t) {
              return one.state.position + one.state.velocity * (t - one.time) - other.state.position -
                     other.state.velocity * (t - other.time);
            };
            // Distance that is least at the closest approach: in the plane or, for an ellipsoid, in space.
            const auto distance_at = [&](double t) {
              Vec3 offset = offset_at(t);
              offset.z *= separation.shape == Separation::Shape::cylinder || dimensions == 2
                              ? 0.0
                              : separation.horizontal / separation.vertical;
              return norm(offset);
            };
            const auto is_passed_at = [&](double t) {
              return distance_at(t + 1e-4) >= distance_at(t - 1e-4);
            };
            const auto gauge_at = [&](double t) { return gauge(separation, offset_at(t), dimensions); };
            const auto least_until = [&](double end) {
              double least = infinity;
              for (int k = 0; k <= samples; ++k)
                least = std::min(least, gauge_at(time + (end - time) * k / samples));
              return least;
            };
            const double early = time + (1 - 1e-3) * separation.look_ahead - 2e-3;
            const double late = time + (1 + 1e-3) * separation.look_ahead + 2e-3;
            const double between = norm(one.state.velocity - other.state.velocity) * separation.look_ahead /
                                   samples / std::min(separation.horizontal, separation.vertical);
            const double now = gauge_at(time);
            if (is_predicted) {
              const bool is_excluded = now > 1.01 && (least_until(late) > 1.01 + between ||
                                                      (!is_passed_at(late) && gauge_at(late) < 0.99));
              EXPECT_FALSE(is_excluded) << a << " " << b << " level " << level << " at " << time;
            } else {
              const bool is_certain = now < 0.99 || ((is_passed_at(early) || gauge_at(early) > 1.01) &&
                                                     least_until(early) < 0.99);
              EXPECT_FALSE(is_certain) << a << " " << b << " level " << level << " at " << time;
            }
            ++seen;
            predicted_count += is_predicted ? 1u : 0u;
          }
        }
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(predicted_count, seen / 100);
  EXPECT_GT(seen, 8000u * static_cast<std::size_t>(runs));
}

TEST(Predictions, GoOnAfterASnapshotAsWithoutIt) {
  const auto events_of = [](bool is_restored) {
    MonitorDefinition made = definition(1.0);
    made.classes.push_back({.acceleration_limit = 5.0});
    made.separations.push_back(
        {0, 1, {Separation::cylinder(8.0, 4.0, 6.0), Separation::well_clear(6.0, 4.0, 1.0, 3.0)}});
    Monitor monitor = Monitor::create(made).value();
    Random random(3);
    std::vector<MonitorEvent> events;
    for (int k = 0; k < 2000; ++k) {
      const double time = 0.02 * k;
      for (const MonitorEvent& event : monitor.events(time)) events.push_back(event);
      const TrackId id = random.bits() % 40;
      if (random.bits() % 50 == 0) {
        static_cast<void>(monitor.remove(id));
      } else {
        const double angle = 0.2 * time + static_cast<double>(id);
        TrackReport report =
            at(time, {60 * std::cos(angle), 60 * std::sin(angle), 0.1 * static_cast<double>(id)},
               {-12 * std::sin(angle), 12 * std::cos(angle), 0}, (id + static_cast<TrackId>(k / 700)) % 2);
        report.position_error = report.velocity_error = 2.0;
        monitor.report(id, report).value();
      }
      if (is_restored && k % 37 == 0) {
        const std::vector<std::byte> bytes = monitor.save();
        monitor = Monitor::restore(bytes).value();
        EXPECT_EQ(monitor.save(), bytes);
      }
    }
    return events;
  };
  const auto events = events_of(false);
  const auto count = [&](MonitorEventKind kind) {
    return std::count_if(events.begin(), events.end(),
                         [&](const MonitorEvent& event) { return event.kind == kind; });
  };
  EXPECT_GT(count(MonitorEventKind::predicted), 100);
  EXPECT_GT(count(MonitorEventKind::prediction_ended), 50);
  EXPECT_GT(count(MonitorEventKind::reclassified), 20);
  EXPECT_EQ(events_of(true), events);
}

TEST(TrackClasses, MayChange) {
  // Own ship under way (0), others (1), own ship at anchor (2), of which nothing is told.
  Monitor monitor =
      Monitor::create(
          {.classes = {{.acceleration_limit = 0.1}, {.acceleration_limit = 0.1}, {.largest_speed = 0.5}},
           .separations = {{0, 1, {Separation::sphere(100.0, 60.0)}}}})
          .value();
  monitor.report(1, at(0.0, {0, 0, 0}, {5, 0, 0})).value();
  monitor.report(2, at(0.0, {90, 0, 0}, {-5, 0, 0}, 1)).value();
  EXPECT_EQ(predictions_of(monitor.events(1.0)).size(), 1u);
  EXPECT_EQ(monitor.open_pairs().size(), 1u);
  monitor.report(1, at(1.0, {5, 0, 0}, {0, 0, 0}, 2)).value();
  auto events = predictions_of(monitor.events(1.0));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, MonitorEventKind::reclassified);
  EXPECT_EQ(events[0].first, 1u);
  EXPECT_TRUE(monitor.open_pairs().empty());
  EXPECT_TRUE(monitor.predicted_pairs().empty());
  EXPECT_EQ(monitor.track(1)->track_class, 2u);
  // Under way again: its pairs are decided anew, behind the event that says so.
  monitor.report(1, at(2.0, {5, 0, 0}, {5, 0, 0}, 0)).value();
  std::vector<MonitorEventKind> kinds;
  for (const MonitorEvent& event : monitor.events(2.0)) kinds.push_back(event.kind);
  EXPECT_EQ(kinds, (std::vector{MonitorEventKind::reclassified, MonitorEventKind::verdict,
                                MonitorEventKind::predicted}));
}

}  // namespace
}  // namespace kinesphere::prediction_test
