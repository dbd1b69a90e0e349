// Regions tile space for all sets of points, and cost about the same where possible.
#include "distributed/partition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "archive/archive.hpp"
#include "archive/fields.hpp"
#include "distributed/bisection.hpp"
#include "kinesphere/random.hpp"
#include "number/infinity.hpp"

namespace kinesphere::partition_test {
namespace {

struct Cloud {
  std::vector<Vec3> positions;
  std::vector<double> costs;

  void add(const Vec3& position, double cost = 1.0) {
    positions.push_back(position);
    costs.push_back(cost);
  }
};

using MakePoint = std::function<Vec3(Random&)>;

/// Returns this rank's part of `count` points.
Cloud cloud_of(const Communicator& communicator, std::uint64_t count, const MakePoint& make_point) {
  const auto ranks = static_cast<std::uint64_t>(communicator.ranks());
  Cloud cloud;
  for (std::uint64_t k = 0; k < count; ++k) {
    Random random = Random::at(1, 2, k);
    const Vec3 point = make_point(random);
    if (random.bits() % ranks == static_cast<std::uint64_t>(communicator.rank())) cloud.add(point);
  }
  return cloud;
}

Vec3 in_cube(Random& random) {
  const double x = random.uniform();
  const double y = random.uniform();
  return {x, y, random.uniform()};
}

/// Returns all coordinates at which regions begin or end, and the ones just before and after.
std::vector<double> coordinates_at_cuts(const Partition& partition, int axis) {
  std::vector<double> coordinates{0.0};
  for (int rank = 0; rank < partition.ranks(); ++rank) {
    const Box& region = partition.region_of(rank);
    for (const double side : {region.lower[axis], region.upper[axis]}) {
      if (!std::isfinite(side)) continue;
      coordinates.push_back(side);
      for (const double to : {-infinity, infinity})
        if (std::isfinite(std::nextafter(side, to))) coordinates.push_back(std::nextafter(side, to));
    }
  }
  return coordinates;
}

/// Draws points at random, points of a cloud, and points at the ends of regions.
class Draw {
 public:
  Draw(const Partition& partition, const Cloud& cloud) : cloud_(cloud) {
    for (int axis = 0; axis < 3; ++axis) at_cuts_.push_back(coordinates_at_cuts(partition, axis));
  }
  Vec3 operator()(Random& random) const {
    Vec3 point = random.uniform(0.0, 3.0) * random.point_in_ball();
    if (random.bits() % 8 == 0) point *= 1e300;
    if (!cloud_.positions.empty() && random.bits() % 2 == 0)
      point = cloud_.positions[random.bits() % cloud_.positions.size()];
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<double>& coordinates = at_cuts_[static_cast<std::size_t>(axis)];
      if (random.bits() % 4 == 0) point[axis] = coordinates[random.bits() % coordinates.size()];
    }
    return point;
  }

 private:
  const Cloud& cloud_;
  std::vector<std::vector<double>> at_cuts_;
};

bool contains(const Box& region, const Vec3& point) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(region.lower[axis] <= point[axis] && point[axis] < region.upper[axis])) return false;
  return true;
}

/// Expects that the owner of a point is the only rank with it in its region.
void expect_one_owner(const Partition& partition, const Vec3& point) {
  const int owner = partition.owner_of(point);
  for (int rank = 0; rank < partition.ranks(); ++rank)
    ASSERT_EQ(contains(partition.region_of(rank), point), rank == owner)
        << rank << ": " << point.x << " " << point.y << " " << point.z;
}

/// Checks `count` points.
void expect_tiling(const Partition& partition, const Cloud& cloud, std::uint64_t count) {
  const Draw draw(partition, cloud);
  for (std::uint64_t k = 0; k < count; ++k) {
    Random random = Random::at(3, 4, k);
    expect_one_owner(partition, draw(random));
    if (testing::Test::HasFatalFailure()) return;
  }
}

/// Returns the cost of the points of all ranks in this rank's region.
double own_cost(Communicator& communicator, const Partition& partition, const Cloud& cloud) {
  std::vector<double> costs(static_cast<std::size_t>(partition.ranks()));
  for (std::size_t k = 0; k < cloud.positions.size(); ++k)
    costs[static_cast<std::size_t>(partition.owner_of(cloud.positions[k]))] += cloud.costs[k];
  communicator.sum(costs);
  return costs[static_cast<std::size_t>(communicator.rank())];
}

void expect_the_same_everywhere(Communicator& communicator, const Partition& partition) {
  ByteWriter writer;
  for (int rank = 0; rank < partition.ranks(); ++rank) writer(partition.region_of(rank));
  for (const auto& bytes : communicator.gather(writer.bytes()))
    EXPECT_TRUE(std::ranges::equal(bytes, writer.bytes()));
}

/// Makes all checks of a partition that do not depend on the points. Returns its imbalance.
double check(Communicator& communicator, const Partition& partition, const Cloud& cloud,
             std::uint64_t tries) {
  EXPECT_EQ(partition.ranks(), communicator.ranks());
  expect_the_same_everywhere(communicator, partition);
  expect_tiling(partition, cloud, tries);
  double sum[] = {own_cost(communicator, partition, cloud)};
  const double most = -communicator.least(-sum[0]);
  communicator.sum(sum);
  return sum[0] > 0.0 ? most * communicator.ranks() / sum[0] : 1.0;
}

/// Chooses partitions, by Zoltan if this build has it and without it, and checks both. Returns the larger
/// imbalance.
double check(const Cloud& cloud, std::uint64_t tries = 5'000) {
  Communicator communicator;
  const Partition chosen = Partition::choose(communicator, cloud.positions, cloud.costs);
  const Partition bisected = Partition::along(bisect(communicator, cloud.positions, cloud.costs));
  return std::max(check(communicator, chosen, cloud, tries), check(communicator, bisected, cloud, tries));
}

TEST(Partition, IsAllOfSpaceByDefault) {
  const Partition partition(4);
  EXPECT_EQ(partition.ranks(), 4);
  EXPECT_EQ(partition.owner_of({1e308, -1e308, 0}), 0);
  EXPECT_EQ(partition.region_of(0).upper.x, infinity);
  for (int rank = 1; rank < 4; ++rank)
    EXPECT_LT(partition.region_of(rank).upper.x, partition.region_of(rank).lower.x);
  expect_tiling(partition, {}, 1000);
}

TEST(Partition, HasOneOwnerForEachOfAMillionPoints) {
  const Communicator communicator;
  EXPECT_LT(check(cloud_of(communicator, 20'000, in_cube), 1'000'000), 1.02);
}

TEST(Partition, OfSmoothClouds) {
  const Communicator communicator;
  const auto ball = [](Random& random) { return random.point_in_ball(); };
  const auto dense_centre = [](Random& random) {
    const Vec3 point = random.point_in_ball();
    return norm_squared(point) * point + Vec3{100, -5, 0};
  };
  const auto sphere = [](Random& random) { return random.unit_vector(); };
  const auto needle = [](Random& random) {
    const Vec3 point = random.point_in_ball();
    return Vec3{1e-3 * point.x, 50 * point.y, 1e-3 * point.z};
  };
  for (const MakePoint& make_point :
       {MakePoint(ball), MakePoint(dense_centre), MakePoint(sphere), MakePoint(needle)})
    EXPECT_LT(check(cloud_of(communicator, 20'000, make_point)), 1.1);
}

TEST(Partition, OfUnequalCosts) {
  const Communicator communicator;
  for (const double unit : {1e-6, 1.0, 1e6}) {
    Cloud cloud = cloud_of(communicator, 20'000, in_cube);
    for (std::size_t k = 0; k < cloud.costs.size(); ++k) {
      const auto [x, y, z] = cloud.positions[k];
      cloud.costs[k] = unit * (1 + 9 * x) * (1 + 9 * y) * (1 + 9 * z);
    }
    EXPECT_LT(check(cloud), 1.1);
  }
}

TEST(Partition, OfPointsThatCostNothing) {
  const Communicator communicator;
  Cloud cloud = cloud_of(communicator, 5'000, in_cube);
  std::fill(cloud.costs.begin(), cloud.costs.end(), 0.0);
  EXPECT_EQ(check(cloud), 1.0);
  // A tenth of the points has all the cost.
  for (std::size_t k = 0; k < cloud.costs.size(); k += 10) cloud.costs[k] = 1.0;
  EXPECT_LT(check(cloud), 1.1);
}

TEST(Partition, OfPointsOfOneRank) {
  const Communicator communicator;
  for (int owner = 0; owner < communicator.ranks(); ++owner) {
    Cloud cloud;
    for (std::uint64_t k = 0; communicator.rank() == owner && k < 5'000; ++k) {
      Random random = Random::at(5, 6, k);
      cloud.add(in_cube(random));
    }
    EXPECT_LT(check(cloud, 2'000), 1.02);
  }
}

TEST(Partition, OfNoPoints) { EXPECT_EQ(check({}), 1.0); }

TEST(Partition, OfPointsAtOnePlace) {
  const Communicator communicator;
  for (const double x : {0.0, 0.5, -7.0, 1e300}) {
    const auto make_point = [x](Random&) { return Vec3{x, x, -x}; };
    EXPECT_DOUBLE_EQ(check(cloud_of(communicator, 1'000, make_point)), communicator.ranks());
  }
}

TEST(Partition, OfFewPoints) {
  const Communicator communicator;
  for (std::uint64_t count = 1; count <= 2 * static_cast<std::uint64_t>(communicator.ranks()); ++count) {
    // With as many points as ranks or fewer, no rank has more than two.
    const double imbalance = check(cloud_of(communicator, count, in_cube), 2'000);
    EXPECT_LE(imbalance * static_cast<double>(count) / communicator.ranks(),
              2.0 + static_cast<double>(count) / communicator.ranks());
  }
}

TEST(Partition, OfPointsOnALineOrPlane) {
  const Communicator communicator;
  for (int axis = 0; axis < 3; ++axis) {
    const auto on_line = [axis](Random& random) {
      Vec3 point{3, -4, 5};
      point[axis] = random.uniform();
      return point;
    };
    const auto on_plane = [axis](Random& random) {
      Vec3 point = in_cube(random);
      point[axis] = 0.3;
      return point;
    };
    EXPECT_LT(check(cloud_of(communicator, 10'000, on_line)), 1.02);
    EXPECT_LT(check(cloud_of(communicator, 10'000, on_plane)), 1.02);
  }
}

TEST(Partition, OfALattice) {
  const Communicator communicator;
  const int ranks = communicator.ranks();
  for (const int side : {2, 3, 8, 20}) {
    Cloud cloud;
    int number = 0;
    for (int x = 0; x < side; ++x)
      for (int y = 0; y < side; ++y)
        for (int z = 0; z < side; ++z)
          if (number++ % ranks == communicator.rank()) cloud.add({double(x), double(y), double(z)});
    const double imbalance = check(cloud);
    // Layers are not divided, so half of one may be on the wrong side of each cut.
    if (side == 20) {
      EXPECT_LT(imbalance, 1.2);
    }
    if ((ranks == 2 || ranks == 4) && side % 2 == 0) {
      EXPECT_EQ(imbalance, 1.0) << side;
    }
  }
}

TEST(Partition, OfHugeAndTinyCoordinates) {
  const Communicator communicator;
  for (const double size : {1e60, 1e12, 1e-12, 1e-60}) {
    const auto make_point = [size](Random& random) {
      const Vec3 point = in_cube(random);
      return size * (2.0 * point - Vec3{1, 1, 1});
    };
    EXPECT_LT(check(cloud_of(communicator, 10'000, make_point)), 1.02) << size;
  }
  const auto far_away = [](Random& random) { return in_cube(random) + Vec3{1e12, -1e12, 1e12}; };
  EXPECT_LT(check(cloud_of(communicator, 10'000, far_away)), 1.1);
}

TEST(Partition, OfClustersOfCoincidingPoints) {
  const Communicator communicator;
  // Many places on a line, with the middle of the points on one side or the other.
  for (int places = 10; places < 50; ++places) {
    const auto make_point = [places](Random& random) {
      return Vec3{0, 0, std::floor(random.uniform() * places)};
    };
    const double imbalance = check(cloud_of(communicator, 5'000, make_point), 100);
    EXPECT_LT(imbalance, 1.05 + static_cast<double>(communicator.ranks()) / places) << places;
  }
}

}  // namespace
}  // namespace kinesphere::partition_test
