// Certified times and gaps of two shapes that move without turning.
//
// The one is at the place x relative to the other. They touch for those x that are differences of a point of
// the other and a point of the one: their Minkowski difference. So the pair is a point, with the motion of
// the one relative to the other, and a solid at rest (docs/guarantee.md, "Moving shapes").
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bound/hull_distance.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere {

struct Sinking;

/// A box or a triangle, by its corners and the directions that can separate it from another.
struct ConvexSolid {
  std::vector<Vec3> points;
  std::vector<Vec3> normals;  ///< unit vectors, one of each two that are opposite
  std::vector<Vec3> edges;    ///< their directions; none if the solid is flat
  std::optional<Box> box{};   ///< the solid, if it is a box

  /// `is_flat`: only what lies in the plane z = 0, as events in two dimensions need it; a triangle there is
  /// one of a chain.
  explicit ConvexSolid(const Box& box, bool is_flat = false);
  explicit ConvexSolid(const Triangle& triangle, bool is_flat = false);
};

/// The difference of two convex solids, which is convex. Its faces are normal to a face of the one or the
/// other, or to an edge of each. Refers to both.
class ConvexDifference {
 public:
  ConvexDifference(const ConvexSolid& own, const ConvexSolid& other);

  /// As the functions of bound.hpp; gaps are negative inside: minus the shortest way out.
  double earliest_meeting(const Bound& bound, double from, double until, double distance) const;
  double earliest_separation(const Bound& bound, double from, double until, double distance) const;
  GapLimits gap_limits(const Bound& bound, double t) const;
  /// Returns the direction out of the difference, and how far away `place` is; `point` is the point of
  /// contact of the two solids, in the middle of their gap.
  SurfacePoint nearest_point(const Vec3& place) const;

 private:
  struct Face {
    Vec3 normal;
    double offset = 0.0;
    double wrong = 0.0;  ///< rounding error of the offset
    HalfSpace raised() const { return {normal, offset + wrong}; }
    HalfSpace lowered() const { return {normal, offset - wrong}; }
  };
  struct Way {
    Face face;
    double separation;  ///< along the normal of the face (length)
  };

  Face face(const Vec3& normal) const;
  NearestInHulls nearest(const Vec3& place, std::vector<Vec3>& own, Corners& near) const;
  Way way_out(const Vec3& place) const;
  template <class Visit>
  auto with_witness(const Bound& bound, double time, Visit visit) const;

  const ConvexSolid& own_;
  const ConvexSolid& other_;
  std::vector<Face> faces_;
};

/// The difference of two shapes, each a box, a triangle or a mesh: that of each two of their convex pieces.
/// Refers to both. Cost of all functions: O(1); of two shapes one of which is a mesh, about O(log n) for n
/// triangles, and n times that if both are.
struct ShapeDifference {
  const Shape& own;    ///< the origin of which is the place of the point
  const Shape& other;  ///< at rest
};

double earliest_meeting(const Bound& bound, const ShapeDifference& shape, double from, double until,
                        double distance = 0.0);
double earliest_separation(const Bound& bound, const ShapeDifference& shape, double from, double until,
                           double distance);
GapLimits gap_limits(const Bound& bound, const ShapeDifference& shape, double t);
/// As of a mesh (mesh_tree.hpp).
double earliest_sinking(const Bound& bound, const ShapeDifference& shape, double from, double until,
                        const Sinking& sinking);

/// Two boxes, or a shape and a half-space, have a difference of the same kind.
Box difference_of(const Box& own, const Box& other);
HalfSpace difference_of(const Shape& own, const HalfSpace& other);

/// What is nearest of two shapes.
struct NearestPieces {
  SurfacePoint surface;  ///< as ConvexDifference::nearest_point()
  std::uint32_t own_part = 0;
  std::uint32_t other_part = 0;  ///< of a mesh, the triangle; of equally near ones the first
};
/// `place`: of the one shape relative to the other, which is at rest and may be a half-space.
NearestPieces nearest_pieces(const Shape& own, const Shape& other, const Vec3& place, bool is_flat);

}  // namespace kinesphere
