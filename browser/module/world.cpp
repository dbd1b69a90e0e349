#include <cmath>
#include <memory>
#include <optional>

#include "exchange.hpp"
#include "lab/scene/scene.hpp"
#include "lab/simulation/scene_answer.hpp"
#include "motion.hpp"

namespace kinesphere::browser {
namespace {

// Both say whether the function of JavaScript's returned, and did not throw.
KINESPHERE_IMPORT(probe)
bool javascript_probe(std::size_t count, const double* ids, double time, double* states);
KINESPHERE_IMPORT(respond)
bool javascript_respond(const double* event, double* velocities);

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Asks the function that the package has been handed. One that throws leaves NaN, which the world refuses;
/// the package throws again what it threw.
void ask_javascript(std::span<const BodyId> ids, double time, std::span<State> states) {
  std::vector<double> numbers;
  for (const BodyId id : ids) numbers.push_back(number_of(id));
  std::vector<double> answers(6 * ids.size(), nan);
  (void)javascript_probe(ids.size(), numbers.data(), time, answers.data());
  for (std::size_t k = 0; k < ids.size(); ++k) states[k] = state_at(answers.data() + 6 * k);
}

/// Bodies of a motion whose number there is the index of their id. A body whose state the motion does not
/// have gets NaN, which the world refuses; so does an answer to an event where bodies cannot be changed.
/// refused() is the motion's own reason then.
class MotionByIndex final : public Mover {
 public:
  explicit MotionByIndex(Motion& motion) : motion_(motion) {}
  void states(std::span<const BodyId> ids, double time, std::span<State> states) override {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const std::uint32_t number = ids[k].index;
      if (auto reason = why_unknown(motion_, number, time)) {
        refused_ = std::move(reason);
        states[k] = {{nan, nan, nan}, {nan, nan, nan}};
      } else {
        states[k] = motion_.state(number, time);
      }
    }
  }
  Departure departure(BodyId body) const override { return motion_.departure(body.index); }
  void depart(BodyId body, const Departure& departure) override {
    (void)motion_.depart(body.index, departure);
  }

  /// What may be done to the motion of what is to be done.
  Answer possible(const Answer& answer) {
    if ((!answer.first_velocity && !answer.second_velocity) || can_be_changed(motion_)) return answer;
    refused_ = {ErrorCode::unsupported, "respond", no_body,
                "run: respond: the bodies of this motion go their own way, and cannot be given velocities"};
    return {Vec3{nan, nan, nan}, std::nullopt};
  }

  const std::optional<Error>& refused() const { return refused_; }

 private:
  Motion& motion_;
  std::optional<Error> refused_;
};

std::optional<Vec3> velocity_at(const double* numbers) {
  if (numbers[3] == 0.0) return std::nullopt;
  return vector_at(numbers);
}

Answer ask_javascript(const Event& event) {
  double numbers[event_numbers];
  put(event, numbers);
  // Of each of the two a velocity, and whether there is one.
  double velocities[8] = {};
  // One that throws leaves NaN too.
  if (!javascript_respond(numbers, velocities)) return {Vec3{nan, nan, nan}, std::nullopt};
  return {velocity_at(velocities), velocity_at(velocities + 4)};
}

/// As all scenes of the program have it: with a mass by index.
Answer bounce_off(const Event& event, std::span<const double> masses, double restitution,
                  double resting_speed) {
  const bool begins = event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
  if (!begins || event.approach_speed <= 0.0) return {};
  const auto mass = [&](BodyId body) { return body.index < masses.size() ? masses[body.index] : 1.0; };
  const bool is_pair = event.second != no_body;
  const double first = mass(event.first);
  const double second = is_pair ? mass(event.second) : first;
  const Bounce after = resting_speed > 0.0 ? settle(event, first, second, restitution, resting_speed)
                                           : bounce(event, first, second, restitution);
  // Who cannot move keeps still.
  const auto unless_fixed = [](double mass_of_it, const Vec3& velocity) {
    return mass_of_it < std::numeric_limits<double>::infinity() ? std::optional(velocity) : std::nullopt;
  };
  if (!is_pair) return {unless_fixed(first, after.first_velocity), std::nullopt};
  return {unless_fixed(first, after.first_velocity), unless_fixed(second, after.second_velocity)};
}

WorldDefinition definition_at(const double* numbers) {
  WorldDefinition definition;
  if (numbers[0] != 0.0) definition.box = Box{vector_at(numbers + 1), vector_at(numbers + 4)};
  definition.periodic = {numbers[7] != 0.0, numbers[8] != 0.0, numbers[9] != 0.0};
  definition.dimensions = static_cast<int>(numbers[10]);
  definition.contact_tolerance = numbers[11];
  definition.separation_distance = numbers[12];
  definition.contacts = numbers[13] != 0.0 ? ContactMode::impacts : ContactMode::begin_and_end;
  definition.allow_overlap = numbers[14] != 0.0;
  definition.zeno_interval = numbers[15];
  definition.start_time = numbers[16];
  return definition;
}

constexpr std::size_t body_numbers = 20;
BodyDefinition body_at(const double* numbers) {
  BodyDefinition body;
  body.position = vector_at(numbers);
  body.velocity = vector_at(numbers + 3);
  body.radius = numbers[6];
  body.acceleration_limit = numbers[7];
  body.planned_acceleration = vector_at(numbers + 8);
  body.position_error = numbers[11];
  body.velocity_error = numbers[12];
  body.solid = numbers[13] != 0.0;
  body.sensor_class = static_cast<SensorClass>(numbers[14]);
  body.filter.category = static_cast<std::uint64_t>(numbers[15]);
  body.filter.mask = numbers[16] < 0.0 ? ~std::uint64_t{0} : static_cast<std::uint64_t>(numbers[16]);
  body.filter.group = static_cast<std::int32_t>(numbers[17]);
  body.user_data = static_cast<std::uint64_t>(numbers[18]);
  return body;
}

Shape shape_at(int kind, const double* numbers) {
  if (kind == 0) return Ball{vector_at(numbers), numbers[3]};
  if (kind == 1) return HalfSpace{vector_at(numbers), numbers[3]};
  if (kind == 2) return Box{vector_at(numbers), vector_at(numbers + 3)};
  return Triangle{vector_at(numbers), vector_at(numbers + 3), vector_at(numbers + 6)};
}

World* handle_of(Result<World> world) { return is_good(world) ? new World(std::move(*world)) : nullptr; }

std::span<const std::byte> bytes_at(const std::byte* bytes, std::size_t count) { return {bytes, count}; }

}  // namespace

KINESPHERE_EXPORT(allocate) void* allocate(std::size_t size) { return std::malloc(size); }
KINESPHERE_EXPORT(release) void release(void* memory) { std::free(memory); }

KINESPHERE_EXPORT(world_create) World* world_create(const double* definition) {
  return handle_of(World::create(definition_at(definition)));
}
KINESPHERE_EXPORT(world_restore)
World* world_restore(const std::byte* snapshot, std::size_t size) {
  return handle_of(World::restore(bytes_at(snapshot, size)));
}
KINESPHERE_EXPORT(world_clone) World* world_clone(const World* world) { return handle_of(world->clone()); }
KINESPHERE_EXPORT(world_free) void world_free(World* world) { delete world; }
KINESPHERE_EXPORT(world_save) bool world_save(const World* world) {
  auto saved = world->save();
  if (saved) answer_bytes() = std::move(*saved);
  return is_good(saved);
}

KINESPHERE_EXPORT(world_definition) const WorldDefinition* world_definition(const World* world) {
  return &world->definition();
}
/// As definition_at() reads it.
KINESPHERE_EXPORT(definition_numbers) void definition_numbers(const WorldDefinition* written) {
  const WorldDefinition& definition = *written;
  auto& numbers = answer();
  numbers.assign(17, 0.0);
  if (definition.box) {
    numbers[0] = 1.0;
    put(definition.box->lower, numbers.data() + 1);
    put(definition.box->upper, numbers.data() + 4);
  }
  for (int axis = 0; axis < 3; ++axis)
    numbers[7 + static_cast<std::size_t>(axis)] = definition.periodic[axis] ? 1.0 : 0.0;
  numbers[10] = definition.dimensions;
  numbers[11] = definition.contact_tolerance;
  numbers[12] = definition.separation_distance;
  numbers[13] = definition.contacts == ContactMode::impacts ? 1.0 : 0.0;
  numbers[14] = definition.allow_overlap ? 1.0 : 0.0;
  numbers[15] = definition.zeno_interval;
  numbers[16] = definition.start_time;
}

KINESPHERE_EXPORT(world_time) double world_time(const World* world) { return world->time(); }
KINESPHERE_EXPORT(world_size) std::size_t world_size(const World* world) { return world->size(); }
KINESPHERE_EXPORT(world_contains) bool world_contains(const World* world, double body) {
  return world->contains(body_of(body));
}

KINESPHERE_EXPORT(world_add_all)
bool world_add_all(World* world, std::size_t count, const double* bodies) {
  std::vector<BodyDefinition> definitions;
  for (std::size_t k = 0; k < count; ++k) definitions.push_back(body_at(bodies + k * body_numbers));
  const auto ids = world->add_all(definitions);
  if (!is_good(ids)) return false;
  answer_ids(*ids);
  return true;
}

KINESPHERE_EXPORT(world_add_fixed)
double world_add_fixed(World* world, int kind, const double* shape, bool is_zone, bool solid,
                       int sensor_class, double user_data) {
  const auto data = static_cast<std::uint64_t>(user_data);
  const auto id = is_zone ? world->add_zone(shape_at(kind, shape), data)
                          : world->add_fixed({.shape = shape_at(kind, shape),
                                              .solid = solid,
                                              .sensor_class = static_cast<SensorClass>(sensor_class),
                                              .user_data = data});
  return is_good(id) ? number_of(*id) : no_id;
}

KINESPHERE_EXPORT(world_remove) bool world_remove(World* world, double body) {
  return is_good(world->remove(body_of(body)));
}
KINESPHERE_EXPORT(world_set_velocity)
bool world_set_velocity(World* world, double body, const double* velocity) {
  return is_good(world->set_velocity(body_of(body), vector_at(velocity)));
}
KINESPHERE_EXPORT(world_teleport) bool world_teleport(World* world, double body, const double* state) {
  return is_good(world->teleport(body_of(body), state_at(state)));
}
KINESPHERE_EXPORT(world_set_radius) bool world_set_radius(World* world, double body, double radius) {
  return is_good(world->set_radius(body_of(body), radius));
}
KINESPHERE_EXPORT(world_set_motion_limits)
bool world_set_motion_limits(World* world, double body, const double* limits) {
  return is_good(
      world->set_motion_limits(body_of(body), {limits[0], vector_at(limits + 1), limits[4], limits[5]}));
}
KINESPHERE_EXPORT(world_disable) bool world_disable(World* world, double body) {
  return is_good(world->disable(body_of(body)));
}
KINESPHERE_EXPORT(world_enable) bool world_enable(World* world, double body, const double* state) {
  return is_good(world->enable(body_of(body), state_at(state)));
}
KINESPHERE_EXPORT(world_rest) bool world_rest(World* world, double body) {
  return is_good(world->rest(body_of(body)));
}
KINESPHERE_EXPORT(world_wake) bool world_wake(World* world, double body) {
  return is_good(world->wake(body_of(body)));
}
KINESPHERE_EXPORT(world_set_sensor)
bool world_set_sensor(World* world, int sensor_class, std::size_t count, const double* distances) {
  return is_good(world->set_sensor(static_cast<SensorClass>(sensor_class),
                                   {.distances = {distances, distances + count}}));
}

/// 0: nothing until then; 1: an event in answer(); -1: an error. Without a motion JavaScript is asked.
KINESPHERE_EXPORT(world_advance) int world_advance(World* world, double until, MotionHandle* handle) {
  if (handle == nullptr)
    return answer_event(world->advance(until, static_cast<Probe::Function>(ask_javascript)));
  MotionByIndex mover(*handle->motion);
  const auto event = world->advance(until, [&](std::span<const BodyId> ids, double time,
                                               std::span<State> states) { mover.states(ids, time, states); });
  if (event || !mover.refused()) return answer_event(event);
  fail(*mover.refused());
  return -1;
}

/// What bodies do at events in world_run().
enum class Responding : int { nothing, bounces, asks_javascript, as_in_scene };

/// All events are in answer() afterwards, also where there is an error.
KINESPHERE_EXPORT(world_run)
bool world_run(World* world, double until, MotionHandle* handle, Responding responding, const double* masses,
               std::size_t mass_count, double restitution, double resting_speed, const Scene* scene) {
  // Functions of JavaScript's may ask for other answers meanwhile.
  std::vector<double> told;
  MotionByIndex mover(*handle->motion);
  const auto answered = [&](const Event& event) -> Answer {
    switch (responding) {
      case Responding::nothing:
        return {};
      case Responding::bounces:
        return bounce_off(event, {masses, mass_count}, restitution, resting_speed);
      case Responding::asks_javascript:
        return ask_javascript(event);
      case Responding::as_in_scene:
        return scene_answer(*scene, event);
    }
    return {};
  };
  const auto respond = [&](const Event& event) { return mover.possible(answered(event)); };
  const auto sink = [&](const Event& event) {
    told.resize(told.size() + event_numbers);
    put(event, told.data() + told.size() - event_numbers);
  };
  const auto done = world->run(until, mover, respond, sink);
  answer() = std::move(told);
  if (!done && mover.refused()) return fail(*mover.refused());
  return is_good(done);
}

/// The velocities of two bodies of these masses after a contact; with a resting speed > 0 as settle() has it.
KINESPHERE_EXPORT(event_bounce)
void event_bounce(const double* event, double first_mass, double second_mass, double restitution,
                  double resting_speed, double* velocities) {
  const Event contact = event_at(event);
  const Bounce after = resting_speed > 0.0
                           ? settle(contact, first_mass, second_mass, restitution, resting_speed)
                           : bounce(contact, first_mass, second_mass, restitution);
  put(after.first_velocity, velocities);
  put(after.second_velocity, velocities + 3);
}

KINESPHERE_EXPORT(world_bodies) void world_bodies(const World* world) { answer_ids(world->bodies()); }

/// Of each body; WorldView.bodyViews() in package/src/world.ts reads them.
constexpr std::size_t view_numbers = 28;
KINESPHERE_EXPORT(world_views) bool world_views(const World* world, std::size_t count, const double* bodies) {
  auto& numbers = answer();
  numbers.assign(count * view_numbers, 0.0);
  for (std::size_t k = 0; k < count; ++k) {
    const auto view = world->body(body_of(bodies[k]));
    if (!is_good(view)) return false;
    double* const at = numbers.data() + k * view_numbers;
    put(view->bound.centre_at(world->time()), at);
    at[3] = view->fixed ? view->definition.radius : view->bound.radius_at(world->time());
    at[4] = view->definition.radius;
    at[5] = view->bound.time;
    put({view->definition.position, view->definition.velocity}, at + 6);
    put(view->box.lower, at + 12);
    put(view->box.upper, at + 15);
    at[18] = view->box_end;
    at[19] = view->enabled ? 1.0 : 0.0;
    at[20] = view->fixed ? 1.0 : 0.0;
    at[21] = view->resting ? 1.0 : 0.0;
    at[22] = view->definition.acceleration_limit;
    at[23] = static_cast<double>(view->definition.sensor_class);
    at[24] = static_cast<double>(view->definition.user_data);
    for (std::size_t axis = 0; axis < 3; ++axis) at[25 + axis] = static_cast<double>(view->image[axis]);
  }
  return true;
}

KINESPHERE_EXPORT(world_touching) bool world_touching(const World* world, double body) {
  const auto ids = world->touching(body_of(body));
  if (!is_good(ids)) return false;
  answer_ids(*ids);
  return true;
}

KINESPHERE_EXPORT(world_counters) void world_counters(const World* world) {
  const Counters& counters = world->counters();
  auto& numbers = answer();
  numbers.clear();
  for (const std::uint64_t events : counters.events) numbers.push_back(static_cast<double>(events));
  for (const std::uint64_t count :
       {counters.probes, counters.window_ends, counters.starts, counters.restarts, counters.pair_checks,
        counters.wall_checks, counters.searches, counters.candidates, counters.hot_pairs,
        counters.certificates, counters.zeno_steps, counters.repeated_contacts})
    numbers.push_back(static_cast<double>(count));
}

/// Triples of two ids and a time; and boxes (6) with how many bodies they hold.
KINESPHERE_EXPORT(world_certificates) void world_certificates(const World* world) {
  answer().clear();
  for (const Certificate& certificate : world->certificates())
    answer().insert(answer().end(),
                    {number_of(certificate.first), number_of(certificate.second), certificate.until});
}
KINESPHERE_EXPORT(world_cells) void world_cells(const World* world) {
  answer().clear();
  for (const CellView& cell : world->cells())
    answer().insert(answer().end(), {cell.box.lower.x, cell.box.lower.y, cell.box.lower.z, cell.box.upper.x,
                                     cell.box.upper.y, cell.box.upper.z, static_cast<double>(cell.bodies)});
}

/// Answers: time, partner, wall, touching or within.
KINESPHERE_EXPORT(world_safe_until) bool world_safe_until(const World* world) {
  const auto safe = world->safe_until();
  if (safe) answer().assign({safe->time, no_id, 0.0, safe->touching ? 1.0 : 0.0});
  return is_good(safe);
}
KINESPHERE_EXPORT(world_safe_until_of_pair)
bool world_safe_until_of_pair(const World* world, double first, double second) {
  const auto safe = world->safe_until(body_of(first), body_of(second));
  if (safe) answer().assign({safe->time, no_id, 0.0, safe->touching ? 1.0 : 0.0});
  return is_good(safe);
}
KINESPHERE_EXPORT(world_earliest_contact) bool world_earliest_contact(const World* world, double body) {
  const auto contact = world->earliest_contact(body_of(body));
  if (contact)
    answer().assign({contact->time, number_of(contact->partner), static_cast<double>(contact->wall),
                     contact->touching ? 1.0 : 0.0});
  return is_good(contact);
}
KINESPHERE_EXPORT(world_earliest_approach)
bool world_earliest_approach(const World* world, double body, double distance) {
  const auto approach = world->earliest_approach(body_of(body), distance);
  if (approach)
    answer().assign({approach->time, number_of(approach->partner), static_cast<double>(approach->wall),
                     approach->within ? 1.0 : 0.0});
  return is_good(approach);
}

namespace {

/// Fours of an id, 1 for certainly, and two limits.
template <class Results>
bool answer_all(const Results& results) {
  if (!is_good(results)) return false;
  answer().clear();
  for (const auto& found : *results)
    answer().insert(answer().end(),
                    {number_of(found.body), found.certainty == Certainty::certainly ? 1.0 : 0.0, found.lower,
                     found.upper});
  return true;
}

}  // namespace

KINESPHERE_EXPORT(world_nearest)
bool world_nearest(const World* world, const double* point, std::size_t count) {
  return answer_all(world->nearest(vector_at(point), count));
}
KINESPHERE_EXPORT(world_ray_cast)
bool world_ray_cast(const World* world, const double* origin, const double* direction, double length) {
  return answer_all(world->ray_cast(vector_at(origin), vector_at(direction), length));
}
KINESPHERE_EXPORT(world_overlapping)
bool world_overlapping(const World* world, const double* centre, double radius) {
  const auto results = world->overlapping(vector_at(centre), radius);
  if (!is_good(results)) return false;
  answer().clear();
  for (const Found& found : *results)
    answer().insert(answer().end(),
                    {number_of(found.body), found.certainty == Certainty::certainly ? 1.0 : 0.0});
  return true;
}

/// Empty where nothing is wrong.
KINESPHERE_EXPORT(world_audit) void world_audit(const World* world) {
  answer_bytes().clear();
  const auto finding = world->audit();
  if (!finding) return;
  for (const char c : finding->where + ": " + finding->what)
    answer_bytes().push_back(static_cast<std::byte>(c));
}

KINESPHERE_EXPORT(world_start_recording) bool world_start_recording(World* world) {
  return is_good(world->start_recording());
}
KINESPHERE_EXPORT(world_stop_recording) bool world_stop_recording(World* world) {
  auto recording = world->stop_recording();
  if (recording) answer_bytes() = std::move(*recording);
  return is_good(recording);
}

KINESPHERE_EXPORT(replay_open) Replay* replay_open(const std::byte* recording, std::size_t size) {
  auto replay = Replay::open(bytes_at(recording, size));
  return is_good(replay) ? new Replay(std::move(*replay)) : nullptr;
}
KINESPHERE_EXPORT(replay_free) void replay_free(Replay* replay) { delete replay; }
KINESPHERE_EXPORT(replay_advance) int replay_advance(Replay* replay) {
  return answer_event(replay->advance());
}
KINESPHERE_EXPORT(replay_finished) bool replay_finished(const Replay* replay) { return replay->finished(); }
KINESPHERE_EXPORT(replay_step) std::size_t replay_step(const Replay* replay) { return replay->step(); }
KINESPHERE_EXPORT(replay_step_count) std::size_t replay_step_count(const Replay* replay) {
  return replay->step_count();
}
/// For reading, as long as the replay is there and stands where it does.
KINESPHERE_EXPORT(replay_world) const World* replay_world(const Replay* replay) { return &replay->world(); }

}  // namespace kinesphere::browser
