// Vec3, a vector of three doubles, and Box, the axis-aligned box between two of them.
//
// Arithmetic functions in public headers are inlined everywhere, even without optimisation. Compilers emit
// out-of-line copies of other inline functions, and the linker keeps one of them for the whole program: the
// library would then compute with code compiled with its user's flags, which may round differently.
#pragma once

#include <algorithm>
#include <cmath>

namespace kinesphere {

/// A vector or a point, in any consistent unit.
struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  /// Return the part along axis 0, 1 or 2.
  constexpr double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

  /// Change all three parts.
  [[gnu::always_inline]] constexpr Vec3& operator+=(const Vec3& other) {
    return *this = {x + other.x, y + other.y, z + other.z};
  }
  [[gnu::always_inline]] constexpr Vec3& operator-=(const Vec3& other) {
    return *this = {x - other.x, y - other.y, z - other.z};
  }
  [[gnu::always_inline]] constexpr Vec3& operator*=(double factor) {
    return *this = {x * factor, y * factor, z * factor};
  }

  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

/// Return the result for each of the three parts.
[[gnu::always_inline]] constexpr Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
[[gnu::always_inline]] constexpr Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
[[gnu::always_inline]] constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
[[gnu::always_inline]] constexpr Vec3 operator*(Vec3 a, double factor) { return a *= factor; }
[[gnu::always_inline]] constexpr Vec3 operator*(double factor, Vec3 a) { return a *= factor; }
[[gnu::always_inline]] constexpr Vec3 operator/(const Vec3& a, double divisor) {
  return {a.x / divisor, a.y / divisor, a.z / divisor};
}

/// Return the scalar and the vector product, and the length of a vector and its square.
[[gnu::always_inline]] constexpr double dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[gnu::always_inline]] constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[gnu::always_inline]] constexpr double norm_squared(const Vec3& a) { return dot(a, a); }
[[gnu::always_inline]] inline double norm(const Vec3& a) { return std::sqrt(norm_squared(a)); }

/// Returns |x| + |y| + |z|, the inexpensive norm from which rounding margins are computed.
[[gnu::always_inline]] inline double norm_one(const Vec3& a) {
  return std::abs(a.x) + std::abs(a.y) + std::abs(a.z);
}

/// Returns true if no part is NaN or infinite.
inline bool is_finite(const Vec3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// All points p with lower <= p <= upper on every axis.
struct Box {
  Vec3 lower{};
  Vec3 upper{};

  friend constexpr bool operator==(const Box&, const Box&) = default;
};

}  // namespace kinesphere
