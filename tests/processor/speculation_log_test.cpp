// The record that a cluster keeps about its bodies for other clusters.
#include "processor/speculation_log.hpp"

#include <gtest/gtest.h>

namespace kinesphere::speculation_log_test {
namespace {

TEST(SpeculationLog, TellsReportsAndRenewalsFromKicks) {
  BatchState batch;
  batch.slots = {{.cluster = 0, .checkpoint = 0}};
  batch.checkpoints.resize(1);
  batch.checkpoints[0].body.body.revision = 5;
  batch.has_checkpoint = {1};
  SpeculationLog log;
  log.begin(batch, 0);
  const FirstChange& at_first = batch.checkpoints[0].first_change;
  EXPECT_EQ(at_first.changed, infinity);

  log.note_change(0, 1.5);
  EXPECT_EQ(at_first.changed, 1.5);
  // The window of the body ends; its bound stays.
  log.add({.number = 0, .revision = 5, .time = 2.0});
  EXPECT_EQ(at_first.changed, 1.5);
  EXPECT_EQ(at_first.invalidated, infinity);
  const auto since_kick = [&](std::size_t k) { return log.updates.all()[k].first_change; };
  EXPECT_EQ(since_kick(0).changed, infinity);

  log.add({.number = 0, .revision = 6, .time = 3.0});
  EXPECT_EQ(at_first.invalidated, infinity);
  EXPECT_EQ(since_kick(0).changed, 3.0);
  EXPECT_EQ(since_kick(0).invalidated, 3.0);
  EXPECT_EQ(since_kick(1).changed, infinity);
  log.note_change(0, 4.0);
  log.note_change(0, 5.0);
  EXPECT_EQ(since_kick(1).changed, 4.0);
  EXPECT_EQ(since_kick(1).invalidated, infinity);
}

TEST(SpeculationLog, SeesBodiesOfOtherIslandsAsThePartBegan) {
  BatchState batch;
  batch.slots = {
      {.cluster = 0, .checkpoint = 0}, {.cluster = 1, .checkpoint = 1}, {.cluster = 2, .checkpoint = 2}, {}};
  batch.checkpoints.resize(3);
  batch.has_checkpoint = {1, 1, 0};
  SpeculationLog log;
  log.begin(batch, 0);
  EXPECT_EQ(log.checkpoint_of(0), nullptr);
  EXPECT_EQ(log.checkpoint_of(1), &batch.checkpoints[1]);
  // These bodies are not changed.
  EXPECT_EQ(log.checkpoint_of(2), nullptr);
  EXPECT_EQ(log.checkpoint_of(3), nullptr);
}

}  // namespace
}  // namespace kinesphere::speculation_log_test
