#include "simulation/oracle/gap_course.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace kinesphere {
namespace {

constexpr int degree = 6;
/// Power or Bernstein coefficients of a polynomial over [0, 1].
using Coefficients = std::array<double, degree + 1>;

Coefficients to_bernstein(const Coefficients& power) {
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

/// The motion in one piece, in s = t - begin, and what it takes to find where the gap reaches a level.
struct CoursePiece {
  double begin, end;
  std::array<Vec3, 4> centre;  ///< power coefficients of the position difference (pair) or position (wall)
  bool is_pair;
  HalfSpace wall;
  double radius;

  double gap(double s) const {
    const Vec3 at = centre[0] + (centre[1] + (centre[2] + centre[3] * s) * s) * s;
    return is_pair ? norm(at) - radius : dot(wall.normal, at) - wall.offset - radius;
  }

  /// Returns half the derivative of the squared distance of a pair.
  double slope(double s) const {
    const Vec3 at = centre[0] + (centre[1] + (centre[2] + centre[3] * s) * s) * s;
    return dot(at, centre[1] + (centre[2] * 2.0 + centre[3] * (3.0 * s)) * s);
  }

  /// Returns a polynomial over [0, 1], for the way from s = lower to s = upper, that is positive where the
  /// gap is larger than `level`. Sets `error` to a bound on the rounding in its coefficients.
  Coefficients above(double level, double lower, double upper, double& error) const {
    const std::array<Vec3, 4> c = centre_over(lower, upper);
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

 private:
  /// Returns the centre's power coefficients over [0, 1], for the way from s = lower to s = upper. They are
  /// expanded anew at `lower` instead of subdivided, which makes the error shrink with the distance.
  std::array<Vec3, 4> centre_over(double lower, double upper) const {
    const double length = upper - lower;
    const Vec3 value = centre[0] + (centre[1] + (centre[2] + centre[3] * lower) * lower) * lower;
    const Vec3 slope = centre[1] + (centre[2] * 2.0 + centre[3] * (3.0 * lower)) * lower;
    const Vec3 curvature = centre[2] + centre[3] * (3.0 * lower);
    return {value, slope * length, curvature * (length * length), centre[3] * (length * length * length)};
  }
};

/// Finds the first time in one piece at which the gap reaches a level.
class RootSearch {
 public:
  RootSearch(const CoursePiece& piece, LevelCrossing crossing, double level)
      : piece_(piece), level_(level), sign_(crossing == LevelCrossing::falls_to ? 1.0 : -1.0) {}

  /// Returns the first s in [0, end - begin] at which the level is reached.
  std::optional<double> first() const { return first_within(0.0, piece_.end - piece_.begin, 0); }

 private:
  static constexpr int max_depth = 60;

  /// Returns the signed distance to the level, positive before the level is reached.
  double room(double s) const { return sign_ * (piece_.gap(s) - level_); }

  std::optional<double> first_within(double lower, double upper, int depth) const {
    double error = 0.0;
    Coefficients c = to_bernstein(piece_.above(level_, lower, upper, error));
    for (double& coefficient : c) coefficient *= sign_;
    if (std::all_of(c.begin(), c.end(), [=](double value) { return value > error; })) return std::nullopt;
    if (room(lower) <= 0.0) return lower;
    if (is_monotone(c, error)) return room(upper) <= 0.0 ? std::optional(bisect(lower, upper)) : std::nullopt;
    // Once rounding hides what is left of the polynomial, its values at the ends decide.
    const bool hidden = *std::max_element(c.begin(), c.end()) <= 2.0 * error;
    if (hidden || depth == max_depth) return room(upper) <= 0.0 ? std::optional(upper) : std::nullopt;
    const double middle = 0.5 * (lower + upper);
    if (const auto found = first_within(lower, middle, depth + 1)) return found;
    return first_within(middle, upper, depth + 1);
  }

  static bool is_monotone(const Coefficients& c, double error) {
    bool rises = true;
    bool falls = true;
    for (std::size_t i = 0; i < degree; ++i) {
      rises = rises && c[i + 1] - c[i] > 2.0 * error;
      falls = falls && c[i] - c[i + 1] > 2.0 * error;
    }
    return rises || falls;
  }

  /// Returns the least double found with room() <= 0. Precondition: room(lower) > 0 and room(upper) <= 0.
  double bisect(double lower, double upper) const {
    for (;;) {
      const double middle = 0.5 * (lower + upper);
      if (middle <= lower || middle >= upper) return upper;
      (room(middle) > 0.0 ? lower : upper) = middle;
    }
  }

  const CoursePiece& piece_;
  double level_;
  double sign_;
};

/// Finds the least gap of a pair, piece after piece. It skips parts that cannot hold a smaller gap than is
/// known, and does not divide parts in which the squared distance is monotone or convex.
class LeastSearch {
 public:
  void visit(const CoursePiece& piece) {
    piece_ = &piece;
    const double duration = piece.end - piece.begin;
    offer(0.0);
    offer(duration);
    search(0.0, duration, 0);
  }
  GapCourse::Least least() const { return least_; }

 private:
  static constexpr int max_depth = 60;

  void offer(double s) {
    const double gap = piece_->gap(s);
    if (gap < least_.gap) least_ = {std::min(piece_->begin + s, piece_->end), gap};
  }

  void search(double lower, double upper, int depth) {
    double error = 0.0;
    const Coefficients c = to_bernstein(piece_->above(-piece_->radius, lower, upper, error));
    const double distance = least_.gap + piece_->radius;
    if (*std::min_element(c.begin(), c.end()) + error >= distance * distance) return;
    bool rises = true, falls = true, is_convex = true;
    for (std::size_t i = 0; i < degree; ++i) {
      rises = rises && c[i + 1] >= c[i];
      falls = falls && c[i] >= c[i + 1];
      is_convex = is_convex && (i == 0 || c[i + 1] - c[i] >= c[i] - c[i - 1]);
    }
    if (rises || falls) return;  // the ends were offered before
    if (is_convex) return offer(bottom(lower, upper));
    const double middle = 0.5 * (lower + upper);
    offer(middle);
    if (depth == max_depth) return;
    search(lower, middle, depth + 1);
    search(middle, upper, depth + 1);
  }

  /// Returns the s at which the slope changes its sign. Precondition: the slope rises in [lower, upper].
  double bottom(double lower, double upper) const {
    for (;;) {
      const double middle = 0.5 * (lower + upper);
      if (middle <= lower || middle >= upper) return upper;
      (piece_->slope(middle) < 0.0 ? lower : upper) = middle;
    }
  }

  const CoursePiece* piece_ = nullptr;
  GapCourse::Least least_{0.0, std::numeric_limits<double>::infinity()};
};

/// Returns the coefficients of a segment's position in powers of t - begin, for a `begin` within the segment.
std::array<Vec3, 4> position_from(const Segment& segment, double begin) {
  const State state = segment.state_at(begin);
  return {state.position, state.velocity, segment.acceleration_at(begin) * 0.5, segment.jerk / 6.0};
}

}  // namespace

const Segment& segment_at(const Trajectory& trajectory, double t) {
  auto after = std::upper_bound(trajectory.begin(), trajectory.end(), t,
                                [](double time, const Segment& segment) { return time < segment.begin; });
  return after == trajectory.begin() ? trajectory.front() : *(after - 1);
}

double GapCourse::gap_at(double t) const {
  const Vec3 at = segment_at(*a_, t).state_at(t).position;
  if (b_ == nullptr) return dot(wall_.normal, at) - wall_.offset - radius_;
  return norm(at - segment_at(*b_, t).state_at(t).position) - radius_;
}

/// Visits the pieces of [from, to] in which each motion is one cubic, until `visit` returns true.
template <class Visit>
void GapCourse::for_each_piece(double from, double to, const Visit& visit) const {
  const auto index_at = [&](const Trajectory& trajectory) {
    return static_cast<std::size_t>(&segment_at(trajectory, from) - trajectory.data());
  };
  std::size_t ia = index_at(*a_);
  std::size_t ib = b_ != nullptr ? index_at(*b_) : 0;
  double begin = from;
  for (;;) {
    const Segment& a = (*a_)[ia];
    const double a_end = ia + 1 < a_->size() ? a.end : to;
    double end = std::min(a_end, to);
    CoursePiece piece{begin, end, position_from(a, begin), b_ != nullptr, wall_, radius_};
    if (b_ != nullptr) {
      const Segment& b = (*b_)[ib];
      const double b_end = ib + 1 < b_->size() ? b.end : to;
      piece.end = end = std::min(end, b_end);
      const std::array<Vec3, 4> other = position_from(b, begin);
      for (std::size_t k = 0; k < 4; ++k) piece.centre[k] -= other[k];
      if (end >= b_end && ib + 1 < b_->size()) ++ib;
    }
    if (visit(piece) || end >= to) return;
    if (end >= a_end && ia + 1 < a_->size()) ++ia;
    begin = end;
  }
}

std::optional<double> GapCourse::first_time(LevelCrossing crossing, double level, double from,
                                            double to) const {
  std::optional<double> time;
  for_each_piece(from, to, [&](const CoursePiece& piece) {
    if (const auto s = RootSearch(piece, crossing, level).first())
      time = std::min(piece.begin + *s, piece.end);
    return time.has_value();
  });
  return time;
}

GapCourse::Least GapCourse::least(double from, double to) const {
  assert(b_ != nullptr);
  LeastSearch search;
  for_each_piece(from, to, [&](const CoursePiece& piece) {
    search.visit(piece);
    return false;
  });
  return search.least();
}

}  // namespace kinesphere
