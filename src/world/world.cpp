// The public face of the engine: every call is checked here before anything changes, and what changes is told
// to the recorder.
#include "kinesphere/world.hpp"

#include <set>
#include <utility>

#include "input/input_check.hpp"
#include "recording/recorder.hpp"
#include "world/changing.hpp"
#include "world/engine.hpp"
#include "world/validation.hpp"

namespace kinesphere {
World::World(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

// The engine is const to all else, so that no change can forget to be recorded.
World::Engine& World::changeable() { return const_cast<Engine&>(*engine_); }

Result<World> World::create(const WorldDefinition& definition) {
  if (auto valid = check_world(definition); !valid) return valid.error();
  return World(std::make_unique<Engine>(definition));
}

Result<void> World::check_alive(BodyId body, std::string_view call) const {
  if (engine_->is_alive(body)) return {};
  const auto& table = engine_->table();
  // A free index has the generation that its next body will have.
  if (body.index < table.size() && body.generation < table[body.index].generation) {
    return Error{ErrorCode::stale_body, "body", body,
                 std::string(call) + ": " + text_of(body) + " has been removed"};
  }
  return Error{ErrorCode::unknown_body, "body", body,
               std::string(call) + ": " + text_of(body) + " was never in this world"};
}

Result<void> World::check_call(BodyId body, std::string_view call) const {
  if (auto idle = check_idle(engine_->activity(), call); !idle) return idle;
  return check_alive(body, call);
}

/// As check_call, for a call that needs the body to be enabled, or disabled.
Result<void> World::check_enabled(BodyId body, bool enabled, std::string_view call) const {
  auto valid = check_call(body, call);
  if (!valid || engine_->table()[body.index].enabled == enabled) return valid;
  return Error{enabled ? ErrorCode::disabled_body : ErrorCode::enabled_body, "body", body,
               std::string(call) + ": body must be " + (enabled ? "enabled" : "disabled") + ", but " +
                   text_of(body) + " is not"};
}

/// Whether there is room for body `id` with this definition, where overlaps are not allowed.
Result<void> World::check_room(const BodyDefinition& body, BodyId id, std::string_view call) const {
  if (definition().allow_overlap) return {};
  const Bound bound = engine_->bound_now(body);
  const auto other = engine_->certain_overlap(id, {bound}, body);
  return other ? Result<void>(overlap_error(call, *other, text_of(*other))) : Result<void>();
}

/// Whether the body may be in this state now.
Result<void> World::check_moved(BodyId id, const State& state, std::string_view call) const {
  BodyDefinition moved = engine_->definition_of(id.index);
  if (auto valid = check_state(state, moved, id, definition(), call); !valid) return valid;
  moved.position = state.position;
  moved.velocity = state.velocity;
  return check_room(moved, id, call);
}

/// Whether there is room for a body to grow where it is: where space repeats, and where overlaps are not
/// allowed.
Result<void> World::check_growth(const BodyDefinition& changed, BodyId id, std::string_view argument,
                                 std::string_view call) const {
  if (auto reach = check_reach(changed, id, argument, call); !reach) return reach;
  const Body& body = engine_->table()[id.index];
  const Bound bound = engine_->bound_with(id, changed);
  if (definition().allow_overlap || !body.enabled || bound.radius <= body.bound.radius) return {};
  if (const auto wall = engine_->certain_overlap_of_wall(bound)) {
    return Error{ErrorCode::outside_domain, std::string(argument), id,
                 std::string(call) + ": " + std::string(argument) + " of " + text_of(id) +
                     " must keep the whole sphere in the box, but it would overlap the wall " +
                     std::string(name_of(*wall))};
  }
  if (const auto other = engine_->certain_overlap(id, {bound}, changed))
    return overlap_error(call, *other, text_of(*other), argument);
  return {};
}

/// Whether there is room where space repeats for all that a body senses.
Result<void> World::check_reach(const BodyDefinition& changed, BodyId id, std::string_view argument,
                                std::string_view call) const {
  const double reach = engine_->sensors().reach(changed.sensor_class);
  return kinesphere::check_reach(reach, changed, id, argument, definition(), call);
}

Result<void> World::check_new(const BodyDefinition& body, BodyId id, std::string_view call) const {
  auto valid = first_error(check_idle(engine_->activity(), call), check_body(body, definition(), call),
                           check_reach(body, no_body, "sensor_class", call));
  return valid ? check_room(body, id, call) : valid;
}

Result<BodyId> World::add(const BodyDefinition& body) {
  if (auto valid = check_new(body, engine_->next_id(), "add"); !valid) return valid.error();
  return changing(step::Add{body}).add(body);
}

Result<void> World::reserve(std::size_t bodies) {
  const std::size_t most = no_body.index;
  auto valid = first_error(
      check_idle(engine_->activity(), "reserve"),
      InputCheck("reserve")
          .require(bodies <= most, ErrorCode::out_of_range, {"bodies"}, "must be at most", most, bodies)
          .result());
  if (valid) changeable().reserve(bodies);
  return valid;
}

Result<std::vector<BodyId>> World::add_all(std::span<const BodyDefinition> bodies) {
  if (auto idle = check_idle(engine_->activity(), "add_all"); !idle) return idle.error();
  HashGrid earlier;
  for (std::uint32_t number = 0; number < bodies.size(); ++number) {
    const std::string call = "add_all: bodies[" + std::to_string(number) + "]";
    if (auto valid = check_new(bodies[number], engine_->next_id(number), call); !valid) return valid.error();
    if (definition().allow_overlap) continue;
    const Bound bound = engine_->bound_now(bodies[number]);
    const Box box = engine_->box_now(bound);
    std::optional<std::uint32_t> other;
    engine_->space().for_each_overlap(earlier, box, [&](std::uint32_t candidate) {
      const Bound placed = engine_->bound_now(bodies[candidate]);
      const bool overlap = engine_->certainly_overlap({bound}, {placed}) &&
                           engine_->may_touch(engine_->next_id(number), bodies[number],
                                              engine_->next_id(candidate), bodies[candidate]);
      if (overlap && (!other || candidate < *other)) other = candidate;
    });
    if (other) return overlap_error(call, no_body, "bodies[" + std::to_string(*other) + "]");
    earlier.set(number, engine_->space().home(box));
  }
  std::vector<BodyId> ids;
  ids.reserve(bodies.size());
  // Room for each of many small batches would be made one by one.
  if (bodies.size() >= engine_->size()) changeable().reserve(engine_->size() + bodies.size());
  for (const BodyDefinition& body : bodies) ids.push_back(changing(step::Add{body}).add(body));
  return ids;
}

Result<void> World::remove(BodyId body) {
  auto valid = check_call(body, "remove");
  if (valid) changing(step::Remove{body}).remove(body);
  return valid;
}

Result<void> World::remove_all(std::span<const BodyId> bodies) {
  if (auto idle = check_idle(engine_->activity(), "remove_all"); !idle) return idle;
  std::set<BodyId> earlier;
  for (std::size_t number = 0; number < bodies.size(); ++number) {
    const std::string call = "remove_all: bodies[" + std::to_string(number) + "]";
    if (auto valid = check_alive(bodies[number], call); !valid) return valid;
    if (!earlier.insert(bodies[number]).second) {
      return Error{ErrorCode::stale_body, "body", bodies[number],
                   call + ": " + text_of(bodies[number]) + " is named twice"};
    }
  }
  for (const BodyId body : bodies) changing(step::Remove{body}).remove(body);
  return {};
}

Result<void> World::set_velocity(BodyId body, const Vec3& velocity) {
  auto valid = check_mobile(body, "set_velocity");
  if (valid) valid = check_velocity(velocity, body, definition(), "set_velocity");
  if (valid) changing(step::SetVelocity{body, velocity}).set_velocity(body, velocity);
  return valid;
}

Result<void> World::teleport(BodyId body, const State& state) {
  auto valid = check_mobile(body, "teleport");
  if (valid) valid = check_moved(body, state, "teleport");
  if (valid) changing(step::Teleport{body, state}).teleport(body, state);
  return valid;
}

Result<void> World::enable(BodyId body, const State& state) {
  auto valid = check_enabled(body, false, "enable");
  if (valid) {
    valid = engine_->table()[body.index].is_fixed()
                ? check_fixed_room(engine_->fixed_definition(body), body, "enable")
                : check_moved(body, state, "enable");
  }
  if (valid) changing(step::Enable{body, state}).enable(body, state);
  return valid;
}

Result<void> World::disable(BodyId body) {
  auto valid = check_enabled(body, true, "disable");
  if (valid) changing(step::Disable{body}).disable(body);
  return valid;
}

Result<void> World::rest(BodyId body) {
  auto valid = check_mobile(body, "rest");
  if (valid) changing(step::RestBody{body}).rest(body);
  return valid;
}

Result<void> World::wake(BodyId body) {
  auto valid = check_mobile(body, "wake");
  if (valid) changing(step::Wake{body}).wake_up(body);
  return valid;
}

Result<void> World::set_radius(BodyId body, double radius) {
  auto valid = check_moving(body, "set_radius");
  if (!valid) return valid;
  BodyDefinition changed = engine_->definition_of(body.index);
  changed.radius = radius;
  valid = check_radius(changed, body, definition(), "set_radius");
  if (valid) valid = check_growth(changed, body, "radius", "set_radius");
  if (valid) changing(step::SetRadius{body, radius}).set_radius(body, radius);
  return valid;
}

Result<void> World::set_motion_limits(BodyId body, const MotionLimits& promise) {
  auto valid = check_moving(body, "set_motion_limits");
  if (!valid) return valid;
  const BodyDefinition changed = with_motion_limits(engine_->definition_of(body.index), promise);
  valid = check_promise(changed, body, definition(), "set_motion_limits");
  if (valid) valid = check_growth(changed, body, "position_error", "set_motion_limits");
  if (valid) changing(step::SetMotionLimits{body, promise}).set_motion_limits(body, promise);
  return valid;
}

Result<void> World::set_filter(BodyId body, const Filter& filter) {
  auto valid = check_call(body, "set_filter");
  if (valid) changing(step::SetFilter{body, filter}).set_filter(body, filter);
  return valid;
}

Result<void> World::set_pair_filter(PairFilter filter) {
  auto valid = check_idle(engine_->activity(), "set_pair_filter");
  const bool given = static_cast<bool>(filter);
  if (valid) changing(step::SetPairFilter{given}).set_pair_filter(std::move(filter));
  return valid;
}

Result<void> World::refilter(BodyId body) {
  auto valid = check_call(body, "refilter");
  if (valid) changing(step::Refilter{body}).refilter(body);
  return valid;
}

Result<void> World::set_solid(BodyId body, bool solid) {
  auto valid = check_call(body, "set_solid");
  if (valid) changing(step::SetSolid{body, solid}).set_solid(body, solid);
  return valid;
}

Result<void> World::set_sensor(SensorClass sensor_class, const Sensor& sensor) {
  auto valid = first_error(check_idle(engine_->activity(), "set_sensor"), check_sensor(sensor, definition()));
  const double reach = reach_of(sensor);
  for (const BodyId id : bodies()) {
    const BodyDefinition body = engine_->definition_of(id.index);
    if (valid && body.sensor_class == sensor_class)
      valid = kinesphere::check_reach(reach, body, id, "sensor", definition(), "set_sensor");
  }
  if (valid) changing(step::SetSensor{sensor_class, sensor}).set_sensor(sensor_class, sensor);
  return valid;
}

Result<void> World::set_sensor_class(BodyId body, SensorClass sensor_class) {
  auto valid = check_call(body, "set_sensor_class");
  if (!valid) return valid;
  BodyDefinition changed = engine_->definition_of(body.index);
  changed.sensor_class = sensor_class;
  valid = check_reach(changed, body, "sensor_class", "set_sensor_class");
  if (valid) changing(step::SetSensorClass{body, sensor_class}).set_sensor_class(body, sensor_class);
  return valid;
}

const Sensor& World::sensor(SensorClass sensor_class) const { return engine_->sensors().of(sensor_class); }

Result<void> World::set_user_data(BodyId body, std::uint64_t data) {
  auto valid = check_call(body, "set_user_data");
  if (valid) changing(step::SetUserData{body, data}).set_user_data(body, data);
  return valid;
}

Result<std::uint64_t> World::user_data(BodyId body) const {
  if (auto valid = check_alive(body, "user_data"); !valid) return valid.error();
  return engine_->table()[body.index].user_data;
}

Result<std::optional<Event>> World::advance(double until, Probe probe) {
  const auto valid = first_error(check_idle(engine_->activity(), "advance"), check_time(until, time()));
  if (!valid) return valid.error();
  return timing_ ? timed_advance(until, probe) : recorded_advance(until, probe);
}

Result<std::optional<Event>> World::recorded_advance(double until, const Probe& probe) {
  if (!recorder_) return changeable().advance(until, probe);
  Recorder::Listener listener(*recorder_, *this, probe, until);
  auto event = changeable().advance(until, listener);
  if (event) listener.succeeded(*event);
  return event;
}

Result<bool> World::refresh(std::span<const std::uint32_t> numbers, const Probe& probe,
                            std::string_view call) {
  if (!recorder_) return changeable().probe_stale(numbers, probe, call);
  Recorder::Listener listener(*recorder_, *this, probe);
  auto probed = changeable().probe_stale(numbers, listener, call);
  if (probed) listener.succeeded();
  return probed;
}

double World::time() const { return engine_->time(); }
std::size_t World::size() const { return engine_->size(); }
const WorldDefinition& World::definition() const { return engine_->definition(); }
bool World::contains(BodyId body) const { return static_cast<bool>(check_alive(body, "contains")); }
const Counters& World::counters() const { return engine_->counters(); }
std::optional<AuditFinding> World::audit() const {
  if (const auto idle = check_idle(engine_->activity(), "audit"); !idle)
    return AuditFinding{"call", idle.error().message};
  return engine_->audit();
}

Result<std::vector<std::byte>> World::save() const {
  if (auto idle = check_idle(engine_->activity(), "save"); !idle) return idle.error();
  return engine_->save();
}

Result<World> World::restore(std::span<const std::byte> snapshot, PairFilter pair_filter) {
  auto engine = Engine::restore(snapshot, std::move(pair_filter));
  if (!engine) return engine.error();
  return World(std::move(*engine));
}

Result<World> World::clone() const {
  if (auto idle = check_idle(engine_->activity(), "clone"); !idle) return idle.error();
  return World(std::make_unique<Engine>(*engine_));
}

Result<void> World::start_recording() {
  auto idle = check_idle(engine_->activity(), "start_recording");
  if (!idle) return idle;
  if (recorder_)
    return Error{ErrorCode::recording, "world", no_body,
                 "start_recording: the world is being recorded already"};
  recorder_ = std::make_unique<Recorder>(*this, engine_->has_pair_filter());
  return {};
}

Result<std::vector<std::byte>> World::stop_recording() {
  if (auto idle = check_idle(engine_->activity(), "stop_recording"); !idle) return idle.error();
  if (!recorder_)
    return Error{ErrorCode::not_recording, "world", no_body,
                 "stop_recording: the world is not being recorded"};
  return std::exchange(recorder_, nullptr)->finish(*this);
}

Result<BodyView> World::body(BodyId id) const {
  if (auto valid = check_alive(id, "body"); !valid) return valid.error();
  return engine_->view(id.index);
}

Result<std::vector<BodyId>> World::touching(BodyId body) const {
  if (auto valid = check_alive(body, "touching"); !valid) return valid.error();
  std::vector<BodyId> partners;
  for (const std::uint32_t partner : engine_->book().partners_of(body.index))
    partners.push_back(engine_->id_of(partner));
  return partners;
}

Result<std::vector<Sensed>> World::sensed(BodyId body) const {
  if (auto valid = check_alive(body, "sensed"); !valid) return valid.error();
  std::vector<Sensed> within;
  for (const Crossing& crossing : engine_->book().crossings_of(body.index))
    within.push_back({engine_->id_of(crossing.partner), crossing.distance});
  return within;
}

std::vector<BodyId> World::bodies() const {
  std::vector<BodyId> ids;
  for (std::uint32_t number = 0; number < engine_->table().size(); ++number)
    if (engine_->table()[number].alive) ids.push_back(engine_->id_of(number));
  return ids;
}

}  // namespace kinesphere
