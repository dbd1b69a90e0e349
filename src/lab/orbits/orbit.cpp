#include "lab/orbits/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "input/input_check.hpp"
#include "lab/orbits/sine.hpp"

namespace kinesphere {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double largest_eccentricity = 0.95;

/// The angle in [-pi, pi], about, that differs by whole turns.
double within_a_turn(double angle) {
  // 2 pi as a sum: multiples of the first part are exact.
  constexpr double part1 = 4.0 * 1.57079632673412561417e+00;
  constexpr double part2 = 4.0 * 6.07710050650619224932e-11;
  const double turns = std::nearbyint(angle / turn);
  return (angle - turns * part1) - turns * part2;
}

/// Of the eccentric anomaly E, which has E - e sin E = M.
SineCosine solve_kepler(double mean_anomaly, double e) {
  const SineCosine m = sine_and_cosine(mean_anomaly);
  // The first terms of the series in e where that is small; where it is not, what always converges.
  double anomaly =
      e < 0.25 ? mean_anomaly + e * m.sine * (1.0 + e * (m.cosine + e * (1.5 * m.cosine * m.cosine - 0.5)))
               : mean_anomaly + (m.sine < 0.0 ? -0.85 : 0.85) * e;
  constexpr int most_rounds = 64;
  constexpr double small = 1e-4;
  for (int round = 0;; ++round) {
    const SineCosine at = sine_and_cosine(anomaly);
    const double f = anomaly - e * at.sine - mean_anomaly;
    const double f1 = 1.0 - e * at.cosine;
    const double f2 = e * at.sine;
    const double f3 = e * at.cosine;
    // Danby's step: its error is of the fourth order.
    const double d1 = -f / f1;
    const double d2 = -f / (f1 + 0.5 * d1 * f2);
    const double d = -f / (f1 + 0.5 * d2 * (f2 + d2 * f3 / 3.0));
    if (std::abs(d) < small || round == most_rounds) {
      // The sine and cosine of a small angle more: their series, up to 1e-20.
      const double d_squared = d * d;
      const double sine = d * (1.0 - d_squared / 6.0);
      const double cosine = 1.0 - 0.5 * d_squared * (1.0 - d_squared / 12.0);
      return {at.sine * cosine + at.cosine * sine, at.cosine * cosine - at.sine * sine};
    }
    anomaly += d;
  }
}

}  // namespace

Result<Orbit> Orbit::through(const State& state) {
  const auto& [r, v] = state;
  InputCheck check("Orbit::through");
  check.finite({"position"}, r).finite({"velocity"}, v);
  if (check.error()) return *check.error();
  const double distance = norm(r);
  const Vec3 h = cross(r, v);
  const double area = norm(h);
  const double energy = 0.5 * norm_squared(v) - earth::gravity / distance;
  const double a = -0.5 * earth::gravity / energy;
  // Towards the perigee, as long as the eccentricity.
  const Vec3 apse = cross(v, h) / earth::gravity - r / distance;
  const double e = norm(apse);
  check.require(
      distance > 0.0 && energy < 0.0 && e <= largest_eccentricity && a * (1.0 - e) >= 0.5 * earth::radius,
      ErrorCode::out_of_range, {"velocity"},
      "must lead around the earth on an ellipse with an eccentricity of at most", largest_eccentricity, e);
  if (check.error()) return *check.error();

  Orbit orbit;
  orbit.semi_major_ = a;
  orbit.eccentricity_ = e;
  orbit.semi_minor_ = a * std::sqrt(1.0 - e * e);
  const Vec3 pole = h / area;
  orbit.cosine_inclination_ = pole.z;
  orbit.sine_inclination_ = std::hypot(pole.x, pole.y);
  // Where there is no node, or no perigee, any direction may stand for it.
  const Vec3 node = orbit.sine_inclination_ > 1e-9
                        ? Vec3{-pole.y / orbit.sine_inclination_, pole.x / orbit.sine_inclination_, 0.0}
                        : Vec3{1.0, 0.0, 0.0};
  const Vec3 ahead = cross(pole, node);
  orbit.cosine_node_ = node.x;
  orbit.sine_node_ = node.y;
  const Vec3 perigee = e > 1e-12 ? apse / e : node;
  orbit.cosine_perigee_ = dot(perigee, node);
  orbit.sine_perigee_ = dot(perigee, ahead);
  const double x = dot(r, perigee) / a + e;
  const double y = dot(r, cross(pole, perigee)) / orbit.semi_minor_;
  const double anomaly = std::atan2(y, x);
  orbit.mean_anomaly_ = anomaly - e * std::sin(anomaly);

  const double n = std::sqrt(earth::gravity / a) / a;
  const double parameter = a * (1.0 - e * e);
  const double part = earth::flattening_term * (earth::radius / parameter) * (earth::radius / parameter) * n;
  const double c = orbit.cosine_inclination_;
  orbit.node_drift_ = -1.5 * part * c;
  orbit.perigee_drift_ = 0.75 * part * (5.0 * c * c - 1.0);
  orbit.mean_motion_ = n + 0.75 * part * std::sqrt(1.0 - e * e) * (3.0 * c * c - 1.0);
  orbit.drift_ = std::abs(orbit.node_drift_) + std::abs(orbit.perigee_drift_);
  orbit.gravity_ = orbit.mean_motion_ * orbit.mean_motion_ * a * a * a;
  orbit.area_speed_ = std::sqrt(orbit.gravity_ * parameter);
  orbit.radial_speed_ = e * std::sqrt(orbit.gravity_ / parameter);
  return orbit;
}

double Orbit::period() const { return turn / mean_motion_; }

double Orbit::largest_speed() const { return area_speed_ / perigee() + drift_ * apogee(); }

double Orbit::largest_acceleration() const {
  return gravity_ / (perigee() * perigee()) + 2.0 * drift_ * area_speed_ / perigee() +
         drift_ * drift_ * apogee();
}

Orbit::InPlane Orbit::in_plane(double time) const {
  const SineCosine anomaly = solve_kepler(within_a_turn(mean_anomaly_ + mean_motion_ * time), eccentricity_);
  const double part = 1.0 - eccentricity_ * anomaly.cosine;
  const double rate = mean_motion_ / part;  // of the eccentric anomaly
  return {.x = semi_major_ * (anomaly.cosine - eccentricity_),
          .y = semi_minor_ * anomaly.sine,
          .vx = -semi_major_ * rate * anomaly.sine,
          .vy = semi_minor_ * rate * anomaly.cosine,
          .distance = semi_major_ * part};
}

Orbit::Orientation Orbit::orientation(double time) const {
  const SineCosine perigee = sine_and_cosine(perigee_drift_ * time);
  const SineCosine node = sine_and_cosine(node_drift_ * time);
  return {.cosine_perigee = cosine_perigee_ * perigee.cosine - sine_perigee_ * perigee.sine,
          .sine_perigee = sine_perigee_ * perigee.cosine + cosine_perigee_ * perigee.sine,
          .cosine_node = cosine_node_ * node.cosine - sine_node_ * node.sine,
          .sine_node = sine_node_ * node.cosine + cosine_node_ * node.sine};
}

/// With the node as the first axis.
Vec3 Orbit::out_of_plane(const Orientation& at, double x, double y) const {
  const double along = at.cosine_perigee * x - at.sine_perigee * y;
  const double ahead = at.sine_perigee * x + at.cosine_perigee * y;
  return {along, cosine_inclination_ * ahead, sine_inclination_ * ahead};
}

Vec3 Orbit::with_node(const Orientation& at, const Vec3& v) const {
  return {at.cosine_node * v.x - at.sine_node * v.y, at.sine_node * v.x + at.cosine_node * v.y, v.z};
}

State Orbit::state_at(double time) const {
  const InPlane p = in_plane(time);
  const Orientation at = orientation(time);
  const Vec3 position = out_of_plane(at, p.x, p.y);
  Vec3 velocity = out_of_plane(at, p.vx - perigee_drift_ * p.y, p.vy + perigee_drift_ * p.x);
  velocity += node_drift_ * Vec3{-position.y, position.x, 0.0};
  return {with_node(at, position), with_node(at, velocity)};
}

Vec3 Orbit::acceleration(const InPlane& p, const Orientation& at) const {
  const double w = perigee_drift_;
  const double pull = gravity_ / (p.distance * p.distance * p.distance) + w * w;
  const Vec3 position = out_of_plane(at, p.x, p.y);
  const Vec3 velocity = out_of_plane(at, p.vx - w * p.y, p.vy + w * p.x);
  const Vec3 inner = out_of_plane(at, -pull * p.x - 2.0 * w * p.vy, -pull * p.y + 2.0 * w * p.vx);
  const double u = node_drift_;
  return with_node(at, {inner.x - 2.0 * u * velocity.y - u * u * position.x,
                        inner.y + 2.0 * u * velocity.x - u * u * position.y, inner.z});
}

Vec3 Orbit::acceleration_at(double time) const { return acceleration(in_plane(time), orientation(time)); }

Orbit::Outlook Orbit::outlook(double time, double horizon) const {
  const InPlane p = in_plane(time);
  const Orientation at = orientation(time);
  Outlook outlook;

  const Vec3 position = out_of_plane(at, p.x, p.y);
  const Vec3 velocity = out_of_plane(at, p.vx - perigee_drift_ * p.y, p.vy + perigee_drift_ * p.x);
  outlook.state = {with_node(at, position),
                   with_node(at, velocity + node_drift_ * Vec3{-position.y, position.x, 0.0})};

  // The acceleration half-way, from the third derivative of the ellipse at rest.
  const double cube = p.distance * p.distance * p.distance;
  const double third = -gravity_ / cube;
  const double outwards = 3.0 * (p.x * p.vx + p.y * p.vy) / (p.distance * p.distance);
  const double half = 0.5 * horizon;
  const Vec3 jerk = out_of_plane(at, third * (p.vx - outwards * p.x), third * (p.vy - outwards * p.y));
  outlook.acceleration = acceleration(p, at) + with_node(at, jerk) * half;

  // Limits over the horizon: of the distance, the speed, and the derivatives of the ellipse at rest.
  const double nearest = std::max(perigee(), p.distance - radial_speed_ * horizon);
  const double farthest = std::min(apogee(), p.distance + radial_speed_ * horizon);
  const double across = area_speed_ / nearest;
  const double speed_squared = across * across + radial_speed_ * radial_speed_;
  const double speed = std::sqrt(speed_squared);
  const double inverse = 1.0 / nearest;
  const double p2 = gravity_ * inverse * inverse;
  const double p3 = p2 * inverse * std::sqrt(across * across + 4.0 * radial_speed_ * radial_speed_);
  const double p4 = p2 * inverse * (6.0 * speed_squared * inverse + 2.0 * p2);
  // And of the path, whose ellipse turns.
  const double w = drift_;
  const double turning = w * (3.0 * p2 + w * (3.0 * speed + w * farthest));
  const double fourth = p4 + w * (4.0 * p3 + w * (6.0 * p2 + w * (4.0 * speed + w * farthest)));
  outlook.deviation = (half * (p3 + turning) + half * turning + 0.5 * half * half * fourth) * (1.0 + 1e-9);
  return outlook;
}

}  // namespace kinesphere
