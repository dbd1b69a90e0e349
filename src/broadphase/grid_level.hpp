// A layer and whose it is: the bodies of about one size in one window, whose times and lengths it turns into
// those of its capsules.
#pragma once

#include <cstdint>
#include <tuple>

#include "broadphase/inflated_bound.hpp"
#include "broadphase/size_classes.hpp"
#include "broadphase/swept_sphere_grid.hpp"
#include "broadphase/window.hpp"

namespace kinesphere {

/// It stays until windows end, even if all of its bodies leave.
struct GridLevel {
  Window window{.end = -infinity};  ///< ends at -infinity if it is nobody's
  int size_class = 0;
  bool has_frame = false;  ///< without one it is empty
  bool fresh = false;      ///< all in it have started since windows ended
  SweptSphereGrid spheres{};
  std::uint64_t changes = 0;  ///< since it was last sorted as windows started

  bool is_of(const Window& its_window, int its_level) const {
    return window == its_window && size_class == its_level;
  }
  /// The order in which layers search each other.
  bool is_before(const GridLevel& other) const {
    return std::tie(window.rung, size_class, window.end) <
           std::tie(other.window.rung, other.size_class, other.window.end);
  }
  bool is_empty() const { return spheres.size() == 0; }

  /// Gives an empty layer a frame: lengths from `base`, times from `origin` until the window ends.
  void open(const Vec3& base, double origin, float coarseness);
  /// Of a body from now on until the window ends.
  SweptSphere swept_sphere(const InflatedBound& bound, double now) const;
  /// In the frame.
  float time(double now) const;
  /// Whom this bound may touch from now on until `end` or until the window ends.
  SweptSphereQuery query(const InflatedBound& bound, double now, double end) const;
  /// No capsule is wider (length).
  double widest() const { return spheres.widest() / spheres.frame().per_length; }
  /// Contains the body from `now` on until the window ends.
  Box box_at(std::uint32_t place, double now) const;
  /// Calls visit(box, number of bodies) for each cell that holds any.
  template <class Visit>
  void for_each_cell(Visit visit) const {
    const SweptSphereFrame& frame = spheres.frame();
    spheres.for_each_cell([&](const Box& box, std::size_t bodies) {
      visit(Box{frame.base + box.lower / frame.per_length, frame.base + box.upper / frame.per_length},
            bodies);
    });
  }

  void grow(const SweptSphereGrid::Growth& growth) {
    changes += growth.replaced;
    spheres.grow(growth);
  }

  /// For one that was read.
  bool is_valid() const;
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [its_window, size, is_framed, is_fresh, sorted, entered] = self;
    archive(its_window, size, is_framed, is_fresh, sorted, entered);
  }
};

}  // namespace kinesphere
