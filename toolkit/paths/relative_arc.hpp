// The relative position of two bodies while each is on one arc, as a polynomial with bounds on its rounding.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "paths/arc_table.hpp"

namespace kinesphere {

/// Position in powers of a part of time that runs from 0 to 1, and for each power a bound on its rounding (on
/// each axis).
struct VectorPolynomial {
  std::size_t terms = 0;
  std::array<Vec3, PolynomialPaths::most_terms> power;
  std::array<double, PolynomialPaths::most_terms> error;

  /// Returns the polynomial of the way from `lower` to `upper`.
  VectorPolynomial over(double lower, double upper) const;
};

/// Bernstein coefficients over [0, 1].
struct BernsteinCoefficients {
  static constexpr std::size_t most = 2 * PolynomialPaths::most_terms;
  std::array<double, most> values;
  std::size_t count = 0;

  const double* begin() const { return values.data(); }
  const double* end() const { return values.data() + count; }
};

class RelativeArc {
 public:
  /// Where the bodies are on the arcs `a` and `b` from `begin` to `end`, which are within both.
  RelativeArc(const ArcTable& arcs, std::size_t a, std::size_t b, double begin, double end);

  std::size_t first_arc() const { return a_; }
  std::size_t second_arc() const { return b_; }
  double time(double x) const { return x >= 1.0 ? end_ : std::min(begin_ + x * (end_ - begin_), end_); }
  double begin() const { return begin_; }
  double end() const { return end_; }
  double distance(double x) const;
  /// Bound on the error of distance() by rounding.
  double rounding() const { return rounding_; }

  // Half the derivative of the squared distance, as SlopeSigns needs it.
  double at(double x) const;
  BernsteinCoefficients over(double lower, double upper, double& error) const;

 private:
  std::size_t a_, b_;
  double begin_, end_;
  VectorPolynomial relative_;
  double rounding_ = 0.0;
};

}  // namespace kinesphere
