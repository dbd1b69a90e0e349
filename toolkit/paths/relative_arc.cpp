#include "paths/relative_arc.hpp"

#include <cmath>

namespace kinesphere {
namespace {

/// Returns a body's position on an arc from `begin` to `end`: Clenshaw's scheme (Horner's for powers) whose
/// values are polynomials in x from 0 to 1. Lanes 0 to 2 are the axes, and lane 3 bounds the sizes of all
/// that is added, with which rounding grows.
VectorPolynomial position_over(const ArcTable& arcs, std::size_t arc, double begin, double end) {
  const bool is_chebyshev = arcs.basis() == PolynomialPaths::Basis::chebyshev;
  const double offset = arcs.local_time(arc, begin);
  const double scale = is_chebyshev ? 2.0 * (end - begin) / arcs.duration(arc) : end - begin;
  const double *x = arcs.coefficients(arc, 0), *y = arcs.coefficients(arc, 1), *z = arcs.coefficients(arc, 2);
  std::array<Lanes, PolynomialPaths::most_terms + 1> here, after;
  here[0] = after[0] = Lanes{};
  std::size_t count = 0;
  for (std::size_t k = arcs.terms(); k-- > 0;) {
    const double factor = is_chebyshev && k > 0 ? 2.0 : 1.0, minus = is_chebyshev ? 1.0 : 0.0;
    const double o = factor * offset, s = factor * scale;
    const Lanes of_here{o, o, o, std::abs(o)}, of_lower{s, s, s, std::abs(s)},
        of_after{-minus, -minus, -minus, minus};
    here[count] = after[count] = Lanes{};
    for (std::size_t power = count + 1; power-- > 0;) {
      const Lanes old = here[power];
      here[power] = of_here * old + of_after * after[power];
      if (power > 0) here[power] += of_lower * here[power - 1];
      after[power] = old;
    }
    const Vec3 c{x[k], y[k], z[k]};
    here[0] += Lanes{c.x, c.y, c.z, norm_one(c)};
    ++count;
  }
  VectorPolynomial result;
  result.terms = count;
  for (std::size_t k = 0; k < count; ++k) {
    result.power[k] = {here[k][0], here[k][1], here[k][2]};
    // At most 24 steps, each of which rounds a few times.
    result.error[k] = 0x1p-46 * here[k][3];
  }
  return result;
}

/// Replaces the coefficients of powers of x by those of powers of y, where x = lower + length y.
template <class Value>
void expand(std::span<Value> c, double lower, double length) {
  if (lower != 0.0)
    for (std::size_t first = 0; first + 1 < c.size(); ++first)
      for (std::size_t k = c.size() - 1; k-- > first;) c[k] += c[k + 1] * lower;
  double power = length;
  for (std::size_t k = 1; k < c.size(); ++k, power *= length) c[k] *= power;
}

}  // namespace

VectorPolynomial VectorPolynomial::over(double lower, double upper) const {
  VectorPolynomial result;
  result.terms = terms;
  for (std::size_t k = 0; k < terms; ++k) {
    result.power[k] = power[k];
    result.error[k] = error[k] + 0x1p-46 * norm_one(power[k]);
  }
  expand(std::span(result.power).first(terms), lower, upper - lower);
  expand(std::span(result.error).first(terms), lower, upper - lower);
  return result;
}

RelativeArc::RelativeArc(const ArcTable& arcs, std::size_t a, std::size_t b, double begin, double end)
    : a_(a), b_(b), begin_(begin), end_(end), relative_(position_over(arcs, a, begin, end)) {
  const VectorPolynomial other = position_over(arcs, b, begin, end);
  for (std::size_t k = 0; k < relative_.terms; ++k) {
    relative_.power[k] -= other.power[k];
    relative_.error[k] += other.error[k];
    rounding_ += 2.0 * relative_.error[k] + 0x1p-46 * norm_one(relative_.power[k]);
  }
}

double RelativeArc::distance(double x) const {
  Vec3 position{};
  for (std::size_t k = relative_.terms; k-- > 0;) position = position * x + relative_.power[k];
  return norm(position);
}

double RelativeArc::at(double x) const {
  Vec3 position{}, velocity{};
  for (std::size_t k = relative_.terms; k-- > 0;) {
    velocity = velocity * x + position;
    position = position * x + relative_.power[k];
  }
  return dot(position, velocity);
}

BernsteinCoefficients RelativeArc::over(double lower, double upper, double& error) const {
  const VectorPolynomial c = relative_.over(lower, upper);
  BernsteinCoefficients slope;
  slope.count = std::max(std::size_t{1}, 2 * c.terms - 2);
  std::fill_n(slope.values.begin(), slope.count, 0.0);
  error = 0.0;
  for (std::size_t k = 1; k < c.terms; ++k) {
    const auto factor = static_cast<double>(k);
    const Vec3 velocity = factor * c.power[k];
    const double velocity_size = norm_one(velocity), velocity_error = factor * c.error[k];
    for (std::size_t i = 0; i < c.terms; ++i) {
      slope.values[i + k - 1] += dot(c.power[i], velocity);
      // On each axis, so the errors count three times in a sum over the axes.
      error += norm_one(c.power[i]) * (velocity_error + 0x1p-44 * velocity_size) +
               c.error[i] * (velocity_size + 3.0 * velocity_error);
    }
  }
  // From powers to Bernstein coefficients: divided by binomial coefficients, then summed along Pascal's
  // triangle.
  const std::size_t degree = slope.count - 1;
  double binomial = 1.0;
  for (std::size_t k = 1; k <= degree; ++k) {
    binomial = binomial * static_cast<double>(degree - k + 1) / static_cast<double>(k);
    slope.values[k] /= binomial;
  }
  for (std::size_t first = 0; first < degree; ++first)
    for (std::size_t k = degree; k > first; --k) slope.values[k] += slope.values[k - 1];
  return slope;
}

}  // namespace kinesphere
