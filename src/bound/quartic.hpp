// The paper's way to the time of a colliding event: eq 10, a quartic, solved numerically or in closed form.
//
//   double t = meeting_time_numeric(a, b, now, now + 10);
//
// Nothing here is certified: an answer may be late by what rounding does to the coefficients, which for a
// grazing pair is enough to miss the meeting. earliest_meeting (bound.hpp) is the safe way; these are what it
// is compared with.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "kinesphere/bound.hpp"

namespace kinesphere {

/// c[0] + c[1] d + ... + c[4] d^4, with d the time from now.
template <class Number>
using QuarticOf = std::array<Number, 5>;
using Quartic = QuarticOf<double>;

/// |c_a - c_b|^2 - (rho_a + rho_b + distance)^2, d = t - from (paper, eq 10, for any plan and growth).
/// It is positive while the bounds are farther apart than `distance` >= 0. Needs both report times <= from.
Quartic meeting_quartic(const Bound& a, const Bound& b, double from, double distance = 0.0);

/// The first root in [0, end], +infinity when there is none, 0 when c[0] <= 0. Between the roots of its
/// derivative a polynomial is monotone, so each piece has at most one root, which Newton's method finds,
/// safeguarded by bisection. Cost: about 0.4 us, twice that of earliest_meeting.
double first_root_numeric(const Quartic& quartic, double end = std::numeric_limits<double>::infinity());

/// As first_root_numeric with end = +infinity, by Ferrari's resolvent cubic. Uses cbrt, acos and cos of
/// the machine's mathematical library, so results may differ between machines: for comparison only.
double first_root_closed_form(const Quartic& quartic);

/// The time of the colliding event of two bounds, as earliest_meeting but for its certainty: in
/// [from, until], or +infinity.
double meeting_time_numeric(const Bound& a, const Bound& b, double from, double until, double distance = 0.0);
double meeting_time_closed_form(const Bound& a, const Bound& b, double from, double until,
                                double distance = 0.0);

/// The numerical solution in any precision: `Number` may be wider than double.
namespace polynomial {

template <class Number, std::size_t size>
Number value(const std::array<Number, size>& c, Number d) {
  Number sum = c[size - 1];
  for (std::size_t k = size - 1; k-- > 0;) sum = sum * d + c[k];
  return sum;
}

template <class Number, std::size_t size>
std::array<Number, size - 1> derivative(const std::array<Number, size>& c) {
  std::array<Number, size - 1> slope{};
  for (std::size_t k = 1; k < size; ++k) slope[k - 1] = static_cast<Number>(k) * c[k];
  return slope;
}

/// The one root in [low, high], where c is monotone and changes its sign.
template <class Number, std::size_t size>
Number only_root(const std::array<Number, size>& c, Number low, Number high) {
  constexpr int max_rounds = 200;
  constexpr Number precision = std::numeric_limits<Number>::epsilon();
  const auto slope = derivative(c);
  const bool falls = value(c, low) > 0;
  Number guess = (low + high) / 2;
  for (int round = 0; round < max_rounds && high - low > precision * high; ++round) {
    const Number height = value(c, guess);
    ((height > 0) == falls ? low : high) = guess;
    const Number step = -height / value(slope, guess);
    const Number newton = guess + step;
    // Not inside also where the slope is zero or overflows.
    const bool inside = newton > low && newton < high;
    if (inside && std::abs(step) <= precision * newton) return newton;
    guess = inside ? newton : (low + high) / 2;
  }
  return guess;
}

/// Roots in increasing order.
template <class Number>
struct Roots {
  std::array<Number, 4> at{};
  std::size_t count = 0;

  void add(Number root) { at[count++] = root; }
};

/// The first `most` roots in (0, end] at which the sign changes.
template <class Number, std::size_t size>
Roots<Number> roots(const std::array<Number, size>& c, Number end, std::size_t most = size - 1) {
  Roots<Number> found;
  if constexpr (size == 2) {
    const Number root = -c[0] / c[1];
    if (root > 0 && root <= end) found.add(root);
  } else {
    Roots<Number> pieces = roots(derivative(c), end);
    if (pieces.count == 0 || pieces.at[pieces.count - 1] < end) pieces.add(end);
    Number low = 0;
    for (std::size_t k = 0; k < pieces.count && found.count < most; ++k) {
      const Number high = pieces.at[k];
      if ((value(c, low) > 0) != (value(c, high) > 0)) found.add(only_root(c, low, high));
      low = high;
    }
  }
  return found;
}

/// No root is larger: from here on the term of the highest degree outweighs all others.
template <class Number, std::size_t size>
Number root_limit(const std::array<Number, size>& c) {
  std::size_t degree = size - 1;
  while (degree > 0 && c[degree] == 0) --degree;
  const auto outweighed = [&](Number d) {
    Number others = 0;
    for (std::size_t k = 0; k < degree; ++k) others = (others + std::abs(c[k])) / d;
    return others < std::abs(c[degree]);
  };
  constexpr Number longest = std::numeric_limits<float>::max();
  Number d = 1;
  while (d < longest && !outweighed(d)) d *= 2;
  return d;
}

template <class Number>
Number first_root(const QuarticOf<Number>& c, Number end) {
  constexpr Number infinity = std::numeric_limits<Number>::infinity();
  if (!(c[0] > 0)) return 0;
  if (end == infinity) end = root_limit(c);
  const Roots<Number> found = roots(c, end, 1);
  return found.count > 0 ? found.at[0] : infinity;
}

}  // namespace polynomial
}  // namespace kinesphere
