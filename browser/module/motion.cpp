#include "motion.hpp"

#include "exchange.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/motion/steered.hpp"

namespace kinesphere::browser {
namespace {

/// Six numbers for each.
std::vector<State> states_at(const double* numbers, std::size_t count) {
  std::vector<State> states;
  states.reserve(count);
  for (std::size_t k = 0; k < count; ++k) states.push_back(state_at(numbers + 6 * k));
  return states;
}

template <class Created>
MotionHandle* handle_of(Result<Created> created) {
  if (!is_good(created)) return nullptr;
  return new MotionHandle{std::make_unique<Created>(std::move(*created))};
}

bool has(const Motion& motion, double body) {
  return body >= 0.0 && body < static_cast<double>(motion.size()) &&
         motion.contains(static_cast<std::uint32_t>(body));
}

/// What Motion says of itself by exceptions, which there are none of here.
bool knows(const MotionHandle& handle, double body) {
  if (has(*handle.motion, body)) return true;
  return fail(
      {ErrorCode::unknown_body, "body", no_body, "Motion: body must be that of a body of the motion"});
}

}  // namespace

KINESPHERE_EXPORT(motion_ballistic)
MotionHandle* motion_ballistic(std::size_t count, const double* states, const double* gravity, double start) {
  return handle_of(Ballistic::create(
      {.start = states_at(states, count), .gravity = vector_at(gravity), .start_time = start}));
}

KINESPHERE_EXPORT(motion_random_forces)
MotionHandle* motion_random_forces(std::size_t count, const double* states, const double* limits,
                                   double interval, double seed, double start) {
  return handle_of(RandomForces::create({.start = states_at(states, count),
                                         .acceleration_limits = {limits, limits + count},
                                         .interval = interval,
                                         .seed = static_cast<std::uint64_t>(seed),
                                         .start_time = start}));
}

KINESPHERE_EXPORT(motion_steered)
MotionHandle* motion_steered(std::size_t count, const double* states, const double* limits, double start) {
  return handle_of(Steered::create({.start = states_at(states, count),
                                    .acceleration_limits = {limits, limits + count},
                                    .start_time = start}));
}

KINESPHERE_EXPORT(motion_clone) MotionHandle* motion_clone(const MotionHandle* handle) {
  return new MotionHandle{handle->motion->clone()};
}
KINESPHERE_EXPORT(motion_free) void motion_free(MotionHandle* handle) { delete handle; }
KINESPHERE_EXPORT(motion_size) std::size_t motion_size(const MotionHandle* handle) {
  return handle->motion->size();
}
KINESPHERE_EXPORT(motion_contains) bool motion_contains(const MotionHandle* handle, std::uint32_t body) {
  return handle->motion->contains(body);
}

/// Of bodies 0, 1, ... where `bodies` is null. A body that is not there gets NaN. Times before its last
/// change are answered as that.
KINESPHERE_EXPORT(motion_states)
void motion_states(const MotionHandle* handle, double time, std::size_t count, const double* bodies,
                   double* states) {
  const Motion& motion = *handle->motion;
  for (std::size_t k = 0; k < count; ++k) {
    const double body = bodies != nullptr ? bodies[k] : static_cast<double>(k);
    if (has(motion, body)) {
      const auto number = static_cast<std::uint32_t>(body);
      put(motion.state(number, std::max(time, motion.departure(number).time)), states + 6 * k);
    } else {
      std::fill_n(states + 6 * k, 6, std::numeric_limits<double>::quiet_NaN());
    }
  }
}

/// Radius aside: limit, plan (3), position error, velocity error, state (6).
KINESPHERE_EXPORT(motion_definition)
bool motion_definition(const MotionHandle* handle, double body, double time, double* numbers) {
  if (!knows(*handle, body)) return false;
  const auto number = static_cast<std::uint32_t>(body);
  const double from = handle->motion->departure(number).time;
  const BodyDefinition definition = handle->motion->definition(number, std::max(time, from));
  numbers[0] = definition.acceleration_limit;
  put(definition.planned_acceleration, numbers + 1);
  numbers[4] = definition.position_error;
  numbers[5] = definition.velocity_error;
  put({definition.position, definition.velocity}, numbers + 6);
  return true;
}

KINESPHERE_EXPORT(motion_set_velocity)
bool motion_set_velocity(MotionHandle* handle, double body, double time, const double* velocity) {
  return knows(*handle, body) &&
         is_good(handle->motion->set_velocity(static_cast<std::uint32_t>(body), time, vector_at(velocity)));
}

KINESPHERE_EXPORT(motion_teleport)
bool motion_teleport(MotionHandle* handle, double body, double time, const double* state) {
  return knows(*handle, body) &&
         is_good(handle->motion->teleport(static_cast<std::uint32_t>(body), time, state_at(state)));
}

KINESPHERE_EXPORT(motion_remove) bool motion_remove(MotionHandle* handle, double body) {
  return knows(*handle, body) && is_good(handle->motion->remove(static_cast<std::uint32_t>(body)));
}

KINESPHERE_EXPORT(motion_add)
double motion_add(MotionHandle* handle, double time, const double* state, double limit) {
  Result<std::uint32_t> added =
      Error{ErrorCode::unsupported, "motion", no_body, "Motion.add: this motion does not take bodies"};
  if (auto* const ballistic = dynamic_cast<Ballistic*>(handle->motion.get()))
    added = ballistic->add(time, state_at(state));
  if (auto* const forces = dynamic_cast<RandomForces*>(handle->motion.get()))
    added = forces->add(time, state_at(state), limit);
  if (auto* const steered = dynamic_cast<Steered*>(handle->motion.get()))
    added = steered->add(time, state_at(state), limit);
  return is_good(added) ? *added : no_id;
}

KINESPHERE_EXPORT(motion_steer)
bool motion_steer(MotionHandle* handle, double body, double time, const double* acceleration) {
  auto* const steered = dynamic_cast<Steered*>(handle->motion.get());
  if (steered == nullptr)
    return fail({ErrorCode::unsupported, "motion", no_body, "steer: this motion cannot be steered"});
  return knows(*handle, body) &&
         is_good(steered->steer(static_cast<std::uint32_t>(body), time, vector_at(acceleration)));
}

}  // namespace kinesphere::browser
