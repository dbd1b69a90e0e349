// Plays a stream: time, events, and the checks after each operation.
#include "stream/player.hpp"
#include "kinesphere/inspection.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "stream/on_world.hpp"

namespace kinesphere::stream {

const std::array<Player::Kind, 29> Player::kinds{{
    {"advance", 58, &Player::advance},
    {"run", 6, &Player::run},
    {"advance to the next event", 22, &Player::advance_to_next},
    {"advance with a bad probe", 4, &Player::advance_with_bad_probe},
    {"add", 16, &Player::add},
    {"add_all", 3, &Player::add_all},
    {"remove", 8, &Player::remove},
    {"remove_all", 2, &Player::remove_all},
    {"set_velocity", 18, &Player::set_velocity},
    {"steer", 12, &Player::steer},
    {"teleport", 8, &Player::teleport},
    {"nudge", 12, &Player::nudge},
    {"set_radius", 10, &Player::set_radius},
    {"set_motion_limits", 8, &Player::set_motion_limits},
    {"set_filter", 8, &Player::set_filter},
    {"set_pair_filter", 2, &Player::set_pair_filter},
    {"refresh_filter", 6, &Player::haunt},
    {"set_solid", 3, &Player::set_solid},
    {"set_sensor", 4, &Player::set_sensor},
    {"set_sensor_class", 4, &Player::set_sensor_class},
    {"add_static", 4, &Player::add_static},
    {"set_user_data", 2, &Player::set_user_data},
    {"disable", 6, &Player::turn_off},
    {"enable", 9, &Player::turn_on},
    {"restore or clone", 9, &Player::restore},
    {"ask", 6, &Player::ask},
    {"call wrongly", 2, &Player::call_wrongly},
    {"rest", 3, &Player::rest},
    {"wake", 1, &Player::wake},
}};

namespace {

/// Thrown by a probe that has no answer.
struct NoAnswer {};

}  // namespace

/// The weights sum up to 256.
const Player::Kind& Player::kind_of(std::uint8_t code) {
  int rest = code;
  for (const Kind& kind : kinds) {
    rest -= kind.weight;
    if (rest < 0) return kind;
  }
  return kinds.back();
}

const char* Player::name_of(const Operation& operation) { return kind_of(operation.code()).name; }

Player::Player(const WorldKind& kind)
    : kind_(kind),
      truth_(kind.definition),
      told_(kind.definition, truth_),
      world_(World::create(kind.definition).value()),
      asked_at_(kind.definition.start_time) {
  give_rotation_probe(world_);
  Random random(kind.first_bodies);
  for (int k = 0; k < 2 * sensor_classes; ++k) set_sensor(random_operation(random));
  for (int k = 0; k < 3; ++k) add_static(random_operation(random));
  for (std::size_t k = 0; k < kind.first_bodies; ++k) add(random_operation(random));
}

void Player::perform(const Operation& operation) {
  (this->*kind_of(operation.code()).perform)(operation);
  check_all();
  if (const auto id = any(operation); id && kind_.sensors) told_.check_account(world_, *id);
}

/// Runs the world's audit, and checks its account of the bodies.
void Player::check_all() const {
  if (const auto finding = world_.inspection().audit())
    throw Disagreement("audit: " + finding->where + ": " + finding->what);
  const std::vector<BodyId> ids = truth_.ids();
  require(world_.time() == truth_.time(), "the time is not the one that was requested");
  require(world_.size() == ids.size() && world_.bodies() == ids, "other bodies than were added");
  for (const BodyId id : ids) check_body(id);
  for (const BodyId id : removed_) require(!world_.contains(id), "a removed body is still there");
}

void Player::check_body(BodyId id) const {
  const BodyView view = world_.body(id).value();
  const TrueBody& body = truth_.at(id);
  const BodyDefinition& found = view.definition;
  const BodyDefinition& expected = body.definition;
  require(view.enabled == body.enabled, "enabled and disabled are mixed up");
  require(view.is_static == body.fixed, "fixed bodies and others are mixed up");
  require(found.radius == expected.radius && found.filter == expected.filter &&
              found.solid == expected.solid && found.sensor_class == expected.sensor_class &&
              found.user_data == expected.user_data &&
              found.acceleration_limit == expected.acceleration_limit &&
              found.planned_acceleration == expected.planned_acceleration,
          "a body's definition is not what was set");
  require(view.sleeping == body.resting, "a body has come to rest or is awake without a reason");
  check_rigid(view, body);
  if (!body.enabled) return;
  const Vec3 centre = view.bound.centre_at(truth_.time());
  const Vec3 position = truth_.state(id).position;
  const Vec3 off = position + truth_.shift_to_nearest(position, centre) - centre;
  const double margin = view.bound.radius_at(truth_.time()) - expected.radius;
  require(norm(off) <= margin + 1e-3 * truth_.definition().contact_tolerance + 1e-12,
          "a body is outside its bound");
}

std::optional<BodyId> Player::any(const Operation& operation) const {
  const std::vector<BodyId> ids = truth_.ids();
  if (ids.empty()) return std::nullopt;
  return ids[operation.body() % ids.size()];
}

std::optional<BodyId> Player::any_moving(const Operation& operation) const {
  const auto id = any(operation);
  return id && !truth_.at(*id).fixed ? id : std::nullopt;
}

/// Returns the operation with another body.
Operation Player::about(BodyId id, Operation operation) const {
  const std::vector<BodyId> ids = truth_.ids();
  const auto place = std::lower_bound(ids.begin(), ids.end(), id);
  operation.bytes[1] = static_cast<std::uint8_t>(place - ids.begin());
  return operation;
}

// Time.

Player::Answers Player::probe() {
  return [this](std::span<const BodyId> ids, double time, std::span<State> states) {
    require(time >= asked_at_, "a probe goes back in time");
    for (std::size_t k = 0; k < ids.size(); ++k) {
      require(truth_.is_present(ids[k]), "a probe of a body that is not there");
      require(!truth_.at(ids[k]).fixed, "a probe of a body that never moves");
      require(!truth_.at(ids[k]).resting || time == truth_.at(ids[k]).rested_at,
              "a probe of a body that rests");
      states[k] = truth_.at(ids[k]).path.front().state_at(time);
    }
  };
}

std::optional<Event> Player::next_event(double until) {
  auto result = on_world([&](World& world) { return world.advance(until, probe()); });
  asked_at_ = world_.time();
  if (!result) throw Disagreement("advance: " + result.error().message);
  move_on();
  if (*result) {
    hear(**result);
  } else {
    told_.settle_ends();
    require(woken_.empty(), "no event reports that a body woke");
    require(world_.time() == until, "no event, and yet the time is not what was asked for");
  }
  return *result;
}

void Player::move_on() {
  require(woken_.empty() || world_.time() == truth_.time(), "no event reports in time that a body woke");
  told_.move_on_to(world_.time());
}

void Player::hear(const Event& event) {
  ++events_;
  require(event.time == world_.time(), "an event of another time");
  if (event.kind == EventKind::woke) return hear_woken(event);
  check_order(event);
  told_.hear(event);
  wake_by(event);
}

/// Checks that events of one instant come in order. After a change the ends that it caused come first, even
/// if others came before; then pending events; then events that the changes caused.
void Player::check_order(const Event& event) {
  const bool same_instant = last_event_ && last_event_->time == event.time;
  if (same_instant && !delivered_before(*last_event_, event))
    require(std::exchange(crossed_, false) || --rounds_ >= 0, "events of one instant in the wrong order");
  if (!same_instant) crossed_ = false;
  crossed_ = crossed_ || event.kind == EventKind::sensor_enter || event.kind == EventKind::sensor_leave;
  last_event_ = event;
}

void Player::advance(const Operation& operation) {
  const double length = operation.fraction(0);
  const double until = world_.time() + (operation.byte(0) % 8 == 0 ? 0.0 : 0.1 * length * length);
  const int most = operation.byte(1) % 4 == 0 ? 1 : 20;
  for (int count = 0; count < most; ++count) {
    const auto event = next_event(until);
    if (!event) break;
    answer(*event, operation);
  }
  send_back();
}

/// Stops at the next event, in the middle of its instant.
void Player::advance_to_next(const Operation& operation) {
  (void)next_event(world_.time() + 0.1 * operation.fraction(0));
}

/// Acts as the caller at an event.
void Player::answer(const Event& event, const Operation& operation) {
  Random random = operation.random();
  for (std::size_t k = 0; k < events_ % 16; ++k) (void)random.bits();
  const auto choice = (random.bits() + operation.byte(2)) % 16;
  const bool begins = event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
  if (choice < 9 && begins && event.approach_speed > 0.0) {
    const Vec3 change = event.normal * ((choice < 5 ? 1.0 : 0.6) * event.approach_speed);
    const auto moves = [this](BodyId id) { return truth_.is_present(id) && !truth_.at(id).fixed; };
    const bool alone = !moves(event.first) || !moves(event.second);
    const auto turn = [&](BodyId id, const Vec3& by) {
      if (moves(id)) set_velocity(id, truth_.state(id).velocity + (alone ? 2.0 : 1.0) * by);
    };
    turn(event.first, -change);
    turn(event.second, change);
  } else if (choice > 12) {
    Operation other = random_operation(random);
    const BodyId id = choice == 13 || event.second == no_body ? event.first : event.second;
    if (choice < 15 && truth_.is_alive(id)) other = about(id, other);
    // Any kind but the first four, which move time on.
    other.bytes[0] = static_cast<std::uint8_t>(90 + other.bytes[0] % (256 - 90));
    perform(other);
  }
}

void Player::advance_with_bad_probe(const Operation& operation) {
  const double until = world_.time() + 0.02 * operation.fraction(0);
  const auto result = on_world([&](World& world) -> Result<std::optional<Event>> {
    int left = operation.byte(1) % 8;
    // A spot check asks for no rotation and leaves a bad one to the next probe.
    bad_rotation_.reset();
    const auto bad = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
      probe()(ids, time, states);
      if (left-- != 0) return;
      if (operation.byte(2) % 3 == 0) throw NoAnswer();
      if (std::any_of(ids.begin(), ids.end(), [this](BodyId id) { return is_rigid(id); })) {
        const double wrong = operation.byte(2) % 2 == 0 ? nan : 1e300;
        if (operation.byte(4) % 2 == 0) bad_rotation_ = Rotation{{wrong, 0, 0, 1}, {}};
        if (operation.byte(4) % 4 == 1) bad_rotation_ = Rotation{{}, {0, 0, wrong}};
        if (kind_.swings && bad_rotation_) return;
      }
      const double wrong = operation.byte(2) % 3 == 1 ? std::numeric_limits<double>::quiet_NaN() : 1e300;
      states[operation.byte(3) % states.size()].position.y = wrong;
    };
    try {
      return world.advance(until, bad);
    } catch (const NoAnswer&) {
      return Error{ErrorCode::not_finite, "probe", no_body, "the probe threw"};
    }
  });
  asked_at_ = world_.time();
  bad_rotation_.reset();
  move_on();
  if (!result) {
    const ErrorCode code = result.error().code;
    require(code == ErrorCode::not_finite || code == ErrorCode::out_of_range,
            "a bad answer is refused for a wrong reason");
    check_snapshot();
  } else if (*result) {
    hear(**result);
  }
}

/// Checks that the world can be saved, and that the restored one is equal and clean.
void Player::check_snapshot() const {
  const std::vector<std::byte> bytes = world_.save().value();
  const auto restored = World::restore(bytes, pair_filter());
  if (!restored) throw Disagreement("restore: " + restored.error().message);
  require(restored->save().value() == bytes, "a restored world saves other bytes");
  if (const auto finding = restored->inspection().audit())
    throw Disagreement("audit of a restored world: " + finding->where + ": " + finding->what);
}

}  // namespace kinesphere::stream
