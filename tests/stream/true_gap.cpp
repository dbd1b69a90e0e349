#include "stream/true_gap.hpp"

#include <cmath>

#include "support/exact_shapes.hpp"

namespace kinesphere::stream {

std::vector<TrueGaps::Solid> TrueGaps::solids(const Thing& thing, Real time, const Vector& origin) const {
  static const true_hulls::Hull point(std::vector<Vec3>(1));
  if (thing.is_ball()) return {{{thing.path.at(time) - origin}, thing.radius.at(time), &point}};
  std::vector<Solid> found;
  const Vector base = thing.sort == Sort::fixed ? Vector{} - origin : thing.path.at(time) - origin;
  if (thing.sort != Sort::rigid) {
    const std::size_t size = thing.corners.size() / std::max<std::size_t>(thing.hulls.size(), 1);
    for (std::size_t k = 0; k < thing.hulls.size(); ++k) {
      found.push_back({{}, 0, &thing.hulls[k]});
      for (std::size_t corner = k * size; corner < (k + 1) * size; ++corner)
        found.back().points.push_back(base + vector(thing.corners[corner]));
    }
    return found;
  }
  const Quaternion orientation = thing.spin.at(static_cast<double>(time)).orientation;
  for (std::size_t k = 0; k < thing.parts.size(); ++k) {
    found.push_back({{}, thing.parts[k].radius, &thing.hulls[k]});
    for (const Vec3& arm : points_of(thing.parts[k]))
      found.back().points.push_back(base + vector(rotated(orientation, arm)));
  }
  return found;
}

Real TrueGaps::between(const Solid& a, const Solid& b, const Measure& how) const {
  const Real radii = a.radius + b.radius;
  if (a.points.size() <= 2 && b.points.size() <= 2)
    return true_hulls::between_segments(a.points.front(), a.points.back(), b.points.front(),
                                        b.points.back()) -
           radii;
  const auto middle_of = [](const Solid& solid) {
    Vector middle{};
    for (const Vector& point : solid.points)
      middle = middle + point * (Real(1) / static_cast<Real>(solid.points.size()));
    return middle;
  };
  const auto reach_of = [](const Solid& solid, const Vector& middle) {
    Real reach = 0;
    for (const Vector& point : solid.points) reach = std::max(reach, length(point - middle));
    return reach;
  };
  const Vector middle = middle_of(a), other = middle_of(b);
  const Real least = length(middle - other) - reach_of(a, middle) - reach_of(b, other) - radii;
  if (least > how.enough) return least;
  work_ += 20 * a.points.size() * b.points.size();
  const auto near_unit = [&](const Solid& solid) {
    std::vector<Vec3> points;
    for (const Vector& point : solid.points)
      points.push_back(rounded((point - middle) * (1 / Real(unit_length_))));
    return true_hulls::Placed(*solid.hull, points);
  };
  const Real enough = (how.enough + radii) / unit_length_;
  const Real distance = unit_length_ * Real(true_hulls::signed_distance(near_unit(a), near_unit(b),
                                                                        static_cast<double>(enough)));
  return (how.is_deep ? distance : std::max<Real>(distance, 0)) - radii;
}

/// Returns the distance from a shape that is no ball.
Real TrueGaps::to_shape(const Thing& thing, const Vector& point, Real time) const {
  const Vector from = thing.sort == Sort::carried ? point - thing.path.at(time) : point;
  return std::visit(
      [&]<class Solid>(const Solid& solid) -> Real {
        if constexpr (std::is_same_v<Solid, Ball>)
          return length(from - vector(solid.centre)) - solid.radius;
        else
          return static_cast<Real>(exact::distance(solid, exact::WideVec{from.x, from.y, from.z}));
      },
      thing.shape);
}

/// Calls visit(shift) for shifts of the second of two bodies to its images near the first one. `way` leads
/// from the first to the second.
template <class Visit>
void TrueGaps::for_each_image(const Vector& way, Visit visit) const {
  if (!world_.periodic.any()) return visit(Vector{});
  const Vec3 size = world_.box->upper - world_.box->lower;
  std::array<Real, 3> nearest{};
  std::array<int, 3> beyond{};
  for (int axis = 0; axis < 3; ++axis) {
    if (!world_.periodic[axis]) continue;
    const auto k = static_cast<std::size_t>(axis);
    nearest[k] = -Real(size[axis]) * std::round(coordinate(way, axis) / size[axis]);
    beyond[k] = 1;
  }
  for (int x = -beyond[0]; x <= beyond[0]; ++x)
    for (int y = -beyond[1]; y <= beyond[1]; ++y)
      for (int z = -beyond[2]; z <= beyond[2]; ++z)
        visit(Vector{nearest[0] + x * Real(size.x), nearest[1] + y * Real(size.y),
                     nearest[2] + z * Real(size.z)});
}

Vector TrueGaps::nearest_way(const Vector& from, const Vector& to) const {
  Vector nearest = to - from;
  if (!world_.periodic.any()) return nearest;
  for_each_image(to - from, [&](const Vector& shift) {
    if (length(to - from + shift) < length(nearest)) nearest = to - from + shift;
  });
  return nearest;
}

Real TrueGaps::between(const Thing& a, const Thing& b, Real time, const Measure& how) const {
  work_ += 10;
  if (a.is_ball() && b.is_ball()) {
    const Vector way = b.path.at(time) - a.path.at(time);
    return length(nearest_way({}, way)) - a.radius.at(time) - b.radius.at(time);
  }
  if (!a.is_ball() && a.has_shape() && b.is_ball())
    return to_shape(a, b.path.at(time), time) - b.radius.at(time);
  const auto* half = std::get_if<HalfSpace>(&a.shape);
  if (half && a.sort == Sort::fixed) {
    Real least = infinity;
    for (const Solid& solid : solids(b, time, {}))
      for (const Vector& point : solid.points)
        least = std::min(least, dot(vector(half->normal), point) - half->offset - solid.radius);
    return least;
  }
  const bool b_is_half = b.sort == Sort::fixed && std::holds_alternative<HalfSpace>(b.shape);
  const bool a_has_corners = a.has_shape() && !a.is_ball();
  if (b_is_half || (b.has_shape() && !b.is_ball() && !a_has_corners)) return between(b, a, time, how);
  const Vector origin = a.sort == Sort::fixed && !a.is_ball() ? vector(a.corners[0]) : a.path.at(time);
  const std::vector<Solid> own = solids(a, time, origin);
  const std::vector<Solid> others = solids(b, time, origin);
  Real least = infinity;
  for_each_image(b.path.at(time) - origin, [&](const Vector& shift) {
    for (Solid other : others) {
      for (Vector& point : other.points) point = point + shift;
      for (const Solid& solid : own)
        least = std::min(least, between(solid, other, {how.is_deep, std::min(how.enough, least)}));
    }
  });
  return least;
}

Real TrueGaps::to_wall(const Thing& thing, Wall wall, Real time) const {
  work_ += 10;
  const int axis = (static_cast<int>(wall) - 1) / 2;
  const bool is_upper = static_cast<int>(wall) % 2 == 0;
  Real least = infinity;
  for (const Solid& solid : solids(thing, time, {}))
    for (const Vector& point : solid.points) {
      const Real x = coordinate(point, axis);
      const Real inside = is_upper ? world_.box->upper[axis] - x : x - world_.box->lower[axis];
      least = std::min(least, inside - solid.radius);
    }
  return least;
}

Real TrueGaps::to_point(const Thing& thing, const Vector& point, Real time) const {
  Thing ball;
  ball.path.position = point;
  return between(thing, ball, time);
}

}  // namespace kinesphere::stream
