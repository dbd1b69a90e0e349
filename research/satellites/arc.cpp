#include "research/satellites/arc.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {
namespace {

/// Factor of the part of gravity that comes from J2: 3/2 J2 G M R^2.
constexpr double j2_factor = 1.5 * earth::oblateness * earth::gravity * earth::radius * earth::radius;

/// Coefficients of a power series, by powers.
using Series = std::array<double, Arc::order + 1>;

/// Returns the k-th coefficient of a product.
double product(const Series& a, const Series& b, int k) {
  double sum = 0.0;
  for (int j = 0; j <= k; ++j) sum += a[static_cast<std::size_t>(j)] * b[static_cast<std::size_t>(k - j)];
  return sum;
}

}  // namespace

Vec3 gravity_at(const Vec3& position) {
  const double squared = norm_squared(position);
  const double inverse = 1.0 / squared;
  const double cube = inverse / std::sqrt(squared);
  const double j2 = j2_factor * inverse * cube;
  const double upright = 5.0 * position.z * position.z * inverse;
  const double level = -earth::gravity * cube - j2 * (1.0 - upright);
  return {level * position.x, level * position.y, (level - 2.0 * j2) * position.z};
}

double largest_gravity(double distance) {
  const double inverse = 1.0 / (distance * distance);
  // The part that comes from J2 is largest above the poles.
  return (earth::gravity + 2.0 * j2_factor * inverse) * inverse * (1.0 + 0x1p-40);
}

// Computes the coefficients of x'' = F x, y'' = F y, z'' = G z with
//   F = -G M r^-3 - c (r^-5 - 5 z^2 r^-7),
//   G = F - 2 c r^-5,
//   c = j2_factor,
// each from those before it: of products by the sum of products, of powers p = s^a, s = r^2, from
//   s p' = a s' p.
Arc::Arc(const State& in_the_middle, double middle) : middle_(middle) {
  Series x{}, y{}, z{}, s{}, zz{}, r3{}, r5{}, r7{}, f{}, g{};
  const auto& [position, velocity] = in_the_middle;
  x[0] = position.x, y[0] = position.y, z[0] = position.z;
  x[1] = velocity.x, y[1] = velocity.y, z[1] = velocity.z;
  for (int k = 0; k <= order - 2; ++k) {
    const auto at = static_cast<std::size_t>(k);
    zz[at] = product(z, z, k);
    s[at] = product(x, x, k) + product(y, y, k) + zz[at];
    if (k == 0) {
      const double inverse = 1.0 / s[0];
      r3[0] = inverse / std::sqrt(s[0]);
      r5[0] = r3[0] * inverse;
      r7[0] = r5[0] * inverse;
    } else {
      double sum3 = 0.0, sum5 = 0.0, sum7 = 0.0;
      for (int j = 0; j < k; ++j) {
        const double part = s[static_cast<std::size_t>(k - j)];
        const double rest = -j, up = -(k - j);
        sum3 += (1.5 * up + rest) * part * r3[static_cast<std::size_t>(j)];
        sum5 += (2.5 * up + rest) * part * r5[static_cast<std::size_t>(j)];
        sum7 += (3.5 * up + rest) * part * r7[static_cast<std::size_t>(j)];
      }
      const double divisor = 1.0 / (k * s[0]);
      r3[at] = sum3 * divisor;
      r5[at] = sum5 * divisor;
      r7[at] = sum7 * divisor;
    }
    f[at] = -earth::gravity * r3[at] - j2_factor * (r5[at] - 5.0 * product(zz, r7, k));
    g[at] = f[at] - 2.0 * j2_factor * r5[at];
    const double divisor = 1.0 / ((k + 1) * (k + 2));
    x[at + 2] = product(x, f, k) * divisor;
    y[at + 2] = product(y, f, k) * divisor;
    z[at + 2] = product(z, g, k) * divisor;
  }

  double power = 1.0;  // the (k - 3)-th power of half_length
  double jerk = 0.0;
  for (int k = 3; k <= order; ++k) {
    const auto at = static_cast<std::size_t>(k);
    jerk += norm(Vec3{x[at], y[at], z[at]}) * (k * (k - 1) * (k - 2)) * power;
    power *= half_length;
  }
  // The factor covers the roundings.
  largest_jerk_ = jerk * (1.0 + 0x1p-40);
  double change = 0.0;  // change of the squared distance
  power = half_length;
  for (int k = 1; k <= order - 2; ++k, power *= half_length)
    change += std::abs(s[static_cast<std::size_t>(k)]) * power;
  constexpr double spare = 1e-3;
  nearest_ = std::sqrt(std::max(0.0, s[0] - change)) - spare;
  farthest_ = std::sqrt(s[0] + change) + spare;
  largest_acceleration_ = largest_gravity(nearest_);
  for (std::size_t k = 0; k < terms_.size(); ++k) terms_[k] = {x[k], y[k], z[k]};
}

Vec3 Arc::position_at(double time) const {
  const double t = time - middle_;
  Vec3 position = terms_[order];
  for (std::size_t k = order; k-- > 0;) position = terms_[k] + position * t;
  return position;
}

State Arc::state_at(double time) const {
  const double t = time - middle_;
  Vec3 position = terms_[order];
  Vec3 velocity{};
  for (std::size_t k = order; k-- > 0;) {
    velocity = position + velocity * t;
    position = terms_[k] + position * t;
  }
  return {position, velocity};
}

Vec3 Arc::acceleration_at(double time) const {
  const double t = time - middle_;
  Vec3 acceleration{};
  for (int k = order; k >= 2; --k)
    acceleration = terms_[static_cast<std::size_t>(k)] * (k * (k - 1)) + acceleration * t;
  return acceleration;
}

}  // namespace kinesphere
