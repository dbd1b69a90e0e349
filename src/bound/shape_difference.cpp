#include "bound/shape_difference.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <type_traits>
#include <variant>

#include "bound/mesh_tree.hpp"
#include "bound/reach.hpp"
#include "bound/rigid_certificates.hpp"
#include "bound/safe_steps.hpp"
#include "bound/triangle.hpp"
#include "bound/witness.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// Of edges that are more nearly parallel, the direction normal to both is that of rounding.
constexpr double nearly_parallel = 0x1p-40;

Vec3 magnitude(const Vec3& vector) { return {std::abs(vector.x), std::abs(vector.y), std::abs(vector.z)}; }

/// Calls visit(solid, number) for a box or a triangle, or for each triangle of a mesh.
template <class Visit>
void for_each_piece(const Shape& shape, bool is_flat, Visit visit) {
  std::visit(
      [&]<class Solid>(const Solid& solid) {
        if constexpr (std::is_same_v<Solid, Mesh>) {
          for (std::uint32_t k = 0; k < solid.size(); ++k) visit(ConvexSolid(solid.triangle(k), is_flat), k);
        } else if constexpr (std::is_same_v<Solid, Box> || std::is_same_v<Solid, Triangle>) {
          visit(ConvexSolid(solid, is_flat), 0u);
        }
      },
      shape);
}

Box box_around(const ConvexSolid& solid) {
  Box box{solid.points.front(), solid.points.front()};
  for (const Vec3& point : solid.points)
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = std::min(box.lower[axis], point[axis]);
      box.upper[axis] = std::max(box.upper[axis], point[axis]);
    }
  return box;
}

/// Calls visit(difference, own number, other number) for the differences of pieces, until it returns false.
/// Leaves out those in boxes whose key(box) is infinite or beyond limit(), as MeshTree::search().
template <class Key, class Limit, class Visit>
void search(const ShapeDifference& shape, bool is_flat, Key key, Limit limit, Visit visit) {
  const Mesh* const own_mesh = std::get_if<Mesh>(&shape.own);
  const Mesh* const other_mesh = std::get_if<Mesh>(&shape.other);
  bool goes_on = true;
  if (other_mesh && other_mesh->size() > 0) {
    for_each_piece(shape.own, is_flat, [&](const ConvexSolid& own, std::uint32_t k) {
      const Box around = box_around(own);
      if (!goes_on) return;
      tree_of(*other_mesh)
          .search([&](const Box& box) { return key(difference_of(around, box)); }, limit,
                  [&](std::uint32_t j, const Triangle& triangle) {
                    const ConvexSolid other(triangle, is_flat);
                    return goes_on = visit(ConvexDifference(own, other), k, j);
                  });
    });
  } else if (own_mesh && own_mesh->size() > 0) {
    for_each_piece(shape.other, is_flat, [&](const ConvexSolid& other, std::uint32_t) {
      const Box around = box_around(other);
      tree_of(*own_mesh).search([&](const Box& box) { return key(difference_of(box, around)); }, limit,
                                [&](std::uint32_t k, const Triangle& triangle) {
                                  const ConvexSolid own(triangle, is_flat);
                                  return visit(ConvexDifference(own, other), k, 0u);
                                });
    });
  } else if (!own_mesh && !other_mesh) {
    for_each_piece(shape.own, is_flat, [&](const ConvexSolid& own, std::uint32_t) {
      for_each_piece(shape.other, is_flat, [&](const ConvexSolid& other, std::uint32_t) {
        visit(ConvexDifference(own, other), 0u, 0u);
      });
    });
  }
}

}  // namespace

ConvexSolid::ConvexSolid(const Box& given, bool is_flat) : box(given) {
  if (is_flat) box->lower.z = box->upper.z = 0.0;
  for (const double x : {box->lower.x, box->upper.x})
    for (const double y : {box->lower.y, box->upper.y}) {
      points.push_back({x, y, box->lower.z});
      if (!is_flat) points.push_back({x, y, box->upper.z});
    }
  normals = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  if (is_flat) return;
  normals.push_back({0.0, 0.0, 1.0});
  edges = normals;
}

ConvexSolid::ConvexSolid(const Triangle& triangle, bool is_flat) {
  if (is_flat) {
    // Of a triangle of a chain, the first two corners are above or below the ends of its segment.
    const Vec3 end = without_z(triangle.b);
    points = {without_z(triangle.a), end, end};
    const Vec3 across = cross(Vec3{0.0, 0.0, 1.0}, points[1] - points[0]);
    normals = {across / norm(across)};
    return;
  }
  points = {triangle.a, triangle.b, triangle.c};
  edges = {triangle.b - triangle.a, triangle.c - triangle.b, triangle.a - triangle.c};
  const Vec3 normal = TriangleFrame(triangle).normal();
  normals = {normal / norm(normal)};
}

ConvexDifference::ConvexDifference(const ConvexSolid& own, const ConvexSolid& other)
    : own_(own), other_(other) {
  const auto add = [&](const Vec3& normal) {
    faces_.push_back(face(normal));
    faces_.push_back(face(-normal));
  };
  for (const Vec3& normal : own.normals) add(normal);
  for (const Vec3& normal : other.normals) add(normal);
  if (own.box && other.box) return;
  for (const Vec3& u : own.edges)
    for (const Vec3& v : other.edges) {
      const Vec3 across = cross(u, v);
      const double length = norm(across);
      if (length > nearly_parallel * norm(u) * norm(v)) add(across / length);
    }
}

/// Returns the plane with this normal that has the difference just below it.
ConvexDifference::Face ConvexDifference::face(const Vec3& normal) const {
  const Vec3 along = magnitude(normal);
  double least = infinity, most = -infinity, own_size = 0.0, other_size = 0.0;
  for (const Vec3& point : own_.points) {
    least = std::min(least, dot(normal, point));
    own_size = std::max(own_size, dot(along, magnitude(point)));
  }
  for (const Vec3& point : other_.points) {
    most = std::max(most, dot(normal, point));
    other_size = std::max(other_size, dot(along, magnitude(point)));
  }
  return {normal, most - least, rounding::margin * (own_size + other_size)};
}

NearestInHulls ConvexDifference::nearest(const Vec3& place, std::vector<Vec3>& own, Corners& near) const {
  own.reserve(own_.points.size());
  for (const Vec3& point : own_.points) own.push_back(place + point);
  if (other_.box)
    near = corners_near(own, *other_.box);
  else
    for (const Vec3& point : other_.points) near.add(point);
  return nearest_in_hulls(own, near.all());
}

/// Returns the direction along which the place is farthest out of the difference: that of a face or, beside
/// an edge or a corner, of the nearest point.
ConvexDifference::Way ConvexDifference::way_out(const Vec3& place) const {
  Way best{{}, -infinity};
  for (const Face& face : faces_)
    if (const double out = dot(face.normal, place) - face.offset; out > best.separation) best = {face, out};
  if (!(best.separation > 0.0)) return best;
  std::vector<Vec3> own;
  Corners near;
  const Face beside = face(nearest(place, own, near).normal);
  const double out = dot(beside.normal, place) - beside.offset;
  // A normal of a face is more exact than one that was computed from points.
  return out > best.separation + 8.0 * (beside.wrong + rounding::margin * norm_one(place)) ? Way{beside, out}
                                                                                           : best;
}

/// Calls visit(witness) with points of the two that are nearest at a time.
template <class Visit>
auto ConvexDifference::with_witness(const Bound& bound, double time, Visit visit) const {
  std::vector<Vec3> own;
  Corners near;
  const NearestInHulls found = nearest(bound.centre_at(time), own, near);
  Witness witness(time);
  for (std::size_t k = 0; k < found.count; ++k) {
    const auto& [first, second, weight] = found.pairs[k];
    Bound point = bound;
    point.position += own_.points[first];
    point.radius += rounding::margin * norm_one(own_.points[first]);
    witness.add(point, {.time = time, .position = near.all()[second]}, 0.0, weight);
  }
  return visit(witness);
}

double ConvexDifference::earliest_meeting(const Bound& bound, double from, double until,
                                          double distance) const {
  double time = from;
  for (int round = 0; round < most_rounds; ++round) {
    const HalfSpace plane = way_out(bound.centre_at(time)).face.raised();
    const double next = kinesphere::earliest_meeting(bound, plane, time, until, distance);
    if (next == infinity) return infinity;
    const double gain = next - time;
    time = next;
    if (!(gain > (time - from) * negligible_gain)) break;
  }
  return time;
}

/// Inside, a place is as deep as the nearest face, along whatever normal that is. Outside, the gap is at most
/// the distance of two points.
double ConvexDifference::earliest_separation(const Bound& bound, double from, double until,
                                             double distance) const {
  const double inside = std::min(distance, -bound.radius);
  double time = from;
  for (int round = 0; round < most_rounds; ++round) {
    double later = infinity;
    for (const Face& face : faces_)
      if (later > time)
        later = std::min(later, kinesphere::earliest_separation(bound, face.lowered(), time, until, inside));
    if (later == infinity) return infinity;
    if (inside < distance)
      later = std::max(later, with_witness(bound, later, [&](const Witness& witness) {
                         return witness.separation(until, distance);
                       }));
    if (later == infinity) return infinity;
    const double gain = later - time;
    time = std::max(time, later);
    if (!(gain > (time - from) * negligible_gain)) break;
  }
  return time;
}

GapLimits ConvexDifference::gap_limits(const Bound& bound, double t) const {
  const Vec3 place = bound.centre_at(t);
  GapLimits limits = kinesphere::gap_limits(bound, way_out(place).face.raised(), t);
  double inside = -infinity;
  for (const Face& face : faces_)
    inside = std::max(inside, kinesphere::gap_limits(bound, face.lowered(), t).upper);
  limits.upper = inside <= -bound.radius
                     ? inside
                     : with_witness(bound, t, [](const Witness& witness) { return witness.largest_gap(); });
  limits.lower = std::min(limits.lower, limits.upper);
  return limits;
}

SurfacePoint ConvexDifference::nearest_point(const Vec3& place) const {
  const Way out = way_out(place);
  std::vector<Vec3> own;
  Corners near;
  const NearestInHulls found = nearest(place, own, near);
  const Vec3 from = found.in_first([&](std::size_t k) { return own[k]; });
  return {from - out.face.normal * (0.5 * std::max(out.separation, 0.0)), out.face.normal, out.separation};
}

// Whole shapes.

double earliest_meeting(const Bound& bound, const ShapeDifference& shape, double from, double until,
                        double distance) {
  double first = infinity;
  const auto limit = [&] { return std::min(first, until); };
  search(
      shape, false, [&](const Box& box) { return earliest_meeting(bound, box, from, limit(), distance); },
      limit,
      [&](const ConvexDifference& piece, std::uint32_t, std::uint32_t) {
        first = std::min(first, piece.earliest_meeting(bound, from, limit(), distance));
        return first > from;
      });
  return first;
}

double earliest_separation(const Bound& bound, const ShapeDifference& shape, double from, double until,
                           double distance) {
  double time = from;
  for (int round = 0; round < most_rounds; ++round) {
    // Whatever piece is chosen, the shapes are not farther apart than it.
    double least = infinity;
    double later = time;
    search(
        shape, false, [&](const Box& box) { return gap_limits(bound, box, time).lower; },
        [&] { return least; },
        [&](const ConvexDifference& piece, std::uint32_t, std::uint32_t) {
          const double gap = piece.gap_limits(bound, time).upper;
          if (!(gap < least)) return true;
          least = gap;
          later = piece.earliest_separation(bound, time, until, distance);
          return later < infinity;
        });
    if (later == infinity) return infinity;
    const double gain = later - time;
    time = std::max(time, later);
    if (!(gain > (time - from) * negligible_gain)) break;
  }
  return time;
}

GapLimits gap_limits(const Bound& bound, const ShapeDifference& shape, double t) {
  GapLimits limits{infinity, infinity};
  search(
      shape, false, [&](const Box& box) { return gap_limits(bound, box, t).lower; },
      [&] { return limits.upper; },
      [&](const ConvexDifference& piece, std::uint32_t, std::uint32_t) {
        const GapLimits own = piece.gap_limits(bound, t);
        limits = {std::min(limits.lower, own.lower), std::min(limits.upper, own.upper)};
        return true;
      });
  return limits;
}

double earliest_sinking(const Bound& bound, const ShapeDifference& shape, double from, double until,
                        const Sinking& sinking) {
  const double outer = std::max(sinking.approaching, sinking.receding);
  const Vec3 centre = bound.centre_at(from);
  const Vec3 velocity = bound.velocity_at(from);
  double first = infinity;
  const auto limit = [&] { return std::min(first, until); };
  search(
      shape, false, [&](const Box& box) { return earliest_meeting(bound, box, from, limit(), outer); }, limit,
      [&](const ConvexDifference& piece, std::uint32_t, std::uint32_t) {
        const double closing = bound.growth_speed - dot(piece.nearest_point(centre).normal, velocity);
        const double distance = closing > sinking.speed ? sinking.approaching : sinking.receding;
        first = std::min(first, piece.earliest_meeting(bound, from, limit(), distance));
        return first > from;
      });
  return first;
}

Box difference_of(const Box& own, const Box& other) {
  return {other.lower - own.upper, other.upper - own.lower};
}

HalfSpace difference_of(const Shape& own, const HalfSpace& other) {
  double least = infinity;
  std::visit(
      [&]<class Solid>(const Solid& solid) {
        if constexpr (std::is_same_v<Solid, Box> || std::is_same_v<Solid, Triangle> ||
                      std::is_same_v<Solid, Mesh>)
          least = -reach(solid, -other.normal);
      },
      own);
  return {other.normal, other.offset - least};
}

NearestPieces nearest_pieces(const Shape& own, const Shape& other, const Vec3& place, bool is_flat) {
  NearestPieces nearest{.surface = {.distance = infinity}};
  const auto order = [](const NearestPieces& found) {
    return std::tuple(found.surface.distance, found.own_part, found.other_part);
  };
  if (const auto* wall = std::get_if<HalfSpace>(&other)) {
    const double distance = dot(wall->normal, place) - difference_of(own, *wall).offset;
    for_each_piece(own, is_flat, [&](const ConvexSolid& piece, std::uint32_t k) {
      const auto height = [&](const Vec3& point) { return dot(wall->normal, place + point) - wall->offset; };
      const Vec3& lowest =
          *std::min_element(piece.points.begin(), piece.points.end(),
                            [&](const Vec3& a, const Vec3& b) { return height(a) < height(b); });
      // The middle of all corners that are as low.
      Vec3 middle;
      double count = 0.0;
      for (const Vec3& point : piece.points) {
        if (height(point) - height(lowest) > 0x1p-40 * norm_one(place + point)) continue;
        middle += place + point;
        count += 1.0;
      }
      middle = middle / count;
      const NearestPieces found{
          {middle - wall->normal * (0.5 * distance), wall->normal, height(lowest)}, k, 0};
      if (order(found) < order(nearest)) nearest = found;
    });
    return nearest;
  }
  const Bound point{.position = place};
  search(
      {own, other}, is_flat, [&](const Box& box) { return gap_limits(point, box, 0.0).lower; },
      [&] { return nearest.surface.distance; },
      [&](const ConvexDifference& piece, std::uint32_t k, std::uint32_t j) {
        const NearestPieces found{piece.nearest_point(place), k, j};
        if (order(found) < order(nearest)) nearest = found;
        return true;
      });
  return nearest;
}

}  // namespace kinesphere
