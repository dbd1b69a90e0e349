// The path of a satellite: an ellipse whose node, perigee and mean anomaly drift as the earth's flattening
// makes them drift on average (secular J2). Lengths in km, times in s.
#pragma once

#include "kinesphere/body.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

namespace earth {
constexpr double gravity = 398600.8;             ///< G M (km^3 / s^2), WGS-72, as element sets use it
constexpr double radius = 6378.135;              ///< at the equator (km)
constexpr double flattening_term = 1.082616e-3;  ///< J2
}  // namespace earth

/// A closed form, so that the state at any time costs the same, about 0.2 us.
class Orbit {
 public:
  /// The ellipse through this state at time 0. Its position then is that of the state; its velocity differs
  /// by what the drift adds. Errors: not_finite; out_of_range where it is no ellipse around the earth, with
  /// an eccentricity of at most 0.95 and a perigee of at least half the earth's radius.
  static Result<Orbit> through(const State& state);

  /// At a time of at most 1e8 seconds. The result is off by less than position_error and velocity_error.
  State state_at(double time) const;
  Vec3 acceleration_at(double time) const;
  /// Of what is computed here, for distances of at most 200,000 km and times of at most 1e7 s.
  static constexpr double position_error = 1e-6;
  static constexpr double velocity_error = 1e-9;

  /// What can be said at a time about the next `horizon` seconds: the acceleration differs from a constant
  /// one by at most `deviation`. docs/satellites.md derives it.
  struct Outlook {
    State state{};
    Vec3 acceleration{};
    double deviation = 0.0;
  };
  Outlook outlook(double time, double horizon) const;

  double semi_major_axis() const { return semi_major_; }
  double eccentricity() const { return eccentricity_; }
  double perigee() const { return semi_major_ * (1.0 - eccentricity_); }
  double apogee() const { return semi_major_ * (1.0 + eccentricity_); }
  double period() const;
  // It never is faster, and never accelerates more, than this.
  double largest_speed() const;
  double largest_acceleration() const;

 private:
  Orbit() = default;
  /// In the plane of the ellipse, whose first axis goes through the perigee.
  struct InPlane {
    double x, y;    ///< position
    double vx, vy;  ///< velocity
    double distance;
  };
  /// From that plane to the directions of the equator and the pole.
  struct Orientation {
    double cosine_perigee, sine_perigee, cosine_node, sine_node;
  };
  InPlane in_plane(double time) const;
  Orientation orientation(double time) const;
  Vec3 out_of_plane(const Orientation& at, double x, double y) const;
  Vec3 with_node(const Orientation& at, const Vec3& v) const;
  Vec3 acceleration(const InPlane& p, const Orientation& at) const;

  double semi_major_ = 0.0;
  double eccentricity_ = 0.0;
  double semi_minor_ = 0.0;
  double mean_motion_ = 0.0;    ///< with its drift (1 / s)
  double gravity_ = 0.0;        ///< for which an ellipse at rest has this mean motion: n^2 a^3
  double mean_anomaly_ = 0.0;   ///< at time 0
  double perigee_drift_ = 0.0;  ///< (1 / s), as the next one
  double node_drift_ = 0.0;
  double drift_ = 0.0;         ///< of both together, at most
  double radial_speed_ = 0.0;  ///< along the line from the earth's centre, at most
  double area_speed_ = 0.0;    ///< distance times the speed across that line
  double cosine_inclination_ = 1.0, sine_inclination_ = 0.0;
  // At time 0.
  double cosine_perigee_ = 1.0, sine_perigee_ = 0.0;
  double cosine_node_ = 1.0, sine_node_ = 0.0;
};

}  // namespace kinesphere
