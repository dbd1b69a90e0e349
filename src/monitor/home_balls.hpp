// Balls in space, and which of them touch each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

#include "kinesphere/vec3.hpp"

namespace kinesphere {

struct HomeBall {
  Vec3 centre{};
  double radius = 0.0;  ///< length, > 0

  static void serialize(auto& self, auto& archive) {
    auto& [centre, radius] = self;
    archive(centre, radius);
  }
};
inline bool touch(const HomeBall& a, const HomeBall& b) {
  return norm(a.centre - b.centre) <= a.radius + b.radius;
}

/// Numbered balls in a hierarchy of grids. A ball is in the level whose cells are once or twice as wide as
/// it, in the cell of its centre.
class HomeBalls {
 public:
  /// Adds a ball. Precondition: there is none with this number.
  void add(std::uint32_t number, const HomeBall& ball);
  /// Removes a ball that add() has added.
  void remove(std::uint32_t number, const HomeBall& ball);
  /// Returns the numbers of the balls that touch this one, in ascending order. Cost: that of the cells around
  /// the ball in each level, at most that of all balls.
  std::vector<std::uint32_t> touching(const HomeBall& ball) const;

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct HashOfCell {
    std::size_t operator()(const Cell& cell) const;
  };
  struct Entry {
    std::uint32_t number;
    HomeBall ball;
  };
  struct Level {
    std::unordered_map<Cell, std::vector<Entry>, HashOfCell> cells;
    /// No cell with a ball has an index below or above these.
    Cell lowest{}, highest{};
  };

  std::map<int, Level> levels_;  ///< by the binary logarithm of the edge of their cells
};

}  // namespace kinesphere
