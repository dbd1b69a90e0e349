// Serialization of those public structs whose fields archives do not find by themselves. A field that is
// added to one of them does not compile until it is added here too.
#pragma once

#include <concepts>
#include <type_traits>

#include "kinesphere/event.hpp"

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
         second_traits, first_state, second_state, point, normal, gap, approach_speed, position_excess,
         velocity_excess, distance, first_user_data, second_user_data, first_mass, second_mass, first_part,
         second_part, first_angular_velocity, second_angular_velocity, first_spin_gain, second_spin_gain,
         acceleration_limit] = self;
  archive(kind, time, first, second, wall, repeated, jammed, already_touching, senses, first_traits,
          second_traits, first_state, second_state, point, normal, gap, approach_speed, position_excess,
          velocity_excess, distance, first_user_data, second_user_data, first_mass, second_mass, first_part,
          second_part, first_angular_velocity, second_angular_velocity, first_spin_gain, second_spin_gain,
          acceleration_limit);
}

}  // namespace kinesphere
