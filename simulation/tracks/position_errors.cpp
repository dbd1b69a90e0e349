// How far the positions of recorded tracks may be off.
#include "simulation/tracks/position_errors.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {

bool PositionErrors::has_limits() const {
  return std::isfinite(speed_limit) || std::isfinite(acceleration_limit);
}

// Between samples at times 0 and T, with positions off by e at most, and with the point l on the straight
// way:
//
// - An acceleration of at most a: a path that begins and ends in 0 is the integral of its acceleration with
// the
//   weight of a string that is held at both ends, whose own integral is t (T - t) / 2. A constant
//   acceleration takes all of it. The way between the true positions is e from l at most.
// - A speed of at most V: the body is within e + V t of the first sample p and within e + V (T - t) of the
// second
//   one q. By Stewart's theorem |y - l|^2 = (1 - t/T) |y - p|^2 + (t/T) |y - q|^2 - (t/T) (1 - t/T) |q -
//   p|^2, so that the rim of this lens is farthest from l, sqrt(e^2 + t (T - t) (V^2 + 4 e V / T - v^2)) with
//   v = |q - p| / T. Where one of the two balls lies in the other there is no rim, and the ball's own
//   farthest point counts, e + t (V + v) or e + (T - t) (V + v). Both are reached.
double PositionErrors::between(const Sample& sample, double since, double rest) const {
  if (!has_limits()) return at_samples + growth * std::min(since, rest);
  double bound = std::numeric_limits<double>::infinity();
  if (std::isfinite(acceleration_limit)) bound = at_samples + 0.5 * acceleration_limit * since * rest;
  if (!std::isfinite(speed_limit)) return bound;
  const double whole = since + rest, speed = sample.way / whole;
  const double room = speed_limit * speed_limit + 4.0 * at_samples * speed_limit / whole - speed * speed;
  const double rim = std::sqrt(std::max(0.0, at_samples * at_samples + since * rest * room));
  return std::min({bound, rim, at_samples + std::min(since, rest) * (speed_limit + speed)});
}

double PositionErrors::at(std::uint32_t track, double t) const {
  const std::vector<Sample>& all = samples[track];
  const auto next = std::ranges::lower_bound(all, t, {}, &Sample::time);
  if (next == all.begin()) return at_samples + growth * (next->time - t);
  if (next == all.end()) return at_samples + growth * (t - all.back().time);
  return between(*(next - 1), t - (next - 1)->time, next->time - t);
}

double PositionErrors::largest(std::uint32_t track, double begin, double end) const {
  double largest = std::max(at(track, begin), at(track, end));
  const std::vector<Sample>& all = samples[track];
  for (std::size_t k = 1; k < all.size(); ++k) {
    // All of these bounds are largest in the middle, or at the samples.
    const double half = 0.5 * (all[k].time - all[k - 1].time);
    largest = std::max(largest, between(all[k - 1], half, half));
  }
  return largest;
}

// Where a limit of speed counts, the error is the least of a line e + t (V + v), which the rim begins on, and
// of the rim, which is concave; or the rim is convex, as the way takes all of the errors, and 2 e / T is
// steepest.
double PositionErrors::steepest(std::uint32_t track, double begin, double end) const {
  if (!has_limits()) return growth;
  const std::vector<Sample>& all = samples[track];
  auto at = std::ranges::upper_bound(all, begin, {}, &Sample::time);
  if (at != all.begin()) --at;
  double steepest = 0.0;
  for (; at != all.end() && at + 1 != all.end() && at->time < end; ++at) {
    const double whole = (at + 1)->time - at->time;
    if (std::isfinite(acceleration_limit)) steepest = std::max(steepest, 0.5 * acceleration_limit * whole);
    if (std::isfinite(speed_limit))
      steepest = std::max(steepest, speed_limit + (at->way + 2.0 * at_samples) / whole);
  }
  return steepest;
}

}  // namespace kinesphere
