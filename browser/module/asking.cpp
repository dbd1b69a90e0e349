// Advancing a world, and its callbacks: states of bodies, and responses to events.
#include <limits>
#include <optional>

#include "exchange.hpp"
#include "kinesphere/step_potential.hpp"
#include "motion_of_bodies.hpp"
#include "numbers.hpp"
#include "simulation/run/scene_answer.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::browser {
namespace {

// These return true if the JavaScript function returned, and false if it threw.
KINESPHERE_IMPORT(probe)
bool javascript_probe(std::size_t count, const double* ids, double time, double* states);
KINESPHERE_IMPORT(respond)
bool javascript_respond(const double* event, double* response);
KINESPHERE_IMPORT(stop)
bool javascript_stop(const double* event);

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Size of a response in numbers: for each of the two bodies a velocity, then for each an angular velocity,
/// then for each an action; whether to stop, whether the two have been turned back, whether they get a state,
/// and it.
constexpr std::size_t response_numbers = 22;

/// Writes a vector, and whether there is one.
void put_optional(const std::optional<Vec3>& velocity, double* numbers) {
  put(velocity.value_or(Vec3{}), numbers);
  numbers[3] = velocity.has_value() ? 1.0 : 0.0;
}

/// Reads a vector, and whether there is one.
std::optional<Vec3> velocity_at(const double* numbers) {
  if (numbers[3] == 0.0) return std::nullopt;
  return vector_at(numbers);
}

/// Returns false, and stores an error, for a motion with bodies in a world that never moved any and has none
/// but static ones: the caller forgot to add them.
bool were_added(const World& world, const MotionHandle* handle) {
  const Counters& counters = world.counters();
  if (handle == nullptr || counters.starts > 0 || counters.restarts > 0) return true;
  const Motion& motion = *handle->motion;
  bool any = false;
  for (std::uint32_t number = 0; number < motion.size() && !any; ++number) any = motion.contains(number);
  if (!any) return true;
  for (const BodyId body : world.bodies())
    if (!world.body(body).value().is_static) return true;
  return fail({ErrorCode::unknown_body, "motion", no_body,
               "motion: its bodies must be added to the world (World.addMotion), which has none that moves"});
}

}  // namespace

Response ask_javascript(const Event& event) {
  double numbers[event_numbers];
  put(event, numbers);
  double response[response_numbers] = {};
  // A function that throws leaves NaN, too.
  if (!javascript_respond(numbers, response)) return {Vec3{nan, nan, nan}, std::nullopt};
  Response answer{.first_velocity = velocity_at(response),
                  .second_velocity = velocity_at(response + 4),
                  .first_angular_velocity = velocity_at(response + 8),
                  .second_angular_velocity = velocity_at(response + 12),
                  .first_action = static_cast<BodyAction>(response[16]),
                  .second_action = static_cast<BodyAction>(response[17]),
                  .turned_back = response[19] != 0.0,
                  .stop = response[18] != 0.0};
  if (response[20] != 0.0) answer.pair_state = static_cast<std::int32_t>(response[21]);
  return answer;
}

Response bounce_roughly(const Event& event, double restitution, const double* numbers) {
  const bool begins = event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
  if (!begins) return {};
  return response_of(event, bounce(event, Roughness{restitution, numbers[0], numbers[1], numbers[2]}));
}

Response bounce_off(const Event& event, std::span<const double> masses, double restitution,
                    double resting_speed) {
  const bool begins = event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
  if (!begins || event.approach_speed <= 0.0) return {};
  const auto mass = [&](BodyId body, double own) {
    return body.index < masses.size() ? masses[body.index] : own;
  };
  const double first = mass(event.first, event.first_mass);
  const double second = mass(event.second, event.second_mass);
  return response_of(event, resting_speed > 0.0 ? settle(event, first, second, restitution, resting_speed)
                                                : bounce(event, first, second, restitution));
}

void ask_javascript(std::span<const BodyId> ids, double time, std::span<State> states) {
  std::vector<double> numbers;
  for (const BodyId id : ids) numbers.push_back(number_of(id));
  std::vector<double> answers(6 * ids.size(), nan);
  (void)javascript_probe(ids.size(), numbers.data(), time, answers.data());
  for (std::size_t k = 0; k < ids.size(); ++k) states[k] = state_at(answers.data() + 6 * k);
}

/// Returns 0 if there is no event until then; 1 if it is in answer(); -1 for an error. Without a motion and a
/// map the JavaScript probe is called.
KINESPHERE_EXPORT(world_advance)
int world_advance(World* world, double until, const MotionHandle* motion, BodyMapHandle* map) {
  if (motion == nullptr && map == nullptr)
    return answer_event(world->advance(until, static_cast<Probe::Function>(ask_javascript)));
  if (!were_added(*world, motion)) return -1;
  MotionOfBodies mover = bodies_of(motion, map);
  const auto event = world->advance(until, [&](std::span<const BodyId> ids, double time,
                                               std::span<State> states) { mover.states(ids, time, states); });
  if (event || !mover.refused()) return answer_event(event);
  fail(*mover.refused());
  return -1;
}

/// One of motion and map is null. In place of masses are the numbers of bounce_roughly(); `other` is the
/// scene or the potential that responds. All events are in answer() afterwards, also after an error.
KINESPHERE_EXPORT(world_run)
bool world_run(World* world, double until, const MotionHandle* motion, BodyMapHandle* map,
               Responding responding, const double* masses, std::size_t mass_count, double restitution,
               double resting_speed, const void* other) {
  answer().clear();
  if (!were_added(*world, motion)) return false;
  // JavaScript functions may use answer() meanwhile.
  std::vector<double> reported;
  MotionOfBodies mover = bodies_of(motion, map);
  const auto answered = [&](const Event& event) -> Response {
    switch (responding) {
      case Responding::nothing:
        return {};
      case Responding::bounces:
        return bounce_off(event, {masses, mass_count}, restitution, resting_speed);
      case Responding::asks_javascript:
        return ask_javascript(event);
      case Responding::as_in_scene:
        return scene_answer(*static_cast<const Scene*>(other), event);
      case Responding::by_potential:
        return static_cast<const StepPotential*>(other)->respond(event);
      case Responding::rough:
        return bounce_roughly(event, restitution, masses);
    }
    return {};
  };
  // With one thread the sink gets an event directly after its response.
  Response last;
  const auto respond = [&](const Event& event) {
    last = mover.possible(event, answered(event));
    return last;
  };
  const auto sink = [&](const Event& event) {
    mover.forget_gone(*world, event, last);
    reported.resize(reported.size() + event_numbers);
    double* const numbers = reported.data() + reported.size() - event_numbers;
    put(event, numbers);
    // What the function threw cannot pass through the module.
    if (last.stop && !javascript_stop(numbers)) world->end_run();
  };
  const auto done = world->run(until, mover, respond, sink);
  answer() = std::move(reported);
  if (!done && mover.refused()) return fail(*mover.refused());
  return is_good(done);
}

/// Returns velocities and angular velocities of two bodies of these masses after a contact; with a resting
/// speed > 0 those of settle().
KINESPHERE_EXPORT(event_bounce)
void event_bounce(const double* event, double first_mass, double second_mass, double restitution,
                  double resting_speed, double* velocities) {
  const Event contact = event_at(event);
  const Bounce after = resting_speed > 0.0
                           ? settle(contact, first_mass, second_mass, restitution, resting_speed)
                           : bounce(contact, first_mass, second_mass, restitution);
  put(after.first_velocity, velocities);
  put(after.second_velocity, velocities + 3);
  put(after.first_angular_velocity, velocities + 6);
  put(after.second_angular_velocity, velocities + 9);
}

/// As event_bounce(), with the masses of the event, for rough balls.
KINESPHERE_EXPORT(event_bounce_rough)
void event_bounce_rough(const double* event, double restitution, double tangential, double friction,
                        double inertia, double* velocities) {
  const Bounce after = bounce(event_at(event), Roughness{restitution, tangential, friction, inertia});
  put(after.first_velocity, velocities);
  put(after.second_velocity, velocities + 3);
  put(after.first_angular_velocity, velocities + 6);
  put(after.second_angular_velocity, velocities + 9);
}

KINESPHERE_EXPORT(potential_create)
StepPotential* potential_create(const World* world, std::size_t count, const double* distances,
                                const double* energies, double outside, double restitution) {
  const auto made = StepPotential::create({.distances = {distances, distances + count},
                                           .energies = {energies, energies + count},
                                           .outside = outside,
                                           .restitution = restitution},
                                          world->definition());
  return is_good(made) ? new StepPotential(*made) : nullptr;
}
KINESPHERE_EXPORT(potential_free) void potential_free(StepPotential* potential) { delete potential; }
KINESPHERE_EXPORT(potential_energy) double potential_energy(const StepPotential* potential, double gap) {
  return potential->energy(gap);
}
/// Writes the numbers of the response.
KINESPHERE_EXPORT(potential_respond)
void potential_respond(const StepPotential* potential, const double* event, double* numbers) {
  const Response response = potential->respond(event_at(event));
  put_optional(response.first_velocity, numbers);
  put_optional(response.second_velocity, numbers + 4);
  numbers[19] = response.turned_back ? 1.0 : 0.0;
}

}  // namespace kinesphere::browser
