// Random numbers that are identical on every machine: splitmix64 (Steele, Lea and Flood 2014), and vectors
// drawn by rejection. With one generator per query, a draw does not depend on the order of queries:
//   Vec3 force = Random::at(seed, body, interval).point_in_ball();
#pragma once

#include <cstdint>

#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// A generator of random numbers that gives the same sequence on every machine. Not for secrets.
class Random {
 public:
  /// Equal seeds give equal sequences.
  explicit constexpr Random(std::uint64_t seed) : counter_(seed) {}

  /// Returns the generator that depends on (seed, stream, index) alone; different triples give independent
  /// generators.
  static constexpr Random at(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
    return Random(mixed(mixed(mixed(seed) ^ stream) ^ index));
  }

  /// Returns 64 random bits.
  constexpr std::uint64_t bits() { return mixed(counter_ += step); }

  /// Returns a number in [0, 1), a multiple of 2^-53.
  constexpr double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// Returns a number in [lower, upper] (rounding may give `upper` itself).
  double uniform(double lower, double upper);

  /// Returns a point uniform in the ball of radius 1 around the origin. Cost: about 2 rejection tries.
  Vec3 point_in_ball();

  /// Returns a point uniform on the sphere of radius 1 around the origin.
  Vec3 unit_vector();

 private:
  static constexpr std::uint64_t step = 0x9e3779b97f4a7c15u;  // 2^64 / golden ratio

  static constexpr std::uint64_t mixed(std::uint64_t word) {
    word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9u;
    word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
    return word ^ (word >> 31);
  }

  std::uint64_t counter_;
};

}  // namespace kinesphere
