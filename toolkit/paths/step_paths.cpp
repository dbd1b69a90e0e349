#include "paths/step_paths.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {
namespace {

/// Bound on the distance of an arc of this duration from the parabola through its two ends and its middle.
double beyond_parabola(double jerk, double duration) {
  // |x (x - 1/2) (x - 1)| <= sqrt(3) / 36 on [0, 1], times the jerk over 3!
  return 0.00802 * jerk * duration * duration * duration;
}

}  // namespace

Steps Steps::of(double begin, double end, double length) {
  const double steps = std::ceil((end - begin) / length);
  return {begin, end, length, std::max(std::size_t{1}, static_cast<std::size_t>(steps))};
}

void StepPaths::compute(const Steps& steps, std::size_t first, std::size_t last) {
  times_.clear();
  for (std::size_t step = first; step < last; ++step) {
    times_.push_back(steps.time(step));
    times_.push_back(0.5 * (steps.time(step) + steps.time(step + 1)));
  }
  times_.push_back(steps.time(last));
  points_.resize(times_.size() + ArcTable::lanes);
  paths_.resize((last - first) * arcs_.bodies());
  for (std::size_t body = 0; body < arcs_.bodies(); ++body) compute(body);
}

void StepPaths::compute(std::size_t body) {
  const std::size_t count = times_.size() / 2;
  std::size_t arc = arcs_.arc_after(body, times_.front());
  const std::size_t behind = arcs_.first_of(body + 1);
  for (std::size_t step = 0; step < count;) {
    while (arc < behind && arcs_.end(arc) <= times_[2 * step]) ++arc;
    std::size_t next = step;
    if (arc < behind && arcs_.begin(arc) <= times_[2 * step])
      while (next < count && times_[2 * next + 2] <= arcs_.end(arc)) ++next;
    if (next > step) {
      compute_within(body, arc, step, next);
      step = next;
    } else {
      paths_[step * arcs_.bodies() + body] = across(body, arc, times_[2 * step], times_[2 * step + 2]);
      ++step;
    }
  }
}

/// Computes the paths in steps that lie within one arc.
void StepPaths::compute_within(std::size_t body, std::size_t arc, std::size_t first, std::size_t last) {
  constexpr std::size_t lanes = ArcTable::lanes;
  ArcTable::Times times;
  for (std::size_t k = 2 * first; k <= 2 * last; k += lanes) {
    for (std::size_t i = 0; i < lanes; ++i) times[i] = times_[std::min(k + i, 2 * last)];
    const ArcTable::Positions positions = arcs_.positions_at(arc, times);
    std::copy(positions.begin(), positions.end(), points_.begin() + static_cast<std::ptrdiff_t>(k));
  }
  for (std::size_t step = first; step < last; ++step) {
    const Vec3 &begin = points_[2 * step], &middle = points_[2 * step + 1], &end = points_[2 * step + 2];
    const double duration = times_[2 * step + 2] - times_[2 * step];
    paths_[step * arcs_.bodies() + body] = {begin, end, middle - 0.5 * (begin + end),
                                            arcs_.error(body) + beyond_parabola(arcs_.jerk(arc), duration)};
  }
}

/// Returns the path in a step of which the arcs from `arc` on, which ends after its begin, may cover parts.
StepPath StepPaths::across(std::size_t body, std::size_t arc, double from, double to) {
  const std::size_t behind = arcs_.first_of(body + 1);
  std::size_t last = arc;
  while (last < behind && arcs_.begin(last) < to) ++last;
  if (last == arc) return {};
  const auto position_at = [this](std::size_t at, double t) {
    return arcs_.positions_at(at, {t, t, t, t})[0];
  };
  const double begin = std::max(from, arcs_.begin(arc)), end = std::min(to, arcs_.end(last - 1));
  const Vec3 first = position_at(arc, begin);
  Vec3 velocity{}, bend{};
  // On a very short part, rounding and jumps would make a wild velocity.
  if (end - begin > 0x1p-10 * (to - from)) velocity = (position_at(last - 1, end) - first) / (end - begin);
  if (begin == from && end == to) {
    const double middle = 0.5 * (from + to);
    bend = position_at(std::min(arcs_.arc_after(body, middle), last - 1), middle) - first -
           velocity * (middle - from);
  }
  StepPath path{first + velocity * (from - begin), first + velocity * (to - begin), bend, 0.0};
  for (; arc < last; ++arc) {
    const double a = std::max(from, arcs_.begin(arc)), b = std::min(to, arcs_.end(arc));
    const ArcTable::Times times{a, 0.5 * (a + b), b, b};
    ArcTable::Positions beside = arcs_.positions_at(arc, times);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double x = (times[i] - from) / (to - from);
      beside[i] -= path.begin + (path.end - path.begin) * x + bend * (4.0 * x * (1.0 - x));
    }
    const double bends = norm(beside[1] - 0.5 * (beside[0] + beside[2]));
    path.radius = std::max(path.radius, std::max(norm(beside[0]), norm(beside[2])) + bends +
                                            beyond_parabola(arcs_.jerk(arc), b - a));
  }
  path.radius += arcs_.error(body);
  return path;
}

}  // namespace kinesphere
