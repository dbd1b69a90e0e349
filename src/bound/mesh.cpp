// Meshes: their hierarchy of boxes, their nearest points, and certificates.
#include <algorithm>
#include <numeric>
#include <optional>
#include <string>

#include "bound/mesh_tree.hpp"
#include "bound/reach.hpp"
#include "bound/rigid_certificates.hpp"
#include "bound/safe_steps.hpp"
#include "bound/triangle.hpp"
#include "input/input_check.hpp"

namespace kinesphere {
namespace {

/// Returns what is wrong with a triple of indices, for the message of a call.
std::optional<Error> error_of(const std::string& call, std::span<const Vec3> vertices,
                              const MeshTree::Corners& corners, std::size_t number) {
  const auto& [a, b, c] = corners;
  const auto fits = [&](std::uint32_t corner) { return corner < vertices.size(); };
  if (fits(a) && fits(b) && fits(c) && thickness({vertices[a], vertices[b], vertices[c]}) >= least_thickness)
    return std::nullopt;
  const std::string where = call + ": triangle " + std::to_string(number);
  InputCheck check(where);
  for (const std::size_t corner : corners) {
    check.require(corner < vertices.size(), ErrorCode::out_of_range, {"corners"},
                  "must be less than the number of vertices", vertices.size(), corner);
    if (check.error()) return check.error();
    check.finite({"vertices"}, vertices[corner]);
  }
  check.require(false, ErrorCode::out_of_range, {"vertices"},
                "must span a triangle, its least height relative to its longest side at least",
                least_thickness, thickness({vertices[a], vertices[b], vertices[c]}));
  return check.error();
}

Box united(Box box, const Box& other) {
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = std::min(box.lower[axis], other.lower[axis]);
    box.upper[axis] = std::max(box.upper[axis], other.upper[axis]);
  }
  return box;
}

/// Distance of a point from a box, less what rounding may add to that of a triangle inside.
double distance_key(const Box& box, const Vec3& from, double size) {
  Vec3 away;
  for (int axis = 0; axis < 3; ++axis)
    away[axis] = std::max({box.lower[axis] - from[axis], from[axis] - box.upper[axis], 0.0});
  return norm(away) - 8.0 * rounding::margin * (size + size_of(box));
}

}  // namespace

Box MeshTree::box_of(const Triangle& t) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = std::min({t.a[axis], t.b[axis], t.c[axis]});
    box.upper[axis] = std::max({t.a[axis], t.b[axis], t.c[axis]});
  }
  return box;
}

MeshTree::MeshTree(std::vector<Vec3> vertices, std::vector<Corners> corners)
    : vertices_(std::move(vertices)), corners_(std::move(corners)), order_(corners_.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(order_.size());
  std::vector<Vec3> middles;
  middles.reserve(corners_.size());
  for (const auto& [a, b, c] : corners_)
    middles.push_back(0.25 * vertices_[a] + 0.25 * vertices_[b] + 0.25 * vertices_[c]);
  add_node(0, static_cast<std::uint32_t>(order_.size()), middles);
  nodes_.shrink_to_fit();
  is_chain_ = has_walls_alone();
}

/// Returns true if each two triangles are the wall over a segment that chain() makes of them.
bool MeshTree::has_walls_alone() const {
  const auto is_over = [](const Vec3& a, const Vec3& b) { return a.x == b.x && a.y == b.y && a.z == -b.z; };
  for (std::size_t k = 0; k < corners_.size(); k += 2) {
    if (k + 1 == corners_.size()) return false;
    const Triangle one = triangle(k);
    const Triangle other = triangle(k + 1);
    if (!(one.a == other.a && one.c == other.b && one.a.z < 0.0 && one.a.z == one.b.z &&
          is_over(one.c, one.b) && is_over(other.c, other.a)))
      return false;
  }
  return true;
}

/// Adds the node of some triangles and all below it. They are halved along the longest axis of their middles;
/// equal middles are ordered by number, so that the same triangles are together everywhere.
void MeshTree::add_node(std::uint32_t begin, std::uint32_t end, std::span<const Vec3> middles) {
  const std::size_t number = nodes_.size();
  const auto from = order_.begin() + begin;
  const auto to = order_.begin() + end;
  nodes_.push_back({{}, begin, end - begin});
  if (end - begin <= most_in_leaf) {
    std::sort(from, to);
    Box box = box_of(triangle(*from));
    std::for_each(from + 1, to, [&](std::uint32_t k) { box = united(box, box_of(triangle(k))); });
    nodes_[number].box = box;
    return;
  }
  Box box{middles[*from], middles[*from]};
  std::for_each(from, to, [&](std::uint32_t k) { box = united(box, {middles[k], middles[k]}); });
  const Vec3 wide = box.upper - box.lower;
  const int axis = wide.x >= wide.y && wide.x >= wide.z ? 0 : wide.y >= wide.z ? 1 : 2;
  const std::uint32_t half = begin + (end - begin) / 2;
  std::nth_element(from, order_.begin() + half, to, [&](std::uint32_t a, std::uint32_t b) {
    const double at_a = middles[a][axis];
    const double at_b = middles[b][axis];
    return at_a != at_b ? at_a < at_b : a < b;
  });
  add_node(begin, half, middles);
  const std::size_t second = nodes_.size();
  add_node(half, end, middles);
  nodes_[number] = {united(nodes_[number + 1].box, nodes_[second].box), static_cast<std::uint32_t>(second),
                    0};
}

Result<Mesh> Mesh::create(std::span<const Vec3> vertices,
                          std::span<const std::array<std::uint32_t, 3>> corners) {
  const std::string call = "Mesh::create";
  InputCheck check(call);
  check.require(!corners.empty(), ErrorCode::out_of_range, {"corners"}, "must have at least one triangle",
                corners.size());
  check.require(corners.size() < limits::most_triangles, ErrorCode::out_of_range, {"corners"},
                "must have fewer triangles than", limits::most_triangles, corners.size());
  if (check.error()) return *check.error();
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (const auto error = error_of(call, vertices, corners[k], k)) return *error;
  return Mesh(
      std::make_shared<const MeshTree>(std::vector<Vec3>(vertices.begin(), vertices.end()),
                                       std::vector<MeshTree::Corners>(corners.begin(), corners.end())));
}

Result<Mesh> Mesh::chain(std::span<const Vec3> points) {
  InputCheck check("Mesh::chain");
  check.require(points.size() >= 2, ErrorCode::out_of_range, {"points"}, "must be at least two",
                points.size());
  std::vector<Vec3> vertices;
  std::vector<MeshTree::Corners> corners;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Subject subject{"points", no_body, {}, k};
    check.finite(subject, points[k])
        .require(points[k].z == 0.0, ErrorCode::out_of_range, subject, "must have z = 0", points[k])
        .require(k == 0 || points[k] != points[k - 1], ErrorCode::out_of_range, subject,
                 "must differ from the point before", points[k]);
    if (check.error()) return *check.error();
    if (k == 0) continue;
    const Vec3 up{0.0, 0.0, 0.5 * norm(points[k] - points[k - 1])};
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Vec3& vertex : {points[k - 1] - up, points[k] - up, points[k] + up, points[k - 1] + up})
      vertices.push_back(vertex);
    corners.push_back({first, first + 1, first + 2});
    corners.push_back({first, first + 2, first + 3});
  }
  if (check.error()) return *check.error();
  return create(vertices, corners);
}

bool Mesh::is_chain() const { return tree_ && tree_->is_chain(); }

std::size_t Mesh::size() const { return tree_ ? tree_->corners().size() : 0; }
Triangle Mesh::triangle(std::size_t number) const { return tree_->triangle(number); }
std::span<const Vec3> Mesh::vertices() const {
  return tree_ ? std::span<const Vec3>(tree_->vertices()) : std::span<const Vec3>();
}
std::span<const std::array<std::uint32_t, 3>> Mesh::corners() const {
  return tree_ ? std::span<const MeshTree::Corners>(tree_->corners()) : std::span<const MeshTree::Corners>();
}

bool operator==(const Mesh& a, const Mesh& b) {
  if (a.tree_ == b.tree_) return true;
  return a.tree_ && b.tree_ && a.tree_->corners() == b.tree_->corners() &&
         a.tree_->vertices() == b.tree_->vertices();
}

Result<std::vector<StaticDefinition>> mesh(std::span<const Vec3> vertices,
                                           std::span<const std::array<std::uint32_t, 3>> corners,
                                           const Filter& filter) {
  if (corners.empty()) return std::vector<StaticDefinition>();
  auto surface = Mesh::create(vertices, corners);
  if (!surface) return surface.error();
  return std::vector<StaticDefinition>{{.shape = std::move(*surface), .filter = filter}};
}

Result<std::vector<StaticDefinition>> triangles(std::span<const Vec3> vertices,
                                                std::span<const std::array<std::uint32_t, 3>> corners,
                                                const Filter& filter) {
  std::vector<StaticDefinition> triangles;
  triangles.reserve(corners.size());
  for (const auto& triple : corners) {
    if (const auto error = error_of("triangles", vertices, triple, triangles.size())) return *error;
    const auto& [a, b, c] = triple;
    triangles.push_back({.shape = Triangle{vertices[a], vertices[b], vertices[c]},
                         .filter = filter,
                         .user_data = triangles.size()});
  }
  return triangles;
}

Vec3 steadied(const Vec3& direction, const Triangle& triangle, double distance, double size) {
  // Divided by its length, a normal along an axis is exact.
  const Vec3 given = TriangleFrame(triangle).normal();
  const Vec3 normal = given / norm(given);
  // Directions of points that hardly have a distance mean little; approach_error() has the same limit.
  constexpr double most_tilted = 0x1p-20;
  const double lost = 0x1p-45 * (size + size_of(triangle));
  const double tilt = distance * most_tilted > lost ? lost / distance : most_tilted;
  if (!(norm(cross(direction, normal)) <= tilt)) return direction;
  return dot(direction, normal) < 0.0 ? -normal : normal;
}

MeshPoint nearest_in(const Mesh& mesh, const Vec3& from) {
  const double size = norm_one(from);
  MeshPoint nearest;
  nearest.surface.distance = infinity;
  if (mesh.size() == 0) return nearest;
  Triangle at;
  tree_of(mesh).search([&](const Box& box) { return distance_key(box, from, size); },
                       [&] { return nearest.surface.distance; },
                       [&](std::uint32_t number, const Triangle& triangle) {
                         const SurfacePoint own = nearest_point(triangle, from);
                         const double best = nearest.surface.distance;
                         if (own.distance > best || (own.distance == best && number > nearest.triangle))
                           return true;
                         nearest = {own, number};
                         at = triangle;
                         return true;
                       });
  nearest.surface.normal = steadied(nearest.surface.normal, at, nearest.surface.distance, size);
  if (mesh.is_chain() && from.z == 0.0) {
    nearest.surface.normal = without_z(nearest.surface.normal);
    nearest.surface.point = without_z(nearest.surface.point);
  }
  return nearest;
}

SurfacePoint nearest_point(const Mesh& shape, const Vec3& from) { return nearest_in(shape, from).surface; }

double earliest_meeting(const Bound& bound, const Mesh& shape, double from, double until, double distance) {
  double first = infinity;
  if (shape.size() == 0) return first;
  const auto limit = [&] { return std::min(first, until); };
  tree_of(shape).search([&](const Box& box) { return earliest_meeting(bound, box, from, limit(), distance); },
                        limit,
                        [&](std::uint32_t, const Triangle& triangle) {
                          first = std::min(first, earliest_meeting(bound, triangle, from, limit(), distance));
                          return first > from;
                        });
  return first;
}

double earliest_separation(const Bound& bound, const Mesh& shape, double from, double until,
                           double distance) {
  double time = from;
  if (shape.size() == 0) return time;
  for (int round = 0; round < most_rounds; ++round) {
    // Whatever triangle is chosen, the mesh is not farther than it.
    const Triangle nearest = shape.triangle(nearest_in(shape, bound.centre_at(time)).triangle);
    const double later = earliest_separation(bound, nearest, time, until, distance);
    if (later == infinity) return infinity;
    const double gain = later - time;
    time = std::max(time, later);
    if (!(gain > (time - from) * negligible_gain)) break;
  }
  return time;
}

double earliest_sinking(const Bound& bound, const Mesh& mesh, double from, double until,
                        const Sinking& sinking) {
  const double outer = std::max(sinking.approaching, sinking.receding);
  const Vec3 centre = bound.centre_at(from);
  const Vec3 velocity = bound.velocity_at(from);
  double first = infinity;
  const auto limit = [&] { return std::min(first, until); };
  tree_of(mesh).search(
      [&](const Box& box) { return earliest_meeting(bound, box, from, limit(), outer); }, limit,
      [&](std::uint32_t, const Triangle& triangle) {
        // Along the direction of now, the triangle keeps its distance as long as its plane does.
        const double closing = bound.growth_speed - dot(nearest_point(triangle, centre).normal, velocity);
        const double distance = closing > sinking.speed ? sinking.approaching : sinking.receding;
        first = std::min(first, earliest_meeting(bound, triangle, from, limit(), distance));
        return first > from;
      });
  return first;
}

GapLimits gap_limits(const Bound& bound, const Mesh& shape, double t) {
  const Vec3 centre = bound.centre_at(t);
  const double size = norm_one(centre) + bound.radius_at(t);
  if (!(size <= limits::largest_size)) return {-infinity, infinity};
  GapLimits limits{infinity, infinity};
  if (shape.size() == 0) return limits;
  tree_of(shape).search([&](const Box& box) { return distance_key(box, centre, size); },
                        [&] { return limits.upper + bound.radius; },
                        [&](std::uint32_t, const Triangle& triangle) {
                          const GapLimits own = gap_limits(bound, triangle, t);
                          limits = {std::min(limits.lower, own.lower), std::min(limits.upper, own.upper)};
                          return true;
                        });
  return limits;
}

}  // namespace kinesphere
