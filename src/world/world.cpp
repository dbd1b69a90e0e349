// Public interface of the engine: each call is checked here before anything changes, and each change is
// recorded.
#include "kinesphere/world.hpp"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <utility>

#include "bodies/shaped_body.hpp"
#include "bodies/validation.hpp"
#include "engine/engine.hpp"
#include "input/input_check.hpp"
#include "kinesphere/inspection.hpp"
#include "recording/recorder.hpp"
#include "world/changing.hpp"
#include "world/preconditions.hpp"
#include "world/undelivered_events.hpp"

namespace kinesphere {
namespace {

/// Least number of bodies whose changes a thread checks at a time.
constexpr std::size_t least_shared = 1024;

}  // namespace

World::World(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}

World::World(World&& other) noexcept { *this = std::move(other); }

World& World::operator=(World&& other) noexcept {
  require_idle("assigned to");
  other.require_idle("moved from");
  engine_ = std::move(other.engine_);
  recorder_ = std::move(other.recorder_);
  undelivered_ = std::move(other.undelivered_);
  timings_ = std::move(other.timings_);
  profiling_ = other.profiling_;
  return *this;
}

World::~World() { require_idle("destroyed"); }

CallState World::activity() const {
  const CallState activity = engine_->activity();
  return running_ && !open_ && activity != CallState::filtering ? CallState::running : activity;
}

/// Aborts the program if the world is destroyed, moved or assigned to from inside a callback, since the
/// running call would return into a destroyed world.
void World::require_idle(const char* done) const noexcept {
  if (!engine_ || (activity() == CallState::idle && !running_)) return;
  std::fprintf(stderr, "kinesphere: a World was %s inside its own %s\n", done,
               activity() == CallState::probing     ? "probe"
               : activity() == CallState::filtering ? "pair filter"
                                                    : "run");
  std::abort();
}

const World::Engine& World::engine(std::string_view call) const {
  if (!engine_) detail::bad_result(moved_from_error(call));
  return *engine_;
}

// The engine is const everywhere else, so that no change can bypass the recorder.
World::Engine& World::changeable() { return const_cast<Engine&>(*engine_); }

Result<World> World::create(const WorldDefinition& definition) {
  if (auto valid = check_world(definition); !valid) return valid.error();
  return World(std::make_unique<Engine>(definition));
}

Result<BodyId> World::add(const BodyDefinition& body) {
  const Preconditions check(*this, "add");
  if (auto idle = check.idle(); !idle) return idle.error();
  if (auto valid = check.new_body(body, engine_->bodies().table().next_id()); !valid) return valid.error();
  return changing(step::Add{body}).add(body);
}

Result<void> World::reserve(std::size_t bodies) {
  const std::size_t most = no_body.index;
  auto valid = Preconditions(*this, "reserve").idle();
  if (valid) {
    valid = InputCheck("reserve")
                .require(bodies <= most, ErrorCode::out_of_range, {"bodies"}, "must be at most", most, bodies)
                .result();
  }
  if (valid) changeable().changes().reserve(bodies);
  return valid;
}

Result<std::vector<BodyId>> World::add_all(std::span<const BodyDefinition> bodies) {
  if (auto idle = Preconditions(*this, "add_all").idle(); !idle) return idle.error();
  const auto call_for = [](std::size_t number) { return "add_all: bodies[" + std::to_string(number) + "]"; };
  std::size_t valid = 0;
  std::optional<Error> wrong;
  for (; valid < bodies.size() && !wrong; ++valid) {
    const auto checked = Preconditions(*this, call_for(valid))
                             .new_body(bodies[valid], engine_->bodies().table().next_id(valid));
    if (!checked) {
      wrong = checked.error();
      break;
    }
  }
  if (!engine_->definition().allow_overlap) {
    if (const auto overlap = engine_->overlaps().first_among(bodies.first(valid)))
      return overlap_error(call_for(overlap->second), no_body,
                           "bodies[" + std::to_string(overlap->first) + "]");
  }
  if (wrong) return *wrong;
  std::vector<BodyId> ids;
  ids.reserve(bodies.size());
  // reserve() is called only for large batches: for many small ones, it would reallocate on every call.
  if (bodies.size() >= engine_->bodies().table().live_count())
    changeable().changes().reserve(engine_->bodies().table().live_count() + bodies.size());
  for (const BodyDefinition& body : bodies) ids.push_back(changing(step::Add{body}).add(body));
  return ids;
}

Result<void> World::remove(BodyIds bodies) {
  if (auto idle = Preconditions(*this, "remove").idle(); !idle) return idle;
  std::set<BodyId> earlier;
  for (std::size_t number = 0; number < bodies.size(); ++number) {
    const std::string call = bodies.size() == 1 ? "remove" : "remove: bodies[" + std::to_string(number) + "]";
    if (auto valid = Preconditions(*this, call).known(bodies[number]); !valid) return valid;
    if (!earlier.insert(bodies[number]).second) {
      return Error{ErrorCode::stale_body, "body", bodies[number],
                   call + ": " + text_of(bodies[number]) + " is named twice"};
    }
  }
  for (const BodyId body : bodies) changing(step::Remove{body}).remove(body);
  return {};
}

Result<void> World::check_set_velocity(BodyId body, const Vec3& velocity) const {
  auto valid = Preconditions(*this, "set_velocity").mobile(body);
  return valid ? check_velocity(velocity, body, engine_->definition(), "set_velocity") : valid;
}

Result<void> World::set_velocity(BodyId body, const Vec3& velocity) {
  auto valid = check_set_velocity(body, velocity);
  if (valid) changing(step::SetVelocity{body, velocity}).set_velocity(body, velocity);
  return valid;
}

Result<void> World::set_velocities(std::span<const BodyId> bodies, std::span<const Vec3> velocities) {
  constexpr std::string_view call = "set_velocities";
  const Preconditions preconditions(*this, call);
  if (auto idle = preconditions.idle(); !idle) return idle;
  InputCheck check(call);
  check.require(velocities.size() == bodies.size(), ErrorCode::out_of_range, {"velocities"},
                "must have one entry per body,", bodies.size(), velocities.size());
  if (check.error()) return *check.error();
  const WorldDefinition& definition = engine_->definition();
  PoolLease lease(engine_->main().workers_for(bodies.size()));
  std::atomic<bool> are_valid = true;
  lease.parallel_for(bodies.size(), least_shared, [&](std::size_t from, std::size_t to, std::size_t) {
    for (std::size_t k = from; k < to; ++k)
      if (!preconditions.may_turn(bodies[k]) || !is_valid_velocity(velocities[k], definition))
        are_valid = false;
  });
  for (std::size_t k = 0; k < bodies.size() && !are_valid; ++k) {
    if (auto valid = preconditions.can_turn(bodies[k]); !valid) return valid;
    if (auto valid = check_velocity(velocities[k], bodies[k], definition, call); !valid) return valid;
  }
  if (recorder_)
    for (std::size_t k = 0; k < bodies.size(); ++k)
      recorder_->note(*this, step::SetVelocity{bodies[k], velocities[k]});
  changeable().changes().set_velocities(bodies, velocities, lease);
  return {};
}

Result<void> World::use_workers(Workers* workers, bool call_probe) {
  auto idle = Preconditions(*this, "use_workers").may_advance();
  if (idle) changeable().use_workers(workers, call_probe);
  return idle;
}

Result<void> World::check_teleport(BodyId body, const State& state) const {
  auto valid = Preconditions(*this, "teleport").mobile(body);
  return valid ? Preconditions(*this, "teleport").moved(body, state) : valid;
}

Result<void> World::teleport(BodyId body, const State& state) {
  auto valid = check_teleport(body, state);
  if (valid) changing(step::Teleport{body, state}).teleport(body, state);
  return valid;
}

Result<void> World::enable(BodyId body, const State& state) {
  auto valid = Preconditions(*this, "enable").enabled(body, false);
  if (valid) {
    valid = engine_->bodies().table()[body.index].is_static()
                ? Preconditions(*this, "enable")
                      .no_static_overlap(static_definition(engine_->bodies(), body), body)
                : Preconditions(*this, "enable").moved(body, state);
  }
  if (valid) changing(step::Enable{body, state}).enable(body, state);
  return valid;
}

Result<void> World::disable(BodyId body) {
  auto valid = Preconditions(*this, "disable").enabled(body, true);
  if (valid) changing(step::Disable{body}).disable(body);
  return valid;
}

Result<void> World::sleep(BodyId body) {
  auto valid = Preconditions(*this, "sleep").idle();
  if (valid) valid = Preconditions(*this, "sleep").can_sleep(body);
  if (valid) changing(step::SleepBody{body}).sleep(body);
  return valid;
}

Result<void> World::wake(BodyId body) {
  auto valid = Preconditions(*this, "wake").mobile(body);
  if (valid) changing(step::Wake{body}).wake_up(body);
  return valid;
}

Result<void> World::check_change(BodyId body, const BodyChange& change) const {
  return Preconditions(*this, "change").changed(body, change);
}

Result<void> World::change(BodyId body, const BodyChange& change) {
  if (auto valid = check_change(body, change); !valid) return valid;
  const auto set = [&](auto made, const auto& value, auto setter) {
    if (!value) return;
    made.argument = *value;
    (changing(made).*setter)(body, *value);
  };
  set(step::SetRadius{body}, change.radius, &WorldEditor::set_radius);
  set(step::SetRadiusRate{body}, change.radius_rate, &WorldEditor::set_radius_rate);
  set(step::SetMotionLimits{body}, change.motion_limits, &WorldEditor::set_motion_limits);
  set(step::SetFilter{body}, change.filter, &WorldEditor::set_filter);
  set(step::SetSolid{body}, change.solid, &WorldEditor::set_solid);
  set(step::SetSensorClass{body}, change.sensor_class, &WorldEditor::set_sensor_class);
  set(step::SetMass{body}, change.mass, &WorldEditor::set_mass);
  set(step::SetUserData{body}, change.user_data, &WorldEditor::set_user_data);
  set(step::SetRotation{body}, change.rotation, &WorldEditor::set_rotation);
  set(step::SetAngularVelocity{body}, change.angular_velocity, &WorldEditor::set_angular_velocity);
  return {};
}

Result<void> World::set_pair_filter(PairFilter filter) {
  auto valid = Preconditions(*this, "set_pair_filter").idle();
  const bool given = static_cast<bool>(filter);
  if (valid) changing(step::SetPairFilter{given}).set_pair_filter(std::move(filter));
  return valid;
}

Result<void> World::refresh_filter(BodyId body) {
  auto valid = Preconditions(*this, "refresh_filter").changeable(body);
  if (valid) changing(step::RefreshFilter{body}).refresh_filter(body);
  return valid;
}

Result<void> World::set_pair_state(BodyId first, BodyId second, std::int32_t state) {
  auto valid = Preconditions(*this, "set_pair_state").pair(first, second);
  if (valid) changing(step::SetPairState{first, second, state}).set_pair_state(first, second, state);
  return valid;
}

Result<std::int32_t> World::pair_state(BodyId first, BodyId second) const {
  const Preconditions check(*this, "pair_state");
  auto valid = check.known(first);
  if (valid) valid = check.known(second);
  if (!valid) return valid.error();
  return engine_->contacts().pairs().between(first.index, second.index).state;
}

Result<void> World::turn_back(const Event& crossing) {
  auto valid = Preconditions(*this, "turn_back").idle();
  if (valid) {
    valid = InputCheck("turn_back")
                .require(is_of_sensor(crossing.kind), ErrorCode::out_of_range, {"crossing"},
                         "must be a sensor_enter or sensor_leave", name_of(crossing.kind))
                .require(crossing.time == engine_->time(), ErrorCode::out_of_range, {"crossing"},
                         "must be of the present time,", engine_->time(), crossing.time)
                .result();
  }
  if (valid) valid = Preconditions(*this, "turn_back").pair(crossing.first, crossing.second);
  if (valid) changing(step::TurnBack::of(crossing)).turn_back(crossing);
  return valid;
}

Result<void> World::schedule(const Timer& timer) {
  auto valid = Preconditions(*this, "schedule").idle();
  if (valid) valid = check_timer(timer, engine_->time());
  if (valid) changing(step::Schedule{timer}).schedule(timer);
  return valid;
}

Result<std::size_t> World::unschedule(std::uint64_t user_data) {
  if (auto idle = Preconditions(*this, "unschedule").idle(); !idle) return idle.error();
  return changing(step::Unschedule{user_data}).unschedule(user_data);
}

Result<void> World::set_sensor(SensorClass sensor_class, const Sensor& sensor) {
  auto valid = Preconditions(*this, "set_sensor").idle();
  if (valid) valid = check_sensor(sensor, engine_->definition());
  if (!valid) return valid;
  const double reach = reach_of(sensor);
  for (const BodyId id : bodies()) {
    const BodyDefinition body = engine_->bodies().definition_of(id.index);
    if (valid && body.sensor_class == sensor_class)
      valid = check_reach(reach, body, id, "sensor", engine_->definition(), "set_sensor");
  }
  if (valid) changing(step::SetSensor{sensor_class, sensor}).set_sensor(sensor_class, sensor);
  return valid;
}

const Sensor& World::sensor(SensorClass sensor_class) const {
  return engine("sensor").bodies().sensors.of(sensor_class);
}

Result<std::uint64_t> World::user_data(BodyId body) const {
  if (auto valid = Preconditions(*this, "user_data").known(body); !valid) return valid.error();
  return engine_->bodies().table()[body.index].user_data;
}

Result<std::optional<Event>> World::advance(double until, Probe probe) {
  auto valid = Preconditions(*this, "advance").may_advance();
  if (valid) valid = Preconditions(*this, "advance").may_ask(probe);
  if (valid) valid = check_time(until, engine_->time(), engine_->definition());
  if (!valid) return valid.error();
  if (undelivered_ && !undelivered_->empty()) return undelivered_->take();
  changeable().begin_call(until);
  return engine_advance(until, probe);
}

Result<std::optional<Event>> World::engine_advance(double until, const Probe& probe) {
  return profiling_ ? timed_advance(until, probe) : recorded_advance(until, probe);
}

EventRange World::events(double until, Probe probe) & { return {*this, until, std::move(probe)}; }

void EventRange::go_on() { event_ = world_->advance(until_, probe_).value(); }

/// Returns true if several threads may call the probe, if the caller permits it. Recording and profiling
/// require calls one at a time, and a rotation probe has to be called in the order of time.
bool World::may_probe_on_threads() const {
  return !recorder_ && !profiling_ && !engine_->bodies().rigid.probe;
}

Result<std::optional<Event>> World::recorded_advance(double until, const Probe& probe) {
  if (!recorder_) {
    PoolLease lease(may_probe_on_threads() ? engine_->probing_workers() : nullptr);
    return changeable().advance(until, probe, lease.count() > 1 ? &lease : nullptr);
  }
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

Result<bool> World::Facet::refresh(std::span<const std::uint32_t> numbers, std::string_view call) const {
  return probing ? probing->refresh(numbers, probe, call) : Result<bool>(false);
}

double World::time() const { return engine("time").time(); }
std::size_t World::size() const { return engine("size").bodies().table().live_count(); }
const WorldDefinition& World::definition() const { return engine("definition").definition(); }
const Counters& World::counters() const { return engine("counters").counters(); }

bool World::contains(BodyId body) const {
  (void)engine("contains");
  return Preconditions(*this, "contains").is_known(body);
}

Result<std::vector<std::byte>> World::save() const {
  if (auto all_delivered = Preconditions(*this, "save").all_delivered(); !all_delivered)
    return all_delivered.error();
  return engine_->save();
}

Result<World> World::restore(std::span<const std::byte> snapshot, PairFilter pair_filter) {
  auto engine = Engine::restore(snapshot, std::move(pair_filter));
  if (!engine) return engine.error();
  return World(std::move(*engine));
}

Result<World> World::clone() const {
  if (auto idle = Preconditions(*this, "clone").idle(); !idle) return idle.error();
  World copy(std::make_unique<Engine>(*engine_));
  if (recorder_) copy.changeable().changes().set_rotation_probe(recorder_->rotation_probe());
  if (undelivered_) copy.undelivered_ = std::make_unique<UndeliveredEvents>(*undelivered_);
  return copy;
}

Result<void> World::start_recording() {
  auto all_delivered = Preconditions(*this, "start_recording").all_delivered();
  if (!all_delivered) return all_delivered;
  if (recorder_)
    return Error{ErrorCode::recording, "world", no_body,
                 "start_recording: the world is being recorded already"};
  const RotationProbe& rotations = engine_->bodies().rigid.probe;
  recorder_ = std::make_unique<Recorder>(*this, engine_->bodies().filters.has_pair_filter(),
                                         static_cast<bool>(rotations));
  changeable().changes().set_rotation_probe(recorder_->listen_to(rotations));
  return {};
}

Result<std::vector<std::byte>> World::stop_recording() {
  if (auto all_delivered = Preconditions(*this, "stop_recording").all_delivered(); !all_delivered)
    return all_delivered.error();
  if (!recorder_)
    return Error{ErrorCode::not_recording, "world", no_body,
                 "stop_recording: the world is not being recorded"};
  changeable().changes().set_rotation_probe(recorder_->rotation_probe());
  return std::exchange(recorder_, nullptr)->finish(*this);
}

Result<BodyView> World::body(BodyId id) const {
  if (auto valid = Preconditions(*this, "body").known(id); !valid) return valid.error();
  return engine_->view(id.index);
}

Result<std::vector<BodyId>> World::touching(BodyId body) const {
  if (auto valid = Preconditions(*this, "touching").known(body); !valid) return valid.error();
  std::vector<BodyId> partners;
  for (const ContactRecord& contact : engine_->contacts().partners_of(body.index))
    partners.push_back(engine_->bodies().id_of(contact.partner));
  return partners;
}

Result<std::vector<SensorOverlap>> World::sensor_overlaps(BodyId body) const {
  if (auto valid = Preconditions(*this, "sensor_overlaps").known(body); !valid) return valid.error();
  std::vector<SensorOverlap> within;
  for (const OverlapRecord& overlap : engine_->contacts().overlaps_of(body.index))
    within.push_back({engine_->bodies().id_of(overlap.partner), overlap.distance});
  return within;
}

std::vector<BodyId> World::bodies() const {
  std::vector<BodyId> ids;
  const Engine& engine = this->engine("bodies");
  for (std::uint32_t number = 0; number < engine.bodies().numbers(); ++number)
    if (engine.bodies().table()[number].alive) ids.push_back(engine.bodies().id_of(number));
  return ids;
}

}  // namespace kinesphere
