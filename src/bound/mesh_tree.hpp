// The triangles of a mesh in a hierarchy of boxes, and searches in it.
//
// All that is certain of a mesh is certain of its triangles (docs/guarantee.md, "Meshes"). A search leaves
// out boxes of which the same is certain as of what is in them: a triangle is no nearer than its box, and is
// not met before.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bound/rounding.hpp"
#include "kinesphere/shape.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

class MeshTree {
 public:
  using Corners = std::array<std::uint32_t, 3>;

  /// Precondition: Mesh::create() accepts both. Cost: O(n log n).
  MeshTree(std::vector<Vec3> vertices, std::vector<Corners> corners);

  const std::vector<Vec3>& vertices() const { return vertices_; }
  const std::vector<Corners>& corners() const { return corners_; }
  Triangle triangle(std::size_t number) const {
    const auto& [a, b, c] = corners_[number];
    return {vertices_[a], vertices_[b], vertices_[c]};
  }
  /// True if chain() can have made the mesh.
  bool is_chain() const { return is_chain_; }
  /// The box of all triangles.
  const Box& box() const { return nodes_.front().box; }

  /// Calls visit(number, triangle) for triangles, those in the boxes with the least key(box) first, until it
  /// returns false. Leaves out boxes whose key is infinite or beyond limit(), which may fall meanwhile. A key
  /// that is NaN leaves nothing out.
  template <class Key, class Limit, class Visit>
  void search(Key key, Limit limit, Visit visit) const {
    struct Waiting {
      std::uint32_t node;
      double key;
    };
    const auto is_out = [&](double of) { return of > limit() || of == infinity; };
    // Each level halves the triangles, of which there are fewer than 2^32, and leaves one node waiting.
    std::array<Waiting, 40> waiting;
    std::size_t count = 0;
    waiting[count++] = {0, key(nodes_.front().box)};
    while (count > 0) {
      const Waiting now = waiting[--count];
      if (is_out(now.key)) continue;
      const Node& node = nodes_[now.node];
      if (node.count > 0) {
        for (std::uint32_t k = node.start; k < node.start + node.count; ++k) {
          const Triangle at = triangle(order_[k]);
          if (node.count > 1 && is_out(key(box_of(at)))) continue;
          if (!visit(order_[k], at)) return;
        }
        continue;
      }
      Waiting near{now.node + 1, key(nodes_[now.node + 1].box)};
      Waiting far{node.start, key(nodes_[node.start].box)};
      if (far.key < near.key) std::swap(near, far);
      waiting[count++] = far;
      waiting[count++] = near;
    }
  }

 private:
  /// A leaf has triangles; the first child of any other node comes next after it.
  struct Node {
    Box box;
    std::uint32_t start = 0;  ///< place of the first triangle in order_, or number of the second child
    std::uint32_t count = 0;  ///< number of triangles; 0 if this is no leaf
  };
  /// Fewer make more boxes, more make more triangles that are asked in vain: 4 took least time on terrain.
  static constexpr std::uint32_t most_in_leaf = 4;

  static Box box_of(const Triangle& t);
  bool has_walls_alone() const;
  void add_node(std::uint32_t begin, std::uint32_t end, std::span<const Vec3> middles);

  std::vector<Vec3> vertices_;
  std::vector<Corners> corners_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;  ///< numbers of the triangles, leaf by leaf
  bool is_chain_ = false;
};

/// Returns the vector of length 1 that events give as the normal: `direction`, or the normal of the triangle
/// if rounding alone may tilt one against the other. `distance`: between the two points that gave the
/// direction; `size`: magnitude of the coordinates that they were computed from.
Vec3 steadied(const Vec3& direction, const Triangle& triangle, double distance, double size);

/// Returns a point or a direction of what is nearest to something in the plane z = 0. A chain is as far above
/// the plane as below, so z is what rounding leaves of 0.
inline Vec3 without_z(const Vec3& vector) { return {vector.x, vector.y, 0.0}; }

/// The point of a mesh nearest to a given point. For a chain and a point with z = 0, it has z = 0, too.
struct MeshPoint {
  SurfacePoint surface;
  std::uint32_t triangle = 0;  ///< of equally near ones the first
};
MeshPoint nearest_in(const Mesh& mesh, const Vec3& from);

struct Sinking;
/// Like earliest_sinking() of a rigid pair (rigid_certificates.hpp): the triangles of the mesh are its
/// points.
double earliest_sinking(const Bound& bound, const Mesh& mesh, double from, double until,
                        const Sinking& sinking);

}  // namespace kinesphere
