// Updates of clusters and of other processes are compared once, each with all others.
#include "speculation/conflict_detector.hpp"

#include <gtest/gtest.h>

#include "support/small_world.hpp"

namespace kinesphere::conflict_detector_test {
namespace {

/// Clusters of two bodies each that fly towards each other, executed by one worker.
class ConflictDetectorTest : public testing::Test {
 protected:
  ConflictDetectorTest() {
    for (std::uint32_t k = 0; k < 6; k += 2) {
      world.add({.radius = 0.1, .position = {10.0 * k, 0, 0}, .velocity = {1, 0, 0}});
      world.add({.radius = 0.1, .position = {10.0 * k + 1, 0, 0}, .velocity = {-1, 0, 0}});
    }
    EXPECT_TRUE(world.main.recertify());
    // Each body is due to get a new swept sphere at once.
    std::vector<PairCertificate> due;
    for (std::uint32_t k = 0; k < 6; k += 2) due.push_back(world.main.certifier().certificate(0.0, k, k + 1));
    clusters.form(due, world.state.bodies, batch.slots);
    batch.checkpoints.resize(6);
    batch.has_checkpoint.resize(6, 1);
    batch.stop = 0.0;
    for (Cluster& cluster : clusters.all()) cluster.dirty.assign({2 * cluster.index, 2 * cluster.index + 1});
  }
  void run(std::uint32_t index) {
    for (const std::uint32_t number : clusters[index].dirty) world.state.bodies[number].dirty = true;
    pool.run(clusters[index], clusters.due_of(clusters[index]), batch, 0);
    const std::uint32_t ran[] = {index};
    detector.note_runs(ran);
  }
  /// Returns the clusters of the updates that take() gives, the fresh ones first.
  std::vector<std::uint32_t> take(std::size_t fresh) {
    std::vector<ClusterUpdate> updates;
    EXPECT_EQ(detector.take(clusters, pool, updates), fresh);
    std::vector<std::uint32_t> of;
    for (const ClusterUpdate& update : updates) of.push_back(update.cluster);
    return of;
  }

  using Of = std::vector<std::uint32_t>;
  static constexpr std::uint32_t other_process = BatchState::unassigned;
  SmallWorld world;
  BatchState batch;
  Clusters clusters;
  RunPool pool{world.state, world.main, 1, world.probe, nullptr};
  ConflictDetector detector;
};

TEST_F(ConflictDetectorTest, TakesEachUpdateOnceAsAFreshOne) {
  run(0);
  EXPECT_EQ(take(2), (Of{0, 0}));
  EXPECT_EQ(take(0), Of{}) << "nothing is new";
  run(1);
  run(2);
  EXPECT_EQ(take(4), (Of{1, 1, 2, 2, 0, 0})) << "those that were compared come behind";
}

TEST_F(ConflictDetectorTest, LeavesOutWhatWasRolledBack) {
  run(0);
  run(1);
  (void)take(4);
  clusters[0].executed = false;
  run(2);
  EXPECT_EQ(take(2), (Of{2, 2, 1, 1}));
}

TEST_F(ConflictDetectorTest, ComparesThoseOfOtherProcessesToo) {
  EXPECT_FALSE(detector.has_new_foreign());
  detector.add_foreign({.number = 4, .revision = 1, .time = 0.0});
  EXPECT_TRUE(detector.has_new_foreign());
  EXPECT_EQ(take(1), (Of{other_process}));
  EXPECT_FALSE(detector.has_new_foreign());
  run(0);
  EXPECT_EQ(take(2), (Of{0, 0, other_process}));
  detector.clear();
  EXPECT_EQ(take(0), Of{});
}

TEST_F(ConflictDetectorTest, KeepsConflictsWithOtherProcessesUntilTheyAreTaken) {
  detector.note_conflict(2, 40);
  detector.note_conflict(1, 41);
  EXPECT_EQ(detector.take_conflicts(),
            (std::vector<std::pair<std::uint32_t, std::uint32_t>>{{2, 40}, {1, 41}}));
  EXPECT_TRUE(detector.take_conflicts().empty());
}

}  // namespace
}  // namespace kinesphere::conflict_detector_test
