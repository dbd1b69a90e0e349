// Ghosts are the balls of a core that are copies: another process handles them as its own, with all that is
// around them. Each process works out what happens to a ghost, as far as it knows what is around it. Ghosts
// keeps what they need to find out whether they agree: the course of each ball, a hash of all that has
// happened to it; which ghosts have been neighbours of balls of one's own; and where the safe regions of
// these have been.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kinesphere/vec3.hpp"
#include "number/bit_cast.hpp"

namespace kinesphere::core {

class Ghosts {
 public:
  /// A safe region that a ball has had.
  struct Region {
    std::uint32_t ball;
    Vec3 centre;   ///< (length)
    double reach;  ///< (length)
  };

  /// Makes room for balls below this number, which are no ghosts.
  explicit Ghosts(std::uint32_t numbers) : balls_(numbers) {}

  void set_ghost(std::uint32_t ball) { balls_[ball].is_ghost = true; }
  bool is_ghost(std::uint32_t ball) const { return balls_[ball].is_ghost; }
  /// Sets the radius of the first safe region (length) of a ball that arrives.
  void set_first_radius(std::uint32_t ball, double radius) { balls_[ball].first_radius = radius; }
  /// Returns that radius; 0 if the ball has to look how far others are.
  double first_radius_of(std::uint32_t ball) const { return balls_[ball].first_radius; }

  /// Adds numbers to the course of a ball.
  template <class... Numbers>
  void note(std::uint32_t ball, Numbers... numbers) {
    ((balls_[ball].course = mixed(balls_[ball].course, numbers)), ...);
    ++balls_[ball].notes;
  }
  void note_neighbours(std::uint32_t a, std::uint32_t b) {
    if (is_ghost(a) == is_ghost(b)) return;
    balls_[is_ghost(a) ? a : b].is_neighbour = true;
  }
  void note_region(std::uint32_t ball, const Vec3& centre, double reach) {
    if (!is_ghost(ball)) regions_.push_back({ball, centre, reach});
  }

  /// Returns true if this ghost has been a neighbour of a ball of one's own.
  bool is_neighbour(std::uint32_t ghost) const { return balls_[ghost].is_neighbour; }
  std::uint64_t course_of(std::uint32_t ball) const { return balls_[ball].course; }
  /// Returns how often something happened to a ball.
  std::uint32_t notes_of(std::uint32_t ball) const { return balls_[ball].notes; }
  /// Returns the safe regions that balls of one's own have got.
  std::span<const Region> regions() const { return regions_; }

 private:
  struct Entry {
    std::uint64_t course = 0;
    double first_radius = 0.0;
    std::uint32_t notes = 0;
    bool is_ghost = false;
    bool is_neighbour = false;
  };

  template <class Number>
  static std::uint64_t mixed(std::uint64_t course, Number number) {
    std::uint64_t word;
    if constexpr (sizeof(Number) == 8)
      word = bit_cast<std::uint64_t>(number);
    else if constexpr (sizeof(Number) == 4)
      word = bit_cast<std::uint32_t>(number);
    else
      word = number;
    const std::uint64_t product = (course ^ word) * 0x9E3779B97F4A7C15u;
    return product ^ product >> 29;
  }

  std::vector<Entry> balls_;  ///< by number
  std::vector<Region> regions_;
};

}  // namespace kinesphere::core
