// Runs of worlds whose bodies are moved by motions of JavaScript, or by a BodyMap.
#include <cmath>

#include "module.hpp"
#include "number/scope_guard.hpp"
#include "simulation/run/scene_answer.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::browser {
namespace {

/// What answers the events of a run, beside its definition: a scene, or bounces of bodies with these masses,
/// by the indices of ids; bodies beyond them have their own.
struct Responding {
  const Scene* scene;
  std::span<const double> masses;
};

Response bounced(const Event& event, std::span<const double> masses, double restitution,
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

GameResponse response_by(const Responding& responding, const ks_run_definition& definition) {
  if (responding.scene != nullptr)
    return [&](const Event& event) { return scene_answer(*responding.scene, event); };
  if (responding.masses.empty() || definition.respond != nullptr)
    return c::response_by("run", definition.respond, definition.respond_user, definition.restitution,
                          definition.resting_speed);
  return [&](const Event& event) {
    return bounced(event, responding.masses, definition.restitution, definition.resting_speed);
  };
}

void run(World& world, double until, MovedBodies& bodies, const GameResponse& chosen,
         const ks_run_definition& definition, std::vector<ks_event>& happened) {
  // With one thread the sink gets an event directly after its response.
  Response last;
  const auto respond = [&](const Event& event) {
    last = chosen ? chosen(event) : Response{};
    bodies.require_possible(event, last);
    return last;
  };
  const auto sink = [&](const Event& event) {
    bodies.forget_gone(world, event, last);
    happened.push_back(c::c_event(event));
    if (last.stop) c::require_success("sink", definition.sink(&happened.back(), definition.sink_user));
  };
  world.run(until, bodies, respond, sink).value();
}

}  // namespace

/// As ks_world_run(), with a motion or a map, of which one is null, and without threads; the sink gets the
/// events with `stop` alone. Tells all events, also after an error; they are valid until the next run.
KINESPHERE_EXPORT(world_run)
ks_status world_run(ks_world world, double until, const MotionHandle* motion, const BodyMapHandle* map,
                    const ks_run_definition* definition, const Scene* scene, const double* masses,
                    std::size_t mass_count, ks_event_list* told) {
  static std::vector<ks_event> last;
  // Functions of JavaScript may run another world meanwhile.
  std::vector<ks_event> happened;
  const ScopeGuard tell([&] {
    last = std::move(happened);
    *told = {last.size(), last.data()};
  });
  return c::changing("run", world, [&](c::WorldObject& object) {
    const Responding responding{scene, {masses, mass_count}};
    MovedBodies bodies(motion, map);
    run(object.world(), until, bodies, response_by(responding, *definition), *definition, happened);
  });
}

/// Fails for a motion with bodies in a world that never moved any and has none but static ones: the caller
/// forgot to add them.
KINESPHERE_EXPORT(world_check_motion)
ks_status world_check_motion(ks_world world, const MotionHandle* handle) {
  return c::reading("run", world, [&](const c::WorldObject& object) {
    const Counters& counters = object.world().counters();
    if (counters.starts > 0 || counters.restarts > 0) return;
    bool any = false;
    for (std::uint32_t number = 0; number < handle->motion->size() && !any; ++number)
      any = handle->motion->contains(number);
    for (const BodyId body : object.world().bodies())
      if (!object.world().body(body).value().is_static) any = false;
    if (any) {
      detail::bad_result(
          {ErrorCode::unknown_body, "motion", no_body,
           "motion: its bodies must be added to the world (World.addMotion), which has none that moves"});
    }
  });
}

}  // namespace kinesphere::browser
