#include "monitor/straight_pass.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {
namespace {

/// Returns the square root of a^2 + b^2 for a, b >= 0 whose squares may overflow.
double hypotenuse(double a, double b) {
  const double larger = std::max(a, b);
  const double part = larger > 0.0 ? std::min(a, b) / larger : 0.0;
  return larger * std::sqrt(1.0 + part * part);
}

/// Returns the time until two that go straight on and meet are within the limit of a component, or lose well
/// clear. With the offset x and the velocity v, c = x.x - limit^2 > 0, and root^2 = (x.v)^2 - v.v c. With a
/// modified tau T, well clear is lost where  v.v t^2 + (2 x.v + T v.v) t + c + T x.v  falls to zero, which is
/// before the limit is reached.
double entry_after(double c, double xv, double v2, double root, double modified_tau) {
  if (modified_tau == 0.0) return c / (root - xv);
  const double constant = c + modified_tau * xv;
  if (constant <= 0.0) return 0.0;
  const double slope = 2.0 * xv + modified_tau * v2;
  return 2.0 * constant / (hypotenuse(modified_tau * v2, 2.0 * root) - slope);
}

}  // namespace

StraightPass straight_pass(const State& first, const State& second, const Components& separation,
                           double now) {
  StraightPass pass{.begin = now};
  const Component& nearest = *separation.begin();
  for (const Component& component : separation) {
    const Vec3 offset = component.part(first.position - second.position);
    const Vec3 velocity = component.part(first.velocity - second.velocity);
    const double v2 = norm_squared(velocity), xv = dot(offset, velocity);
    if (&component == &nearest) {
      const double nearest_after = v2 > 0.0 ? std::max(0.0, -xv / v2) : 0.0;
      pass.closest_time = now + nearest_after;
      pass.closest_distance = norm(offset + velocity * nearest_after);
    }
    const double c = norm_squared(offset) - component.limit * component.limit;
    const double discriminant = xv * xv - v2 * c;
    if (c > 0.0 && !(xv < 0.0 && discriminant >= 0.0)) {
      pass.begin = infinity;
      continue;
    }
    const double root = std::sqrt(std::max(0.0, discriminant));
    if (c > 0.0)
      pass.begin = std::max(pass.begin, now + entry_after(c, xv, v2, root, component.modified_tau));
    if (v2 > 0.0) pass.end = std::min(pass.end, now + (root - xv) / v2);
  }
  if (pass.begin > pass.end) pass.begin = infinity;
  if (pass.begin == infinity) pass.end = infinity;
  return pass;
}

double avoidable_until(const State& first, const State& second, const ErrorBound& limit,
                       const Components& separation, const StraightPass& pass, double now) {
  if (pass.begin == infinity || separation.predicts_entry) return infinity;
  if (pass.begin <= now) return now;
  // Returns the latest start from which all places of time t are within: t - s, if the two can go at most
  // 1/2 limit s^2 in a component, and have that room. A convex function of t, as the distance is.
  const auto latest_start = [&](double t) {
    double least = infinity;
    for (const Component& component : separation) {
      const Vec3 offset = component.part(first.position - second.position) +
                          component.part(first.velocity - second.velocity) * (t - now);
      const double room = component.limit - norm(offset);
      least = std::min(least, room > 0.0 ? std::sqrt(2.0 * room / component.length(limit)) : 0.0);
    }
    return t - least;
  };
  double low = pass.begin, high = pass.end;
  constexpr int rounds = 40;
  for (int round = 0; round < rounds; ++round) {
    const double left = low + (high - low) / 3.0, right = high - (high - low) / 3.0;
    if (latest_start(left) < latest_start(right))
      high = right;
    else
      low = left;
  }
  return std::max(now, latest_start(0.5 * (low + high)));
}

}  // namespace kinesphere
