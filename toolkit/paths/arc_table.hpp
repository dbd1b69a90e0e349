// The arcs of known paths: where a body is on an arc, and how much an arc bends.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kinesphere/approaches.hpp"
#include "parallel/thread_pool.hpp"

namespace kinesphere {

/// Four numbers, in vectors of the processor where the compiler knows such types.
#if defined(__GNUC__)
using Lanes [[gnu::vector_size(32)]] = double;
#else
struct Lanes {
  double at[4];

  double& operator[](std::size_t lane) { return at[lane]; }
  double operator[](std::size_t lane) const { return at[lane]; }
  friend Lanes operator+(Lanes a, const Lanes& b) { return a += b; }
  friend Lanes operator+(Lanes a, double b) { return a += {b, b, b, b}; }
  friend Lanes operator*(Lanes a, const Lanes& b) {
    for (std::size_t lane = 0; lane < 4; ++lane) a[lane] *= b[lane];
    return a;
  }
  Lanes& operator+=(const Lanes& other) {
    for (std::size_t lane = 0; lane < 4; ++lane) at[lane] += other[lane];
    return *this;
  }
  Lanes& operator-=(const Lanes& other) {
    for (std::size_t lane = 0; lane < 4; ++lane) at[lane] -= other[lane];
    return *this;
  }
};
#endif

/// Returns what is wrong with the paths, if anything is, in the words of an error of `call`.
std::optional<Error> first_error(const char* call, const PolynomialPaths& paths, PoolLease& lease);

/// The paths, with what is known of each arc and each body. Precondition: there is no first_error().
class ArcTable {
 public:
  /// Positions are computed this many at a time.
  static constexpr std::size_t lanes = 4;
  using Times = std::array<double, lanes>;
  using Positions = std::array<Vec3, lanes>;

  ArcTable(const PolynomialPaths& paths, PoolLease& lease);

  std::size_t bodies() const { return firsts_.size() - 1; }
  /// The arcs of a body are those from first_of(body) to before first_of(body + 1).
  std::size_t first_of(std::size_t body) const { return firsts_[body]; }
  double begin(std::size_t arc) const { return paths_.begins[arc]; }
  double end(std::size_t arc) const { return paths_.ends[arc]; }
  double duration(std::size_t arc) const { return end(arc) - begin(arc); }
  /// Returns the first arc of the body that ends after t, or first_of(body + 1).
  std::size_t arc_after(std::size_t body, double t) const;
  /// True if an arc that begins when the one before it ends is of the same body.
  bool continues(std::size_t arc) const;

  PolynomialPaths::Basis basis() const { return paths_.basis; }
  std::size_t terms() const { return paths_.terms; }
  /// The coefficients of an axis.
  const double* coefficients(std::size_t arc, std::size_t axis) const {
    return paths_.coefficients.data() + (3 * arc + axis) * paths_.terms;
  }
  /// Returns the arc's own time, as its basis has it.
  double local_time(std::size_t arc, double t) const;
  Positions positions_at(std::size_t arc, const Times& times) const;
  State state_at(std::size_t arc, double t) const;

  /// Bound on the third derivative of the arc's position (length / time^3).
  double jerk(std::size_t arc) const { return jerks_[arc]; }
  /// How far the body may be from what positions_at() returns: its declared error, and rounding.
  double error(std::size_t body) const { return errors_[body]; }
  double declared_error(std::size_t body) const { return paths_.errors.empty() ? 0.0 : paths_.errors[body]; }
  /// Largest component of any velocity (an upper bound).
  double largest_speed() const { return largest_speed_; }

 private:
  PolynomialPaths paths_;
  std::vector<std::size_t> firsts_;
  std::vector<double> jerks_;
  std::vector<double> errors_;
  double largest_speed_ = 0.0;
};

}  // namespace kinesphere
