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
  const std::size_t count = ids_.size();
  for (auto* const values : {&accelerations_, &positions_, &velocities_}) values->resize(count);
  if (origins_.size() != count || own_.size() != count || motions_.size() != count || !is_finite(gravity_))
    return false;
  for (std::size_t place = 0; place < count; ++place) {
    const auto& [since, start] = origins_[place];
    if (!(since <= time) || !is_finite(start.position) || !is_finite(start.velocity) ||
        !is_finite(own_[place]) || motions_[place] > GameMotion::disabled || find(ids_[place]))
      return false;
    if (motions_[place] == GameMotion::flying) fly(place);
    give_place(ids_[place], place);
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

Vec3 GameBodies::wrapped(Vec3 position) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (!periodic_[axis]) continue;
    const double size = box_.upper[axis] - box_.lower[axis];
    double& coordinate = position[axis];
    coordinate -= size * std::floor((coordinate - box_.lower[axis]) / size);
    if (!(box_.lower[axis] <= coordinate && coordinate < box_.upper[axis])) coordinate = box_.lower[axis];
  }
  return position;
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

void GameBodies::give_place(BodyId body, std::size_t place) {
  if (body.index >= places_.size()) places_.resize(body.index + std::size_t{1}, nowhere);
  places_[body.index] = static_cast<std::uint32_t>(place);
}

void GameBodies::add(BodyId body, double time, const State& state, const Vec3& acceleration) {
  give_place(body, ids_.size());
  ids_.push_back(body);
  origins_.emplace_back();
  own_.push_back(acceleration);
  motions_.push_back(GameMotion::flying);
  for (auto* const values : {&accelerations_, &positions_, &velocities_}) values->emplace_back();
  restart(ids_.size() - 1, time, state);
}

void GameBodies::remove(std::size_t place) {
  places_[ids_[place].index] = nowhere;
  if (place + 1 < ids_.size()) places_[ids_.back().index] = static_cast<std::uint32_t>(place);
  const auto close = [place](auto&... arrays) { ((arrays[place] = arrays.back(), arrays.pop_back()), ...); };
  close(ids_, origins_, accelerations_, own_, motions_, positions_, velocities_);
}

void GameBodies::restart(std::size_t place, double time, const State& state) {
  origins_[place] = {time, state};
  fly(place);
  tell(place, time);
}

void GameBodies::halt(std::size_t place, double time, GameMotion motion) {
  origins_[place] = {time, {flight(place, time).position, {}}};
  motions_[place] = motion;
  accelerations_[place] = {};
  tell(place, time);
}

void GameBodies::set_acceleration(std::size_t place, double time, const Vec3& acceleration) {
  own_[place] = acceleration;
  if (motions_[place] != GameMotion::disabled) restart(place, time, flight(place, time));
}

void GameBodies::set_gravity(double time, const Vec3& gravity) {
  gravity_ = gravity;
  for (std::size_t place = 0; place < ids_.size(); ++place) set_acceleration(place, time, own_[place]);
}

Error GameBodies::not_moved(BodyId body) {
  return {
      ErrorCode::unknown_body, "body", body,
      "GameWorld: body: " + text_of(body) + " must be moved by the game, but was added to its world() alone"};
}

void GameBodies::refuse(BodyId body) { detail::bad_result(not_moved(body)); }

void GameBodies::states(std::span<const BodyId> ids, double time, std::span<State> states) {
  for (std::size_t k = 0; k < ids.size(); ++k) states[k] = flight(known(ids[k]), time);
}

MotionOrigin GameBodies::origin(BodyId body) const { return origins_[known(body)]; }

void GameBodies::set_origin(BodyId body, const MotionOrigin& origin) {
  restart(known(body), origin.time, origin.state);
}

}  // namespace kinesphere
