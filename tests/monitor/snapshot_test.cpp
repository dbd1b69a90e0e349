// A monitor that is restored goes on as the one that was saved, and nothing else can be restored.
#include <gtest/gtest.h>

#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/random.hpp"
#include "support/sealed_snapshot.hpp"

namespace kinesphere::snapshot_test {
namespace {

constexpr std::size_t tracks = 60;

/// Drives a monitor through a stretch of time: the same reports for the same seed and stretch.
std::vector<MonitorEvent> drive(Monitor& monitor, int stretch) {
  Random random = Random::at(7, static_cast<std::uint64_t>(stretch), 0);
  std::vector<MonitorEvent> events;
  const auto go_to = [&](double time) {
    for (const MonitorEvent& event : monitor.events(time)) events.push_back(event);
  };
  for (int k = 0; k < 400; ++k) {
    const double time = stretch * 10.0 + k * 0.025;
    go_to(time);
    const auto id = static_cast<TrackId>(random.uniform(0.0, static_cast<double>(tracks)));
    TrackReport report{
        .stamp = time - random.uniform(0.0, 0.5), .position_error = 0.5, .velocity_error = 0.5};
    const double angle = 0.3 * report.stamp + static_cast<double>(id);
    // On a circle each; now and then somewhere else.
    report.state = {{30 * std::cos(angle), 30 * std::sin(angle), 0.5 * static_cast<double>(id % 7)},
                    {-9 * std::sin(angle), 9 * std::cos(angle), 0}};
    if (k % 50 == 49) report.state.position.x += 200;
    if (k % 90 == 89)
      static_cast<void>(monitor.remove(id));
    else
      monitor.report(id, report).value();
  }
  go_to(stretch * 10.0 + 10.0);
  return events;
}

Monitor made() {
  return Monitor::create({.classes = {{.acceleration_limit = 4.0, .largest_speed = 20.0}},
                          .separations = {{0, 0, {Separation::sphere(5.0), Separation::cylinder(3.0, 1.0)}}},
                          .silence_after = 4.0,
                          .forget_after = 9.0})
      .value();
}

TEST(MonitorSnapshot, GoesOnAsTheOneThatWasSaved) {
  Monitor monitor = made();
  std::size_t events = drive(monitor, 0).size();
  for (int stretch = 1; stretch < 4; ++stretch) {
    const std::vector<std::byte> snapshot = monitor.save();
    Monitor restored = Monitor::restore(snapshot).value();
    EXPECT_EQ(restored.save(), snapshot);
    const auto expected = drive(monitor, stretch);
    EXPECT_EQ(drive(restored, stretch), expected);
    EXPECT_EQ(restored.save(), monitor.save());
    events += expected.size();
  }
  EXPECT_GT(events, 1000u);
  EXPECT_GT(monitor.counters().contradictions, 10u);
}

/// A dense sky of which little is known: pairs that turn apart and undecided again within a window, and
/// tracks that may be at one of several places.
std::vector<MonitorEvent> watch_dense_sky(std::uint64_t seed, bool is_restored_often) {
  Monitor monitor = Monitor::create({.classes = {{.acceleration_limit = 6.0, .largest_speed = 400.0}},
                                     .separations = {{0, 0, {Separation::sphere(500.0)}}},
                                     .window = 1.0,
                                     .silence_after = 3.0,
                                     .forget_after = 8.0})
                        .value();
  Random random(seed);
  std::vector<MonitorEvent> events;
  for (int k = 0; k < 3000; ++k) {
    const double time = 0.004 * k;
    for (const MonitorEvent& event : monitor.events(time)) events.push_back(event);
    const auto id = static_cast<TrackId>(random.uniform(0.0, static_cast<double>(tracks)));
    const double stamp = time - random.uniform(0.0, 0.2),
                 angle = 0.25 * stamp + 1.7 * static_cast<double>(id);
    const double radius = 2000.0 + 100.0 * static_cast<double>(id % 9);
    TrackReport report{.stamp = stamp, .position_error = 10.0, .velocity_error = 25.0};
    report.state = {{radius * std::cos(angle), radius * std::sin(angle), 0},
                    {-0.08 * radius * std::sin(angle), 0.08 * radius * std::cos(angle), 0}};
    monitor.report(id, report).value();
    if (is_restored_often && k % 3 == 0) monitor = Monitor::restore(monitor.save()).value();
  }
  return events;
}

TEST(MonitorSnapshot, MakesNoDifferenceHoweverOftenItIsRestored) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const std::vector<MonitorEvent> expected = watch_dense_sky(seed, false);
    EXPECT_GT(expected.size(), 2000u);
    EXPECT_TRUE(watch_dense_sky(seed, true) == expected) << "seed " << seed;
  }
}

TEST(MonitorSnapshot, KeepsEventsThatHaveNotBeenTold) {
  Monitor monitor = made();
  for (TrackId id = 0; id < 5; ++id) monitor.report(id, {.position_error = 1.0}).value();
  ASSERT_TRUE(monitor.advance(0.0)->has_value());
  Monitor restored = Monitor::restore(monitor.save()).value();
  std::vector<MonitorEvent> rest, expected;
  for (const MonitorEvent& event : restored.events(1.0)) rest.push_back(event);
  for (const MonitorEvent& event : monitor.events(1.0)) expected.push_back(event);
  EXPECT_EQ(rest, expected);
  EXPECT_GE(rest.size(), 9u);
}

TEST(MonitorSnapshot, RefusesDamage) {
  Monitor monitor = made();
  drive(monitor, 0);
  const std::vector<std::byte> snapshot = monitor.save();
  for (std::size_t size = 0; size < snapshot.size(); size += 97)
    EXPECT_EQ(Monitor::restore(std::span(snapshot).first(size)).error().code, ErrorCode::bad_snapshot);
  Random random(3);
  // Damage that the checksum is made to agree with never does worse than another monitor.
  int refused = 0;
  for (int k = 0; k < 3000; ++k) {
    std::vector<std::byte> damaged = snapshot;
    for (int n = 0; n <= k % 3; ++n) {
      const auto at =
          static_cast<std::size_t>(random.uniform(20.0, static_cast<double>(snapshot.size() - 8)));
      damaged[at] = static_cast<std::byte>(random.bits() & 255);
    }

    Result<Monitor> restored = Monitor::restore(sealed(damaged));
    if (!restored) {
      EXPECT_EQ(restored.error().code, ErrorCode::bad_snapshot);
      ++refused;
      continue;
    }
    for (int n = 0; n < 20; ++n)
      if (!restored->advance(std::max(restored->time(), 11.0))) break;
    static_cast<void>(restored->open_pairs());
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace kinesphere::snapshot_test
