// Functions for the pointers that C takes. Those of JavaScript are imports, which find the function that is
// meant by `user`, a number; they return 1 if it threw.
#include "module.hpp"

namespace kinesphere::browser {
namespace {

KINESPHERE_IMPORT(probe)
std::int32_t javascript_probe(const ks_body_id* bodies, std::size_t count, double time, ks_state* states,
                              void* user);
KINESPHERE_IMPORT(rotate)
std::int32_t javascript_rotate(const ks_body_id* bodies, std::size_t count, double time,
                               ks_rotation* rotations, void* user);
KINESPHERE_IMPORT(filter) std::int32_t javascript_filter(ks_body_id first, ks_body_id second, void* user);
KINESPHERE_IMPORT(respond)
std::int32_t javascript_respond(const ks_event* event, ks_response* response, void* user);
KINESPHERE_IMPORT(sink) std::int32_t javascript_sink(const ks_event* event, void* user);
KINESPHERE_IMPORT(poll)
std::int32_t javascript_poll(const std::uint64_t* tracks, std::size_t count, double time,
                             ks_track_report* reports, std::uint8_t* has_report, void* user);

std::int32_t probe_of(MovedBodies bodies, const ks_body_id* ids, std::size_t count, double time,
                      ks_state* states) {
  bodies.states(c::ids_of(ids, count), time, {reinterpret_cast<State*>(states), count});
  return 0;
}
std::int32_t probe_motion(const ks_body_id* bodies, std::size_t count, double time, ks_state* states,
                          void* user) {
  return probe_of({static_cast<const MotionHandle*>(user), nullptr}, bodies, count, time, states);
}
std::int32_t probe_map(const ks_body_id* bodies, std::size_t count, double time, ks_state* states,
                       void* user) {
  return probe_of({nullptr, static_cast<const BodyMapHandle*>(user)}, bodies, count, time, states);
}

std::int32_t respond_by_potential(const ks_event* event, ks_response* response, void* user) {
  return ks_step_potential_respond(*static_cast<const ks_step_potential*>(user), event, response);
}
std::int32_t respond_roughly(const ks_event* event, ks_response* response, void* user) {
  return ks_bounce_rough(event, static_cast<const ks_roughness*>(user), response);
}

}  // namespace

// Each returns the address of a function, which for JavaScript is a number.
KINESPHERE_EXPORT(callback_probe) ks_probe callback_probe() { return javascript_probe; }
KINESPHERE_EXPORT(callback_probe_motion) ks_probe callback_probe_motion() { return probe_motion; }
KINESPHERE_EXPORT(callback_probe_map) ks_probe callback_probe_map() { return probe_map; }
KINESPHERE_EXPORT(callback_probe_game) ks_probe callback_probe_game() { return ks_probe_motions; }
KINESPHERE_EXPORT(callback_rotate) ks_rotation_probe callback_rotate() { return javascript_rotate; }
KINESPHERE_EXPORT(callback_filter) ks_pair_filter callback_filter() { return javascript_filter; }
KINESPHERE_EXPORT(callback_respond) ks_respond callback_respond() { return javascript_respond; }
KINESPHERE_EXPORT(callback_potential) ks_respond callback_potential() { return respond_by_potential; }
KINESPHERE_EXPORT(callback_rough) ks_respond callback_rough() { return respond_roughly; }
KINESPHERE_EXPORT(callback_sink) ks_sink callback_sink() { return javascript_sink; }
KINESPHERE_EXPORT(callback_poll) ks_poll callback_poll() { return javascript_poll; }

std::vector<double>& answer() {
  static std::vector<double> numbers;
  return numbers;
}
KINESPHERE_EXPORT(answer_numbers) const double* answer_numbers() { return answer().data(); }
KINESPHERE_EXPORT(answer_count) std::size_t answer_count() { return answer().size(); }

}  // namespace kinesphere::browser
