// A block of boxes compares them all at once as it would one by one, whatever the numbers are.
#include "research/grid/box_block.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere::box_block_test {
namespace {

constexpr std::uint64_t seed = 3101;
constexpr int rounds = 20000;

/// Boxes lie within this many steps of each other: that is half of what can be told from 16 bits.
constexpr int span = 16000;

/// Whole numbers, of which boxes keep the last 16 bits.
struct WideBox {
  std::array<int, 3> lower;
  std::array<int, 3> upper;

  StepBox low_bits() const {
    const auto low = [](const std::array<int, 3>& steps) {
      return std::array{static_cast<StepBox::Step>(steps[0]), static_cast<StepBox::Step>(steps[1]),
                        static_cast<StepBox::Step>(steps[2])};
    };
    return {low(lower), low(upper)};
  }
};

bool have_a_step_in_common(const WideBox& a, const WideBox& b) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (std::max(a.lower[axis], b.lower[axis]) > std::min(a.upper[axis], b.upper[axis])) return false;
  return true;
}

/// Few enough for edges to coincide often.
int awkward(Random& random) {
  static const std::vector<int> values{0, 1, 2, 4095, 4096, 4097, span - 1, span};
  return values[random.bits() % values.size()];
}
int everyday(Random& random) { return static_cast<int>(random.uniform(0.0, span)); }

WideBox draw(Random& random, int origin, int (*number)(Random&)) {
  WideBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int a = origin + number(random);
    const int b = origin + number(random);
    std::tie(box.lower[axis], box.upper[axis]) = std::minmax({a, b});
  }
  return box;
}

/// A box that touches the other one, or misses it by one step, on one axis.
WideBox beside(Random& random, int origin, const WideBox& other) {
  WideBox box = draw(random, origin, everyday);
  const std::size_t axis = random.bits() % 3;
  const int apart = random.bits() % 2 == 0 ? 0 : 1;
  if (random.bits() % 2 == 0) {
    box.lower[axis] = other.upper[axis] + apart;
    box.upper[axis] = box.lower[axis] + 100;
  } else {
    box.upper[axis] = other.lower[axis] - apart;
    box.lower[axis] = box.upper[axis] - 100;
  }
  return box;
}

/// A block of which not always all places are in use, and what should be in those.
struct Mirrored {
  BoxBlock block;
  std::vector<WideBox> boxes;

  void push(const WideBox& box) {
    block.put(boxes.size(), box.low_bits(), static_cast<std::uint32_t>(boxes.size()) + 7);
    boxes.push_back(box);
  }
  BoxBlock::Places in_use() const { return BoxBlock::first(boxes.size()); }
  BoxBlock::Places overlapping(const WideBox& query) const {
    BoxBlock::Places places = 0;
    for (std::size_t place = 0; place < boxes.size(); ++place)
      if (have_a_step_in_common(boxes[place], query)) places |= 1u << place;
    return places;
  }
};

using Draw = WideBox (*)(Random&, int origin, Mirrored&);

class BoxBlocks : public testing::TestWithParam<std::pair<const char*, Draw>> {};

TEST_P(BoxBlocks, overlap_what_has_a_step_in_common_with_the_query) {
  std::array<int, BoxBlock::width + 1> found{};
  for (std::uint64_t round = 0; round < rounds; ++round) {
    Random random = Random::at(seed, round, 0);
    const int origin = static_cast<int>(random.bits() % 200000) - 100000;
    Mirrored mirrored;
    const WideBox box = GetParam().second(random, origin, mirrored);
    const BoxBlock::Places expected = mirrored.overlapping(box);
    const BoxBlock::Places found_at_once = mirrored.block.overlapping(BoxBlock::Query(box.low_bits()));
    ASSERT_EQ(found_at_once & mirrored.in_use(), expected) << "seed " << seed << ", round " << round;
    ASSERT_EQ(found_at_once, mirrored.block.overlapping_one_by_one(box.low_bits()))
        << "seed " << seed << ", round " << round;
    ++found[static_cast<std::size_t>(std::popcount(expected))];
  }
  for (std::size_t count = 0; count < 3; ++count) EXPECT_GT(found[count], 0) << count;
}

template <int (*number)(Random&)>
WideBox draw_all(Random& random, int origin, Mirrored& mirrored) {
  for (auto count = random.bits() % (BoxBlock::width + 1); count > 0; --count)
    mirrored.push(draw(random, origin, number));
  return draw(random, origin, number);
}

WideBox draw_neighbours(Random& random, int origin, Mirrored& mirrored) {
  const WideBox query = draw(random, origin, everyday);
  for (std::size_t place = 0; place < BoxBlock::width; ++place) mirrored.push(beside(random, origin, query));
  return query;
}

INSTANTIATE_TEST_SUITE_P(OfAllKinds, BoxBlocks,
                         testing::Values(std::pair{"everyday", &draw_all<everyday>},
                                         std::pair{"awkward", &draw_all<awkward>},
                                         std::pair{"touching", &draw_neighbours}),
                         [](const auto& kind) { return std::string(kind.param.first); });

TEST(BoxBlock, finds_who_stands_in_the_first_places) {
  const StepBox box{{1, 2, 3}, {4, 5, 6}};
  BoxBlock block;
  for (std::uint32_t body = 0; body < BoxBlock::width; ++body) {
    EXPECT_EQ(block.find(body + 20), BoxBlock::width);
    block.put(body, box, body + 20);
    EXPECT_EQ(block.find(body + 20), body);
    EXPECT_EQ(block.find(body + 20, body + 1), body);
    EXPECT_EQ(block.find(body + 20, body), BoxBlock::width);
    EXPECT_EQ(block.body(body), body + 20);
    EXPECT_EQ(block.box(body), box);
    EXPECT_EQ(block.overlapping(BoxBlock::Query(box)), (2u << body) - 1u);
  }
  block.put(2, {{10, 10, 10}, {11, 11, 11}}, 50);
  EXPECT_EQ(block.find(50), 2u);
  EXPECT_EQ(block.find(22), BoxBlock::width);
  EXPECT_EQ(block.overlapping(BoxBlock::Query(box)), 0xffu & ~4u);
  EXPECT_EQ(BoxBlock::first(0), 0u);
  EXPECT_EQ(BoxBlock::first(3), 7u);
  EXPECT_EQ(BoxBlock::first(BoxBlock::width), 0xffu);
}

TEST(BoxBlock, fills_two_cache_lines) {
  EXPECT_EQ(sizeof(BoxBlock), 128u);
  EXPECT_EQ(alignof(BoxBlock), 64u);
}

}  // namespace
}  // namespace kinesphere::box_block_test
