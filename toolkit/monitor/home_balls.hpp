// Balls in space, and which of them touch each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "kinesphere/vec3.hpp"

namespace kinesphere {

struct HomeBall {
  Vec3 centre{};
  double radius = 0.0;  ///< length, > 0; 0: no ball
};
inline bool touch(const HomeBall& a, const HomeBall& b) {
  return norm(a.centre - b.centre) <= a.radius + b.radius;
}

/// Numbered balls in a hierarchy of grids. A ball is in the level whose cells are one to four times as wide
/// as it, in the cell of its centre. The cells of all levels share one hash table.
class HomeBalls {
 public:
  /// Adds a ball. Precondition: there is none with this number.
  void add(std::uint32_t number, const HomeBall& ball);
  /// Removes the ball with this number. Precondition: there is one.
  void remove(std::uint32_t number);
  /// Returns the numbers of the balls that touch this one, in ascending order. Cost: that of the cells around
  /// the ball in each level, at most that of all balls.
  std::vector<std::uint32_t> touching(const HomeBall& ball) const;

 private:
  using Cell = std::array<std::int64_t, 3>;
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  struct Entry {
    HomeBall ball{};
    std::uint32_t next = none;  ///< number of the next ball whose cell has the same hash
  };
  struct Level {
    std::size_t balls = 0;
    /// No cell with a ball has an index below or above these.
    Cell lowest{}, highest{};
  };
  struct Range {
    int exponent;
    Cell lowest, highest;
  };

  static Cell cell_at(const Vec3& place, int exponent);
  std::size_t bucket_of(int exponent, const Cell& cell) const;
  std::size_t bucket_of(const HomeBall& ball) const;
  void grow();

  std::vector<Entry> entries_;        ///< by number
  std::vector<std::uint32_t> first_;  ///< first ball of each bucket; a power of two of them
  std::map<int, Level> levels_;       ///< by the binary logarithm of the edge of their cells
  std::size_t balls_ = 0;
};

}  // namespace kinesphere
