// A table of swept spheres, each of a body, stored by columns as searches read them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "broadphase/swept_sphere.hpp"
#include "broadphase/swept_sphere_search.hpp"

namespace kinesphere {

/// Swept spheres and the numbers of their bodies, in no particular order.
struct UnsortedSweptSpheres {
  std::vector<std::uint32_t> numbers;
  std::vector<SweptSphere> spheres;
};

/// Each swept sphere has a slot, which it keeps until the next resize() or clear(). Removed bodies leave free
/// slots.
class SweptSphereTable {
 public:
  /// Body number of a free slot.
  static constexpr std::uint32_t free_slot = std::numeric_limits<std::uint32_t>::max();

  /// Number of slots, free ones included.
  std::uint32_t slots() const { return static_cast<std::uint32_t>(numbers_.size()); }
  std::uint32_t free_slots() const { return free_slots_; }
  /// Number of slots that are not free.
  std::size_t bodies() const { return numbers_.size() - free_slots_; }
  /// Returns the number of the body at a slot, or `free_slot` if the slot is free.
  std::uint32_t number_at(std::uint32_t slot) const { return numbers_[slot]; }
  /// Returns the swept sphere at a slot; a free slot has one that is far away.
  SweptSphere swept_sphere_at(std::uint32_t slot) const;
  /// Returns pointers to the columns. Invalidated by add(), resize() and clear().
  SweptSphereColumns columns() const;
  /// Returns the swept spheres of all slots that are not free.
  UnsortedSweptSpheres all() const;

  void clear();
  /// Adds a swept sphere in a new slot behind all others, and returns the slot.
  std::uint32_t add(std::uint32_t number, const SweptSphere& sphere);
  /// Replaces the swept sphere of the body at a slot. Precondition: the slot is not free. Thread safety:
  /// concurrent calls for different slots are safe.
  void replace(std::uint32_t slot, const SweptSphere& sphere);
  /// Makes the slot free. Precondition: it is not free yet.
  void remove(std::uint32_t slot);
  /// Sets the number of slots, none of them free, and reserves memory for `more` slots that are added later.
  /// Precondition of all other calls: fill() or leave_free() has been called for each slot.
  void resize(std::uint32_t count, std::uint32_t more);
  void fill(std::uint32_t slot, std::uint32_t number, const SweptSphere& sphere) {
    numbers_[slot] = number;
    store(slot, sphere);
  }
  void leave_free(std::uint32_t slot);
  /// Gives a free slot to a body.
  void occupy(std::uint32_t slot, std::uint32_t number, const SweptSphere& sphere);

  /// True if the deserialized state is consistent.
  bool is_valid() const;
  static void serialize(auto& self, auto& archive) {
    auto& [columns, numbers, free_slots] = self;
    archive(columns, numbers, free_slots);
  }

 private:
  void store(std::uint32_t slot, const SweptSphere& sphere) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      columns_[axis][slot] = sphere.centre[axis];
      columns_[axis + 3][slot] = sphere.velocity[axis];
    }
    columns_[6][slot] = sphere.radius;
  }

  std::array<std::vector<float>, 7> columns_;  ///< with search_lanes readable numbers behind the last slot
  std::vector<std::uint32_t> numbers_;
  std::uint32_t free_slots_ = 0;
};

}  // namespace kinesphere
