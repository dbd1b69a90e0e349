// The subspace tree finds what a plain list of bodies and cells finds.
#include "research/rivals/event_driven/subspace_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere::subspace_tree_test {
namespace {

constexpr std::uint64_t seed = 3103;

/// Returns up to eight cells near the origin, or anywhere, on one of a few levels.
CellRange random_cells(Random& random) {
  const bool far = random.bits() % 4 == 0;
  CellRange range{static_cast<int>(random.bits() % 6) * (far ? 8 : 1), {}, {}};
  const std::int64_t limit = std::int64_t{1} << (far ? Grids::coarsest_level - range.level : 4);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    range.first[axis] =
        static_cast<std::int64_t>(random.bits() % static_cast<std::uint64_t>(2 * limit)) - limit;
    range.last[axis] = range.first[axis];
    if (range.first[axis] < limit - 1 && random.bits() % 2 == 0) ++range.last[axis];
  }
  return range;
}

class MirroredTree {
 public:
  void set(std::uint32_t body, const CellRange& cells) {
    remove(body);
    cells.for_each_cell([&](const Cell& cell) { tree_.insert(cell, body); });
    bodies_[body] = cells;
  }
  void remove(std::uint32_t body) {
    const auto at = bodies_.find(body);
    if (at == bodies_.end()) return;
    at->second.for_each_cell([&](const Cell& cell) { tree_.erase(cell, body); });
    bodies_.erase(at);
  }

  void expect_same_neighbours(const CellRange& query) const {
    std::vector<std::uint32_t> visited;
    tree_.for_each_neighbour(query, [&](std::uint32_t body) { visited.push_back(body); });
    std::vector<std::uint32_t> expected;
    for (const auto& [body, cells] : bodies_) {
      // A body counts once for each of its cells that intersects one of the query.
      cells.for_each_cell([&, number = body](const Cell& cell) {
        if (intersect({cell.level, cell.index, cell.index}, query)) expected.push_back(number);
      });
    }
    // A coarse query cell may be intersected by a finer one of a body only; a coarse cell of a body by
    // several of the query: it counts once.
    std::sort(visited.begin(), visited.end());
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(visited, expected);
  }

  /// Checks that no cell is empty, and that all cells together hold what was inserted.
  void expect_no_empty_cells() const {
    std::size_t entries = 0;
    for (const auto& [cell, bodies] : tree_.cells()) {
      ASSERT_FALSE(bodies.empty());
      entries += bodies.size();
    }
    std::size_t expected = 0;
    for (const auto& [body, cells] : bodies_) cells.for_each_cell([&](const Cell&) { ++expected; });
    ASSERT_EQ(entries, expected);
  }

 private:
  SubspaceTree tree_;
  std::map<std::uint32_t, CellRange> bodies_;
};

TEST(SubspaceTree, answers_like_a_plain_list) {
  for (const std::uint32_t bodies : {4u, 60u, 400u}) {
    Random random = Random::at(seed, bodies, 0);
    MirroredTree tree;
    for (int action = 0; action < 4000; ++action) {
      const auto body = static_cast<std::uint32_t>(random.bits() % bodies);
      if (random.bits() % 4 == 0) {
        tree.remove(body);
      } else {
        tree.set(body, random_cells(random));
      }
      if (action % 4 == 0) tree.expect_same_neighbours(random_cells(random));
      if (action % 100 == 0) tree.expect_no_empty_cells();
      if (HasFatalFailure()) FAIL() << "seed " << seed << ", " << bodies << " bodies, action " << action;
    }
    for (std::uint32_t body = 0; body < bodies; ++body) tree.remove(body);
    tree.expect_no_empty_cells();
  }
}

TEST(SubspaceTree, finds_the_finest_in_the_coarsest_and_the_reverse) {
  SubspaceTree tree;
  const std::int64_t outermost = (std::int64_t{1} << Grids::coarsest_level) - 1;
  tree.insert({0, {outermost, 0, -1 - outermost}}, 1);
  tree.insert({Grids::coarsest_level, {0, 0, -1}}, 2);
  const auto found = [&](const Cell& cell) {
    std::vector<std::uint32_t> bodies;
    tree.for_each_neighbour({cell.level, cell.index, cell.index},
                            [&](std::uint32_t body) { bodies.push_back(body); });
    std::sort(bodies.begin(), bodies.end());
    return bodies;
  };
  EXPECT_EQ(found({Grids::coarsest_level, {0, 0, -1}}), (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(found({0, {outermost, 0, -1 - outermost}}), (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(found({0, {0, 0, -1}}), (std::vector<std::uint32_t>{2}));
  EXPECT_EQ(found({Grids::coarsest_level, {0, 0, 0}}), (std::vector<std::uint32_t>{}));
}

}  // namespace
}  // namespace kinesphere::subspace_tree_test
