// Support function of boxes, triangles and meshes, the magnitude of their coordinates, and planes beside
// them.
#pragma once

#include <algorithm>

#include "bound/mesh_tree.hpp"
#include "bound/rounding.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere {

/// Support function: returns the largest dot product of `direction` and a point of the shape.
inline double reach(const Box& box, const Vec3& direction) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    sum += std::max(direction[axis] * box.lower[axis], direction[axis] * box.upper[axis]);
  return sum;
}

inline double reach(const Triangle& t, const Vec3& direction) {
  return std::max({dot(direction, t.a), dot(direction, t.b), dot(direction, t.c)});
}

inline double reach(const Mesh& mesh, const Vec3& direction) {
  double most = -infinity;
  tree_of(mesh).search([&](const Box& box) { return -reach(box, direction); }, [&] { return -most; },
                       [&](std::size_t, const Triangle& triangle) {
                         most = std::max(most, reach(triangle, direction));
                         return true;
                       });
  return most;
}

/// Magnitude of a shape's coordinates, for rounding margins. Sums are used, so that any NaN propagates.
inline double size_of(const Box& box) { return norm_one(box.lower) + norm_one(box.upper); }
inline double size_of(const Triangle& t) { return norm_one(t.a) + norm_one(t.b) + norm_one(t.c); }
inline double size_of(const Mesh& mesh) { return 2.0 * size_of(tree_of(mesh).box()); }

/// Returns a plane, for any normal, with the shape on its far side (n.x <= offset): it is raised by the
/// possible rounding error.
template <class Solid>
HalfSpace supporting_plane(const Solid& solid, const Vec3& normal) {
  return {normal, reach(solid, normal) + rounding::margin * size_of(solid)};
}

}  // namespace kinesphere
