// Certificates between two clusters, which stand as long as neither is executed again.
#include "speculation/cross_cluster_pairs.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace kinesphere::cross_cluster_pairs_test {
namespace {

class CrossClusterPairsTest : public testing::Test {
 protected:
  CrossClusterPairsTest() {
    for (int body = 0; body < 6; ++body) bodies_.add({.radius = 1.0}, 0.0);
    clusters_.form(std::vector<PairCertificate>{{0.1, 0, 1, 0, 0}, {0.2, 2, 3, 0, 0}, {0.3, 4, 5, 0, 0}},
                   bodies_, slots_);
    for (Cluster& cluster : clusters_.all()) {
      cluster.executed = true;
      cluster.runs = 1;
    }
    pairs_.note(clusters_[0], clusters_[1], {1.0, 0, 2, 0, 0});
    pairs_.note(clusters_[1], clusters_[2], {2.0, 3, 4, 0, 0});
    pairs_.note(clusters_[0], clusters_[2], {3.0, 1, 5, 0, 0});
  }
  std::set<double> standing() const {
    std::set<double> times;
    pairs_.for_each_standing(clusters_,
                             [&](const PairCertificate& pair) { times.insert(pair.failure_time); });
    return times;
  }

  Bodies bodies_{WorldDefinition{}};
  std::vector<BatchState::BodySlot> slots_;
  Clusters clusters_;
  CrossClusterPairs pairs_;
};

TEST_F(CrossClusterPairsTest, StandAtFirst) { EXPECT_EQ(standing(), (std::set<double>{1.0, 2.0, 3.0})); }

TEST_F(CrossClusterPairsTest, OfAClusterThatIsRolledBackFall) {
  clusters_[1].executed = false;
  EXPECT_EQ(standing(), (std::set<double>{3.0}));
}

TEST_F(CrossClusterPairsTest, OfAnEarlierRunFall) {
  clusters_[2].runs = 2;
  EXPECT_EQ(standing(), (std::set<double>{1.0}));
  pairs_.note(clusters_[1], clusters_[2], {4.0, 3, 4, 0, 0});
  EXPECT_EQ(standing(), (std::set<double>{1.0, 4.0}));
}

TEST_F(CrossClusterPairsTest, OfAMergedClusterFall) {
  clusters_.merge(clusters_[0], clusters_[1]);
  EXPECT_EQ(standing(), (std::set<double>{3.0}))
      << "the cluster that is merged into is rolled back elsewhere";
  pairs_.clear();
  EXPECT_EQ(standing(), (std::set<double>{}));
}

}  // namespace
}  // namespace kinesphere::cross_cluster_pairs_test
