// The truth about one body, in long double: where it is, how large it is and how it turns.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "kinesphere/rigid_body.hpp"
#include "kinesphere/shape.hpp"
#include "support/placed_parts.hpp"
#include "support/spin.hpp"
#include "support/true_hulls.hpp"

namespace kinesphere::stream {

using Real = long double;
using placed_parts::points_of;
using true_hulls::dot;
using true_hulls::length;
using true_hulls::vector;
using true_hulls::Vector;

inline Real coordinate(const Vector& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
inline Vec3 rounded(const Vector& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// Constant acceleration since a time.
struct Path {
  double since = 0.0;
  Vector position{}, velocity{}, acceleration{};

  Vector at(Real time) const {
    const Real s = time - since;
    return position + (velocity + acceleration * (s / 2)) * s;
  }
  Vector velocity_at(Real time) const { return velocity + acceleration * (time - since); }
};

/// A radius that changes at a constant rate.
struct Course {
  double since = 0.0;
  Real radius = 0, rate = 0;

  Real at(Real time) const { return std::max<Real>(radius + rate * (time - since), 0); }
  /// True if it has become that of a point, or nearly.
  bool has_vanished(Real time, Real negligible) const { return rate < 0 && at(time) <= negligible; }
};

struct Range {
  double least = 0.0, greatest = 0.0;
};

enum class Sort { ball, rigid, carried, fixed };

struct Thing {
  BodyId id{};
  Sort sort = Sort::ball;
  bool alive = true;
  bool enabled = true;
  bool sleeping = false;
  BodyDefinition definition{};  ///< its position, velocity and radius are those of the start
  Path path{};
  Course radius{};
  double last_contact = -std::numeric_limits<double>::infinity();  ///< according to events
  Range pressure{};  ///< limits of the acceleration that pressed it upon its partner then
  // Of a rigid body.
  Spin spin{};
  double largest_spin = 0.0;
  double spin_limit = 0.0;  ///< largest angular acceleration
  std::vector<RigidPart> parts{};
  // Of a shape, relative to the path of the body that carries it.
  Shape shape{};
  std::vector<Vec3> corners{};  ///< none of a ball and a half-space; three of each triangle of a mesh
  /// Of the parts, of the corners, or of the triangles of a mesh, in units of length.
  std::vector<true_hulls::Hull> hulls{};
  double reach = 0.0;  ///< largest distance of a point of the parts from the position

  bool present() const { return alive && enabled; }
  bool has_shape() const { return sort == Sort::carried || sort == Sort::fixed; }
  bool moves() const { return sort != Sort::fixed; }
  bool is_ball() const {
    return sort == Sort::ball || (sort == Sort::fixed && std::holds_alternative<Ball>(shape));
  }

  /// Starts a path and a radius.
  void start(const BodyDefinition& body, double now) {
    definition = body;
    path = {now, vector(body.position), vector(body.velocity), vector(body.planned_acceleration)};
    radius = {now, body.radius, body.radius_rate};
  }
  void wake(double now) {
    if (sleeping) path = {now, path.at(now), {}, vector(definition.planned_acceleration)};
    sleeping = false;
  }
  void set_parts(const std::vector<RigidPart>& given, double unit_length);
  /// `flat`: boxes have no end along z.
  void set_shape(const Shape& given, double now, double unit_length, bool flat);
};

/// Returns the true state of a body that moves.
inline State state_of(const Thing& thing, double time) {
  return {rounded(thing.path.at(time)), rounded(thing.path.velocity_at(time))};
}

}  // namespace kinesphere::stream
