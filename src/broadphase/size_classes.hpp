// The sizes of capsules by levels: which levels share a layer, and how wide the cells of a layer have to be.
// Both are learned when windows start, for the next ones.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "broadphase/inflated_bound.hpp"
#include "broadphase/window.hpp"

namespace kinesphere {

/// Widths of one level differ by less than a factor of 8. Levels that few bodies have are merged with larger
/// ones: each layer costs a search of its own.
class SizeClasses {
 public:
  /// By the size of its capsule for the whole window, however much of it has passed.
  static int size_class_of(const InflatedBound& bound, const Window& window);
  /// The least width of a level (length), a power of two.
  static double unit_of(int level);
  static bool is_size_class(int level);

  /// The level whose layer a body of this level starts in, with many others.
  int size_class_to_start(int level) const;
  /// The same for one that enters by itself: few do that, for whom alone no layer is worth while.
  int size_class_to_enter(int level) const;
  /// What merge() has found holds from now on.
  void use_merged() { merged_ = next_merged_; }
  /// Chooses which levels will share a layer from the numbers of bodies of all that have them. `volume` is
  /// that of the space in which the bodies are, or its area if `flat`.
  void merge(const std::map<int, std::size_t>& bodies, double volume, bool flat);

  /// Layer::coarseness() that such a layer has turned out to need; at first 1.
  float coarseness(int rung, int level) const;
  void set_coarseness(int rung, int level, float coarseness);

  /// For one that was read.
  bool is_valid() const;
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [merged, next_merged, coarse] = self;
    archive(merged, next_merged, coarse);
  }

 private:
  struct Merged {
    int size_class;
    int into;

    template <class Self, class Archive>
    static void serialize(Self& self, Archive& archive) {
      auto& [from, to] = self;
      archive(from, to);
    }
  };
  struct Coarseness {
    int rung;
    int size_class;
    float coarseness;

    template <class Self, class Archive>
    static void serialize(Self& self, Archive& archive) {
      auto& [power, size, edge] = self;
      archive(power, size, edge);
    }
  };

  std::vector<Merged> merged_;       ///< by level
  std::vector<Merged> next_merged_;  ///< the same from the next start on
  std::vector<Coarseness> coarse_;   ///< where it is not 1
};

}  // namespace kinesphere
