#include "mixed_worlds/player.hpp"

#include <sstream>
#include <utility>

#include "kinesphere/inspection.hpp"
#include "kinesphere/recording.hpp"

namespace kinesphere::mixed {
namespace {

/// So many events make a step of a crowd too long.
constexpr std::size_t most_events_of_a_step = 4'000;

}  // namespace

Player::Player(const Scenario& scenario)
    : truth_(scenario), world_(World::create(scenario.definition()).value()), draw_(scenario) {
  give_rotation_probe();
  if (scenario.recorded) world_.start_recording().value();
  if (scenario.sensors) change_sensor();
  for (int k = 0; k < scenario.bodies; ++k) come();
  for (int k = 0; k < 3 && scenario.statics; ++k) build(false);
  for (int k = 0; k < 2 && scenario.zones; ++k) build(true);
  for (int k = 0; k < 3 && scenario.carried; ++k) carry();
}

void Player::play() {
  try {
    for (int stop = 0; stop < scenario().stops; ++stop) {
      for (std::size_t k = draw_.below(3); k > 0; --k) change_any();
      if (scenario().answers) while_there_is_room([this] { check_answers(); });
      steer();
      const double duration = times(draw_.uniform(0.0, 0.25));
      step(now() + (draw_.one_in(6) ? 1e-6 * duration : duration));
      if (const auto finding = world_.inspection().audit())
        throw Disagreement("audit: " + finding->where + ": " + finding->what);
      if (scenario().answers) while_there_is_room([this] { check_answers(); });
      if (scenario().copies && draw_.one_in(5)) send_back();
      if (scenario().recorded && stop == scenario().stops / 2) replay();
    }
    if (scenario().recorded) replay();
  } catch (const CutShort&) {
    tally_.cut_short = true;
  }
}

/// Calls call(), and shrinks a ball that has grown too large for periodic space.
template <class Call>
void Player::while_there_is_room(Call call) {
  try {
    call();
  } catch (const BadResult& result) {
    if (result.error().argument != "radius" || !world_.contains(result.error().body)) throw;
    shrink(result.error().body);
  }
}

// What is told about a failure.

void Player::tell(const std::string& line) {
  story_.push_back(line);
  if (story_.size() > 40) story_.pop_front();
}

std::string Player::story() const {
  std::string story;
  for (const std::string& line : story_) story += "\n  " + line;
  return story;
}

void Player::begin_change(const char* name) {
  befores_.push_back(truth_.things);
  std::ostringstream line;
  line.precision(17);
  line << "at " << now() << ": " << name;
  tell(line.str());
}

// Time.

State Player::report(BodyId id, double time) {
  const Thing& thing = truth_.at(id);
  Vector position = thing.path.at(time), velocity = thing.path.velocity_at(time);
  if (const double error = thing.definition.position_error; error > 0.0) {
    Random random = Random::at(scenario().seed, id.index, reports_++);
    const auto off = [&](double most) {
      Vec3 way = 0.99 * most * random.point_in_ball();
      if (scenario().flat) way.z = 0.0;
      return vector(way);
    };
    position = position + off(error);
    if (!thing.sleeping) velocity = velocity + off(thing.definition.velocity_error);
  }
  return {rounded(position), rounded(velocity)};
}

Probe Player::probe() {
  return [this](std::span<const BodyId> ids, double time, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = report(ids[k], time);
  };
}

void Player::give_rotation_probe() {
  if (!scenario().spins) return;
  world_
      .set_rotation_probe([this](std::span<const BodyId> ids, double time, std::span<Rotation> rotations) {
        for (std::size_t k = 0; k < ids.size(); ++k) rotations[k] = truth_.at(ids[k]).spin.at(time);
      })
      .value();
}

/// Moves the truth on to the time of the world, and checks that nothing was left untold until then.
void Player::move_on() {
  const double time = world_.time();
  if (time < now()) throw Disagreement("time goes back");
  if (time == now()) return;
  check_silence(now(), time);
  befores_.clear();
  truth_.now = time;
}

void Player::step(double until) {
  for (std::size_t events = 0; events < most_events_of_a_step;) {
    const auto event = world_.advance(until, probe());
    move_on();
    if (!event) {
      const Error& error = event.error();
      if (error.argument != "radius" || !world_.contains(error.body)) throw Disagreement(error.message);
      shrink(error.body);
      continue;
    }
    if (world_.time() != (*event ? (*event)->time : until)) throw Disagreement("another time than asked for");
    if (!*event) return;
    ++events;
    hear(**event);
    if (scenario().copies && draw_.one_in(40)) send_back();
  }
  throw CutShort();
}

void Player::shrink(BodyId grown) {
  begin_change("shrink");
  const double radius = lengths(0.05);
  world_.change(grown, {.radius = radius, .radius_rate = 0.0}).value();
  truth_.at(grown).radius = {now(), radius, 0};
  restarted(grown);
}

/// Goes on with a copy of the world.
void Player::send_back() {
  if (draw_.one_in(3)) {
    world_ = world_.clone().value();
  } else {
    const auto bytes = world_.save().value();
    World back = World::restore(bytes).value();
    if (back.save().value() != bytes) throw Disagreement("a restored world saves itself differently");
    world_ = std::move(back);
  }
  give_rotation_probe();
}

void Player::replay() {
  Replay replay = Replay::open(world_.stop_recording().value()).value();
  while (!replay.finished()) (void)replay.advance().value();
  if (replay.world().save().value() != world_.save().value())
    throw Disagreement("the replayed world is another one");
  world_.start_recording().value();
}

// Motion.

void Player::turn(BodyId id, const Vec3& velocity) {
  Thing& thing = truth_.at(id);
  thing.wake(now());
  world_.set_velocity(id, velocity).value();
  thing.path = {now(), thing.path.at(now()), vector(velocity), thing.path.acceleration};
}

void Player::spin(BodyId id, const Vec3& angular_velocity) {
  Thing& thing = truth_.at(id);
  world_.change(id, {.angular_velocity = angular_velocity}).value();
  const double speed = norm(angular_velocity);
  thing.spin = {now(), thing.spin.at(now()).orientation,
                speed > 0.0 ? angular_velocity / speed : Vec3{0.0, 0.0, 1.0}, speed};
}

bool Player::can_rest(const Thing& thing) const {
  return (thing.sort == Sort::ball || thing.sort == Sort::carried) && thing.enabled && !thing.sleeping &&
         thing.radius.rate == 0;
}

void Player::rest(Thing& thing) {
  world_.set_velocity(thing.id, {}).value();
  world_.sleep(thing.id).value();
  thing.path = {now(), thing.path.at(now()), {}, {}};
  thing.sleeping = true;
}

/// Notes that a change of the body may have moved it over others, or away from them.
void Player::restarted(BodyId id) {
  truth_.last_change = now();
  for (auto& [contact, state] : states_)
    if (contact.has(id)) state.clear = state.held = false;
}

/// Draws accelerations until the next step, towards the middle rather than away.
void Player::steer() {
  for (Thing& thing : truth_.things) {
    if (!thing.present() || !thing.moves() || thing.sleeping) continue;
    const BodyDefinition& body = thing.definition;
    Vector acceleration = vector(body.planned_acceleration);
    const Vector away = thing.path.at(now()) - vector(draw_.middle());
    const Vector back = away * (-1 / (length(away) + lengths(0.1)));
    if (body.acceleration_limit > 0.0)
      acceleration = acceleration + (back * 0.55L + vector(draw_.point_in_ball()) * 0.44L) *
                                        static_cast<Real>(body.acceleration_limit);
    thing.path = {now(), thing.path.at(now()), thing.path.velocity_at(now()), acceleration};
    if (thing.sort == Sort::rigid && thing.spin_limit > 0.0) {
      const double speed = thing.spin.speed_at(now());
      const bool slows = speed > 0.5 * thing.largest_spin || (speed >= 0.0 && draw_.one_in(2));
      thing.spin = {now(), thing.spin.at(now()).orientation, thing.spin.axis, speed,
                    (slows ? -0.5 : 0.5) * thing.spin_limit * draw_.uniform()};
    }
    const bool leaves = length(away) > lengths(2.0 * scenario().edge) && dot(away, thing.path.velocity) > 0;
    if (!scenario().box && leaves) turn_back(thing);
  }
}

void Player::turn_back(Thing& thing) {
  begin_change("turn back");
  const Vec3 velocity = -rounded(thing.path.velocity);
  turn(thing.id, norm(velocity) > speeds(10.0) ? 0.1 * velocity : velocity);
  truth_.last_change = now();
}

}  // namespace kinesphere::mixed
