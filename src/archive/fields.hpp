// Serialization of those public structs whose fields archives do not find by themselves. A field that is
// added to one of them does not compile until it is added here too.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "archive/heap_counter.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere {

/// Satisfied by T and const T.
template <class Self, class T>
concept Some = std::same_as<std::remove_const_t<Self>, T>;

void serialize(Some<BodyId> auto& self, auto& archive) {
  // The tag of the world is left out, because it would make equal histories differ.
  auto& [index, generation, world] = self;
  archive(index, generation);
}

void serialize(Some<Event> auto& self, auto& archive) {
  auto& [kind, time, first, second, wall, repeated, jammed, already_touching, senses, first_traits,
         second_traits, pair_state, first_state, second_state, point, normal, gap, approach_speed,
         position_excess, velocity_excess, distance, first_user_data, second_user_data, first_mass,
         second_mass, first_part, second_part, first_angular_velocity, second_angular_velocity,
         first_spin_gain, second_spin_gain, acceleration_limit] = self;
  archive(kind, time, first, second, wall, repeated, jammed, already_touching, senses, first_traits,
          second_traits, pair_state, first_state, second_state, point, normal, gap, approach_speed,
          position_excess, velocity_excess, distance, first_user_data, second_user_data, first_mass,
          second_mass, first_part, second_part, first_angular_velocity, second_angular_velocity,
          first_spin_gain, second_spin_gain, acceleration_limit);
}

/// The hierarchy of the triangles is made anew where a mesh is read. A mesh that Mesh::create() refuses is
/// read as one without triangles.
void serialize(Some<Mesh> auto& self, auto& archive) {
  using Archive = std::remove_reference_t<decltype(archive)>;
  if constexpr (std::same_as<Archive, HeapCounter>) {
    // Boxes and order, for each triangle.
    constexpr std::size_t hierarchy = 48;
    archive.add(self.vertices().size_bytes() + self.corners().size_bytes() + self.size() * hierarchy);
  } else {
    std::vector<Vec3> vertices(self.vertices().begin(), self.vertices().end());
    std::vector<std::array<std::uint32_t, 3>> corners(self.corners().begin(), self.corners().end());
    archive(vertices, corners);
    if constexpr (!std::is_const_v<std::remove_reference_t<decltype(self)>>) {
      const auto read = Mesh::create(vertices, corners);
      self = read ? read.value() : Mesh{};
    }
  }
}

}  // namespace kinesphere
