// The grid finds what a plain list of boxes finds, each box once.
#include "research/measures/box_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere::box_grid_test {
namespace {

Box random_box(Random& random, int octaves) {
  const double half = std::ldexp(random.uniform(), -static_cast<int>(random.bits() % 20) * octaves / 20);
  const Vec3 centre = 8.0 * random.point_in_ball();
  return {centre - Vec3{half, half, random.uniform() * half},
          centre + Vec3{half, random.uniform() * half, half}};
}

bool overlap(const Box& a, const Box& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.lower[axis] > b.upper[axis] || b.lower[axis] > a.upper[axis]) return false;
  return true;
}

TEST(BoxGrid, AnswersLikeAPlainList) {
  BoxGrid grid;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const int octaves = seed % 2 == 0 ? 1 : 20;
    std::vector<BoxGrid::Entry> entries;
    for (std::uint32_t body = 0; body < seed * 5; ++body)
      entries.push_back({random_box(random, octaves), body});
    // Points, and boxes that touch.
    for (std::uint32_t k = 0; k < seed / 4; ++k)
      entries.push_back(
          {{entries[k].box.upper, entries[k].box.upper}, static_cast<std::uint32_t>(entries.size())});
    grid.build(entries);
    using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
    Pairs found_pairs, expected_pairs;
    grid.for_each_pair([&](std::uint32_t a, std::uint32_t b) { found_pairs.emplace_back(a, b); });
    std::sort(found_pairs.begin(), found_pairs.end());
    for (const BoxGrid::Entry& a : entries)
      for (const BoxGrid::Entry& b : entries)
        if (b.body < a.body && overlap(a.box, b.box)) expected_pairs.emplace_back(a.body, b.body);
    ASSERT_EQ(found_pairs, expected_pairs) << "seed " << seed;
  }
}

}  // namespace
}  // namespace kinesphere::box_grid_test
