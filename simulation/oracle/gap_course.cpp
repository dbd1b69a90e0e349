#include "simulation/oracle/gap_course.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "simulation/oracle/course_piece.hpp"

namespace kinesphere {
namespace {

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
    for (std::size_t i = 0; i < course_degree; ++i) {
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
    for (std::size_t i = 0; i < course_degree; ++i) {
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
void GapCourse::for_each_piece(double from, double to, const PieceVisitor& visit) const {
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
    CoursePiece piece{begin, end, CubicPosition::of(a, begin), b_ != nullptr, wall_, radius_};
    if (b_ != nullptr) {
      const Segment& b = (*b_)[ib];
      const double b_end = ib + 1 < b_->size() ? b.end : to;
      piece.end = end = std::min(end, b_end);
      piece.centre -= CubicPosition::of(b, begin);
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
