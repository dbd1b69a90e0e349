// Batches of clusters give the events of one processor with all bodies, and can be rolled back.
#include "speculation/speculative_runner.hpp"

#include <gtest/gtest.h>

#include <deque>

#include "kinesphere/random.hpp"
#include "support/eager_workers.hpp"
#include "support/small_world.hpp"

namespace kinesphere::speculative_runner_test {
namespace {

constexpr std::uint64_t seed = 5211;
constexpr std::uint32_t pairs = 800;  // enough for batches of 16 clusters

/// Pairs of balls that meet in the next unit of time, far from the other pairs.
void add_pairs(SmallWorld& world) {
  Random random(seed);
  for (std::uint32_t k = 0; k < pairs; ++k) {
    const Vec3 place{20.0 * (k % 30), 20.0 * (k / 30), 0.0};
    const Vec3 direction = random.unit_vector();
    world.add({.radius = 0.1, .acceleration_limit = 0.1, .position = place, .velocity = direction});
    world.add(
        {.radius = 0.1, .acceleration_limit = 0.1, .position = place + direction * random.uniform(0.4, 1.0)});
  }
  EXPECT_TRUE(world.main.recertify());
}

/// The instants at which contacts begin, without a response.
std::vector<std::pair<double, std::uint32_t>> times_of(const auto& events) {
  std::vector<std::pair<double, std::uint32_t>> times;
  for (const Event& event : events) times.emplace_back(event.time, event.first.index);
  return times;
}

class SpeculativeRunnerTest : public testing::TestWithParam<int> {
 protected:
  SpeculativeRunnerTest() { add_pairs(world); }

  SmallWorld world;
  Workers workers = eager_workers(GetParam()).value();
};

TEST_P(SpeculativeRunnerTest, FindsTheEventsOfOneProcessor) {
  SmallWorld plain;
  add_pairs(plain);
  const auto expected = plain.advance_all(0.5);
  ASSERT_GT(expected.size(), 5u);
  PoolLease lease(&workers);
  SpeculativeRunner runner(world.state, world.main, lease, world.probe, nullptr);
  runner.require_speculation();
  std::deque<Event> events;
  int batches = 0;
  while (world.main.is_certified() && world.main.time() < 0.5 && runner.run(0.5, events)) ++batches;
  while (const auto event = world.advance(0.5)) events.push_back(*event);
  EXPECT_GT(batches, 0);
  EXPECT_EQ(times_of(events), times_of(expected));
  EXPECT_EQ(world.main.work().counters.probes, plain.main.work().counters.probes) << "and asks as often";
}

TEST_P(SpeculativeRunnerTest, RestoresTheStateBeforeABatch) {
  PoolLease lease(&workers);
  SpeculativeRunner runner(world.state, world.main, lease, world.probe, nullptr);
  runner.require_speculation();
  std::vector<Bound> before;
  for (std::uint32_t number = 0; number < 2 * pairs; ++number)
    before.push_back(world.state.bodies[number].bound);
  const std::size_t queued = world.main.queue().size();
  runner.begin_batch(runner.take_due(0.5, infinity));
  EXPECT_GT(runner.clusters().size(), 0u);
  ASSERT_TRUE(runner.execute_all([](const Cluster&) { return true; }));
  bool has_changed = false;
  for (std::uint32_t number = 0; number < 2 * pairs; ++number)
    has_changed = has_changed || world.state.bodies[number].bound != before[number];
  EXPECT_TRUE(has_changed);
  runner.rollback();
  runner.end_batch();
  for (std::uint32_t number = 0; number < 2 * pairs; ++number) {
    EXPECT_EQ(world.state.bodies[number].bound, before[number]);
    EXPECT_TRUE(world.state.contacts.partners_of(number).empty());
  }
  EXPECT_EQ(world.main.queue().size(), queued) << "what was due is due again";
  EXPECT_EQ(world.main.time(), 0.0);
}

TEST_P(SpeculativeRunnerTest, JoinsTheClustersOfBodies) {
  PoolLease lease(&workers);
  SpeculativeRunner runner(world.state, world.main, lease, world.probe, nullptr);
  runner.require_speculation();
  runner.begin_batch(runner.take_due(0.5, infinity));
  const std::uint32_t numbers[] = {0, 2, 59};
  runner.merge_bodies(numbers);
  const Cluster* const joined = runner.cluster_of(0);
  ASSERT_NE(joined, nullptr);
  EXPECT_EQ(runner.cluster_of(2), joined);
  EXPECT_EQ(runner.cluster_of(59), joined);
  EXPECT_EQ(runner.cluster_of(5000), nullptr) << "nobody";
  ASSERT_TRUE(runner.execute_all([](const Cluster&) { return true; }));
  EXPECT_FALSE(runner.commit([](const Cluster&) { return true; }).empty());
  runner.end_batch();
}

INSTANTIATE_TEST_SUITE_P(Threads, SpeculativeRunnerTest, testing::Values(1, 3));

}  // namespace
}  // namespace kinesphere::speculative_runner_test
