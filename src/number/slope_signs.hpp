// The signs of a polynomial's slope, in the order of time: with them extrema are found and none is left out.
#pragma once

#include <algorithm>

namespace kinesphere {

/// Goes through a slope's signs. In each part, Bernstein coefficients tell that the slope has one sign or
/// that it rises or falls throughout; other parts are divided.
///
/// Slope: at(s) is the slope; over(lower, upper, error) returns its Bernstein coefficients for the way from
/// lower to upper, times any positive factor, and sets `error` to a bound on the rounding in them.
/// Visitor: rises(s), falls(s) and stays(s) are called where the slope becomes positive, negative, or so
/// small that rounding hides its sign, perhaps again and again with the sign that it has; s never decreases.
template <class Slope, class Visitor>
class SlopeSigns {
 public:
  SlopeSigns(const Slope& slope, Visitor& visitor) : slope_(slope), visitor_(visitor) {}

  void visit(double lower, double upper) { visit(lower, upper, 0); }

 private:
  static constexpr int max_depth = 60;

  void visit(double lower, double upper, int depth) {
    double error = 0.0;
    const auto c = slope_.over(lower, upper, error);
    const auto [least, largest] = std::minmax_element(c.begin(), c.end());
    if (*least > error) return visitor_.rises(lower);
    if (*largest < -error) return visitor_.falls(lower);
    if (is_monotone(c, error, 1.0)) return turn(c, error, lower, upper, 1.0);
    if (is_monotone(c, error, -1.0)) return turn(c, error, lower, upper, -1.0);
    // The factor keeps a slope that stays near `error` from being divided for ever.
    const bool hidden = std::max(-*least, *largest) <= 4.0 * error;
    if (hidden || depth == max_depth) return visitor_.stays(lower);
    const double middle = 0.5 * (lower + upper);
    visit(lower, middle, depth + 1);
    visit(middle, upper, depth + 1);
  }

  /// Passes a part in which the slope rises (sign 1) or falls (sign -1).
  template <class Coefficients>
  void turn(const Coefficients& c, double error, double lower, double upper, double sign) {
    const auto becomes = [&](double value, double s) { value > 0.0 ? visitor_.rises(s) : visitor_.falls(s); };
    const double front = sign * *c.begin(), back = sign * *(c.end() - 1);
    if (front < -error) becomes(-sign, lower);
    if (back < -error) return;
    const double s = root(lower, upper, sign);
    visitor_.stays(s);
    if (back > error) becomes(sign, s);
  }

  /// Returns the s at which the slope changes its sign, or the end of [lower, upper] that is nearest to that.
  double root(double lower, double upper, double sign) const {
    if (sign * slope_.at(lower) >= 0.0) return lower;
    for (;;) {
      const double middle = 0.5 * (lower + upper);
      if (middle <= lower || middle >= upper) return upper;
      (sign * slope_.at(middle) < 0.0 ? lower : upper) = middle;
    }
  }

  template <class Coefficients>
  static bool is_monotone(const Coefficients& c, double error, double sign) {
    return std::adjacent_find(c.begin(), c.end(), [=](double here, double next) {
             return !(sign * (next - here) > 2.0 * error);
           }) == c.end();
  }

  const Slope& slope_;
  Visitor& visitor_;
};

}  // namespace kinesphere
