// Time to collision.
#include "simulation/tracks/time_to_collision.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "number/infinity.hpp"
#include "simulation/oracle/course_piece.hpp"

namespace kinesphere {
namespace {

/// A polynomial over [0, 1] in powers, with a bound on the rounding in its coefficients.
struct Polynomial {
  static constexpr std::size_t terms = 11;
  std::array<double, terms> power{};
  double error = 0.0;

  /// Adds factor * a * b.
  void add_product(double factor, const Polynomial& a, const Polynomial& b) {
    double size = 0.0, size_a = 0.0, size_b = 0.0;
    for (std::size_t i = 0; i < terms; ++i) {
      size_a += std::abs(a.power[i]);
      size_b += std::abs(b.power[i]);
      for (std::size_t k = 0; i + k < terms; ++k) {
        const double term = factor * a.power[i] * b.power[k];
        power[i + k] += term;
        size += std::abs(term);
      }
    }
    error += 0x1p-46 * size + std::abs(factor) * (a.error * (size_b + b.error) + size_a * b.error);
  }

  struct Range {
    double lower, upper;
  };
  /// Returns the least and the largest Bernstein coefficient, which enclose the polynomial.
  Range range() const {
    Range range{infinity, -infinity};
    for (std::size_t i = 0; i < terms; ++i) {
      // The ratios of binomials: (i over k) / (degree over k).
      double coefficient = 0.0, ratio = 1.0;
      for (std::size_t k = 0; k <= i; ++k) {
        coefficient += ratio * power[k];
        ratio *= static_cast<double>(i - k) / static_cast<double>(std::max<std::size_t>(terms - 1 - k, 1));
      }
      range.lower = std::min(range.lower, coefficient);
      range.upper = std::max(range.upper, coefficient);
    }
    return {range.lower - error, range.upper + error};
  }
};

/// The components of a position or velocity, each a polynomial.
using VectorPolynomial = std::array<Polynomial, 3>;

Polynomial dot_product(double factor, const VectorPolynomial& a, const VectorPolynomial& b) {
  Polynomial sum;
  for (std::size_t axis = 0; axis < 3; ++axis) sum.add_product(factor, a[axis], b[axis]);
  return sum;
}

/// Finds the least time to collision, piece after piece.
class CollisionSearch {
 public:
  explicit CollisionSearch(double radii) : radii_(radii) {}

  void visit(const CoursePiece& piece) {
    piece_ = &piece;
    const double duration = piece.end - piece.begin;
    offer(0.0);
    offer(duration);
    search(0.0, duration, 0);
  }
  const LeastTimeToCollision& least() const { return least_; }

 private:
  static constexpr int max_depth = 30;
  static constexpr double tolerance = 1e-6;

  void offer(double s) {
    const auto& c = piece_->centre.power;
    const Vec3 way = c[0] + (c[1] + (c[2] + c[3] * s) * s) * s;
    const Vec3 velocity = c[1] + (c[2] * 2.0 + c[3] * (3.0 * s)) * s;
    const double seconds = time_to_collision(way, velocity, radii_);
    if (seconds < least_.seconds) least_ = {std::min(piece_->begin + s, piece_->end), seconds};
  }

  /// Returns a lower bound between two times; infinity where the two are on no course of collision, or only
  /// rounding makes it one.
  double bound(double lower, double upper) const {
    const CubicPosition centre = piece_->centre_over(lower, upper);
    VectorPolynomial way, velocity;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t k = 0; k < 4; ++k) {
        const double power = centre.power[k][static_cast<int>(axis)];
        way[axis].power[k] = power;
        if (k > 0) velocity[axis].power[k - 1] = static_cast<double>(k) * power / (upper - lower);
      }
    Polynomial gap = dot_product(1.0, way, way);
    gap.power[0] -= radii_ * radii_;
    const Polynomial approach = dot_product(-1.0, way, velocity);
    Polynomial root_squared;
    root_squared.add_product(1.0, approach, approach);
    root_squared.add_product(-1.0, dot_product(1.0, velocity, velocity), gap);
    const double fastest = approach.range().upper, root = root_squared.range().upper;
    if (fastest <= 2.0 * approach.error || root <= 2.0 * root_squared.error) return infinity;
    return std::max(gap.range().lower, 0.0) / (fastest + std::sqrt(root));
  }

  void search(double lower, double upper, int depth) {
    const double least = bound(lower, upper);
    if (least == infinity || least >= least_.seconds * (1.0 - tolerance)) return;
    const double middle = 0.5 * (lower + upper);
    offer(middle);
    if (depth == max_depth) return;
    search(lower, middle, depth + 1);
    search(middle, upper, depth + 1);
  }

  double radii_;
  const CoursePiece* piece_ = nullptr;
  LeastTimeToCollision least_{0.0, infinity};
};

}  // namespace

double time_to_collision(const Vec3& way, const Vec3& velocity, double radii) {
  const double gap = norm_squared(way) - radii * radii;
  if (gap <= 0.0) return 0.0;
  const double approach = -dot(way, velocity);
  const double root_squared = approach * approach - norm_squared(velocity) * gap;
  if (!(approach > 0.0) || !(root_squared >= 0.0)) return infinity;
  return gap / (approach + std::sqrt(root_squared));
}

LeastTimeToCollision least_time_to_collision(const Motion& motion, const Approach& approach,
                                             const std::vector<double>& radii) {
  if (approach.closest.distance <= 0.0) return {approach.closest.time, 0.0};
  const Trajectory first = motion.trajectory(approach.first, approach.begin, approach.end);
  const Trajectory second = motion.trajectory(approach.second, approach.begin, approach.end);
  const double sum = radii[approach.first] + radii[approach.second];
  CollisionSearch search(sum);
  std::size_t i = 0, k = 0;
  for (double begin = approach.begin; begin < approach.end;) {
    while (i + 1 < first.size() && first[i].end <= begin) ++i;
    while (k + 1 < second.size() && second[k].end <= begin) ++k;
    const double first_end = i + 1 < first.size() ? first[i].end : approach.end;
    const double second_end = k + 1 < second.size() ? second[k].end : approach.end;
    CoursePiece piece{.begin = begin,
                      .end = std::min({first_end, second_end, approach.end}),
                      .centre = CubicPosition::of(first[i], begin),
                      .is_pair = true,
                      .wall = {},
                      .radius = sum};
    piece.centre -= CubicPosition::of(second[k], begin);
    search.visit(piece);
    begin = piece.end;
  }
  return search.least();
}

}  // namespace kinesphere
