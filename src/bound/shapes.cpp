// Shapes at rest: nearest points and bounding boxes.
#include <limits>

#include "bound/mesh_tree.hpp"
#include "bound/rounding.hpp"
#include "bound/triangle.hpp"

namespace kinesphere {
namespace {

/// Below this length the square underflows, so a vector has no direction.
constexpr double least_length = 0x1p-500;

Box box_of(const Ball& ball, double) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const double clearance = ball.radius + rounding::margin * (std::abs(ball.centre[axis]) + ball.radius);
    box.lower[axis] = ball.centre[axis] - clearance;
    box.upper[axis] = ball.centre[axis] + clearance;
  }
  return box;
}

Box box_of(const HalfSpace& solid, double limit) {
  // From n.x <= offset follows n_i x_i <= offset - (the minimum of the other axes' terms).
  Box box{{-limit, -limit, -limit}, {limit, limit, limit}};
  const double size = std::abs(solid.offset) + limit * norm_one(solid.normal);
  for (int axis = 0; axis < 3; ++axis) {
    const double along = solid.normal[axis];
    if (along == 0.0) continue;
    const double others = limit * (norm_one(solid.normal) - std::abs(along));
    const double farthest = (solid.offset + others + rounding::margin * size) / std::abs(along);
    if (!(farthest < limit)) continue;
    const double end = std::max(farthest, -limit);
    (along > 0.0 ? box.upper[axis] : box.lower[axis]) = along > 0.0 ? end : -end;
  }
  return box;
}

Box box_of(const Box& box, double) { return box; }

Box box_of(const Triangle& t, double) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = std::min({t.a[axis], t.b[axis], t.c[axis]});
    box.upper[axis] = std::max({t.a[axis], t.b[axis], t.c[axis]});
  }
  return box;
}

Box box_of(const Mesh& mesh, double) { return mesh.size() > 0 ? tree_of(mesh).box() : Box{}; }

/// Returns the nearest point on the surface for a position inside the box.
SurfacePoint nearest_face(const Box& box, const Vec3& from) {
  SurfacePoint nearest{.distance = -std::numeric_limits<double>::infinity()};
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      const double end = upper ? box.upper[axis] : box.lower[axis];
      const double distance = upper ? from[axis] - end : end - from[axis];
      if (!(distance > nearest.distance)) continue;
      nearest = {from, {}, distance};
      nearest.point[axis] = end;
      nearest.normal[axis] = upper ? 1.0 : -1.0;
    }
  }
  return nearest;
}

}  // namespace

SurfacePoint nearest_point(const HalfSpace& shape, const Vec3& from) {
  const double distance = dot(shape.normal, from) - shape.offset;
  return {from - shape.normal * distance, shape.normal, distance};
}

SurfacePoint nearest_point(const Box& shape, const Vec3& from) {
  Vec3 point;
  for (int axis = 0; axis < 3; ++axis)
    point[axis] = std::clamp(from[axis], shape.lower[axis], shape.upper[axis]);
  const Vec3 away = from - point;
  const double distance = norm(away);
  if (distance > least_length) return {point, away / distance, distance};
  return nearest_face(shape, from);
}

SurfacePoint nearest_point(const Triangle& shape, const Vec3& from) {
  const TriangleFrame frame(shape);
  const Vec3 offset = from - frame.origin();
  const double height = frame.above_plane(offset);
  const Vec3 plane_normal = height < 0.0 ? -frame.normal() : frame.normal();
  const PlaneVector place = frame.in_plane(offset);
  if (frame.contains(place)) return {from - frame.normal() * height, plane_normal, std::abs(height)};
  const SidePoint nearest = nearest_on_sides(frame, place);
  const Vec3 away = frame.vector(nearest.away) + frame.normal() * height;
  const double distance = norm(away);
  return {nearest.place(frame), distance > least_length ? away / distance : plane_normal, distance};
}

Box bounding_box(const Shape& shape, double limit) {
  return std::visit([=](const auto& solid) { return box_of(solid, limit); }, shape);
}

}  // namespace kinesphere
