// Overlapping boxes, against all pairs.
#include "window/box_pairs.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "kinesphere/random.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Box around(const Vec3& middle, double half) {
  const Vec3 room = Vec3{1.0, 1.0, 1.0} * half;
  return {middle - room, middle + room};
}

std::vector<Box> random_boxes(std::uint64_t seed, double side) {
  Random random(seed);
  std::vector<Box> boxes;
  for (int k = 0; k < 300; ++k) {
    const double half = k % 50 == 0 ? 6.0 : random.uniform(0.0, 0.6);
    boxes.push_back(
        around({random.uniform(0, side), random.uniform(0, side), random.uniform(0, side)}, half));
  }
  return boxes;
}

bool overlap(const Box& a, const Box& b, const Vec3& shift) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.lower[axis] + shift[axis] > b.upper[axis] || b.lower[axis] > a.upper[axis] + shift[axis])
      return false;
  return true;
}

/// Each box by itself.
std::vector<std::uint32_t> owners_of(const std::vector<Box>& boxes) {
  std::vector<std::uint32_t> owners(boxes.size());
  std::iota(owners.begin(), owners.end(), 0u);
  return owners;
}

TEST(BoxPairs, AreAllThatOverlap) {
  for (const double size : {0.1, 1.0, 30.0}) {
    const std::vector<Box> boxes = random_boxes(3, 16.0);
    Pairs expected;
    for (std::uint32_t a = 0; a < boxes.size(); ++a)
      for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
        if (overlap(boxes[a], boxes[b], {})) expected.emplace_back(a, b);
    EXPECT_EQ(overlapping_pairs(boxes, owners_of(boxes), Space(WorldDefinition{}), size), expected) << size;
    EXPECT_GT(expected.size(), 300u);
  }
}

TEST(BoxPairs, AreFoundInAllImages) {
  WorldDefinition definition{.box = Box{{0, 0, 0}, {16, 16, 16}}};
  definition.periodic = {true, true, false};
  for (const double size : {0.3, 1.1, 7.0, 40.0}) {
    const std::vector<Box> boxes = random_boxes(4, 16.0);
    Pairs expected;
    for (std::uint32_t a = 0; a < boxes.size(); ++a)
      for (std::uint32_t b = a + 1; b < boxes.size(); ++b) {
        bool found = false;
        for (const double x : {-16.0, 0.0, 16.0})
          for (const double y : {-16.0, 0.0, 16.0}) found = found || overlap(boxes[a], boxes[b], {x, y, 0.0});
        if (found) expected.emplace_back(a, b);
      }
    EXPECT_EQ(overlapping_pairs(boxes, owners_of(boxes), Space(definition), size), expected) << size;
  }
}

TEST(BoxPairs, AreOfDifferentOwners) {
  const std::vector<Box> boxes = random_boxes(7, 16.0);
  for (const std::uint32_t count : {1u, 2u, 20u}) {
    std::vector<std::uint32_t> owners(boxes.size());
    for (std::uint32_t k = 0; k < owners.size(); ++k) owners[k] = k % count;
    Pairs expected = overlapping_pairs(boxes, owners_of(boxes), Space(WorldDefinition{}), 1.0);
    std::erase_if(expected, [&](const auto& pair) { return owners[pair.first] == owners[pair.second]; });
    EXPECT_EQ(overlapping_pairs(boxes, owners, Space(WorldDefinition{}), 1.0), expected) << count;
    EXPECT_EQ(expected.empty(), count == 1);
  }
}

TEST(BoxPairs, MayBeEverywhereAndFarAway) {
  std::vector<Box> boxes{around({0, 0, 0}, 1.0), around({1e300, 0, 0}, 1.0), around({1e300, 0, 0}, 2.0)};
  boxes.push_back({{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}});
  const Pairs expected{{0, 3}, {1, 2}, {1, 3}, {2, 3}};
  EXPECT_EQ(overlapping_pairs(boxes, owners_of(boxes), Space(WorldDefinition{}), 1.0), expected);
  EXPECT_TRUE(overlapping_pairs({}, {}, Space(WorldDefinition{}), 1.0).empty());
}

}  // namespace
}  // namespace kinesphere
