// The local minima of a gap: where the derivative of the squared distance turns from negative to positive.
#include <algorithm>
#include <cassert>

#include "number/slope_signs.hpp"
#include "simulation/oracle/course_piece.hpp"
#include "simulation/oracle/gap_course.hpp"

namespace kinesphere {
namespace {

/// Goes through the signs of the slope in the order of time.
class MinimaSearch {
 public:
  void visit(const CoursePiece& piece) {
    piece_ = &piece;
    const double duration = piece.end - piece.begin;
    if (!is_started_) start();
    last_ = point(duration, true);
    if (duration > 0.0) SlopeSigns(*this, *this).visit(0.0, duration);
  }

  std::vector<GapCourse::Minimum> minima() {
    if (course_ == Course::falling) candidate_ = last_;
    if (course_ != Course::rising) minima_.push_back(candidate_);
    return std::move(minima_);
  }

  // The slope of the piece.
  double at(double s) const { return piece_->slope(s); }
  Coefficients over(double lower, double upper, double& error) const {
    return to_bernstein(piece_->slope_over(lower, upper, error));
  }

  // The slope has this sign from s on.
  void falls(double /*s*/) { course_ = Course::falling; }
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

 private:
  /// `flat`: the gap has stopped falling, or has been the same since the first time.
  enum class Course { falling, flat, rising };

  GapCourse::Minimum point(double s, bool is_at_end) const {
    return {std::min(piece_->begin + s, piece_->end), piece_->gap(s), is_at_end};
  }
  void start() {
    is_started_ = true;
    candidate_ = point(0.0, true);
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
