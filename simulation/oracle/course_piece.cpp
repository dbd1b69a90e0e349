#include "simulation/oracle/course_piece.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {

Coefficients to_bernstein(const Coefficients& power) {
  constexpr std::size_t degree = course_degree;
  static constexpr std::array<std::array<double, degree + 1>, degree + 1> binomial{
      {{1},
       {1, 1},
       {1, 2, 1},
       {1, 3, 3, 1},
       {1, 4, 6, 4, 1},
       {1, 5, 10, 10, 5, 1},
       {1, 6, 15, 20, 15, 6, 1}}};
  Coefficients bernstein{};
  for (std::size_t i = 0; i <= degree; ++i)
    for (std::size_t k = 0; k <= i; ++k) bernstein[i] += binomial[i][k] / binomial[degree][k] * power[k];
  return bernstein;
}

CubicPosition CubicPosition::of(const Segment& segment, double begin) {
  const State state = segment.state_at(begin);
  CubicPosition result{
      {state.position, state.velocity, segment.acceleration_at(begin) * 0.5, segment.jerk / 6.0}};
  const double since = std::abs(begin - segment.begin);
  const double jerk = norm_one(segment.jerk);
  const double acceleration = norm_one(segment.acceleration) + jerk * since;
  const double velocity = norm_one(segment.velocity) + acceleration * since;
  const double position = norm_one(segment.position) + velocity * since;
  result.error = {0x1p-50 * position, 0x1p-50 * velocity, 0x1p-50 * acceleration, 0x1p-50 * jerk};
  return result;
}

CubicPosition& CubicPosition::operator-=(const CubicPosition& other) {
  for (std::size_t k = 0; k < 4; ++k) {
    power[k] -= other.power[k];
    error[k] += other.error[k];
  }
  return *this;
}

double CoursePiece::gap(double s) const {
  const auto& c = centre.power;
  const Vec3 at = c[0] + (c[1] + (c[2] + c[3] * s) * s) * s;
  return is_pair ? norm(at) - radius : dot(wall.normal, at) - wall.offset - radius;
}

double CoursePiece::slope(double s) const {
  const auto& c = centre.power;
  const Vec3 at = c[0] + (c[1] + (c[2] + c[3] * s) * s) * s;
  return dot(at, c[1] + (c[2] * 2.0 + c[3] * (3.0 * s)) * s);
}

Coefficients CoursePiece::above(double level, double lower, double upper, double& error) const {
  const std::array<Vec3, 4> c = centre_over(lower, upper).power;
  Coefficients power{};
  double size = 0.0;
  if (is_pair) {
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 4; ++k) {
        power[i + k] += dot(c[i], c[k]);
        size += std::abs(dot(c[i], c[k]));
      }
    const double reach = std::max(0.0, radius + level);
    power[0] -= reach * reach;
    size += reach * reach;
  } else {
    for (std::size_t i = 0; i < 4; ++i) power[i] = dot(wall.normal, c[i]);
    for (const double p : power) size += std::abs(p);
    power[0] -= wall.offset + radius + level;
    size += std::abs(wall.offset) + radius + std::abs(level);
  }
  error = 0x1p-46 * size;
  return power;
}

Coefficients CoursePiece::slope_over(double lower, double upper, double& error) const {
  const CubicPosition c = centre_over(lower, upper);
  Coefficients power{};
  double size = 0.0, unsure = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 1; k < 4; ++k) {
      const auto factor = static_cast<double>(k);
      power[i + k - 1] += factor * dot(c.power[i], c.power[k]);
      const double first = norm_one(c.power[i]) + c.error[i], second = norm_one(c.power[k]) + c.error[k];
      size += factor * first * second;
      unsure += factor * (c.error[i] * second + first * c.error[k]);
    }
  error = 0x1p-46 * size + unsure;
  return power;
}

// The powers are expanded anew at `lower` instead of subdivided, which makes the error shrink with the
// distance.
CubicPosition CoursePiece::centre_over(double lower, double upper) const {
  const double length = upper - lower;
  const auto expanded = [&](const auto& c) {
    const auto value = c[0] + (c[1] + (c[2] + c[3] * lower) * lower) * lower;
    const auto slope = c[1] + (c[2] * 2.0 + c[3] * (3.0 * lower)) * lower;
    const auto curvature = c[2] + c[3] * (3.0 * lower);
    return std::decay_t<decltype(c)>{value, slope * length, curvature * (length * length),
                                     c[3] * (length * length * length)};
  };
  return {expanded(centre.power), expanded(centre.error)};
}

}  // namespace kinesphere
