// The local minima of a gap: where the derivative of the squared distance turns from negative to positive.
#include <algorithm>
#include <cassert>

#include "simulation/oracle/course_piece.hpp"
#include "simulation/oracle/gap_course.hpp"

namespace kinesphere {
namespace {

/// Goes through the signs of the slope in the order of time. In each part of a piece Bernstein coefficients
/// tell the sign or that the slope rises or falls throughout; other parts are divided.
class MinimaSearch {
 public:
  void visit(const CoursePiece& piece) {
    piece_ = &piece;
    const double duration = piece.end - piece.begin;
    if (!is_started_) start();
    last_ = point(duration, true);
    if (duration > 0.0) search(0.0, duration, 0);
  }

  std::vector<GapCourse::Minimum> minima() {
    if (course_ == Course::falling) candidate_ = last_;
    if (course_ != Course::rising) minima_.push_back(candidate_);
    return std::move(minima_);
  }

 private:
  static constexpr int max_depth = 60;
  /// `flat`: the gap has stopped falling, or has been the same since the first time.
  enum class Course { falling, flat, rising };

  GapCourse::Minimum point(double s, bool is_at_end) const {
    return {std::min(piece_->begin + s, piece_->end), piece_->gap(s), is_at_end};
  }
  void start() {
    is_started_ = true;
    candidate_ = point(0.0, true);
  }

  // The slope has this sign from s on.
  void falls() { course_ = Course::falling; }
  void stays(double s) {
    if (course_ != Course::falling) return;
    candidate_ = point(s, false);
    course_ = Course::flat;
  }
  void rises(double s) {
    stays(s);
    if (course_ == Course::flat) minima_.push_back(candidate_);
    course_ = Course::rising;
  }

  void search(double lower, double upper, int depth) {
    double error = 0.0;
    const Coefficients c = to_bernstein(piece_->slope_over(lower, upper, error));
    const auto [least, largest] = std::minmax_element(c.begin(), c.end());
    if (*least > error) return rises(lower);
    if (*largest < -error) return falls();
    if (is_increasing(c, error)) return turn(c, error, lower, upper);
    if (is_decreasing(c, error)) {
      if (c.front() > error) rises(lower);
      if (c.back() < -error) falls();
      return;
    }
    // The factor keeps a slope that stays near `error` from being divided for ever.
    const bool hidden = std::max(-*least, *largest) <= 4.0 * error;
    if (hidden || depth == max_depth) return stays(lower);
    const double middle = 0.5 * (lower + upper);
    search(lower, middle, depth + 1);
    search(middle, upper, depth + 1);
  }

  /// Passes a part in which the slope rises.
  void turn(const Coefficients& c, double error, double lower, double upper) {
    if (c.front() < -error) falls();
    if (c.back() < -error) return;
    const double s = bottom(lower, upper);
    stays(s);
    if (c.back() > error) rises(s);
  }

  /// Returns the s at which the slope changes its sign, or the end of [lower, upper] that is nearest to that.
  double bottom(double lower, double upper) const {
    if (piece_->slope(lower) >= 0.0) return lower;
    for (;;) {
      const double middle = 0.5 * (lower + upper);
      if (middle <= lower || middle >= upper) return upper;
      (piece_->slope(middle) < 0.0 ? lower : upper) = middle;
    }
  }

  static bool is_increasing(const Coefficients& c, double error) {
    return std::adjacent_find(c.begin(), c.end(), [error](double here, double next) {
             return !(next - here > 2.0 * error);
           }) == c.end();
  }
  static bool is_decreasing(const Coefficients& c, double error) {
    return std::adjacent_find(c.begin(), c.end(), [error](double here, double next) {
             return !(here - next > 2.0 * error);
           }) == c.end();
  }

  const CoursePiece* piece_ = nullptr;
  Course course_ = Course::flat;
  bool is_started_ = false;
  GapCourse::Minimum candidate_{}, last_{};
  std::vector<GapCourse::Minimum> minima_;
};

}  // namespace

std::vector<GapCourse::Minimum> GapCourse::minima(double from, double to) const {
  assert(b_ != nullptr);
  MinimaSearch search;
  for_each_piece(from, to, [&](const CoursePiece& piece) {
    search.visit(piece);
    return false;
  });
  return search.minima();
}

}  // namespace kinesphere
