// A grid level: the swept spheres of the bodies of about one size in one window. It converts the bodies'
// times and lengths to the units of the level's frame.
#pragma once

#include <cstdint>
#include <tuple>

#include "broadphase/inflated_bound.hpp"
#include "broadphase/size_classes.hpp"
#include "broadphase/swept_sphere_grid.hpp"
#include "broadphase/window.hpp"

namespace kinesphere {

/// A level stays until windows end (BroadPhase::end_windows()), even if all its bodies leave.
struct GridLevel {
  Window window{.end = -infinity};  ///< ends at -infinity if the level is unused
  int size_class = 0;
  bool has_frame = false;  ///< a level without a frame is empty
  bool fresh = false;      ///< all bodies in it have started since the last BroadPhase::end_windows()
  SweptSphereGrid spheres{};
  std::uint64_t changes = 0;  ///< entries, replacements and removals since the last sort at a restart

  bool is_of(const Window& its_window, int its_size_class) const {
    return window == its_window && size_class == its_size_class;
  }
  /// Strict order of grid levels. Of two fresh levels, the bodies of the lesser one search the other level.
  bool is_before(const GridLevel& other) const {
    return std::tie(window.rung, size_class, window.end) <
           std::tie(other.window.rung, other.size_class, other.window.end);
  }
  bool is_empty() const { return spheres.size() == 0; }

  /// Gives an empty level a frame: lengths count from `base`, times from `origin` until the window ends.
  void open(const Vec3& base, double origin, float coarseness);
  /// Returns the swept sphere of a body from `now` until the window ends, in units of the frame.
  SweptSphere swept_sphere(const InflatedBound& bound, double now) const;
  /// Converts a time to units of the frame; 0 in the endless window.
  float time(double now) const;
  /// Returns a query for the bodies that `bound` may touch from `now` until `end` or until the window ends,
  /// whichever is earlier.
  SweptSphereQuery query(const InflatedBound& bound, double now, double end) const;
  /// Upper limit of the widths of the level's swept spheres (length).
  double widest() const { return spheres.widest() / spheres.frame().per_length; }
  /// Returns a box that contains the body at a slot from `now` until the window ends.
  Box box_at(std::uint32_t slot, double now) const;
  /// Calls visit(box, number of bodies) for each cell that holds a body.
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

  /// True if the deserialized state is consistent.
  bool is_valid() const;
};

}  // namespace kinesphere
