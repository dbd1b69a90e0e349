// What a response to an event says of the bodies, and how it is applied to their motions.
#pragma once

#include <array>
#include <optional>

#include "kinesphere/result.hpp"
#include "kinesphere/run.hpp"
#include "kinesphere/world_definition.hpp"
#include "space/space.hpp"

namespace kinesphere {

/// What a response says of one body of its event. Refers to the response.
struct BodyResponse {
  BodyId body;
  const std::optional<Vec3>& velocity;
  const std::optional<Vec3>& angular_velocity;
  BodyAction action;
};

/// Returns what a response says of the first and of the second body of its event.
inline std::array<BodyResponse, 2> parts_of(const Event& event, const Response& answer) {
  return {{{event.first, answer.first_velocity, answer.first_angular_velocity, answer.first_action},
           {event.second, answer.second_velocity, answer.second_angular_velocity, answer.second_action}}};
}

/// Checks what a response says of the pair. Errors: unsupported for a state of no pair, and where no sensor
/// distance is crossed.
Result<void> check_pair_response(const Event& event, const Response& answer);
/// Gives a response the velocities in the images in which the source has the bodies, where images slide.
void move_to_images_of(MotionSource& source, const Space& space, const Event& event, Response& answer);
/// Sets the origins of all bodies with new velocities, or of none if the source throws or returns a state
/// that check_report() refuses. Errors: those of check_report().
Result<void> apply_response(MotionSource& source, const WorldDefinition& world, const Event& event,
                            const Response& answer);

}  // namespace kinesphere
