// Post-encroachment time: branch and bound over pairs of parts of the two curves, least difference first.
#include "simulation/tracks/post_encroachment.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "number/infinity.hpp"
#include "simulation/oracle/course_piece.hpp"

namespace kinesphere {
namespace {

/// A part of a curve, and its chord: at each time they are no farther apart than `deviation`.
struct Part {
  const Segment* segment;
  double begin, end;
  Vec3 chord_begin, chord_velocity;
  double deviation;
  Box box;  ///< contains the part

  double middle() const { return 0.5 * (begin + end); }
};

Part part_of(const Segment& segment, double begin, double end) {
  const std::array<Vec3, 4>& power = CubicPosition::of(segment, begin).power;
  const double duration = end - begin;
  const Vec3 linear = power[1] * (duration / 3.0);
  const Vec3 square = power[2] * (duration * duration / 3.0);
  const Vec3 cube = power[3] * (duration * duration * duration);
  const Vec3 all = 3.0 * (linear + square) + cube;
  // The Bernstein coefficients from the begin of the part, and those of the chord: both curves are in the
  // convex hulls of theirs, and their difference is in that of the differences.
  const Vec3 bernstein[] = {{}, linear, 2.0 * linear + square, all};
  Part part{&segment, begin, end, power[0], all / duration, 0.0, {power[0], power[0]}};
  for (int k = 0; k < 4; ++k) {
    part.deviation = std::max(part.deviation, norm(bernstein[k] - all * (k / 3.0)));
    for (int axis = 0; axis < 3; ++axis) {
      const double x = power[0][axis] + bernstein[k][axis];
      part.box.lower[axis] = std::min(part.box.lower[axis], x);
      part.box.upper[axis] = std::max(part.box.upper[axis], x);
    }
  }
  return part;
}

bool are_within(const Box& a, const Box& b, double distance) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double gap = std::max({0.0, a.lower[axis] - b.upper[axis], b.lower[axis] - a.upper[axis]});
    sum += gap * gap;
  }
  return sum <= distance * distance;
}

/// Which difference of times the chords of two parts need to come within a distance of each other.
class ChordLags {
 public:
  ChordLags(const Part& first, const Part& second) : first_(first), second_(second) {
    const double low = second.begin - first.end, high = second.end - first.begin;
    least_ = std::clamp(0.0, low, high);
    // The distance of closest() is a convex function of the lag.
    double from = low, to = high;
    for (int round = 0; round < rounds; ++round) {
      const double left = from + (to - from) / 3.0, right = to - (to - from) / 3.0;
      if (closest(left).distance < closest(right).distance)
        to = right;
      else
        from = left;
    }
    nearest_ = 0.5 * (from + to);
  }

  /// Returns the least difference of the times, and the later of them; infinity if there is none.
  PostEncroachment within(double distance) const {
    if (!(closest(nearest_).distance <= distance)) return {0.0, infinity};
    double inside = nearest_, outside = least_;
    if (closest(outside).distance <= distance) inside = outside;
    for (int round = 0; round < rounds && inside != outside; ++round) {
      const double middle = 0.5 * (inside + outside);
      (closest(middle).distance <= distance ? inside : outside) = middle;
    }
    const double at = closest(inside).first_time;
    return {std::max(at, at + inside), std::abs(inside)};
  }

 private:
  static constexpr int rounds = 80;
  struct Closest {
    double first_time, distance;
  };

  /// Returns where the first is nearest to where the second is `lag` later.
  Closest closest(double lag) const {
    const double from = std::max(first_.begin, second_.begin - lag);
    const double to = std::max(from, std::min(first_.end, second_.end - lag));
    const Vec3 way = second_.chord_begin + second_.chord_velocity * (from + lag - second_.begin) -
                     first_.chord_begin - first_.chord_velocity * (from - first_.begin);
    const Vec3 velocity = second_.chord_velocity - first_.chord_velocity;
    const double speed_squared = norm_squared(velocity);
    const double after =
        speed_squared > 0.0 ? std::clamp(-dot(way, velocity) / speed_squared, 0.0, to - from) : 0.0;
    return {from + after, norm(way + velocity * after)};
  }

  const Part& first_;
  const Part& second_;
  double nearest_;  ///< the lag at which they come nearest
  double least_;    ///< the lag nearest to 0
};

/// Parts of both curves that may overlap.
struct Candidate {
  Part first, second;
  PostEncroachment earliest;  ///< no overlap has a lesser difference of times

  bool operator>(const Candidate& other) const { return earliest.seconds > other.earliest.seconds; }
};

class EncroachmentSearch {
 public:
  /// Parts no longer than `shortest` are not divided.
  EncroachmentSearch(double radii, double shortest) : radii_(radii), shortest_(shortest) {}

  void add(const Part& first, const Part& second) {
    if (!are_within(first.box, second.box, radii_)) return;
    const double deviation = first.deviation + second.deviation;
    const ChordLags lags(first, second);
    const Candidate candidate{first, second, lags.within(radii_ + deviation)};
    if (!(candidate.earliest.seconds < found_.seconds)) return;
    offer(lags.within(radii_ - deviation));
    candidates_.push(candidate);
  }
  PostEncroachment run() {
    constexpr double tolerance = 1e-6;
    while (!candidates_.empty() &&
           candidates_.top().earliest.seconds < found_.seconds * (1.0 - tolerance) - shortest_) {
      const auto [first, second, earliest] = candidates_.top();
      candidates_.pop();
      const bool divides_first = first.deviation > second.deviation;
      const Part& curved = divides_first ? first : second;
      // Parts that cannot be divided, and may overlap, do so or all but do.
      if (curved.deviation == 0.0 || curved.end - curved.begin <= shortest_) {
        offer(earliest);
        continue;
      }
      for (const Part& half : {part_of(*curved.segment, curved.begin, curved.middle()),
                               part_of(*curved.segment, curved.middle(), curved.end)})
        divides_first ? add(half, second) : add(first, half);
    }
    return found_;
  }

 private:
  void offer(const PostEncroachment& overlap) {
    if (overlap.seconds < found_.seconds) found_ = overlap;
  }

  double radii_, shortest_;
  PostEncroachment found_{0.0, infinity};
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates_;
};

std::vector<Part> parts_of(const Trajectory& trajectory, double begin, double end) {
  std::vector<Part> parts;
  for (const Segment& segment : trajectory) {
    const double from = std::max(segment.begin, begin), to = std::min(segment.end, end);
    if (from < to) parts.push_back(part_of(segment, from, to));
  }
  return parts;
}

}  // namespace

PostEncroachment post_encroachment(const Motion& motion, const Approach& approach,
                                   const std::vector<double>& radii) {
  if (approach.closest.distance <= 0.0) return {approach.closest.time, 0.0};
  const Trajectory first = motion.trajectory(approach.first, approach.begin, approach.end);
  const Trajectory second = motion.trajectory(approach.second, approach.begin, approach.end);
  EncroachmentSearch search(radii[approach.first] + radii[approach.second],
                            0x1p-30 * (approach.end - approach.begin));
  const std::vector<Part> others = parts_of(second, approach.begin, approach.end);
  for (const Part& part : parts_of(first, approach.begin, approach.end))
    for (const Part& other : others) search.add(part, other);
  return search.run();
}

}  // namespace kinesphere
