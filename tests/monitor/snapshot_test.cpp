// A restored monitor continues like the saved one, and nothing else can be restored.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/random.hpp"
#include "number/infinity.hpp"
#include "support/sealed_snapshot.hpp"
#include "support/test_size.hpp"

namespace kinesphere::snapshot_test {
namespace {

constexpr std::size_t tracks = 60;

/// Drives a monitor through a span of time: equal reports for equal seed and span.
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
        .timestamp = time - random.uniform(0.0, 0.5), .position_error = 0.5, .velocity_error = 0.5};
    const double angle = 0.3 * report.timestamp + static_cast<double>(id);
    // Each on a circle; now and then elsewhere.
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
  return Monitor::create(
             {.classes = {{.acceleration_limit = 4.0, .largest_speed = 20.0}},
              .separations = {{0, 0, {Separation::sphere(5.0, 3.0), Separation::cylinder(3.0, 1.0)}}},
              .stale_after = 4.0,
              .drop_after = 9.0})
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

/// A dense sky with little information: pairs that turn apart and undecided again within a window, and tracks
/// with several hypotheses.
std::vector<MonitorEvent> watch_dense_sky(std::uint64_t seed, bool is_restored_often) {
  Monitor monitor = Monitor::create({.classes = {{.acceleration_limit = 6.0, .largest_speed = 400.0}},
                                     .separations = {{0, 0, {Separation::sphere(500.0)}}},
                                     .window = 1.0,
                                     .stale_after = 3.0,
                                     .drop_after = 8.0})
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
    TrackReport report{.timestamp = stamp, .position_error = 10.0, .velocity_error = 25.0};
    report.state = {{radius * std::cos(angle), radius * std::sin(angle), 0},
                    {-0.08 * radius * std::sin(angle), 0.08 * radius * std::cos(angle), 0}};
    monitor.report(id, report).value();
    if (is_restored_often && k % 3 == 0) monitor = Monitor::restore(monitor.save()).value();
  }
  return events;
}

TEST(MonitorSnapshot, MakesNoDifferenceHoweverOftenItIsRestored) {
  for (std::uint64_t seed = 1; seed <= rounds_of(3u); ++seed) {
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
  // Damage with a corrected checksum results in a refusal or in another valid monitor.
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

using Bytes = std::vector<std::byte>;

template <class T>
void put(Bytes& bytes, std::size_t at, const T& value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// Returns the place at which these values stand one behind the other.
template <class... Values>
std::vector<std::size_t> places_of(const Bytes& bytes, const Values&... values) {
  Bytes sought((sizeof values + ...));
  std::size_t at = 0;
  ((put(sought, at, values), at += sizeof values), ...);
  std::vector<std::size_t> places;
  for (auto k = bytes.begin(); k != bytes.end(); ++k) {
    k = std::search(k, bytes.end(), sought.begin(), sought.end());
    if (k == bytes.end()) break;
    places.push_back(static_cast<std::size_t>(k - bytes.begin()));
  }
  return places;
}

bool is_refused(const Bytes& damaged) {
  const auto restored = Monitor::restore(sealed(damaged));
  EXPECT_TRUE(restored || restored.error().code == ErrorCode::bad_snapshot);
  return !restored;
}

/// Each hypothesis has a region of its own.
TEST(MonitorSnapshot, RefusesAnotherNumberOfRegions) {
  Monitor monitor = made();
  monitor.report(3, {.timestamp = 0.0}).value();
  monitor.report(3, {.timestamp = 0.15625, .state = {{500, 0, 0}, {}}}).value();
  const Bytes snapshot = monitor.save();
  // The regions of the first track with a number, and of it, of which there are two.
  const auto places = places_of(snapshot, std::uint64_t{1}, std::uint64_t{2});
  ASSERT_EQ(places.size(), 1u);
  for (const std::uint64_t other : {0u, 1u, 3u}) {
    Bytes damaged = snapshot;
    put(damaged, places.front() + sizeof other, other);
    EXPECT_TRUE(is_refused(damaged)) << other;
  }
}

/// A track that has left its regions already would be missed by others until it reports.
TEST(MonitorSnapshot, RefusesTimesThatHavePassed) {
  Monitor monitor = made();
  monitor.report(1, {.timestamp = 0.0}).value();
  monitor.report(2, {.timestamp = 0.0, .state = {{9, 0, 0}, {}}, .position_error = 1.0}).value();
  EXPECT_TRUE(monitor.advance(0.5).value() == std::nullopt);
  const Bytes snapshot = monitor.save();
  constexpr double stale_at = 4.0, stay_end = 1.0;
  for (const double time : {stale_at, stay_end}) {
    const auto places = places_of(snapshot, time);
    ASSERT_FALSE(places.empty()) << time;
    std::size_t refused = 0;
    for (const std::size_t place : places) {
      Bytes damaged = snapshot;
      put(damaged, place, 0.25);
      refused += is_refused(damaged) ? 1 : 0;
    }
    EXPECT_GE(refused, 2u) << time << ": one of each track";
  }
}

/// Regression: the state of a number without a track was taken over by the next track of that number.
TEST(MonitorSnapshot, RefusesWhatIsLeftOfATrack) {
  constexpr TrackId id = 0x1122334455667788;
  constexpr std::size_t size_of_none = 58;
  Monitor monitor = made();
  monitor.report(1, {.timestamp = 0.0}).value();
  monitor.report(id, {.timestamp = 0.0}).value();
  monitor.remove(1).value();
  while (monitor.advance(0.0).value()) continue;
  const Bytes snapshot = monitor.save();
  const auto places = places_of(snapshot, id);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_FALSE(is_refused(snapshot));
  for (std::size_t at = places.front() - size_of_none; at < places.front(); ++at) {
    ASSERT_EQ(snapshot[at], std::byte{0});
    Bytes damaged = snapshot;
    damaged[at] = std::byte{1};
    EXPECT_TRUE(is_refused(damaged)) << places.front() - at << " before the next one";
  }
}

/// Regression: lengths overflowed if a plan ended, or the largest speed was reached, after the largest time.
TEST(MonitorSnapshot, IsNotRefusedWhenAPlanOutlivesAllTimes) {
  Monitor monitor = made();
  TrackReport report{.timestamp = 0.0, .plan = TrackReport::Plan{{0, 0, 1}, 0.1, 1e200}};
  monitor.report(1, report).value();
  static_cast<void>(monitor.advance(1.0).value());
  const auto restored = Monitor::restore(monitor.save());
  EXPECT_TRUE(restored) << restored.error().message;
}

}  // namespace
}  // namespace kinesphere::snapshot_test
