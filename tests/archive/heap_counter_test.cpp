// Memory behind values: allocations of vectors and sets, at any depth.
#include "archive/heap_counter.hpp"
#include "archive/fields.hpp"

#include <gtest/gtest.h>

namespace kinesphere::heap_counter_test {
namespace {

struct Tree {
  std::vector<Tree> children;
  double value = 0.0;
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [below, number] = self;
    archive(below, number);
  }
};

TEST(HeapCounter, CountsCapacitiesAndNodesHoweverDeep) {
  std::vector<double> numbers;
  EXPECT_EQ(heap_bytes(numbers, 5, Event{}, std::optional<Event>(Event{})), 0u);
  numbers.reserve(100);
  EXPECT_EQ(heap_bytes(numbers), 816u);
  EXPECT_EQ(heap_bytes(std::pair(numbers, 1)), 0u) << "an empty copy has none";
  EXPECT_EQ(heap_bytes(std::set<int>{1, 2, 3}), 3u * (4 + 4 * sizeof(void*) + 16));
  Tree tree;
  tree.children.resize(2);
  tree.children[0].children.resize(3);
  EXPECT_EQ(heap_bytes(tree), 5 * sizeof(Tree) + 2 * 16);
  EXPECT_EQ(heap_bytes(std::optional(tree), std::array{tree, tree}), 3 * heap_bytes(tree));
}

}  // namespace
}  // namespace kinesphere::heap_counter_test
