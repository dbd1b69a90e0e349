// The course of a pair's distance over a span of time: its approaches and minima.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "paths/relative_arc.hpp"

namespace kinesphere {

/// Appends the approaches of two bodies within [from, to], and their minima, to lists in which they count
/// from 0. Precondition: at `from` and `to` the two are farther apart than `distance` and their errors, or
/// `from` and `to` are the begin and end of the search.
class PairCourse {
 public:
  PairCourse(const ArcTable& arcs, double distance) : arcs_(arcs), distance_(distance) {}

  void follow(std::uint32_t first, std::uint32_t second, double from, double to);

  std::vector<Approaches::Approach> approaches{};
  std::vector<Approaches::Minimum> minima{};

 private:
  /// A point of the course; between successive ones the distance rises or falls throughout, up to rounding.
  struct Knot {
    std::size_t piece;
    double x;  ///< from 0 to 1 in its piece
    double distance;
  };
  struct KnotCollector;

  void add_piece(std::size_t a, std::size_t b, double from, double to);
  void finish(std::uint32_t first, std::uint32_t second);
  Knot crossing(const Knot& near, const Knot& far, double limit) const;
  void add_approach(std::uint32_t first, std::uint32_t second, std::size_t from, std::size_t to,
                    double limit);
  void add_minima(const std::vector<Knot>& course, double depth, const Approaches::Approach& approach);
  double time_of(const Knot& knot) const { return pieces_[knot.piece].time(knot.x); }

  const ArcTable& arcs_;
  double distance_;
  std::vector<RelativeArc> pieces_;
  std::vector<Knot> knots_;
};

}  // namespace kinesphere
