// Arcs of polynomials of satellites that are drawn at random.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinesphere/approaches.hpp"

namespace kinesphere::program {

/// The numbers that PolynomialPaths refers to, in Chebyshev polynomials.
struct Arcs {
  std::size_t terms = 0;
  std::vector<double> errors{};
  std::vector<std::uint32_t> bodies{};
  std::vector<double> begins{}, ends{};
  std::vector<double> coefficients{};

  /// Refers to these numbers.
  PolynomialPaths paths() const;
  /// Returns the memory that the numbers take (bytes).
  std::size_t bytes() const;
};

/// Satellites of the earth on Kepler's ellipses, in km and seconds: as in catalogues most are low, in shells
/// of a few inclinations, and some go far out. An arc is at most 0.65 radians long at the speed of the
/// perigee. Fits are right to within a metre, the declared error.
Arcs satellite_arcs(std::uint32_t satellites, double seconds, std::uint64_t seed);

}  // namespace kinesphere::program
