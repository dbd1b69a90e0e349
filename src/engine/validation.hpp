// Is this input fit for the promise? The one place that says no.
#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "engine/call_state.hpp"
#include "input/input_check.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

Result<void> check_world(const WorldDefinition& definition);
/// `call` is the function that the caller used, for the message.
Result<void> check_body(const BodyDefinition& body, const WorldDefinition& world, std::string_view call);
Result<void> check_shape(const Shape& shape, const WorldDefinition& world, std::string_view call);
/// Of a body that is in the world already: its radius or its promise as it would be.
Result<void> check_radius(const BodyDefinition& changed, BodyId body, const WorldDefinition& world,
                          std::string_view call);
Result<void> check_limits(const BodyDefinition& changed, BodyId body, const WorldDefinition& world,
                          std::string_view call);
Result<void> check_state(const State& state, const BodyDefinition& definition, BodyId body,
                         const WorldDefinition& world, std::string_view call);
Result<void> check_sensor(const Sensor& sensor, const WorldDefinition& world);
/// Whether a body that senses as far as this has room where space repeats.
Result<void> check_reach(double reach, const BodyDefinition& body, BodyId id, std::string_view argument,
                         const WorldDefinition& world, std::string_view call);
Result<void> check_velocity(const Vec3& velocity, BodyId body, const WorldDefinition& world,
                            std::string_view call);
Result<void> check_report(const State& state, BodyId body, double time, const WorldDefinition& world,
                          std::string_view call = "advance");
/// What a probe or a mover is handed to fill in: check_report refuses it, so one that forgets to answer is
/// told so.
inline constexpr double not_said = std::numeric_limits<double>::quiet_NaN();
inline constexpr State no_answer{{not_said, not_said, not_said}, {not_said, not_said, not_said}};
Result<void> check_time(double until, double now);
/// A world that has been moved from cannot do anything.
Error moved_from_error(std::string_view call);

/// Lengths reach this many contact tolerances: then the rounding of a certificate stays well within one.
double coordinate_limit(const WorldDefinition& world);

/// Another body is where one is to be, as `argument` has it.
Error overlap_error(std::string_view call, BodyId other, const std::string& name_of_other,
                    std::string_view argument = "position");
/// A length of a question: from 0 to four times the largest coordinate.
InputCheck& require_length(InputCheck& check, std::string_view argument, double length,
                           const WorldDefinition& world);
/// In two dimensions z must be 0.
void require_plane(InputCheck& check, const Subject& subject, const Vec3& value,
                   const WorldDefinition& world);

/// A first answer that is an error ends a chain of checks.
template <class... Checks>
Result<void> first_error(const Checks&... checks) {
  Result<void> result;
  (void)((static_cast<bool>(checks) || (result = checks, false)) && ...);
  return result;
}

}  // namespace kinesphere
