// Polynomials in quadruple precision, and the first place where one is no longer positive: slow arithmetic to
// compare certificates with. It has twice the digits of a double, so products of doubles are exact, and its
// errors are 2^-60 of the library's margins.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "number/infinity.hpp"

namespace kinesphere::exact {

__extension__ typedef __float128 Wide;

inline Wide abs(Wide x) { return x < 0 ? -x : x; }
inline Wide max(Wide x, Wide y) { return x < y ? y : x; }
inline Wide min(Wide x, Wide y) { return y < x ? y : x; }

/// Three steps of Newton's method from a double, scaled into the range of doubles by an even power of two.
inline Wide sqrt(Wide x) {
  if (!(x > 0)) return 0;
  Wide scale = 1;
  while (x * scale * scale > 0x1p600) scale *= 0x1p-300;
  while (x * scale * scale < 0x1p-600) scale *= 0x1p300;
  const Wide scaled = x * scale * scale;
  Wide root = std::sqrt(static_cast<double>(scaled));
  for (int k = 0; k < 3; ++k) root = (root + scaled / root) / 2;
  return root / scale;
}

/// c[0] + c[1] d + ... + c[4] d^4.
struct Polynomial {
  std::array<Wide, 5> c{};

  Wide at(Wide d) const { return c[0] + d * (c[1] + d * (c[2] + d * (c[3] + d * c[4]))); }
  Wide slope_at(Wide d) const { return c[1] + d * (2 * c[2] + d * (3 * c[3] + d * 4 * c[4])); }

  /// Returns the polynomial as one of d - start.
  Polynomial from(Wide start) const {
    Polynomial moved = *this;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 3; k + 1 > i; --k) moved.c[k] += start * moved.c[k + 1];
    return moved;
  }
};

inline Polynomial operator+(const Polynomial& p, const Polynomial& q) {
  Polynomial sum;
  for (std::size_t k = 0; k < 5; ++k) sum.c[k] = p.c[k] + q.c[k];
  return sum;
}

inline Polynomial operator-(const Polynomial& p) { return {{-p.c[0], -p.c[1], -p.c[2], -p.c[3], -p.c[4]}}; }

inline Polynomial operator-(const Polynomial& p, const Polynomial& q) { return p + -q; }

/// The square of a polynomial of degree 2.
inline Polynomial squared(const Polynomial& q) {
  const auto& [c, b, a, none3, none4] = q.c;
  return {{c * c, 2 * b * c, b * b + 2 * a * c, 2 * a * b, a * a}};
}

namespace detail {

using Coefficients = std::array<Wide, 5>;

/// Returns the coefficients of p on [0, width] in the Bernstein basis: p lies between the least and the
/// greatest.
inline Coefficients bernstein(const Polynomial& p, Wide width) {
  static constexpr int binomial[5][5] = {
      {1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 2, 1, 0, 0}, {1, 3, 3, 1, 0}, {1, 4, 6, 4, 1}};
  Coefficients b{};
  Wide power = 1;
  for (std::size_t k = 0; k < 5; ++k, power *= width)
    for (std::size_t i = k; i < 5; ++i) b[i] += p.c[k] * power * binomial[i][k] / binomial[4][k];
  return b;
}

inline int sign_changes(const Coefficients& b) {
  int changes = 0;
  for (std::size_t i = 1; i < 5; ++i) changes += (b[i] > 0) != (b[i - 1] > 0);
  return changes;
}

/// Returns the only zero of p in [low, high]. Precondition: p(low) > 0 >= p(high).
inline Wide only_zero(const Polynomial& p, Wide low, Wide high) {
  Wide guess = (low + high) / 2;
  for (int round = 0; round < 300 && high - low > 0x1p-104 * high; ++round) {
    const Wide value = p.at(guess);
    (value > 0 ? low : high) = guess;
    const Wide step = value / p.slope_at(guess);
    const Wide newton = guess - step;
    guess = newton > low && newton < high ? newton : (low + high) / 2;
    if (abs(step) < 0x1p-104 * high && guess == newton) return guess;
  }
  return high;
}

inline Wide first_zero_between(const Polynomial& p, Wide low, Wide high) {
  const Coefficients b = bernstein(p.from(low), high - low);
  if (b[0] <= 0) return low;
  const int changes = sign_changes(b);
  if (changes == 0) return infinity;
  if (changes == 1) return only_zero(p, low, high);
  const Wide middle = (low + high) / 2;
  if (high - low < 0x1p-90 * high) return middle;
  const Wide zero = first_zero_between(p, low, middle);
  return zero <= middle ? zero : first_zero_between(p, middle, high);
}

}  // namespace detail

/// Returns the first d in [0, end] with p(d) <= 0, or +infinity. Uses Bernstein coefficients over intervals
/// that double in length, so that early zeros are as precise as late ones.
inline Wide first_zero(const Polynomial& p, Wide end) {
  if (p.c[0] <= 0) return 0;
  const auto certainly_positive_until = [&](Wide d) {
    return d * (abs(p.c[1]) + d * (abs(p.c[2]) + d * (abs(p.c[3]) + d * abs(p.c[4])))) < p.c[0];
  };
  Wide low = end;
  while (!certainly_positive_until(low)) low /= 4;
  while (low < end) {
    const Wide high = min(2 * low, end);
    const Wide zero = detail::first_zero_between(p, low, high);
    if (zero <= high) return zero;
    low = high;
  }
  return infinity;
}

}  // namespace kinesphere::exact
