// Shapes of bodies, and certified times at which a moving body can meet them.
//
//   const BodyId floor = world.add_static({.shape = HalfSpace{{0, 0, 1}, 0.0}}).value();
//   const BodyId step = world.add_static({.shape = Box{{0, 0, 0}, {2, 1, 0.2}}}).value();
//   const BodyId hill = world.add_static({.shape = Mesh::create(vertices, corners).value()}).value();
//   const BodyId lift = world.add_moving_shape({{.velocity = {0, 0, 1}, .mass = inf}, Box{{-3, -3, -0.2}, {3,
//   3, 0}}}).value();
//
// All shapes but a mesh are convex, and none turns; the functions below take shapes at rest. A mesh is the
// union of its triangles: it is met when the first of them is. For a convex shape and any
// direction, however computed, two facts hold. The shape lies behind its supporting plane in that direction,
// so a body that stays in front of the plane does not meet it. The distance of a body from the shape is at
// most its distance from any point that stays in the shape. The certificates below follow from these two
// facts, with the margins that bound.hpp describes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "kinesphere/bound.hpp"
#include "kinesphere/filter.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/sensor.hpp"

namespace kinesphere {

/// A solid ball.
struct Ball {
  Vec3 centre{};
  double radius = 1.0;  ///< >= 0 (length)

  friend constexpr bool operator==(const Ball&, const Ball&) = default;
};

/// Two-sided triangle without thickness. A body without a response passes through it. A body that bounces
/// off it should have a radius of more than two contact tolerances, the largest depth that it can reach.
struct Triangle {
  Vec3 a{};
  Vec3 b{};
  Vec3 c{};

  friend constexpr bool operator==(const Triangle&, const Triangle&) = default;
};

class MeshTree;

/// A surface of triangles that is one shape: terrain, a level, a machine. Two-sided and without thickness,
/// like each of its triangles. Its distance is that of its nearest triangle, so that a ball that slides over
/// a flat floor of many triangles meets one plane: the normal is that of the floor, also above an edge, and
/// there is one contact. Immutable; copies share the triangles, and are made in O(1) by any thread.
///
/// The body that has the mesh touches another one as a whole: while a ball rests on the floor of a mesh and
/// rolls against a wall of the same mesh, ContactEvents::impacts tells the impact, and begin_and_end does
/// not. What should begin and end apart has a mesh of its own.
class Mesh {
 public:
  /// A mesh without triangles, which no world takes. It is infinitely far from everything.
  Mesh() = default;

  /// Returns the mesh with one triangle for each triple of indices into `vertices`; events name a triangle by
  /// the number of its triple (Event::first_part, Event::second_part). Winding, order and shared vertices do
  /// not matter, and holes may be left. Cost: O(n log n) for n triangles, once; about 60 bytes for each.
  /// Errors: out_of_range for no triple, for an invalid index, and for a triangle with two equal corners or
  /// three nearly collinear ones (its least height below 2^-20 of its longest side); not_finite.
  static Result<Mesh> create(std::span<const Vec3> vertices,
                             std::span<const std::array<std::uint32_t, 3>> corners);

  /// Returns the surface of worlds of two dimensions: a chain of segments from each point to the next, all
  /// with z = 0; repeat the first point at the end to close it. Each segment is a wall of two triangles, as
  /// far above the plane as below: in events, half the number of the triangle is that of the segment. These
  /// are the only meshes that a world of two dimensions takes. Errors: out_of_range for fewer than two
  /// points, for neighbours that are equal and for a z that is not 0; not_finite.
  static Result<Mesh> chain(std::span<const Vec3> points);
  /// Returns true if chain() can have made the mesh.
  bool is_chain() const;

  /// Number of triangles.
  std::size_t size() const;
  /// Returns a triangle. Precondition: number < size().
  Triangle triangle(std::size_t number) const;
  /// As given to create(). Valid while any copy of the mesh lives.
  std::span<const Vec3> vertices() const;
  std::span<const std::array<std::uint32_t, 3>> corners() const;

  /// Compares vertices and corners. Cost: O(1) for copies, else O(n).
  friend bool operator==(const Mesh& a, const Mesh& b);
  /// The hierarchy of its triangles, for the library. Precondition: size() > 0.
  friend const MeshTree& tree_of(const Mesh& mesh) { return *mesh.tree_; }

 private:
  explicit Mesh(std::shared_ptr<const MeshTree> tree) : tree_(std::move(tree)) {}

  std::shared_ptr<const MeshTree> tree_;
};

/// Shape of a static body, or of one that carries it. A Box is solid, and so is the side of a HalfSpace where
/// bodies may not be.
using Shape = std::variant<Ball, HalfSpace, Box, Triangle, Mesh>;

/// Definition of a body that never moves: World::add_static().
struct StaticDefinition {
  Shape shape{};
  /// Selects the bodies that it may touch, sense and be sensed by. Two static bodies never meet.
  Filter filter{};
  /// As in BodyDefinition: false for a zone, which only senses.
  bool solid = true;
  SensorClass sensor_class = 0;
  /// Stored for the caller; the world does not interpret it.
  std::uint64_t user_data = 0;

  friend bool operator==(const StaticDefinition&, const StaticDefinition&) = default;
};

/// Definition of a body whose surface is that of a shape, which it carries along without turning it:
/// World::add_moving_shape(). Lifts, pistons, doors, paddles and walls that close in are moving shapes. They
/// meet all bodies that their filters let them meet, but no walls of the world's box.
struct MovingShape {
  /// As for World::add(), with any position. The radius is replaced by that of the smallest ball around the
  /// position that contains the shape. A mass of infinity makes a body that no contact turns.
  BodyDefinition body{};
  /// A Box, a Triangle or a Mesh, relative to the body's position. The position should be near the middle of
  /// the shape: the world searches within that ball.
  Shape shape = Box{};

  friend bool operator==(const MovingShape&, const MovingShape&) = default;
};

/// Returns one body with this filter whose shape is the Mesh of these triangles, for World::add_static_all();
/// none without triangles. Errors: as Mesh::create().
Result<std::vector<StaticDefinition>> mesh(std::span<const Vec3> vertices,
                                           std::span<const std::array<std::uint32_t, 3>> corners,
                                           const Filter& filter = {});
/// Returns one body for each triple of indices into `vertices`, a triangle with this filter; user_data is the
/// number of the triple. They are met one by one, also at the edges that they share: what slides or rolls
/// over these is braked and turned. Errors: as Mesh::create().
Result<std::vector<StaticDefinition>> triangles(std::span<const Vec3> vertices,
                                                std::span<const std::array<std::uint32_t, 3>> corners,
                                                const Filter& filter = {});

/// The point of a shape nearest to a given point.
struct SurfacePoint {
  /// A point on the surface of the shape, to within rounding.
  Vec3 point{};
  /// Unit vector from the shape towards the given point. For a given point on a triangle it is either
  /// normal.
  Vec3 normal{};
  /// Distance (length); negative inside a solid: minus the depth below the nearest face.
  double distance = 0.0;

  friend constexpr bool operator==(const SurfacePoint&, const SurfacePoint&) = default;
};
/// Return the point of the surface of a shape nearest to `from`. Cost: O(1); for a mesh of n triangles about
/// O(log n). The normal of a mesh is that of the nearest triangle, as far as rounding could tell.
SurfacePoint nearest_point(const HalfSpace& shape, const Vec3& from);
SurfacePoint nearest_point(const Box& shape, const Vec3& from);
SurfacePoint nearest_point(const Triangle& shape, const Vec3& from);
SurfacePoint nearest_point(const Mesh& shape, const Vec3& from);

/// Like earliest_meeting() of two bounds (bound.hpp), with a solid box, a triangle or a mesh at rest instead
/// of the second bound. Each iteration steps to the supporting plane that faces the centre; exact for a
/// ballistic body that meets a face. A mesh asks the triangles that may be met first.
double earliest_meeting(const Bound& bound, const Box& shape, double from, double until,
                        double distance = 0.0);
double earliest_meeting(const Bound& bound, const Triangle& shape, double from, double until,
                        double distance = 0.0);
double earliest_meeting(const Bound& bound, const Mesh& shape, double from, double until,
                        double distance = 0.0);

/// Like earliest_separation() of two bounds. It follows a point of the shape that moves with the centre for
/// as long as it can.
double earliest_separation(const Bound& bound, const Box& shape, double from, double until, double distance);
double earliest_separation(const Bound& bound, const Triangle& shape, double from, double until,
                           double distance);
double earliest_separation(const Bound& bound, const Mesh& shape, double from, double until, double distance);

/// Like gap_limits() of two bounds (bound.hpp).
GapLimits gap_limits(const Bound& bound, const Box& shape, double t);
GapLimits gap_limits(const Bound& bound, const Triangle& shape, double t);
GapLimits gap_limits(const Bound& bound, const Mesh& shape, double t);

/// Returns the bounding box of the part of the shape within `limit` of the origin on each axis, rounded
/// outward.
Box bounding_box(const Shape& shape, double limit);

}  // namespace kinesphere
