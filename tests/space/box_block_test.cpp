// A block of boxes compares them all at once as it would one by one, whatever the numbers are.
#include "space/box_block.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "archive/archive.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere {
namespace {

constexpr std::uint64_t seed = 3101;
constexpr int rounds = 20000;

StepBox everything() {
  return {{StepBox::least, StepBox::least, StepBox::least},
          {StepBox::largest, StepBox::largest, StepBox::largest}};
}

/// Few enough for edges to coincide often.
StepBox::Step awkward(Random& random) {
  static const std::vector<StepBox::Step> values{
      StepBox::least, StepBox::least + 1, -4096, -1, 0, 1, 4095, 4096, 8191, StepBox::largest};
  return values[random.bits() % values.size()];
}
StepBox::Step everyday(Random& random) { return static_cast<StepBox::Step>(random.uniform(-5000.0, 5000.0)); }

StepBox draw(Random& random, StepBox::Step (*number)(Random&)) {
  StepBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const StepBox::Step a = number(random);
    const StepBox::Step b = number(random);
    std::tie(box.lower[axis], box.upper[axis]) = std::minmax({a, b});
  }
  return box;
}

/// A box that touches the other one, or misses it by one step, on one axis.
StepBox beside(Random& random, const StepBox& other) {
  StepBox box = draw(random, everyday);
  const std::size_t axis = random.bits() % 3;
  const int apart = random.bits() % 2 == 0 ? 0 : 1;
  if (random.bits() % 2 == 0) {
    box.lower[axis] = StepBox::clamped(other.upper[axis] + apart);
    box.upper[axis] = StepBox::clamped(box.lower[axis] + 100);
  } else {
    box.upper[axis] = StepBox::clamped(other.lower[axis] - apart);
    box.lower[axis] = StepBox::clamped(box.upper[axis] - 100);
  }
  return box;
}

bool have_a_step_in_common(const StepBox& a, const StepBox& b) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (std::max(a.lower[axis], b.lower[axis]) > std::min(a.upper[axis], b.upper[axis])) return false;
  return true;
}

/// Some places of a block in use, and what should be in them.
struct Mirrored {
  BoxBlock block;
  std::array<std::optional<StepBox>, BoxBlock::width> boxes;

  void put(std::size_t place, const StepBox& box) {
    block.put(place, box, static_cast<std::uint32_t>(place) + 7);
    boxes[place] = box;
  }
  void clear(std::size_t place) {
    block.clear(place);
    boxes[place].reset();
  }
  BoxBlock::Places overlapping(const StepBox& query) const {
    BoxBlock::Places places = 0;
    for (std::size_t place = 0; place < BoxBlock::width; ++place)
      if (boxes[place] && have_a_step_in_common(*boxes[place], query)) places |= 1u << place;
    return places;
  }
};

class BoxBlocks : public testing::TestWithParam<std::pair<const char*, StepBox (*)(Random&, Mirrored&)>> {};

TEST_P(BoxBlocks, overlap_what_has_a_step_in_common_with_the_query) {
  std::array<int, BoxBlock::width + 1> found{};
  for (std::uint64_t round = 0; round < rounds; ++round) {
    Random random = Random::at(seed, round, 0);
    Mirrored mirrored;
    const StepBox box = GetParam().second(random, mirrored);
    const BoxBlock::Query query(box);
    const BoxBlock::Places expected = mirrored.overlapping(box);
    ASSERT_EQ(mirrored.block.overlapping(query), expected) << "seed " << seed << ", round " << round;
    ASSERT_EQ(mirrored.block.overlapping_one_by_one(box), expected) << "seed " << seed << ", round " << round;
    ++found[static_cast<std::size_t>(std::popcount(expected))];
  }
  for (std::size_t count = 0; count < 3; ++count) EXPECT_GT(found[count], 0) << count;
}

template <StepBox::Step (*number)(Random&)>
StepBox draw_all(Random& random, Mirrored& mirrored) {
  for (std::size_t place = 0; place < BoxBlock::width; ++place) {
    if (random.bits() % 4 != 0) mirrored.put(place, draw(random, number));
    if (random.bits() % 8 == 0) mirrored.clear(place);
  }
  return draw(random, number);
}

StepBox draw_neighbours(Random& random, Mirrored& mirrored) {
  const StepBox query = draw(random, everyday);
  for (std::size_t place = 0; place < BoxBlock::width; ++place) mirrored.put(place, beside(random, query));
  return query;
}

INSTANTIATE_TEST_SUITE_P(OfAllKinds, BoxBlocks,
                         testing::Values(std::pair{"everyday", &draw_all<everyday>},
                                         std::pair{"awkward", &draw_all<awkward>},
                                         std::pair{"touching", &draw_neighbours}),
                         [](const auto& kind) { return std::string(kind.param.first); });

TEST(BoxBlock, has_free_places_that_overlap_nothing) {
  BoxBlock block;
  const BoxBlock::Query all(everything());
  EXPECT_EQ(block.overlapping(all), 0u);
  EXPECT_EQ(block.overlapping_one_by_one(everything()), 0u);
  for (std::size_t place = 0; place < BoxBlock::width; ++place) {
    EXPECT_TRUE(block.is_free(place));
    block.put(place, everything(), 5);
    EXPECT_FALSE(block.is_free(place));
    EXPECT_EQ(block.overlapping(all), 1u << place);
    EXPECT_EQ(block.box(place), everything());
    EXPECT_EQ(block.body(place), 5u);
    block.clear(place);
    EXPECT_TRUE(block.is_free(place));
    EXPECT_EQ(block.overlapping(all), 0u);
  }
}

TEST(BoxBlock, comes_back_from_an_archive_with_its_free_places) {
  BoxBlock block, back;
  const StepBox box{{-1, 0, 2}, {5, StepBox::largest, 3}};
  block.put(2, box, 9);
  ByteWriter writer;
  writer(block);
  ByteReader reader(writer.bytes());
  reader(back);
  EXPECT_FALSE(reader.failed());
  EXPECT_EQ(back.overlapping(BoxBlock::Query(everything())), 4u);
  EXPECT_EQ(back.box(2), box);
  EXPECT_EQ(back.body(2), 9u);
  for (std::size_t place = 0; place < BoxBlock::width; ++place) EXPECT_EQ(back.is_free(place), place != 2);
}

TEST(StepBox, clamps_steps_that_are_too_many) {
  EXPECT_EQ(StepBox::clamped(32766), StepBox::largest);
  EXPECT_EQ(StepBox::clamped(32767), StepBox::largest);
  EXPECT_EQ(StepBox::clamped(std::int64_t{1} << 50), StepBox::largest);
  EXPECT_EQ(StepBox::clamped(-32768), StepBox::least);
  EXPECT_EQ((StepBox{{0, -5, 2}, {3, 4, 2}}.extent()), 9);
}

TEST(BoxBlock, visits_places_once_and_in_ascending_order) {
  for (BoxBlock::Places places = 0; places < 1u << BoxBlock::width; ++places) {
    std::vector<std::size_t> expected, visited;
    for (std::size_t place = 0; place < BoxBlock::width; ++place)
      if ((places >> place) % 2 == 1) expected.push_back(place);
    BoxBlock::for_each(places, [&visited](std::size_t place) { visited.push_back(place); });
    EXPECT_EQ(visited, expected);
  }
}

}  // namespace
}  // namespace kinesphere
