// A table of capsules, each of a body, as searches read them: by columns.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "broadphase/swept_sphere.hpp"
#include "broadphase/swept_sphere_search.hpp"

namespace kinesphere {

/// Capsules in no order, each of a body.
struct UnsortedSweptSpheres {
  std::vector<std::uint32_t> numbers;
  std::vector<SweptSphere> spheres;

  explicit UnsortedSweptSpheres(std::size_t size = 0) : numbers(size), spheres(size) {}
};

/// Each capsule has a place, which it keeps until the table is filled anew. Bodies that go leave holes.
class SweptSphereTable {
 public:
  /// In place of the number of a body: nobody's.
  static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

  /// Places are less than this.
  std::uint32_t slots() const { return static_cast<std::uint32_t>(numbers_.size()); }
  std::uint32_t free_slots() const { return free_slots_; }
  /// Bodies that are there.
  std::size_t bodies() const { return numbers_.size() - free_slots_; }
  /// Of a body, or nobody.
  std::uint32_t number_at(std::uint32_t place) const { return numbers_[place]; }
  /// That of a hole is far away.
  SweptSphere swept_sphere_at(std::uint32_t place) const;
  /// Good until a capsule is added.
  SweptSphereColumns columns() const;
  /// All but the holes.
  UnsortedSweptSpheres all() const;

  void clear();
  /// Returns its place, behind all others.
  std::uint32_t add(std::uint32_t number, const SweptSphere& sphere);
  /// Another capsule for the body at a place. Several threads may do that at the same time, at different
  /// places.
  void replace(std::uint32_t place, const SweptSphere& sphere);
  /// Leaves a hole.
  void remove(std::uint32_t place);
  /// Makes so many places, at each of which fill() puts a body before anything else is asked, and keeps
  /// memory for `more` that are added later.
  void resize(std::uint32_t places, std::uint32_t more);
  void fill(std::uint32_t place, std::uint32_t number, const SweptSphere& sphere) {
    numbers_[place] = number;
    store(place, sphere);
  }

  /// For one that was read.
  bool is_valid() const;
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [columns, numbers, holes] = self;
    archive(columns, numbers, holes);
  }

 private:
  void store(std::uint32_t place, const SweptSphere& sphere) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      columns_[axis][place] = sphere.centre[axis];
      columns_[axis + 3][place] = sphere.velocity[axis];
    }
    columns_[6][place] = sphere.radius;
  }

  std::array<std::vector<float>, 7> columns_;  ///< with room behind the last place for a search to read
  std::vector<std::uint32_t> numbers_;
  std::uint32_t free_slots_ = 0;
};

}  // namespace kinesphere
