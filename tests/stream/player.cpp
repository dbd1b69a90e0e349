#include "stream/player.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include "contact/contact_event.hpp"
#include "kinesphere/inspection.hpp"
#include "kinesphere/recording.hpp"

namespace kinesphere::stream {

/// The weights sum up to 256. The first ones are no changes of the world.
const std::array<Player::Kind, 32> Player::kinds{{
    {"run", 8, &Player::run},
    {"advance", 46, &Player::advance},
    {"advance to the next event", 22, &Player::advance_to_next},
    {"advance with a bad probe", 4, &Player::advance_with_bad_probe},
    {"sprint", 2, &Player::sprint},
    {"replay", 3, &Player::replay},
    {"save or clone", 6, &Player::send_back},
    {"ask", 10, &Player::ask},
    {"call wrongly", 2, &Player::call_wrongly},
    {"add", 14, &Player::come},
    {"add_all", 2, &Player::come_together},
    {"build", 4, &Player::build},
    {"remove", 6, &Player::remove},
    {"remove some", 2, &Player::remove_some},
    {"set_velocity", 23, &Player::set_velocity},
    {"teleport", 8, &Player::teleport},
    {"nudge", 10, &Player::nudge},
    {"disable or enable", 14, &Player::switch_on_or_off},
    {"radius", 8, &Player::set_radius},
    {"radius_rate", 6, &Player::set_radius_rate},
    {"motion_limits", 7, &Player::set_limits},
    {"filter", 6, &Player::set_filter},
    {"set_pair_filter", 2, &Player::set_pair_filter},
    {"refresh_filter", 4, &Player::haunt},
    {"solid", 4, &Player::set_solid},
    {"set_sensor", 4, &Player::set_sensor},
    {"sensor_class", 4, &Player::set_sensor_class},
    {"user_data", 1, &Player::set_user_data},
    {"angular_velocity", 5, &Player::set_spin},
    {"rotation", 5, &Player::set_rotation},
    {"sleep or wake", 8, &Player::sleep_or_wake},
    {"set_shape", 6, &Player::set_shape},
}};

namespace {

constexpr unsigned first_change = 103;

/// So many events make a step of a crowd too long.
constexpr std::size_t most_events_of_a_step = 4'000;

/// So many probes make a scenario too long: of hulls that turn deep inside each other, for example.
constexpr std::size_t most_probes = 100'000;

/// Thrown by a probe that has no answer.
struct NoAnswer {};

}  // namespace

const Player::Kind& Player::kind_of(std::uint8_t code) {
  int rest = code;
  for (const Kind& kind : kinds) {
    rest -= kind.weight;
    if (rest < 0) return kind;
  }
  return kinds.back();
}

Player::Player(const Scenario& scenario)
    : truth_(scenario), world_(World::create(scenario.definition()).value()), draw_(scenario) {
  give_rotation_probe(world_);
  if (scenario.recorded) world_.start_recording().value();
  set_sensor();
  for (int k = 0; k < scenario.bodies; ++k) come();
  for (int k = 0; k < 3 && scenario.statics; ++k) build(false);
  for (int k = 0; k < 2 && scenario.zones; ++k) build(true);
  for (int k = 0; k < 3 && scenario.carried; ++k) carry();
}

void Player::perform(const Operation& operation) {
  chosen_ = operation.body();
  draw_.start(operation.random());
  (this->*kind_of(operation.code()).perform)();
  check_world();
}

void Player::perform_any_change() {
  const auto code = first_change + draw_.below(256 - first_change);
  (this->*kind_of(static_cast<std::uint8_t>(code)).perform)();
}

void Player::finish() { replay(); }

/// Returns the body of the present operation; null if there is none.
Thing* Player::thing() {
  const std::vector<BodyId> ids = world_.bodies();
  return ids.empty() ? nullptr : &truth_.at(ids[chosen_ % ids.size()]);
}

/// Returns the body of the present operation if it can move now.
Thing* Player::moving_thing() {
  Thing* const thing = this->thing();
  return thing && thing->enabled && thing->moves() ? thing : nullptr;
}

// What holds after each operation.

void Player::check_world() {
  if (const auto finding = world_.inspection().audit())
    throw Disagreement("audit: " + finding->where + ": " + finding->what);
  check_awake();
  require(world_.time() == now(), "the time is not the one that was requested");
  std::vector<BodyId> alive;
  for (const Thing& thing : truth_.things) {
    if (!thing.alive) continue;
    alive.push_back(thing.id);
    check_body(thing);
  }
  require(world_.bodies() == alive, "other bodies than were added");
  for (const BodyId id : removed_) require(!world_.contains(id), "a removed body is still there");
}

void Player::check_body(const Thing& thing) const {
  const BodyView view = world_.body(thing.id).value();
  const BodyDefinition& found = view.definition;
  const BodyDefinition& expected = thing.definition;
  require(view.enabled == thing.enabled && view.is_static == !thing.moves() &&
              view.sleeping == thing.sleeping && view.rigid.has_value() == (thing.sort == Sort::rigid),
          "a body is of another kind, or awake or asleep without a reason");
  require(found.filter == expected.filter && found.solid == expected.solid &&
              found.sensor_class == expected.sensor_class && found.user_data == expected.user_data &&
              found.acceleration_limit == expected.acceleration_limit &&
              found.planned_acceleration == expected.planned_acceleration &&
              (!thing.moves() || found.mass == expected.mass),
          "the definition of a body is not what was set");
  if (!thing.present() || !thing.moves()) return;
  const Vec3 centre = view.bound.centre_at(now());
  const Vector off = truth_.gaps.nearest_way(thing.path.at(now()), vector(centre));
  const double radius =
      thing.sort == Sort::ball ? static_cast<double>(thing.radius.at(now())) : view.definition.radius;
  const double margin = view.bound.radius_at(now()) - radius + truth_.report_errors({thing.id});
  require(length(off) <= margin + truth_.slack(), "a body is outside its bound");
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
  rounds_ = 3;
  std::ostringstream line;
  line.precision(17);
  line << "at " << now() << ": " << name;
  tell(line.str());
}

// Time.

Probe Player::probe() {
  return [this](std::span<const BodyId> ids, double time, std::span<State> states) {
    require(time >= now(), "a probe goes back in time");
    if ((probes_ += ids.size()) > most_probes) throw CutShort();
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const Thing& thing = truth_.at(ids[k]);
      require(thing.id == ids[k] && thing.present() && thing.moves(), "a probe of a body that does not move");
      require(!thing.sleeping || time == thing.path.since, "a probe of a body that sleeps");
      states[k] = truth_.report(thing, time);
    }
  };
}

void Player::give_rotation_probe(World& world) {
  if (!scenario().spins) return;
  const auto probe = [this](std::span<const BodyId> ids, double time, std::span<Rotation> rotations) {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      require(truth_.at(ids[k]).present() && truth_.at(ids[k]).sort == Sort::rigid,
              "a rotation of what does not turn");
      rotations[k] = truth_.at(ids[k]).spin.at(time);
      auto& [w, x, y, z] = rotations[k].orientation;
      // Both signs of a quaternion are the same rotation.
      if (ids[k].index % 2 == 1) rotations[k].orientation = {-w, -x, -y, -z};
    }
    if (bad_rotation_) rotations[0] = *std::exchange(bad_rotation_, std::nullopt);
  };
  world.set_rotation_probe(probe).value();
}

/// Moves the truth on to the time of the world, and checks that nothing was left untold until then.
void Player::move_on() {
  const double time = world_.time();
  if (time < now()) throw Disagreement("time goes back");
  if (time == now()) return;
  require(woken_.empty(), "no event reports in time that a body woke");
  check_silence(now(), time);
  befores_.clear();
  truth_.now = time;
}

/// Advances to the next event, and hears it.
std::optional<Event> Player::next_event(double until) {
  for (;;) {
    const auto event = world_.advance(until, probe());
    move_on();
    if (!event) {
      const Error& error = event.error();
      if (error.argument != "radius" || !world_.contains(error.body)) throw Disagreement(error.message);
      shrink(error.body);
      continue;
    }
    require(world_.time() == (*event ? (*event)->time : until), "another time than asked for");
    if (*event)
      hear(**event);
    else
      require(woken_.empty(), "no event reports that a body woke");
    return *event;
  }
}

void Player::advance() {
  steer();
  const double duration = times(draw_.uniform(0.0, 0.25));
  const double until = now() + (draw_.one_in(6) ? 1e-6 * duration : draw_.one_in(12) ? 0.0 : duration);
  const bool is_short = draw_.one_in(8);
  for (std::size_t events = 0; events < most_events_of_a_step; ++events) {
    const auto event = next_event(until);
    if (!event) return;
    respond(*event);
    if (is_short && events > 3) return;
  }
  throw CutShort();
}

/// Stops at the next event, in the middle of its instant.
void Player::advance_to_next() { (void)next_event(now() + times(draw_.uniform(0.0, 0.25))); }

void Player::advance_with_bad_probe() {
  begin_change("a bad probe");
  std::size_t left = draw_.below(8);
  const std::size_t kind = draw_.below(3);
  const std::size_t place = draw_.below(1000);
  const double wrong = draw_.one_in(2) ? nan : 1e300;
  const double until = now() + times(draw_.uniform(0.0, 0.1));
  // A spot check asks for no rotation and leaves a bad one to the next probe.
  bad_rotation_.reset();
  const auto bad = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    probe()(ids, time, states);
    if (left-- != 0) return;
    if (kind == 0) throw NoAnswer();
    const bool turns =
        std::ranges::any_of(ids, [this](BodyId id) { return truth_.at(id).sort == Sort::rigid; });
    if (kind == 1 && turns && scenario().spins)
      bad_rotation_ = place % 2 == 0 ? Rotation{{wrong, 0, 0, 1}, {}} : Rotation{{}, {0, 0, wrong}};
    else
      states[place % states.size()].position.y = wrong;
  };
  std::optional<Result<std::optional<Event>>> result;
  try {
    result = world_.advance(until, bad);
  } catch (const NoAnswer&) {
  }
  bad_rotation_.reset();
  move_on();
  if (result && *result) {
    if (**result) hear(***result);
    return;
  }
  if (result && result->error().argument != "radius") {
    const ErrorCode code = result->error().code;
    require(code == ErrorCode::not_finite || code == ErrorCode::out_of_range,
            "a bad answer is refused for a wrong reason");
  }
  const std::vector<std::byte> bytes = world_.save().value();
  const World back = World::restore(bytes, pair_filter()).value();
  require(back.save().value() == bytes, "a restored world saves other bytes");
  if (const auto finding = back.inspection().audit())
    throw Disagreement("audit of a restored world: " + finding->where + ": " + finding->what);
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
  if (!scenario().copies) return;
  if (draw_.one_in(3)) {
    world_ = world_.clone().value();
    if (truth_.has_pair_filter) world_.set_pair_filter(pair_filter()).value();
  } else {
    const auto bytes = world_.save().value();
    World back = World::restore(bytes, pair_filter()).value();
    require(back.save().value() == bytes, "a restored world saves itself differently");
    world_ = std::move(back);
  }
  give_rotation_probe(world_);
}

/// Compares the replay of all steps since the last one.
void Player::replay() {
  if (!scenario().recorded) return;
  Replay replay = Replay::open(world_.stop_recording().value()).value();
  while (!replay.finished()) (void)replay.advance().value();
  require(replay.world().save().value() == world_.save().value(), "the replayed world is another one");
  world_.start_recording().value();
}

// Motion.

void Player::turn(BodyId id, const Vec3& velocity) {
  Thing& thing = truth_.at(id);
  world_.set_velocity(id, velocity).value();
  rounds_ = 3;
  check_awake(std::vector{id});
  // A run goes on from the same place, in double precision.
  thing.path = {now(), vector(state_of(thing, now()).position), vector(velocity), thing.path.acceleration};
}

void Player::spin(BodyId id, const Vec3& angular_velocity) {
  Thing& thing = truth_.at(id);
  world_.change(id, {.angular_velocity = angular_velocity}).value();
  rounds_ = 3;
  const double speed = norm(angular_velocity);
  thing.spin = {now(), thing.spin.at(now()).orientation,
                speed > 0.0 ? angular_velocity / speed : Vec3{0.0, 0.0, 1.0}, speed};
}

bool Player::can_rest(const Thing& thing) const {
  return (thing.sort == Sort::ball || thing.sort == Sort::carried) && thing.enabled && !thing.sleeping &&
         thing.radius.rate == 0;
}

void Player::rest(Thing& thing) {
  turn(thing.id, {});
  world_.sleep(thing.id).value();
  woken_.erase(thing.id);
  thing.path = {now(), thing.path.at(now()), {}, {}};
  thing.sleeping = true;
}

/// Notes that a change of the body may have moved it over others, or away from them.
void Player::restarted(BodyId id) {
  truth_.last_change = now();
  rounds_ = 3;
  check_awake();
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

}  // namespace kinesphere::stream
