// Two rectangles on their ways.
#pragma once

#include <utility>
#include <vector>

#include "simulation/tracks/approaches.hpp"
#include "simulation/tracks/position_errors.hpp"
#include "simulation/tracks/rectangles.hpp"

namespace kinesphere {

/// The ways of the two bodies of an approach, in pieces that both have in common.
class RectanglePair {
 public:
  struct Piece {
    double begin, end;
    RectanglePiece first, second;
  };

  /// How much of the errors of both positions counts.
  enum class Errors { none, nearer, farther };

  /// `errors` must outlive it.
  RectanglePair(const Motion& motion, const Approach& approach, const std::vector<RectangleBody>& bodies,
                const PositionErrors& errors = {}, Errors counted = Errors::none);

  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Returns the distance, less or more the errors.
  double gap(const Piece& piece, double t) const;
  double time_to_touch(const Piece& piece, double t) const {
    return kinesphere::time_to_touch(first_, piece.first.pose(t), second_, piece.second.pose(t));
  }
  /// Returns into how many equal parts a piece has to be divided, 8 to 1024, so that the gap changes in each
  /// by a tenth of the smaller body's diagonal at most.
  int parts_of(const Piece& piece) const;
  /// Returns a bound on how fast the gap changes between two times of a piece.
  double fastest(const Piece& piece, double from, double to) const;
  /// Returns the least value of `function` (a piece and a time) near a time, between two others of that
  /// piece; the time of it.
  template <class Function>
  static double lowest_near(Function function, double from, double to) {
    constexpr int rounds = 60;
    constexpr double golden = 0.6180339887498949;
    double one = to - golden * (to - from), two = from + golden * (to - from);
    double at_one = function(one), at_two = function(two);
    for (int round = 0; round < rounds; ++round) {
      if (at_one <= at_two) {
        to = std::exchange(two, one);
        at_two = at_one;
        one = to - golden * (to - from);
        at_one = function(one);
      } else {
        from = std::exchange(one, two);
        at_one = at_two;
        two = from + golden * (to - from);
        at_two = function(two);
      }
    }
    return at_one <= at_two ? one : two;
  }
  /// Returns what is told of the two at a time.
  DistanceMinimum minimum(const Piece& piece, double t) const;

 private:
  const RectangleBody &first_, &second_;
  std::uint32_t first_track_, second_track_;
  const PositionErrors* errors_;  ///< null for none
  double sign_;                   ///< with which the errors count
  std::vector<Piece> pieces_;
};

}  // namespace kinesphere
