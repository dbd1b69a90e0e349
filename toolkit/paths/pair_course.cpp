#include "paths/pair_course.hpp"

#include <algorithm>

#include "number/slope_signs.hpp"

namespace kinesphere {

/// Adds a knot wherever the slope's sign may change.
struct PairCourse::KnotCollector {
  PairCourse& course;

  void add(double x) {
    const std::size_t piece = course.pieces_.size() - 1;
    if (course.knots_.empty() || course.knots_.back().piece != piece || course.knots_.back().x < x)
      course.knots_.push_back({piece, x, course.pieces_.back().distance(x)});
  }
  void rises(double x) { add(x); }
  void falls(double x) { add(x); }
  void stays(double x) { add(x); }
};

void PairCourse::follow(std::uint32_t first, std::uint32_t second, double from, double to) {
  std::size_t a = arcs_.arc_after(first, from), b = arcs_.arc_after(second, from);
  while (a < arcs_.first_of(first + 1) && b < arcs_.first_of(second + 1)) {
    const double begin = std::max({from, arcs_.begin(a), arcs_.begin(b)});
    const double end = std::min({to, arcs_.end(a), arcs_.end(b)});
    if (begin >= to) break;
    if (begin < end) {
      if (!pieces_.empty() && pieces_.back().end() < begin) finish(first, second);
      add_piece(a, b, begin, end);
    }
    const bool is_a_over = arcs_.end(a) <= arcs_.end(b), is_b_over = arcs_.end(b) <= arcs_.end(a);
    if (is_a_over) ++a;
    if (is_b_over) ++b;
  }
  finish(first, second);
}

void PairCourse::add_piece(std::size_t a, std::size_t b, double from, double to) {
  pieces_.emplace_back(arcs_, a, b, from, to);
  KnotCollector collector{*this};
  collector.add(0.0);
  SlopeSigns(pieces_.back(), collector).visit(0.0, 1.0);
  collector.add(1.0);
}

/// Adds the approaches in the pieces that have been collected, which follow each other without a gap.
void PairCourse::finish(std::uint32_t first, std::uint32_t second) {
  const double limit = distance_ + arcs_.declared_error(first) + arcs_.declared_error(second);
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    if (knots_[k].distance > limit) continue;
    const std::size_t from = k;
    while (k + 1 < knots_.size() && knots_[k + 1].distance <= limit) ++k;
    add_approach(first, second, from, k, limit);
  }
  pieces_.clear();
  knots_.clear();
}

/// Returns the last point of the way from `near`, within the limit, to `far`, beyond it, that is within it.
PairCourse::Knot PairCourse::crossing(const Knot& near, const Knot& far, double limit) const {
  if (near.piece != far.piece) return near;
  const RelativeArc& piece = pieces_[near.piece];
  double within = near.x, beyond = far.x;
  for (;;) {
    const double middle = 0.5 * (within + beyond);
    if (middle == within || middle == beyond) return {near.piece, within, piece.distance(within)};
    (piece.distance(middle) <= limit ? within : beyond) = middle;
  }
}

/// Adds the approach whose knots are those from `from` to `to`.
void PairCourse::add_approach(std::uint32_t first, std::uint32_t second, std::size_t from, std::size_t to,
                              double limit) {
  std::vector<Knot> course;
  if (from > 0) course.push_back(crossing(knots_[from], knots_[from - 1], limit));
  course.insert(course.end(), knots_.begin() + static_cast<std::ptrdiff_t>(from),
                knots_.begin() + static_cast<std::ptrdiff_t>(to) + 1);
  if (to + 1 < knots_.size()) course.push_back(crossing(knots_[to], knots_[to + 1], limit));
  double rounding = 0.0;
  for (std::size_t piece = course.front().piece; piece <= course.back().piece; ++piece)
    rounding = std::max(rounding, pieces_[piece].rounding());
  const double errors = arcs_.declared_error(first) + arcs_.declared_error(second);
  Approaches::Approach approach{.first = first,
                                .second = second,
                                .begin = time_of(course.front()),
                                .end = time_of(course.back()),
                                .begins_with_path = from == 0,
                                .ends_with_path = to + 1 == knots_.size()};
  approach.closest = minima.size();
  add_minima(course, 2.0 * (errors + rounding), approach);
  for (std::size_t k = approach.closest; k < minima.size(); ++k)
    if (minima[k].distance < minima[approach.closest].distance) approach.closest = k;
  approach.is_certain = minima[approach.closest].distance + errors + rounding <= distance_;
  approaches.push_back(approach);
}

/// Adds the minima of a course that lie deeper by `depth` than what is between them.
void PairCourse::add_minima(const std::vector<Knot>& course, double depth,
                            const Approaches::Approach& approach) {
  const auto add = [&](const Knot& knot) {
    const RelativeArc& piece = pieces_[knot.piece];
    const double time = time_of(knot);
    const bool is_first = approach.begins_with_path && &knot == &course.front();
    const bool is_last = approach.ends_with_path && &knot == &course.back();
    minima.push_back({.approach = approaches.size(),
                      .time = time,
                      .distance = knot.distance,
                      .first = arcs_.state_at(piece.first_arc(), time),
                      .second = arcs_.state_at(piece.second_arc(), time),
                      .is_cut_off = is_first || is_last});
  };
  const Knot* extreme = course.data();
  bool falls = true;
  for (const Knot& knot : course) {
    const double rise = falls ? knot.distance - extreme->distance : extreme->distance - knot.distance;
    if (rise < 0.0) {
      extreme = &knot;
    } else if (rise > depth) {
      if (falls) add(*extreme);
      falls = !falls;
      extreme = &knot;
    }
  }
  if (falls) add(*extreme);
}

}  // namespace kinesphere
