// One worker executes clusters one after the other, and keeps what each has done apart.
#include "speculation/run_pool.hpp"

#include <gtest/gtest.h>

#include "support/small_world.hpp"

namespace kinesphere::run_pool_test {
namespace {

/// Removes the second body of each contact.
struct Remover : ResponseHandler {
  Result<Response> respond(const Event& event) override {
    Response response;
    response.stop = stops;
    if (event.kind == EventKind::contact_begin) response.second_action = BodyAction::remove;
    return response;
  }
  Result<void> apply(const Event&, const Response&) override { return {}; }
  MotionOrigin origin(BodyId) override { return {}; }
  void set_origin(BodyId, const MotionOrigin&) override {}
  bool stops = false;
};

class RunPoolTest : public testing::Test {
 protected:
  RunPoolTest() {
    for (std::uint32_t k = 0; k < 4; k += 2) {
      world.add({.radius = 0.1, .position = {10.0 * k, 0, 0}, .velocity = {1, 0, 0}});
      world.add({.radius = 0.1, .position = {10.0 * k + 1.0 + 0.1 * k, 0, 0}});
    }
    EXPECT_TRUE(world.main.recertify());
    batch.until = 4.0;
    batch.stop = 4.0;
    batch.epoch_end = batch.next_slice = infinity;
    std::vector<PairCertificate> due;
    world.main.certifier().for_each_certificate(world.main.queue(), [&](const PairCertificate& pair) {
      if (pair.has_second()) due.push_back(pair);
    });
    EXPECT_EQ(due.size(), 2u);
    clusters.form(due, world.state.bodies, batch.slots);
    batch.checkpoints.resize(8);
    batch.has_checkpoint.resize(8, 1);
    world.state.contacts.start_side_by_side(false);
  }
  void run(RunPool& pool, std::uint32_t index) {
    pool.run(clusters[index], clusters.due_of(clusters[index]), batch, 0);
  }

  SmallWorld world;
  BatchState batch;
  Clusters clusters;
};

TEST_F(RunPoolTest, KeepsTheEventsOfEachCluster) {
  RunPool pool(world.state, world.main, 1, world.probe, nullptr);
  run(pool, 0);
  run(pool, 1);
  for (const std::uint32_t index : {0u, 1u}) {
    EXPECT_FALSE(clusters[index].failed);
    const auto events = pool.events_of(clusters[index]);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].event.kind, EventKind::contact_begin);
    EXPECT_EQ(events[0].event.first.index, 2 * index);
    EXPECT_NEAR(events[0].event.time, index == 0 ? 0.8 : 1.0, 1e-5);
    EXPECT_EQ(pool.work_of(clusters[index]).counters.probes, 2u);
    EXPECT_TRUE(pool.updates_of(clusters[index]).empty()) << "nobody changed its velocity";
  }
  clusters[0].executed = false;
  EXPECT_TRUE(pool.events_of(clusters[0]).empty()) << "rolled back";
}

TEST_F(RunPoolTest, RemovesBodiesAndLeavesTheirNumbersToTheCommit) {
  Remover handler;
  RunPool pool(world.state, world.main, 1, world.probe, &handler);
  run(pool, 0);
  const auto events = pool.events_of(clusters[0]);
  ASSERT_EQ(events.size(), 2u) << "the contact ends with the body";
  EXPECT_TRUE(events[0].removes_second);
  EXPECT_EQ(events[1].event.kind, EventKind::contact_end);
  EXPECT_EQ(&events[1].cause(), &events[0]);
  ASSERT_EQ(pool.updates_of(clusters[0]).size(), 1u);
  EXPECT_TRUE(pool.updates_of(clusters[0])[0].is_departure());
  EXPECT_FALSE(world.state.bodies[1].alive);
  EXPECT_TRUE(world.state.broad_phase.contains(1));
  EXPECT_EQ(world.state.bodies.table().live_count(), 4u);
}

TEST_F(RunPoolTest, EndsABatchBeforeAnInstantThatConcernsAll) {
  Remover handler;
  handler.stops = true;
  RunPool pool(world.state, world.main, 1, world.probe, &handler);
  run(pool, 0);
  const double stop = batch.stop;
  EXPECT_NEAR(stop, 0.8, 1e-5);
  run(pool, 1);
  EXPECT_TRUE(pool.events_of(clusters[1]).empty()) << "its contact is later";
}

TEST_F(RunPoolTest, FailsWithTheErrorOfAProbe) {
  const Probe silent = [](std::span<const BodyId>, double, std::span<State>) {};
  RunPool pool(world.state, world.main, 1, silent, nullptr);
  run(pool, 0);
  EXPECT_TRUE(clusters[0].failed);
  ASSERT_TRUE(pool.failure_of(clusters[0]));
  EXPECT_EQ(pool.failure_of(clusters[0])->code, ErrorCode::not_finite);
}

}  // namespace
}  // namespace kinesphere::run_pool_test
