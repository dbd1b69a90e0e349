// Fields of the library's records to those of kinesphere.h, and back. Numbers of enumerators and kinds must
// have been checked before.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>

#include "interface/fields.hpp"
#include "kinesphere.h"
#include "kinesphere/body.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/filter.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/monitor/monitor_event.hpp"
#include "kinesphere/monitor/report.hpp"
#include "kinesphere/probe.hpp"
#include "kinesphere/rigid_body.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere::c {

/// Returns `bit` if it is set, else 0: for records with sums of bits.
inline std::uint32_t bit_of(bool set, std::uint32_t bit) { return set ? bit : 0; }

inline BodyId id_of(ks_body_id id) { return {id.index, id.generation, id.world}; }
inline ks_body_id c_id(BodyId id) { return {id.index, id.generation, id.world}; }
inline Vec3 vector_of(const ks_vec3& v) { return {v.x, v.y, v.z}; }
inline ks_vec3 c_vector(const Vec3& v) { return {v.x, v.y, v.z}; }
inline State state_of(const ks_state& state) {
  return {vector_of(state.position), vector_of(state.velocity)};
}
inline ks_state c_state(const State& state) { return {c_vector(state.position), c_vector(state.velocity)}; }
inline Rotation rotation_of(const ks_rotation& rotation) {
  const auto& [w, x, y, z] = rotation.orientation;
  return {{w, x, y, z}, vector_of(rotation.angular_velocity)};
}
inline ks_rotation c_rotation(const Rotation& rotation) {
  const auto& [w, x, y, z] = rotation.orientation;
  return {{w, x, y, z}, c_vector(rotation.angular_velocity)};
}
inline Box box_of(const ks_box& box) { return {vector_of(box.lower), vector_of(box.upper)}; }
inline ks_box c_box(const Box& box) { return {c_vector(box.lower), c_vector(box.upper)}; }
inline Filter filter_of(const ks_filter& filter) { return {filter.category, filter.mask, filter.group}; }
inline ks_filter c_filter(const Filter& filter) { return {filter.category, filter.mask, filter.group}; }

// Numbers, and enumerators that are numbered alike.
template <class From, class To>
requires(std::is_arithmetic_v<From> || std::is_enum_v<From>) &&
    (std::is_arithmetic_v<To> || std::is_enum_v<To>)void convert(From from, To& to) {
  to = static_cast<To>(from);
}
inline void convert(ks_bool from, bool& to) { to = from != 0; }

// In C the number 0 says that there is no event.
inline void convert(EventKind from, ks_event_kind& to) {
  to = KS_EVENT_BOUND_VIOLATION + static_cast<ks_event_kind>(from);
}
inline void convert(ks_event_kind from, EventKind& to) {
  to = static_cast<EventKind>(from - KS_EVENT_BOUND_VIOLATION);
}
inline void convert(MonitorEventKind from, ks_monitor_event_kind& to) {
  to = KS_MONITOR_VERDICT + static_cast<ks_monitor_event_kind>(from);
}

inline void convert(const std::optional<ContactEvents>& from, ks_contacts& to) {
  to = from ? static_cast<ks_contacts>(*from) : KS_CONTACTS_OF_WORLD;
}
inline void convert(ks_contacts from, std::optional<ContactEvents>& to) {
  to.reset();
  if (from != KS_CONTACTS_OF_WORLD) to = static_cast<ContactEvents>(from);
}

inline void convert(const Axes& from, ks_axes& to) {
  to = bit_of(from.x, KS_AXIS_X) | bit_of(from.y, KS_AXIS_Y) | bit_of(from.z, KS_AXIS_Z);
}
inline void convert(ks_axes from, Axes& to) {
  to = {(from & KS_AXIS_X) != 0, (from & KS_AXIS_Y) != 0, (from & KS_AXIS_Z) != 0};
}

inline void convert(const BodyTraits& from, ks_traits& to) {
  to = bit_of(from.is_static, KS_TRAIT_STATIC) | bit_of(from.is_zone, KS_TRAIT_ZONE) |
       bit_of(from.is_sleeping, KS_TRAIT_SLEEPING);
}
inline void convert(ks_traits from, BodyTraits& to) {
  to = {(from & KS_TRAIT_STATIC) != 0, (from & KS_TRAIT_ZONE) != 0, (from & KS_TRAIT_SLEEPING) != 0};
}

inline void convert(const BodyId& from, ks_body_id& to) { to = c_id(from); }
inline void convert(const ks_body_id& from, BodyId& to) { to = id_of(from); }
inline void convert(const Vec3& from, ks_vec3& to) { to = c_vector(from); }
inline void convert(const ks_vec3& from, Vec3& to) { to = vector_of(from); }
inline void convert(const State& from, ks_state& to) { to = c_state(from); }
inline void convert(const ks_state& from, State& to) { to = state_of(from); }
inline void convert(const Filter& from, ks_filter& to) { to = c_filter(from); }
inline void convert(const ks_filter& from, Filter& to) { to = filter_of(from); }

inline void convert(const ErrorBound& from, ks_error_bound& to) {
  const bool is_ball = from == ErrorBound(from.horizontal());
  to = {is_ball ? KS_BOUND_BALL : KS_BOUND_CYLINDER, from.horizontal(), from.vertical()};
}
inline void convert(const ks_error_bound& from, ErrorBound& to) {
  to = from.kind == KS_BOUND_BALL ? ErrorBound(from.horizontal)
                                  : ErrorBound::cylinder(from.horizontal, from.vertical);
}

/// A field on its way to a field of the other record.
template <class From>
struct Converted {
  const From& from;
  template <class To>
  operator To() const {
    To to;
    convert(from, to);
    return to;
  }
};
inline constexpr auto converted = []<class From>(const From& from) { return Converted<From>{from}; };

/// Visits the fields of two records, as interface/fields.hpp goes through them.
inline constexpr auto convert_fields = [](const char* /*name*/, const auto& from, auto& to) {
  convert(from, to);
};

}  // namespace kinesphere::c
