// GameBodies: free flight, and places without gaps.
#include "motion/game_bodies.hpp"

#include <cmath>

#include "input/input_check.hpp"

namespace kinesphere {

GameBodies::GameBodies(const WorldDefinition& world, const Vec3& gravity)
    : gravity_(gravity), periodic_(world.periodic), box_(world.box.value_or(Box{})) {}

bool GameBodies::complete(const WorldDefinition& world, double time) {
  periodic_ = world.periodic;
  box_ = world.box.value_or(Box{});
  positions_.resize(ids_.size());
  velocities_.resize(ids_.size());
  if (paths_.size() != ids_.size() || !is_finite(gravity_)) return false;
  for (std::size_t place = 0; place < ids_.size(); ++place) {
    const auto& [since, start, acceleration, motion] = paths_[place];
    if (!(since <= time) || !is_finite(start.position) || !is_finite(start.velocity) ||
        !is_finite(acceleration) || motion > GameMotion::disabled || find(ids_[place]))
      return false;
    if (ids_[place].index >= places_.size()) places_.resize(ids_[place].index + std::size_t{1}, nowhere);
    places_[ids_[place].index] = static_cast<std::uint32_t>(place);
  }
  return true;
}

std::optional<std::size_t> GameBodies::find(BodyId body) const {
  if (body.index >= places_.size() || places_[body.index] == nowhere) return std::nullopt;
  const BodyId found = ids_[places_[body.index]];
  const bool is_same_world = found.world == body.world || found.world == 0 || body.world == 0;
  if (found != body || !is_same_world) return std::nullopt;
  return places_[body.index];
}

/// Computes as Segment::state_at() does.
State GameBodies::flight(std::size_t place, double time) const {
  const auto& [since, start, own, motion] = paths_[place];
  if (motion != GameMotion::flying) return start;
  const double s = time - since;
  const Vec3 acceleration = gravity_ + own;
  return {start.position + s * (start.velocity + s * (0.5 * acceleration)),
          start.velocity + s * acceleration};
}

State GameBodies::state(std::size_t place, double time) const {
  State state = flight(place, time);
  for (int axis = 0; axis < 3; ++axis) {
    if (!periodic_[axis]) continue;
    const double size = box_.upper[axis] - box_.lower[axis];
    double& coordinate = state.position[axis];
    coordinate -= size * std::floor((coordinate - box_.lower[axis]) / size);
    if (!(box_.lower[axis] <= coordinate && coordinate < box_.upper[axis])) coordinate = box_.lower[axis];
  }
  return state;
}

void GameBodies::tell(std::size_t place, double time) const {
  const State now = state(place, time);
  positions_[place] = now.position;
  velocities_[place] = now.velocity;
}

void GameBodies::refreshed(double time) const {
  if (told_at_ == time) return;
  for (std::size_t place = 0; place < ids_.size(); ++place) tell(place, time);
  told_at_ = time;
}

void GameBodies::add(BodyId body, double time, const State& state, const Vec3& acceleration) {
  if (body.index >= places_.size()) places_.resize(body.index + std::size_t{1}, nowhere);
  places_[body.index] = static_cast<std::uint32_t>(ids_.size());
  ids_.push_back(body);
  paths_.push_back({time, state, acceleration});
  positions_.emplace_back();
  velocities_.emplace_back();
  tell(ids_.size() - 1, time);
}

void GameBodies::remove(std::size_t place) {
  places_[ids_[place].index] = nowhere;
  if (place + 1 < ids_.size()) places_[ids_.back().index] = static_cast<std::uint32_t>(place);
  const auto close = [place](auto& values) {
    values[place] = values.back();
    values.pop_back();
  };
  close(ids_), close(paths_), close(positions_), close(velocities_);
}

void GameBodies::restart(std::size_t place, double time, const State& state) {
  paths_[place] = {time, state, paths_[place].acceleration};
  tell(place, time);
}

void GameBodies::halt(std::size_t place, double time, GameMotion motion) {
  restart(place, time, {flight(place, time).position, {}});
  paths_[place].motion = motion;
}

void GameBodies::set_acceleration(std::size_t place, double time, const Vec3& acceleration) {
  GamePath& path = paths_[place];
  if (path.motion != GameMotion::disabled) path = {time, flight(place, time), acceleration};
  path.acceleration = acceleration;
}

void GameBodies::set_gravity(double time, const Vec3& gravity) {
  for (std::size_t place = 0; place < ids_.size(); ++place)
    set_acceleration(place, time, paths_[place].acceleration);
  gravity_ = gravity;
}

std::size_t GameBodies::known(BodyId body) const {
  const auto place = find(body);
  if (!place) [[unlikely]]
    detail::bad_result({ErrorCode::unknown_body, "body", body,
                        "GameWorld: body: " + text_of(body) +
                            " must be moved by the game, but was added to its world() alone"});
  return *place;
}

void GameBodies::states(std::span<const BodyId> ids, double time, std::span<State> states) {
  for (std::size_t k = 0; k < ids.size(); ++k) states[k] = flight(known(ids[k]), time);
}

MotionOrigin GameBodies::origin(BodyId body) const {
  const GamePath& path = paths_[known(body)];
  return {path.since, path.start};
}

void GameBodies::set_origin(BodyId body, const MotionOrigin& origin) {
  restart(known(body), origin.time, origin.state);
}

}  // namespace kinesphere
