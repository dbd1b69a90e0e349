// Motions that the library has of the bodies of a world.
#include <limits>
#include <optional>

#include "exchange.hpp"
#include "input/input_check.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/motion/frame_motion.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/motion/steered_motion.hpp"
#include "objects.hpp"

namespace kinesphere::c {
namespace {

/// Copies an array of the definition, which has a number for each body; an optional one may be null.
std::vector<double> numbers_of(const double* numbers, std::size_t count) {
  if (numbers == nullptr) return {};
  return {numbers, numbers + count};
}

std::vector<State> states_of(const ks_motion_definition& definition) {
  std::vector<State> states;
  states.reserve(definition.count);
  for (std::size_t k = 0; k < definition.count; ++k) states.push_back(state_of(definition.states[k]));
  return states;
}

FrameMotion frames_of(const ks_motion_definition& definition, double start_time) {
  FrameMotionDefinition frames{
      .start = {},
      .acceleration_limits = numbers_of(definition.acceleration_limits, definition.count),
      .interval = definition.interval,
      .position_error = definition.position_error,
      .start_time = start_time};
  for (const State& state : states_of(definition)) {
    frames.start.push_back(state.position);
    frames.velocities.push_back(state.velocity);
  }
  return FrameMotion::create(std::move(frames)).value();
}

MotionId<> add(std::string_view call, Simulation& simulation, const ks_motion_definition& definition) {
  const double start_time = simulation.world().time();
  if (definition.kind == KS_MOTION_FRAMES) return simulation.add_motion(frames_of(definition, start_time));
  if (definition.kind == KS_MOTION_BALLISTIC) {
    return simulation.add_motion(Ballistic::create({.start = states_of(definition),
                                                    .gravity = vector_of(definition.gravity),
                                                    .start_time = start_time})
                                     .value());
  }
  require_array(call, definition.acceleration_limits, definition.count, "definition.acceleration_limits");
  std::vector<double> limits = numbers_of(definition.acceleration_limits, definition.count);
  if (definition.kind == KS_MOTION_STEERED) {
    return simulation.add_motion(SteeredMotion::create({.start = states_of(definition),
                                                        .acceleration_limits = std::move(limits),
                                                        .start_time = start_time})
                                     .value());
  }
  return simulation.add_motion(RandomForces::create({.start = states_of(definition),
                                                     .acceleration_limits = std::move(limits),
                                                     .interval = definition.interval,
                                                     .seed = definition.seed,
                                                     .start_time = start_time})
                                   .value());
}

/// Returns a motion of frames. Throws out_of_range for any other one.
const FrameMotion& frame_motion(std::string_view call, const Simulation& simulation, std::uint32_t motion) {
  const auto* const frames = dynamic_cast<const FrameMotion*>(&simulation.motion(MotionId<>{motion}));
  if (frames == nullptr) {
    detail::bad_result(
        {ErrorCode::out_of_range, "motion", no_body,
         std::string(call) + ": motion " + std::to_string(motion) + " must be of kind KS_MOTION_FRAMES"});
  }
  return *frames;
}

/// Adds a body to a motion of one of the four kinds, and returns its number there.
std::uint32_t add_one(std::string_view call, Motion& motion, const ks_motion_definition& definition,
                      std::size_t k, double time) {
  const State state = state_of(definition.states[k]);
  const double* const limits = definition.acceleration_limits;
  if (auto* const flight = dynamic_cast<Ballistic*>(&motion)) return flight->add(time, state).value();
  if (auto* const frames = dynamic_cast<FrameMotion*>(&motion)) {
    const double unlimited = std::numeric_limits<double>::infinity();
    return frames->add(time, state, limits != nullptr ? limits[k] : unlimited).value();
  }
  require_pointer(call, limits, "definition.acceleration_limits");
  if (auto* const ships = dynamic_cast<SteeredMotion*>(&motion))
    return ships->add(time, state, limits[k]).value();
  return dynamic_cast<RandomForces&>(motion).add(time, state, limits[k]).value();
}

/// What the bodies of a definition have beside their motion.
struct Properties {
  BodyDefinition like{};
  std::vector<double> radii;
  std::vector<double> masses;
};

/// Throws unless the definition is a valid one.
Properties properties_of(std::string_view call, const ks_motion_definition& definition) {
  require_array(call, definition.states, definition.count, "definition.states");
  Properties properties{.radii = numbers_of(definition.radii, definition.count),
                        .masses = numbers_of(definition.masses, definition.count)};
  if (definition.like != nullptr) {
    require_record(call, definition.like, "definition.like");
    properties.like = body_of(call, *definition.like);
  }
  if (definition.radii == nullptr) properties.radii.assign(definition.count, properties.like.radius);
  if (definition.masses == nullptr) properties.masses.assign(definition.count, properties.like.mass);
  InputCheck check(call);
  for (std::size_t k = 0; k < definition.count; ++k)
    check.not_negative_or_infinite({.argument = "definition.masses", .part = "entry", .part_number = k},
                                   properties.masses[k]);
  check.result().value();
  return properties;
}

struct AddedMotion {
  MotionId<> motion;
  std::vector<BodyId> bodies;
};

AddedMotion add_motion(std::string_view call, WorldObject& object, const ks_motion_definition& definition) {
  require_number(call, "definition.kind", definition.kind, KS_MOTION_BALLISTIC, KS_MOTION_STEERED);
  const Vec3 gravity = vector_of(definition.gravity);
  InputCheck(call)
      .require(definition.kind == KS_MOTION_BALLISTIC || gravity == Vec3{}, ErrorCode::out_of_range,
               {"definition.gravity"}, "must be 0 for all kinds but KS_MOTION_BALLISTIC", gravity)
      .result()
      .value();
  const Properties properties = properties_of(call, definition);
  require_idle(object.world());
  const MotionId<> motion = add(call, object.simulation(), definition);
  auto bodies = object.simulation().add_all(motion, properties.radii, properties.like).value();
  for (std::size_t k = 0; k < bodies.size(); ++k)
    object.world().change(bodies[k], {.mass = properties.masses[k]}).value();
  return {motion, std::move(bodies)};
}

/// Bodies that join a motion, until kept: then they stay.
class JoiningBodies {
 public:
  JoiningBodies(Simulation& simulation, MotionId<> motion) : simulation_(simulation), motion_(motion) {}
  JoiningBodies(const JoiningBodies&) = delete;
  JoiningBodies& operator=(const JoiningBodies&) = delete;
  ~JoiningBodies() {
    for (const BodyId body : ids_) (void)simulation_.remove(body);
  }

  void join(std::uint32_t number, const BodyDefinition& like) {
    ScopeGuard forget([&] { (void)simulation_.motion(motion_).remove(number); });
    ids_.push_back(simulation_.add(motion_, number, like).value());
    forget.dismiss();
  }
  std::vector<BodyId> keep() { return std::exchange(ids_, {}); }

 private:
  Simulation& simulation_;
  MotionId<> motion_;
  std::vector<BodyId> ids_;
};

std::vector<BodyId> add_to_motion(std::string_view call, WorldObject& object, MotionId<> motion,
                                  const ks_motion_definition& definition) {
  Properties properties = properties_of(call, definition);
  require_idle(object.world());
  JoiningBodies bodies(object.simulation(), motion);
  for (std::size_t k = 0; k < definition.count; ++k) {
    properties.like.radius = properties.radii[k];
    properties.like.mass = properties.masses[k];
    bodies.join(add_one(call, object.simulation().motion(motion), definition, k, object.world().time()),
                properties.like);
  }
  return bodies.keep();
}

void push_frame(std::string_view call, WorldObject& object, std::uint32_t motion, const ks_vec3* positions,
                std::size_t count, std::optional<double> time) {
  require_array(call, positions, count, "positions");
  (void)frame_motion(call, object.simulation(), motion);
  object.simulation().push({motion}, vectors_of(positions, count), time).value();
}

}  // namespace
}  // namespace kinesphere::c

using namespace kinesphere;
using namespace kinesphere::c;

ks_status ks_motion_definition_init(ks_motion_definition* definition, uint32_t struct_size) {
  return initialise(__func__, definition, struct_size,
                    ks_motion_definition{.struct_size = struct_size,
                                         .kind = KS_MOTION_BALLISTIC,
                                         .interval = FrameMotionDefinition{}.interval,
                                         .seed = RandomForcesDefinition{}.seed});
}

ks_status ks_world_add_motion(ks_world world, const ks_motion_definition* definition, uint32_t* motion,
                              ks_body_id* ids) {
  return changing(__func__, world, [&, call = __func__](WorldObject& object) {
    require_record(call, definition, "definition");
    require_array(call, ids, definition->count, "ids");
    const AddedMotion added = add_motion(call, object, *definition);
    for (const BodyId id : added.bodies) *ids++ = c_id(id);
    if (motion != nullptr) *motion = added.motion.index;
  });
}

ks_status ks_world_add_to_motion(ks_world world, uint32_t motion, const ks_motion_definition* definition,
                                 uint32_t* numbers, ks_body_id* ids) {
  return changing(__func__, world, [&, call = __func__](WorldObject& object) {
    require_record(call, definition, "definition");
    require_array(call, ids, definition->count, "ids");
    for (const BodyId id : add_to_motion(call, object, {motion}, *definition)) {
      *ids++ = c_id(id);
      if (numbers != nullptr) *numbers++ = object.simulation().find(id)->number;
    }
  });
}

ks_status ks_world_steer(ks_world world, ks_body_id body, ks_vec3 acceleration) {
  return changing(__func__, world, [&, call = __func__](WorldObject& object) {
    const BodyId id = id_of(body);
    (void)object.world().body(id).value();
    require_idle(object.world());
    const auto moved = object.simulation().find(id);
    auto* const motion =
        moved ? dynamic_cast<SteeredMotion*>(&object.simulation().motion(moved->motion)) : nullptr;
    if (motion == nullptr) {
      detail::bad_result(
          {ErrorCode::unsupported, "body", id,
           std::string(call) + ": a motion of kind KS_MOTION_STEERED must move " + text_of(id)});
    }
    motion->steer(moved->number, object.world().time(), vector_of(acceleration)).value();
  });
}

ks_status ks_world_push_frame(ks_world world, uint32_t motion, const ks_vec3* positions, size_t count) {
  return changing(__func__, world, [&, call = __func__](WorldObject& object) {
    push_frame(call, object, motion, positions, count, {});
  });
}

ks_status ks_world_push_frame_at(ks_world world, uint32_t motion, const ks_vec3* positions, size_t count,
                                 double time) {
  return changing(__func__, world, [&, call = __func__](WorldObject& object) {
    push_frame(call, object, motion, positions, count, time);
  });
}

ks_status ks_world_latest_frame(ks_world world, uint32_t motion, ks_vec3* positions, size_t capacity,
                                size_t* count) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    write_all(call, frame_motion(call, object.simulation(), motion).latest(), positions, capacity, count,
              c_vector);
  });
}

ks_status ks_world_latest_frame_time(ks_world world, uint32_t motion, double* time) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    require_pointer(call, time, "time");
    *time = frame_motion(call, object.simulation(), motion).latest_time();
  });
}

ks_status ks_world_states(ks_world world, const ks_body_id* bodies, size_t count, double time,
                          ks_state* states) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    require_array(call, bodies, count, "bodies");
    require_array(call, states, count, "states");
    std::vector<State> found;
    for (const BodyId id : ids_of(bodies, count)) found.push_back(object.simulation().state(id, time));
    for (const State& state : found) *states++ = c_state(state);
  });
}
