// How near to a collision two rectangles came.
#include "simulation/tracks/rectangle_conflicts.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "number/infinity.hpp"
#include "simulation/tracks/rectangle_pair.hpp"

namespace kinesphere {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Returns the least value of a function of a piece and a time, and when that is: at one of some times in
/// each piece, and from the lowest of these on.
template <class Function>
std::pair<double, double> lowest(const RectanglePair& pair, Function function) {
  double least = infinity, at = 0.0;
  const RectanglePair::Piece* of = nullptr;
  for (const auto& piece : pair.pieces()) {
    const int parts = pair.parts_of(piece);
    for (int part = 0; part <= parts; ++part) {
      const double t = piece.begin + (piece.end - piece.begin) * part / parts;
      const double value = function(piece, t);
      if (value < least) {
        least = value;
        at = t;
        of = &piece;
      }
    }
  }
  if (of == nullptr) return {at, least};
  const double step = (of->end - of->begin) / pair.parts_of(*of);
  const double better =
      RectanglePair::lowest_near([&](double t) { return function(*of, t); }, std::max(of->begin, at - step),
                                 std::min(of->end, at + step));
  const double value = function(*of, better);
  return value < least ? std::pair(better, value) : std::pair(at, least);
}

/// A part of the way of one body.
struct PieceOfWay {
  const RectanglePiece* piece;
  double begin, end;

  double middle() const { return 0.5 * (begin + end); }
  double half() const { return 0.5 * (end - begin); }
};

/// A part of the way of each.
struct PiecePair {
  PieceOfWay first, second;
  double least = 0.0;  ///< no two times of the two differ by less

  bool operator>(const PiecePair& other) const { return least > other.least; }
};

class EncroachmentOfRectangles {
 public:
  EncroachmentOfRectangles(const RectangleBody& first, const RectangleBody& second, double shortest)
      : first_(first), second_(second), shortest_(shortest) {}

  void add(const PieceOfWay& first, const PieceOfWay& second) {
    const double least = std::max({0.0, second.begin - first.end, first.begin - second.end});
    if (least >= found_.seconds - shortest_) return;
    const RectanglePose a = first.piece->pose(first.middle()), b = second.piece->pose(second.middle());
    const double moves = moved(first, first_) + moved(second, second_);
    const Vec3 way = b.position - a.position;
    if (std::hypot(way.x, way.y) - first_.reach() - second_.reach() > moves) return;
    const double turns =
        std::abs(first.piece->turn_rate) * first.half() + std::abs(second.piece->turn_rate) * second.half();
    const double angle = angle_between(a.heading, b.heading);
    if (angle + turns < least_angle) return;
    const double gap = gap_between(first_, a, second_, b);
    if (gap > moves) return;
    if (gap <= 0.0 && angle >= least_angle) offer(first.middle(), second.middle());
    // Within parts as short as this all places are one; a body that stands has one for a long time.
    if (moves <= 1e-7 * (first_.reach() + second_.reach()))
      offer_least(first, second);
    else
      cells_.push({first, second, least});
  }
  PostEncroachment run() {
    while (!cells_.empty() && cells_.top().least < found_.seconds - shortest_) {
      const auto [first, second, least] = cells_.top();
      cells_.pop();
      const bool divides_first = moved(first, first_) > moved(second, second_);
      const PieceOfWay& divided = divides_first ? first : second;
      for (const PieceOfWay& half : {PieceOfWay{divided.piece, divided.begin, divided.middle()},
                                     PieceOfWay{divided.piece, divided.middle(), divided.end}})
        divides_first ? add(half, second) : add(first, half);
    }
    return found_;
  }

 private:
  static constexpr double least_angle = pi / 6.0;

  /// Returns how far a point of a body is at most from where it is in the middle of a part.
  static double moved(const PieceOfWay& part, const RectangleBody& body) {
    return part.piece->fastest(body.reach(), part.begin, part.end) * part.half();
  }
  /// Offers the two times of the parts that differ least.
  void offer_least(const PieceOfWay& first, const PieceOfWay& second) {
    const double at = std::clamp(second.middle(), first.begin, first.end);
    offer(at, std::clamp(at, second.begin, second.end));
  }
  static double angle_between(double a, double b) { return std::abs(std::remainder(a - b, 2.0 * pi)); }
  void offer(double first, double second) {
    if (std::abs(first - second) < found_.seconds)
      found_ = {std::max(first, second), std::abs(first - second)};
  }

  const RectangleBody &first_, &second_;
  double shortest_;
  PostEncroachment found_{0.0, infinity};
  std::priority_queue<PiecePair, std::vector<PiecePair>, std::greater<>> cells_;
};

}  // namespace

CollisionCourse collision_course(const Motion& motion, const Approach& approach,
                                 const std::vector<RectangleBody>& bodies) {
  const RectanglePair pair(motion, approach, bodies);
  using Piece = RectanglePair::Piece;
  const auto seconds = [&](const Piece& piece, double t) { return pair.time_to_touch(piece, t); };
  const auto deceleration = [&](const Piece& piece, double t) {
    const double left = pair.time_to_touch(piece, t);
    const double speed = norm(piece.first.pose(t).velocity - piece.second.pose(t).velocity);
    return left == infinity || speed == 0.0 ? 0.0 : left == 0.0 ? infinity : 0.5 * speed / left;
  };
  CollisionCourse course{.least = {approach.closest.time, 0.0}};
  if (approach.closest.distance > 0.0) {
    const auto [at, least] = lowest(pair, seconds);
    course.least = {at, least};
  }
  const auto [at, worst] =
      lowest(pair, [&](const Piece& piece, double t) { return -deceleration(piece, t); });
  course.at = at;
  course.deceleration = -worst;
  return course;
}

PostEncroachment post_encroachment(const Motion& motion, const Approach& approach,
                                   const std::vector<RectangleBody>& bodies) {
  if (approach.closest.distance <= 0.0) return {approach.closest.time, 0.0};
  const RectangleBody &first = bodies[approach.first], &second = bodies[approach.second];
  EncroachmentOfRectangles search(first, second, 0x1p-20 * (approach.end - approach.begin));
  const auto others = pieces_of(motion, approach.second, second, approach.begin, approach.end);
  const auto pieces = pieces_of(motion, approach.first, first, approach.begin, approach.end);
  for (const RectanglePiece& piece : pieces)
    for (const RectanglePiece& other : others)
      search.add({&piece, piece.begin, piece.end}, {&other, other.begin, other.end});
  return search.run();
}

}  // namespace kinesphere
