// Proofs that all states in two discs have, or have not, lost well clear. docs/monitoring.md, Lemma 6,
// derives each of the conditions, with the same letters.
#include "monitor/well_clear.hpp"

#include <algorithm>
#include <cmath>

#include "bound/rounding.hpp"
#include "kinesphere/limits.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// Factor that makes a positive result of a few roundings too small.
constexpr double safety = 1.0 - 0x1p-40;
/// No monitor lasts longer.
constexpr double longest_time = 4.0 * limits::largest_time;

double root_of_squares(double a, double b) { return std::sqrt(a * a + b * b); }

/// Returns for how long a condition, slack > 0, certainly holds; negative if it fails, for at least that
/// time. `rate(h)`, not less for a larger h, limits how fast the slack changes in the next h >= 0.
template <class Rate>
double time_of_slack(double slack, Rate rate) {
  const double size = std::abs(slack);
  // The rate for a longer time holds for a shorter one.
  const double longest = std::min(size / rate(0.0), longest_time);
  const auto within = [&](double h) { return std::min(h, size / rate(h) * safety); };
  double time = within(longest);
  // Where the rate itself grows fast, `longest` is far too long, and the time far too short.
  if (time < 0.25 * longest) time = std::max(time, within(std::sqrt(time * longest)));
  // Numbers that overflow prove nothing.
  if (!(time > 0.0 && size > 0.0)) return 0.0;
  return std::copysign(time < longest_time ? time : infinity, slack);
}

/// The discs, and quantities that several conditions share.
struct Situation {
  Situation(const RelativeDiscs& discs, const WellClearLimits& limits)
      : limit(limits.distance),
        tau(limits.modified_tau),
        s(norm(discs.position)),
        v(norm(discs.velocity)),
        u(norm(discs.position + discs.velocity * (0.5 * limits.modified_tau))),
        cross(std::abs(discs.position.x * discs.velocity.y - discs.position.y * discs.velocity.x)),
        p(discs.position_error),
        q(discs.velocity_error),
        a(discs.acceleration),
        g(discs.grows ? discs.velocity_growth : 0.0),
        grows(discs.grows),
        margin(rounding::margin * (s + p + limit + tau * (v + q))),
        cross_margin(rounding::margin * (s + p + limit) * (v + q)) {}

  double limit, tau;            ///< D and T
  double s, v, u, cross;        ///< |S|, |V|, |S + V T / 2| and |S x V|
  double p, q;                  ///< radii of the discs
  double a, g;                  ///< rates of the velocity's centre and radius
  bool grows;                   ///< RelativeDiscs::grows
  double margin, cross_margin;  ///< more than all roundings of a length, and of a cross product

  // Upper limits in the next h.
  double v_in(double h) const { return v + a * h; }
  double q_in(double h) const { return q + g * h; }
  double p_rate_in(double h) const { return grows ? q_in(h) : 0.0; }
  double p_in(double h) const { return p + p_rate_in(h) * h; }
  double s_in(double h) const { return s + v_in(h) * h; }
  /// Rate of |S| (or |U|), of p and of T |V|, together.
  double length_rate_in(double h) const { return v_in(h) + p_rate_in(h) + tau * a; }
  /// Rate of T q (|S| + p).
  double spread_rate_in(double h) const {
    return tau * (g * (s_in(h) + p_in(h)) + q_in(h) * (v_in(h) + p_rate_in(h)));
  }
  /// Rate of |S x V|, D |V|, D q, p |V| and q (|S| + p), together.
  double cross_rate_in(double h) const {
    return (s_in(h) + p_in(h) + limit) * (a + g) + q_in(h) * (v_in(h) + p_rate_in(h)) +
           p_rate_in(h) * v_in(h);
  }
};

/// The two are too far apart for their largest possible relative speed.
double far_for(const Situation& now) {
  const double reach = now.tau * (now.v + now.q);
  const double slack = now.s - now.p - 0.5 * (reach + root_of_squares(reach, 2.0 * now.limit)) - now.margin;
  return time_of_slack(slack, [&](double h) { return now.length_rate_in(h) + now.tau * now.g; });
}

/// s.(s + T v) > D^2 for all states.
double slow_for(const Situation& now) {
  const auto root = [&](double speed) {
    const double half = 0.5 * now.tau * speed;
    return now.limit * now.limit + half * half + now.tau * now.q * now.p;
  };
  const double slack = now.u - now.p - std::sqrt(root(now.v) + now.tau * now.q * now.s) - now.margin;
  return time_of_slack(slack, [&](double h) {
    const double least = std::sqrt(root(std::max(0.0, now.v - now.a * h))) * safety;
    return now.length_rate_in(h) + now.spread_rate_in(h) / (2.0 * least);
  });
}

/// |s x v| > D |v| for all states: they pass farther from each other than D.
double passing_for(const Situation& now) {
  const double slack =
      now.cross - (now.p + now.limit) * now.v - now.q * (now.s + now.p + now.limit) - now.cross_margin;
  return time_of_slack(slack, [&](double h) { return now.cross_rate_in(h); });
}

/// |s| <= D for all states.
double near_for(const Situation& now) {
  const double slack = now.limit - now.s - now.p - now.margin;
  return time_of_slack(slack, [&](double h) { return now.v_in(h) + now.p_rate_in(h); });
}

/// s.(s + T v) <= D^2 for all states.
double fast_for(const Situation& now) {
  const double needed = (now.u + now.p) * (now.u + now.p) + now.tau * now.q * (now.s + now.p);
  const double slack = root_of_squares(now.limit, 0.5 * now.tau * now.v) -
                       std::sqrt(std::max(now.limit * now.limit, needed)) - now.margin;
  return time_of_slack(slack, [&](double h) {
    return now.length_rate_in(h) + now.spread_rate_in(h) / (2.0 * now.limit * safety);
  });
}

/// |s x v| <= D |v| for all states: they pass within D of each other.
double meeting_for(const Situation& now) {
  const double slack =
      now.limit * (now.v - now.q) - now.cross - now.p * now.v - now.q * (now.s + now.p) - now.cross_margin;
  return time_of_slack(slack, [&](double h) { return now.cross_rate_in(h); });
}

}  // namespace

double clear_by_tau_for(const RelativeDiscs& discs, const WellClearLimits& limits) {
  const Situation now(discs, limits);
  return std::max({far_for(now), slow_for(now), passing_for(now)});
}

double lost_for(const RelativeDiscs& discs, const WellClearLimits& limits) {
  const Situation now(discs, limits);
  return std::max(near_for(now), std::min(fast_for(now), meeting_for(now)));
}

}  // namespace kinesphere
