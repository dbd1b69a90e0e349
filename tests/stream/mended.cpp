#include "stream/any_bytes.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "stream/damage.hpp"
#include "stream/player.hpp"
#include "support/sealed_snapshot.hpp"

namespace kinesphere::stream {
namespace {

using Content = std::vector<std::byte>;

/// For worlds that may have had a pair filter.
bool any_pair(BodyId, BodyId) { return true; }

void demand(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

/// A snapshot, or a recording in two parts: its first snapshot, and its steps.
struct Original {
  Content snapshot;
  Content recording_header{};
  Content steps{};

  bool is_recording() const { return !recording_header.empty(); }
};

Original parts_of(const Content& recording) {
  const auto at = [&](std::size_t from, std::size_t to) {
    return Content(recording.begin() + static_cast<std::ptrdiff_t>(from),
                   recording.begin() + static_cast<std::ptrdiff_t>(to));
  };
  std::uint64_t size = 0;
  for (std::size_t k = 8; k-- > 0;)
    size = size << 8 | static_cast<std::uint64_t>(recording[snapshot_header_size + k]);
  const std::size_t begin = snapshot_header_size + 8;
  return {at(begin, begin + size), at(0, snapshot_header_size), at(begin + size, recording.size() - 8)};
}

Content whole(const Original& parts) {
  Content snapshot = sealed(parts.snapshot);
  if (!parts.is_recording()) return snapshot;
  Content all = parts.recording_header;
  all.resize(snapshot_header_size + 8);
  write_number(all, snapshot_header_size, snapshot.size());
  all.insert(all.end(), snapshot.begin(), snapshot.end());
  all.insert(all.end(), parts.steps.begin(), parts.steps.end());
  all.resize(all.size() + 8);
  return sealed(std::move(all));
}

Content of_stream(std::uint64_t seed, int operations, bool many) {
  Bytes bytes = random_stream(seed, static_cast<std::size_t>(operations));
  if (!many) bytes = with_bodies(bytes, 8);
  return snapshot_after(bytes);
}

/// Bodies that move straight on and bounce, in one of several spaces.
class Crowd {
 public:
  Crowd(const WorldDefinition& definition, int bodies, std::uint64_t seed)
      : random_(seed), world_(World::create(definition).value()) {
    const bool flat = definition.dimensions == 2;
    world_.set_sensor(1, {.distances = {0.2, 0.1}}).value();
    for (int k = 0; k < bodies; ++k) {
      State state{{random_.uniform(0.5, 7.5), random_.uniform(0.5, 7.5), random_.uniform(0.5, 7.5)},
                  (k % 9 == 0 ? 20.0 : 2.0) * random_.point_in_ball()};
      if (k % 7 == 0) state.velocity = {};
      if (flat) state.position.z = state.velocity.z = 0.0;
      BodyDefinition body{.radius = random_.uniform(0.01, 0.25),
                          .acceleration_limit = k % 4 == 0 ? 1.0 : 0.0,
                          .position_error = k % 11 == 0 ? 0.01 : 0.0,
                          .position = state.position,
                          .velocity = state.velocity,
                          .filter = {.category = 1u << (k % 3), .group = k % 5 == 0 ? 1 : 0},
                          .solid = k % 6 != 0,
                          .sensor_class = static_cast<SensorClass>(k % 2),
                          .user_data = std::uint64_t(k)};
      if (const auto id = world_.add(body)) keep(*id, state);
    }
    for (int k = 0; k < bodies; k += 5) add_rigid_body(k, flat);
    const bool repeats = definition.periodic.x || definition.periodic.y;
    for (int k = 0; k < 3; ++k) {
      Vec3 place{2.0 * k + 1.0, k == 0 ? 8.0 : 4.0, flat ? 0.0 : 4.0};
      Shape shape = Ball{place, 0.3};
      if (!repeats && k == 1) shape = Box{place, place + Vec3{1, 1, flat ? 0.0 : 1.0}};
      if (!repeats && k == 2) shape = HalfSpace{{0, 1, 0}, 0.1};
      if (const auto id = world_.add_static({.shape = shape})) keep(*id, {place, {}});
    }
  }

  /// Adds a capsule or a dumbbell that keeps its angular velocity.
  void add_rigid_body(int number, bool flat) {
    State state{{random_.uniform(0.5, 7.5), random_.uniform(0.5, 7.5), random_.uniform(0.5, 7.5)},
                random_.point_in_ball()};
    if (flat) state.position.z = state.velocity.z = 0.0;
    RigidBody body{.body = {.position = state.position, .velocity = state.velocity},
                   .parts = {{{-0.3, 0, 0}, {0.3, 0, 0}, 0.1}},
                   .rotation = {.angular_velocity = {0, 0, random_.uniform(-2.0, 2.0)}}};
    if (number % 2 == 1) body.parts = {{{-0.3, 0, 0}, {-0.3, 0, 0}, 0.1}, {{0.3, 0, 0}, {0.3, 0, 0}, 0.2}};
    if (const auto id = world_.add_rigid_body(body)) keep(*id, state);
  }

  void go(double duration, bool bounces = true) {
    const double until = world_.time() + duration;
    while (const auto event = world_.advance(until, probe()).value()) {
      if (!bounces || event->kind != EventKind::contact_begin) continue;
      const Bounce after = bounce(*event, 1.0, 1.0, 0.9);
      velocity_change(event->first, after.first_velocity);
      velocity_change(event->second, after.second_velocity);
    }
  }
  void velocity_change(BodyId id, const Vec3& velocity) {
    const Vec3 place = place_of(id, world_.time());
    if (world_.set_velocity(id, velocity)) keep(id, {place, velocity});
  }
  /// Leaves the world in the middle of an instant, with changes that no probe has confirmed.
  void disturb() {
    for (const BodyId id : world_.bodies()) {
      const auto what = id.index % 8;
      if (what == 1) velocity_change(id, {1, 1, 0});
      if (what == 2 && world_.sleep(id)) keep(id, {place_of(id, world_.time()), {}});
      if (what == 3) (void)world_.disable(id);
      if (what == 4) (void)world_.change(id, {.motion_limits = MotionLimits{.acceleration_limit = 2.0}});
      if (what == 5) (void)world_.remove(id);
    }
  }
  /// Makes an advance that a bad answer ends.
  void fail() {
    (void)world_.advance(world_.time() + 1.0, [](std::span<const BodyId>, double, std::span<State>) {});
  }
  World& world() { return world_; }

 private:
  void keep(BodyId id, const State& state) {
    if (id.index >= starts_.size()) starts_.resize(id.index + 1u);
    starts_[id.index] = {world_.time(), state};
  }
  Vec3 place_of(BodyId id, double time) const {
    const MotionOrigin& from = starts_[id.index];
    return from.state.position + from.state.velocity * (time - from.time);
  }
  Probe probe() {
    return [this](std::span<const BodyId> ids, double time, std::span<State> states) {
      for (std::size_t k = 0; k < ids.size(); ++k)
        states[k] = {place_of(ids[k], time), starts_[ids[k].index].state.velocity};
    };
  }

  Random random_;
  World world_;
  std::vector<MotionOrigin> starts_;
};

std::vector<Original> make_originals() {
  const Box box{{0, 0, 0}, {8, 8, 8}};
  const std::vector<WorldDefinition> definitions{
      {.allow_overlap = true},
      {.box = box, .contacts = ContactEvents::impacts, .start_time = 1e9},
      {.box = box, .periodic = {true, true, true}, .allow_overlap = true},
      {.box = box, .periodic = {true, false, false}, .dimensions = 2, .separation_distance = 1e-3},
      {.box = box, .spread_window_starts = true},
  };
  std::vector<Original> all;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) all.push_back({of_stream(seed, 60, seed % 4 == 0)});
  for (std::size_t k = 0; k < definitions.size(); ++k) {
    Crowd few(definitions[k], 8, k + 1);
    few.go(0.5);
    few.world().start_recording().value();
    few.go(0.5, false);
    few.disturb();
    all.push_back({few.world().save().value()});
    few.go(0.5);
    all.push_back(parts_of(few.world().stop_recording().value()));
    // Sufficient for sorted grid levels.
    Crowd many(definitions[k], 150, k + 11);
    many.go(0.3);
    if (k % 2 == 1) {
      many.disturb();
      many.fail();
    }
    all.push_back({many.world().save().value()});
  }
  return all;
}

const Original& original(std::uint8_t number) {
  static const std::vector<Original> all = make_originals();
  return all[number % all.size()];
}

/// Makes all queries of a world.
void ask(World& world, Random& random, const Probe& probe) {
  const Vec3 point = 8.0 * random.point_in_ball();
  (void)world.inspection().audit();
  (void)world.inspection().cells();
  (void)world.inspection().certificates();
  (void)world.certificates().safe_until();
  (void)world.queries().overlapping(point, 2.0);
  (void)world.queries().overlapping(Box{point, point + Vec3{1, 1, 1}});
  (void)world.queries().nearest(point, 3);
  (void)world.queries().ray_cast(point, {1, 0.5, 0}, 10.0);
  (void)world.queries().sphere_cast(point, 0.5, {0, 1, 0}, 10.0);
  const auto bodies = world.bodies();
  for (std::size_t k = 0; k < bodies.size() && k < 24; ++k) {
    const BodyId id = bodies[k];
    const BodyId other = bodies[random.bits() % bodies.size()];
    (void)world.body(id);
    (void)world.body(id);
    (void)world.touching(id);
    (void)world.sensor_overlaps(id);
    (void)world.certificates().safe_until(id);
    (void)world.certificates().earliest_contact(id);
    (void)world.certificates().earliest_approach(id, 0.5);
    (void)world.certificates().safe_until(id, other, 0.5);
    (void)world.certificates().distance_limits(id, other, world.time() + 1.0);
  }
  (void)world.queries(probe).nearest(point, 2);
}

void change(World& world, Random& random) {
  const auto bodies = world.bodies();
  if (bodies.empty()) return;
  const BodyId id = bodies[random.bits() % bodies.size()];
  const State state{8.0 * random.point_in_ball(), random.point_in_ball()};
  switch (random.bits() % 12) {
    case 0:
      return (void)world.remove(id);
    case 1:
      return (void)world.teleport(id, state);
    case 2:
      return (void)world.sleep(id);
    case 3:
      return (void)world.wake(id);
    case 4:
      return (void)(world.disable(id) && world.enable(id, state));
    case 5:
      return (void)world.change(id, {.filter = Filter{.category = 2, .mask = 3}});
    case 6:
      return (void)world.change(id, {.sensor_class = 1});
    case 7:
      return (void)world.add({.radius = 0.1, .position = state.position, .velocity = state.velocity});
    case 8:
      return (void)world.add_static({.shape = Ball{state.position, 0.2}});
    case 9:
      return (void)world.change(id, {.motion_limits = MotionLimits{.acceleration_limit = 1.0}});
    case 10:
      return (void)world.change(id, {.radius = 0.2});
    default:
      return (void)world.set_velocity(id, state.velocity);
  }
}

struct Enough {};

void use(World world) {
  Random random(7);
  int left = 400;
  const bool flat = world.definition().dimensions == 2;
  const auto answers = [&](std::span<const BodyId> ids, double, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      demand(world.contains(ids[k]), "a probe asks for a body that is not there");
      if (--left < 0) throw Enough();
      states[k] = {8.0 * random.point_in_ball(), random.point_in_ball()};
      if (flat) states[k].position.z = states[k].velocity.z = 0.0;
    }
  };
  const Probe probe = answers;
  Random turns(8);
  if (world.bodies().size() % 2 == 0) give_random_rotations(world, turns);
  const auto restored = World::restore(world.save().value(), any_pair);
  if (!restored)
    throw std::logic_error("what was restored is refused when it is saved: " + restored.error().message);
  try {
    ask(world, random, probe);
    for (int k = 0; k < 30; ++k) {
      const double step = k % 4 == 0 ? 1e-3 : k % 4 == 1 ? 10.0 : 0.5;
      const auto event =
          world.advance(std::min(1e30, world.time() + duration_of_few_turns(world, step)), probe);
      if (!event) break;
      if (k % 3 == 0) change(world, random);
    }
    ask(world, random, probe);
  } catch (const Enough&) {
  }
  const auto saved = world.save();
  demand(static_cast<bool>(saved), "what was used cannot be saved");
  const auto again = World::restore(*saved, any_pair);
  if (!again) throw std::logic_error("what was used is refused when it is saved: " + again.error().message);
}

void replay(const Content& recording) {
  const auto read = read_recording(recording, any_pair);
  auto opened = Replay::open(recording, any_pair);
  if (!opened) {
    demand(opened.error().code == ErrorCode::bad_recording || opened.error().code == ErrorCode::bad_snapshot,
           "a recording is refused with another error");
    return;
  }
  while (!opened->finished()) {
    const auto event = opened->advance();
    if (event) continue;
    demand(event.error().code == ErrorCode::diverged, "a replay ends with another error");
    break;
  }
  demand(static_cast<bool>(read) == opened->finished(), "a recording is not read as it is replayed");
  if (auto copy = opened->world().clone()) use(std::move(*copy));
}

}  // namespace

void try_mended(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return;
  Original damaged = original(bytes[0]);
  for (std::size_t at = 1; at + damage_size <= bytes.size(); at += damage_size) {
    const auto how = bytes.subspan(at, damage_size);
    if (damaged.is_recording() && how[3] % 2 == 0) {
      damage(damaged.steps, 0, 0, how);
    } else {
      damage(damaged.snapshot, snapshot_header_size, 8, how);
    }
  }
  const Content all = whole(damaged);
  if (damaged.is_recording()) return replay(all);
  auto restored = World::restore(all, any_pair);
  if (restored) return use(std::move(*restored));
  demand(restored.error().code == ErrorCode::bad_snapshot, "a snapshot is refused with another error");
}

}  // namespace kinesphere::stream
