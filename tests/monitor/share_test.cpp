// Monitors that divide the pairs among themselves report together what one reports.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/random.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::share_test {
namespace {

const std::vector<Separation> two_levels{Separation::sphere(5.0, 3.0), Separation::cylinder(3.0, 1.0)};

MonitorDefinition definition(Shard share, const std::vector<Separation>& levels = two_levels) {
  return {.classes = {{.acceleration_limit = 4.0, .largest_speed = 20.0}},
          .separations = {{0, 0, levels}},
          .stale_after = 4.0,
          .drop_after = 9.0,
          .shard = share};
}

/// Returns the events of a share for equal reports: late ones, wrong ones, dropped tracks.
std::vector<MonitorEvent> watch(Shard share, const std::vector<Separation>& levels = two_levels) {
  Monitor monitor = Monitor::create(definition(share, levels)).value();
  Random random(11);
  std::vector<MonitorEvent> events;
  for (int k = 0; k < 3000; ++k) {
    const double time = 0.01 * k;
    for (const MonitorEvent& event : monitor.events(time))
      // All monitors report events of single tracks.
      if (share.contains(event.first)) events.push_back(event);
    const auto id = static_cast<TrackId>(random.uniform(0.0, 80.0));
    if (k % 97 == 0) {
      static_cast<void>(monitor.remove(id));
      continue;
    }
    TrackReport report{
        .timestamp = time - random.uniform(0.0, 0.4), .position_error = 0.5, .velocity_error = 0.5};
    const double angle = 0.3 * report.timestamp + static_cast<double>(id);
    report.state = {{30 * std::cos(angle), 30 * std::sin(angle), 0.5 * static_cast<double>(id % 7)},
                    {-9 * std::sin(angle), 9 * std::cos(angle), 0}};
    if (k % 60 == 59) report.state.position.x += 200;
    monitor.report(id, report).value();
    for (const OpenPair& pair : monitor.open_pairs())
      EXPECT_TRUE(share.contains(std::min(pair.first, pair.second)));
  }
  return events;
}

TEST(MonitorShare, SharesTellTogetherWhatOneTells) {
  const std::vector<MonitorEvent> all = watch({});
  EXPECT_GT(all.size(), 1000u);
  for (const std::uint64_t of : {2u, 5u, 64u}) {
    std::size_t reported = 0;
    for (std::uint64_t share = 0; share < of; ++share) {
      std::vector<MonitorEvent> expected;
      std::copy_if(all.begin(), all.end(), std::back_inserter(expected),
                   [&](const MonitorEvent& event) { return event.first % of == share; });
      const Shard one{.of = of, .first = share};
      EXPECT_EQ(watch(one), expected) << share << " of " << of;
      reported += expected.size();
    }
    EXPECT_EQ(reported, all.size());
  }
  // Shares that are watched together.
  const Shard several{.of = 8, .first = 3, .count = 4};
  std::vector<MonitorEvent> expected;
  std::copy_if(all.begin(), all.end(), std::back_inserter(expected),
               [&](const MonitorEvent& event) { return several.contains(event.first); });
  EXPECT_EQ(watch(several), expected);
}

TEST(MonitorShare, ASharesPartOfWellClearIsThatOfAll) {
  const std::vector<Separation> levels{Separation::well_clear(3.0, 2.0, 0.5, 1.0)};
  const Shard one{.of = 2, .first = 1};
  std::vector<MonitorEvent> expected;
  for (const MonitorEvent& event : watch({}, levels))
    if (one.contains(event.first)) expected.push_back(event);
  EXPECT_GT(expected.size(), 1000u);
  EXPECT_EQ(watch(one, levels), expected);
}

TEST(MonitorShare, AnswersForItsOwnPairsAlone) {
  Monitor monitor = Monitor::create(definition({.of = 2, .first = 1})).value();
  for (TrackId id = 1; id < 4; ++id) monitor.report(id, {.position_error = 1.0}).value();
  EXPECT_TRUE(monitor.answer(1, 2));
  EXPECT_TRUE(monitor.answer(3, 1));
  expect_error(monitor.answer(2, 3), ErrorCode::out_of_range, "second", "answer");
  EXPECT_EQ(Monitor::restore(monitor.save())->definition().shard, (Shard{.of = 2, .first = 1}));
}

TEST(MonitorShare, IsChecked) {
  for (const Shard wrong :
       {Shard{.of = 0}, Shard{.of = 3, .count = 0}, Shard{.of = 3, .first = 3},
        Shard{.of = 3, .first = 2, .count = 2}, Shard{.of = 3, .first = ~std::uint64_t{0}, .count = 2}})
    expect_error(Monitor::create(definition(wrong)), ErrorCode::out_of_range, "shard", "Monitor::create");
}

}  // namespace
}  // namespace kinesphere::share_test
