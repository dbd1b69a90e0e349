#include "research/measures/probe_floor.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "contact/contact_event.hpp"
#include "kinesphere/bound.hpp"
#include "number/infinity.hpp"
#include "research/measures/box_grid.hpp"
#include "simulation/oracle/gap_course.hpp"

namespace kinesphere {
namespace {

/// Returns the true sphere of a body on a piece of its path, as a bound that does not grow.
Bound true_sphere(const Segment& piece, double radius) {
  return {.time = piece.begin,
          .position = piece.position,
          .velocity = piece.velocity,
          .planned_acceleration = piece.acceleration,
          .radius = radius};
}

Box united(const Box& a, const Box& b) {
  Box box = a;
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = std::min(a.lower[axis], b.lower[axis]);
    box.upper[axis] = std::max(a.upper[axis], b.upper[axis]);
  }
  return box;
}

/// Returns the first time at which the bound is within `distance` of the other. earliest_meeting() is never
/// late; repeated from its own answer, it comes as near to the truth as rounding allows.
template <class Other>
double meeting(const Bound& bound, const Other& other, double from, double to, double distance) {
  constexpr int most_rounds = 30;
  for (int round = 0; round < most_rounds; ++round) {
    const double next = earliest_meeting(bound, other, from, to, distance);
    if (!(next > from) || next == infinity) return next;
    from = next;
  }
  return from;
}

class FloorCount {
 public:
  FloorCount(const Scene& scene, const Flight& flight)
      : scene_(scene), flight_(flight), tolerance_(scene.world.contact_tolerance) {
    const double start = scene.world.start_time;
    bodies_.resize(scene.bodies.size());
    for (std::uint32_t number = 0; number < bodies_.size(); ++number) {
      Body& body = bodies_[number];
      body.definition = scene.motion->definition(number, start);
      body.definition.radius = scene.bodies[number].radius;
      body.bound = bound_of(body.definition, state(number, start), start);
    }
    for (const FlightContact& contact : flight.contacts) {
      note(contact.first, contact);
      if (contact.wall == Wall::none) note(contact.second, contact);
    }
    for (Body& body : bodies_) {
      std::sort(body.stops.begin(), body.stops.end());
      body.stops.erase(std::unique(body.stops.begin(), body.stops.end()), body.stops.end());
    }
  }

  ProbeFloor run() {
    const double start = scene_.world.start_time;
    const double window = window_length();
    for (double begin = start; begin < scene_.end_time;) {
      const double end = std::min(begin + window, scene_.end_time);
      std::vector<BoxGrid::Entry> boxes;
      for (std::uint32_t number = 0; number < bodies_.size(); ++number)
        boxes.push_back({true_box(number, begin, end), number});
      grid_.build(boxes);
      for (std::uint32_t number = 0; number < bodies_.size(); ++number) go_through(number, begin, end);
      begin = end;
    }
    ProbeFloor floor;
    for (const Body& body : bodies_) floor.probes.push_back(body.probes);
    return floor;
  }

 private:
  struct Body {
    BodyDefinition definition;
    Bound bound;                ///< bound since the last counted probe
    std::vector<double> stops;  ///< times of contact begins and ends, at which the body is probed anyway
    std::size_t next_stop = 0;
    std::vector<FlightContact> long_contacts;  ///< contacts that end later than they begin
    std::uint64_t probes = 0;
  };

  void note(std::uint32_t number, const FlightContact& contact) {
    Body& body = bodies_[number];
    for (const double time : {contact.begin, contact.end})
      if (time > scene_.world.start_time && time <= scene_.end_time) body.stops.push_back(time);
    if (contact.end > contact.begin) body.long_contacts.push_back(contact);
  }

  State state(std::uint32_t number, double time) const {
    return segment_at(flight_.paths[number], time).state_at(time);
  }

  /// Returns the length of a window of time in which others are looked for: the average body moves half way
  /// to its neighbours in it.
  double window_length() const {
    const double duration = scene_.end_time - scene_.world.start_time;
    Box all{bodies_.front().bound.position, bodies_.front().bound.position};
    double speed = 0.0, acceleration = 0.0;
    for (const Body& body : bodies_) {
      all = united(all, {body.bound.position, body.bound.position});
      speed += norm(body.bound.velocity);
      acceleration += body.definition.acceleration_limit + norm(body.definition.planned_acceleration);
    }
    const auto count = static_cast<double>(bodies_.size());
    const Vec3 size = all.upper - all.lower;
    const double distance = 0.5 * std::cbrt(size.x * size.y * size.z / count);
    speed /= count;
    acceleration /= count;
    const double window = 2.0 * distance / (speed + std::sqrt(speed * speed + 2.0 * acceleration * distance));
    // The window is NaN, zero or infinite if all bodies lie in a plane or are at rest.
    return window > 1e-3 * duration && window < duration ? window : 0.1 * duration;
  }

  Box true_box(std::uint32_t number, double begin, double end) const {
    std::optional<Box> box;
    for_each_piece(number, begin, end, [&](const Bound& sphere, double from, double to) {
      const Box piece = swept_box(sphere, from, to);
      box = box ? united(*box, piece) : piece;
      return true;
    });
    return *box;
  }

  /// Calls visit(true sphere, from, to) for the pieces of a path in turn, until it returns false.
  template <class Visit>
  void for_each_piece(std::uint32_t number, double begin, double end, Visit visit) const {
    const Trajectory& path = flight_.paths[number];
    for (const Segment* piece = &segment_at(path, begin); piece != path.data() + path.size(); ++piece) {
      const bool last = piece->end >= end || piece + 1 == path.data() + path.size();
      const double to = last ? end : piece->end;
      if (!visit(true_sphere(*piece, bodies_[number].definition.radius), std::max(begin, piece->begin), to))
        return;
      if (last) return;
    }
  }

  /// Counts the probes of a body in a window.
  void go_through(std::uint32_t number, double begin, double end) {
    Body& body = bodies_[number];
    for (double now = begin;;) {
      const bool stops = body.next_stop < body.stops.size() && body.stops[body.next_stop] <= end;
      const double until = stops ? body.stops[body.next_stop] : end;
      double next = now < until ? latest_probe(number, now, until) : infinity;
      next = std::max(next, body.bound.time + shortest_interval(body));
      if (next >= until) {
        if (!stops) return;
        ++body.next_stop;
        next = until;
      }
      ++body.probes;
      body.bound = bound_of(body.definition, state(number, next), next);
      now = next;
    }
  }

  /// Returns the least time between probes (time), for gaps that rounding has used up. The bound grows by far
  /// less than the tolerance in it.
  double shortest_interval(const Body& body) const {
    const double limit = body.definition.acceleration_limit;
    return limit > 0.0 ? std::sqrt(tolerance_ / limit) / 64.0 : infinity;
  }

  /// Returns the latest time at which the body has to be probed; infinity if that is not before `until`.
  double latest_probe(std::uint32_t number, double from, double until) {
    const Bound& bound = bodies_[number].bound;
    near_.clear();
    grid_.for_each_overlap(swept_box(bound, from, until),
                           [this](std::uint32_t other) { near_.push_back(other); });
    double latest = infinity;
    for (const std::uint32_t other : near_) {
      if (other == number || touch(number, other, Wall::none, from)) continue;
      for_each_piece(other, from, std::min(until, latest),
                     [&](const Bound& sphere, double begin, double end) {
                       const double met = meeting(bound, sphere, begin, end, -tolerance_);
                       latest = std::min(latest, met);
                       return met == infinity;
                     });
    }
    if (!scene_.world.box) return latest;
    for (const Wall wall : walls) {
      if (touch(number, number, wall, from)) continue;
      latest =
          std::min(latest, meeting(bound, half_space(*scene_.world.box, wall), from, until, -tolerance_));
    }
    return latest;
  }

  bool touch(std::uint32_t number, std::uint32_t other, Wall wall, double time) const {
    const auto& contacts = bodies_[number].long_contacts;
    return std::any_of(contacts.begin(), contacts.end(), [&](const FlightContact& contact) {
      return contact.wall == wall && (contact.first == other || contact.second == other) &&
             contact.begin <= time && time < contact.end;
    });
  }

  const Scene& scene_;
  const Flight& flight_;
  double tolerance_;
  std::vector<Body> bodies_;
  BoxGrid grid_;                     ///< true boxes of the bodies in the window
  std::vector<std::uint32_t> near_;  ///< scratch memory of latest_probe()
};

}  // namespace

std::uint64_t ProbeFloor::total() const {
  return std::accumulate(probes.begin(), probes.end(), std::uint64_t{0});
}

ProbeFloor probe_floor(const Scene& scene, const Flight& flight) {
  if (scene.bodies.empty() || !(scene.end_time > scene.world.start_time))
    return ProbeFloor{std::vector<std::uint64_t>(scene.bodies.size())};
  return FloorCount(scene, flight).run();
}

}  // namespace kinesphere
