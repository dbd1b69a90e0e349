// Values of C to values of the library and back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "boundary.hpp"
#include "convert.hpp"
#include "kinesphere/certificates.hpp"
#include "kinesphere/game_world.hpp"
#include "kinesphere/response.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere::c {

// These records have one layout in both languages, so arrays of them pass as they are.
static_assert(sizeof(ks_body_id) == sizeof(BodyId) && offsetof(ks_body_id, world) == offsetof(BodyId, world));
static_assert(sizeof(ks_vec3) == sizeof(Vec3) && offsetof(ks_vec3, z) == offsetof(Vec3, z));
static_assert(sizeof(ks_state) == sizeof(State) && offsetof(ks_state, velocity) == offsetof(State, velocity));
static_assert(sizeof(ks_rotation) == sizeof(Rotation) &&
              offsetof(ks_rotation, angular_velocity) == offsetof(Rotation, angular_velocity));

inline std::span<const BodyId> ids_of(const ks_body_id* ids, std::size_t count) {
  return {reinterpret_cast<const BodyId*>(ids), count};
}
inline std::span<const Vec3> vectors_of(const ks_vec3* vectors, std::size_t count) {
  return {reinterpret_cast<const Vec3*>(vectors), count};
}
inline const ks_body_id* c_ids(std::span<const BodyId> ids) {
  return reinterpret_cast<const ks_body_id*>(ids.data());
}
inline const ks_vec3* c_vectors(std::span<const Vec3> vectors) {
  return reinterpret_cast<const ks_vec3*>(vectors.data());
}
inline ks_rotation* c_rotations(std::span<Rotation> rotations) {
  return reinterpret_cast<ks_rotation*>(rotations.data());
}
inline ks_state* c_states(std::span<State> states) { return reinterpret_cast<ks_state*>(states.data()); }

// Numbers that stand for enumerators are refused, as out_of_range, if they stand for none.

/// Throws BadResult unless `number` is in [least, most].
void require_number(std::string_view call, std::string_view argument, std::int64_t number, std::int64_t least,
                    std::int64_t most);
SensorClass sensor_class_of(std::string_view call, std::int32_t number);
Shape shape_of(std::string_view call, const ks_shape& shape);
/// Throws a Failure if a definition of a body was filled from zeros instead of the defaults, which the
/// function `defaults` gives: its body would touch and sense nothing.
void refuse_zeros(std::string_view call, const ks_filter& filter, std::int32_t solid, double mass,
                  const char* defaults);
BodyDefinition body_of(std::string_view call, const ks_body_definition& body);
ks_body_definition c_body(const BodyDefinition& body);
ErrorBound bound_of(std::string_view call, const ks_error_bound& bound);

WorldDefinition world_of(std::string_view call, const ks_world_definition& caller);
ks_world_definition c_world(const WorldDefinition& definition);
ks_body_view c_view(const BodyView& view);
/// Without its classes and separations.
ks_monitor_definition c_monitor(const MonitorDefinition& definition);

ks_event c_event(const Event& event);
/// Writes what an advance returned, with the world at `time`.
void write_next(const std::optional<Event>& next, double time, ks_event* event);
/// Throws BadResult unless the event is one that c_event() can have made.
Event event_of(std::string_view call, const ks_event& given);

/// Returns the response by `respond`, or, if it is null, by bounces; none if the restitution is NaN. Throws
/// BadResult unless a bounce can have these numbers.
GameResponse response_by(std::string_view call, ks_respond respond, void* user, double restitution,
                         double resting_speed);

/// Throws BadResult if an array or a hull is missing.
RigidBody rigid_of(std::string_view call, const ks_body_definition& body, const ks_rigid_definition& rigid);

/// Empty if `filter` is null.
PairFilter pair_filter_of(ks_pair_filter filter, void* user);

}  // namespace kinesphere::c
