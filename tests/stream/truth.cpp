// The true motion of bodies, and the exact course of the gaps between them.
#include "stream/truth.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere::stream {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::string text_of(BodyId id) { return std::to_string(id.index) + "." + std::to_string(id.generation); }

}  // namespace

std::string text_of(const Contact& contact) {
  return text_of(contact.first) + " and " +
         (contact.wall == Wall::none ? text_of(contact.second) : std::string(name_of(contact.wall)));
}

void Truth::add(BodyId id, const BodyDefinition& body, const Vec3& acceleration) {
  if (id.index >= bodies_.size()) {
    require(id.index == bodies_.size() && id.generation == 0, "a new index is not the next one");
    bodies_.emplace_back();
  } else {
    require(!at(id).alive && id.generation == at(id).id.generation + 1, "an id is given out twice");
  }
  at(id) = {.id = id, .definition = body, .alive = true, .enabled = true};
  at(id).path = {{time_, infinity, body.position, body.velocity, acceleration, {}}};
}

void Truth::remove(BodyId id) {
  at(id).alive = false;
  haunted_.erase(id);
}

void Truth::restart(BodyId id) {
  Segment& path = at(id).path.front();
  const State now = path.state_at(time_);
  path.begin = time_;
  path.position = now.position;
  path.velocity = now.velocity;
}

void Truth::move(BodyId id, const State& state) {
  restart(id);
  at(id).path.front().position = state.position;
  at(id).path.front().velocity = state.velocity;
}

void Truth::steer(BodyId id, const Vec3& acceleration) {
  restart(id);
  at(id).path.front().acceleration = acceleration;
}

std::vector<BodyId> Truth::ids() const {
  std::vector<BodyId> ids;
  for (const TrueBody& body : bodies_)
    if (body.alive) ids.push_back(body.id);
  return ids;
}

bool Truth::is_alive(BodyId id) const { return id.index < bodies_.size() && at(id).alive && at(id).id == id; }

void Truth::haunt(BodyId id) {
  if (!haunted_.insert(id).second) haunted_.erase(id);
}

bool Truth::passes_filters(BodyId a, const Filter& filter_of_a, BodyId b) const {
  return passes(filter_of_a, at(b).definition.filter) && (!has_pair_filter || pair_filter(a, b));
}

bool Truth::may_touch(const Contact& contact) const {
  if (!is_present(contact.first)) return false;
  if (contact.wall != Wall::none) return true;
  return is_present(contact.second) &&
         passes_filters(contact.first, at(contact.first).definition.filter, contact.second);
}

double Truth::radii(const Contact& contact) const {
  const double first = at(contact.first).definition.radius;
  return contact.wall == Wall::none ? first + at(contact.second).definition.radius : first;
}

GapCourse Truth::course(const Contact& contact) const {
  const Trajectory& path = at(contact.first).path;
  if (contact.wall != Wall::none) return {path, half_space(*definition_.box, contact.wall), radii(contact)};
  return {path, at(contact.second).path, radii(contact)};
}

/// Of the first body to the second; of a body inside a wall, along the normal of the wall.
Truth::Relative Truth::relative(const Contact& contact) const {
  const State first = state(contact.first);
  const Vec3 acceleration = at(contact.first).path.front().acceleration;
  if (contact.wall != Wall::none) {
    const HalfSpace inside = half_space(*definition_.box, contact.wall);
    const Vec3 n = inside.normal;
    return {n * (dot(n, first.position) - inside.offset), n * dot(n, first.velocity),
            n * dot(n, acceleration)};
  }
  const State second = state(contact.second);
  return {second.position - first.position, second.velocity - first.velocity,
          at(contact.second).path.front().acceleration - acceleration};
}

double Truth::approach_speed(const Contact& contact) const {
  const auto [x, v, g] = relative(contact);
  if (contact.wall != Wall::none) return -dot(half_space(*definition_.box, contact.wall).normal, v);
  const double distance = norm(x);
  return distance > 0.0 ? -dot(x, v) / distance : -norm(v);
}

bool Truth::may_reach(const Contact& contact, Crossing crossing, double level, double until) const {
  const auto [x, v, g] = relative(contact);
  const double s = until - time_;
  const double way = 1.001 * (norm(v) + 0.5 * norm(g) * s) * s + 1e-9;
  const double gap = course(contact).gap_at(time_);
  return crossing == Crossing::falls_to ? gap - way <= level : gap + way >= level;
}

/// From the greatest value of x.x' / (1, or |n.x| for a wall), where x is the relative position.
bool Truth::opens_before(const Contact& contact, double until) const {
  const auto [x, v, g] = relative(contact);
  if (contact.wall != Wall::none) {
    const Vec3 n = half_space(*definition_.box, contact.wall).normal;
    return std::max(dot(n, v), dot(n, v + g * (until - time_))) >= -1e-9;
  }
  const double q0 = dot(x, v);
  const double q1 = norm_squared(v) + dot(x, g);
  const double q2 = 1.5 * dot(v, g);
  const double q3 = 0.5 * norm_squared(g);
  const double end = until - time_;
  const auto opening = [=](double s) { return q0 + (q1 + (q2 + q3 * s) * s) * s; };
  double most = std::max(opening(0.0), opening(end));
  const double discriminant = q2 * q2 - 3.0 * q1 * q3;
  if (discriminant >= 0.0 && q3 > 0.0) {
    for (const double sign : {-1.0, 1.0}) {
      const double s = (-q2 + sign * std::sqrt(discriminant)) / (3.0 * q3);
      if (s > 0.0 && s < end) most = std::max(most, opening(s));
    }
  }
  return most >= -1e-9;
}

}  // namespace kinesphere::stream
