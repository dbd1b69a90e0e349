// Size classes of swept spheres: which classes share a grid level, and how coarse a level's cells have to be.
// A start of windows measures this for the next one.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "broadphase/inflated_bound.hpp"
#include "broadphase/window.hpp"

namespace kinesphere {

/// Swept spheres of one size class differ in width by less than a factor of 8. A class with few bodies is
/// merged into a larger one, because each grid level costs a search of its own.
class SizeClasses {
 public:
  /// Returns the size class of the body's swept sphere for the whole window, however much of it has passed.
  static int size_class_of(const InflatedBound& bound, const Window& window);
  /// Returns the least width of a size class (length), a power of two.
  static double unit_of(int size_class);
  static bool is_size_class(int size_class);

  /// Returns the size class whose grid level a body of this class starts in, at a start of many bodies.
  int size_class_to_start(int size_class) const;
  /// Returns the size class whose grid level a body of this class enters alone. Few bodies enter alone, and a
  /// grid level just for them does not pay.
  int size_class_to_enter(int size_class) const;
  /// Puts the result of the last merge() into effect.
  void use_merged() { merged_ = next_merged_; }
  /// Chooses which size classes will share a grid level. `bodies` holds the number of bodies of each class
  /// that has any. `volume` is the volume of the space in which the bodies are, or its area if `flat`.
  void merge(const std::map<int, std::size_t>& bodies, double volume, bool flat);

  /// Returns the SweptSphereGrid::coarseness() that grid levels of this rung and size class have turned out
  /// to need; at first 1.
  float coarseness(int rung, int size_class) const;
  void set_coarseness(int rung, int size_class, float coarseness);

  /// True if the deserialized state is consistent.
  bool is_valid() const;
  static void serialize(auto& self, auto& archive) {
    auto& [merged, next_merged, coarse] = self;
    archive(merged, next_merged, coarse);
  }

 private:
  struct Merged {
    int size_class;
    int into;
  };
  struct Coarseness {
    int rung;
    int size_class;
    float coarseness;
  };

  std::vector<Merged> merged_;       ///< ascending by size class
  std::vector<Merged> next_merged_;  ///< merged_ from the next start on
  std::vector<Coarseness> coarse_;   ///< entries other than 1
};

}  // namespace kinesphere
