// Boxes: how large and how long, and whose they overlap.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "bound/encounter.hpp"
#include "memory/prefetch.hpp"
#include "number/infinity.hpp"
#include "world/engine.hpp"

namespace kinesphere {
namespace {

/// A box is kept when it will last for the shortest part of the time that a new one would. Then ever shorter
/// parts are tried.
constexpr double next_part = 0.75;
constexpr double shortest_part = next_part * next_part * next_part * next_part;
/// A box with room on all sides is as large as one ahead of its body that lasts this part as long.
constexpr double turned_part = 0.4;

Vec3 centre_of(const Box& box) { return 0.5 * (box.lower + box.upper); }

double width_of(const Box& box) {
  const Vec3 size = box.upper - box.lower;
  return std::max({size.x, size.y, size.z});
}

/// About the distance between so many points along a line or in a layer, if their box is thinner than that,
/// or in a cube around it. The same on all machines, without std::cbrt().
double spacing_within(const Vec3& size, int count) {
  std::array<double, 3> sides{size.x, size.y, size.z};
  std::sort(sides.begin(), sides.end(), std::greater<>());
  const double on_line = sides[0] / count;
  if (!(sides[1] > on_line)) return on_line;
  const double in_layer = std::sqrt(sides[1] * on_line);
  if (!(sides[2] > in_layer)) return in_layer;
  return std::ldexp(sides[0], -std::ilogb(count) / 3);
}

}  // namespace

/// New bodies begin with a horizon that lets them go about a quarter of the distance between them.
void World::Engine::choose_first_horizons(const std::vector<std::uint32_t>& round) {
  Vec3 lower{infinity, infinity, infinity};
  Vec3 upper = -lower;
  int count = 0;
  for (const std::uint32_t number : round) {
    if (bodies_[number].horizon.is_chosen() || bodies_[number].is_fixed()) continue;
    ++count;
    const Box own = box(number);
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], own.lower[axis]);
      upper[axis] = std::max(upper[axis], own.upper[axis]);
    }
  }
  if (count == 0) return;
  const double spacing = spacing_within(upper - lower, count);
  const double way = spacing > 0.0 ? 0.25 * spacing : definition_.contact_tolerance;
  for (const std::uint32_t number : round)
    if (!bodies_[number].horizon.is_chosen() && !bodies_[number].is_fixed())
      bodies_[number].horizon = Horizon(way, definition_.contact_tolerance);
}

/// Contains all that the body can touch or sense.
Bound World::Engine::reach(const Body& body) const {
  Bound bound = body.bound;
  if (sensors_.any()) bound.radius += sensors_.reach(body.sensor_class);
  return bound;
}

/// How far the gap of the two can be from one that means something: no sensor distance of either is larger.
double World::Engine::reach_of_pair(const Body& a, const Body& b) const {
  return std::max(sensors_.reach(a.sensor_class), sensors_.reach(b.sensor_class));
}

/// How long a new box of the body would last.
double World::Engine::box_length(const Body& body) const {
  const double squared_speed =
      norm_squared(body.bound.velocity) + body.bound.growth_speed * body.bound.growth_speed;
  const double length = body.horizon.length(squared_speed, body.largest_acceleration());
  return space_.repeats() ? longest_in_period(body, length) : length;
}

/// Where the body goes, straight on from now for this long: both ends of its way, with the radius that it has
/// at the end.
Box World::Engine::box_of_way(const MovedBound& moved, double length) const {
  const Vec3 end = moved.centre + moved.velocity * length;
  const double half = moved.radius_after(length) + rounding_room();
  const Vec3 radius{half, half, half};
  const Vec3 lower{std::min(moved.centre.x, end.x), std::min(moved.centre.y, end.y),
                   std::min(moved.centre.z, end.z)};
  const Vec3 upper{std::max(moved.centre.x, end.x), std::max(moved.centre.y, end.y),
                   std::max(moved.centre.z, end.z)};
  return {lower - radius, upper + radius};
}

/// Whether the body has to look for its neighbours, in a new box.
bool World::Engine::renew_box(std::uint32_t number) {
  if (bodies_[number].is_fixed()) {
    register_shape(number);
    return true;
  }
  const double length = box_length(bodies_[number]);
  if (keep_box(number, length)) return false;
  register_box(number, length);
  return true;
}

/// The body may stay in its box for a good while yet, after a kick for one: then its neighbours are still
/// those that it has. `length` is how long a new box would last.
bool World::Engine::keep_box(std::uint32_t number, double length) {
  Body& body = bodies_[number];
  if (body.box_end <= time_) return false;
  const Box box = this->box(number);
  const MovedBound moved(reach(body), time_);
  const auto holds_for = [&](double time) {
    const Box way = box_of_way(moved, time);
    bool inside = true;
    for (int axis = 0; axis < definition_.dimensions; ++axis) {
      inside &= box.lower[axis] <= way.lower[axis];
      inside &= way.upper[axis] <= box.upper[axis];
    }
    return inside;
  };
  if (!holds_for(shortest_part * length)) return false;
  while (!holds_for(length)) length *= next_part;
  body.box_end = time_ + length;
  return body.box_end > time_;
}

void World::Engine::register_box(std::uint32_t number, double length) {
  Body& body = bodies_[number];
  body.box_end = just_after(time_ + (body.turned ? turned_part : 1.0) * length);
  set_box(number, bring_home(number, box_until_end(body)));
  body.turned = false;
}

void World::Engine::set_box(std::uint32_t number, const Box& box) {
  if (space_.repeats()) boxes_[number] = box;
  grid_.set(number, box);
}

/// As others see it at a glance, until its box ends. A fixed body needs a closer look.
Sketch World::Engine::sketch_of(const Body& body) const {
  return body.is_fixed() ? Sketch() : Sketch(body.bound, body.box_end, norm_one(space_.period()));
}

/// What others see of a body that has got another box, or another end of it.
void World::Engine::sketch_box(std::uint32_t number) {
  sketches_[number] = sketch_of(bodies_[number]);
  if (!space_.repeats()) return;
  homes_[number] = home_of(number);
}

/// Where the body's box is, to single precision.
Home World::Engine::home_of(std::uint32_t number) const {
  return Home(space_.from_corner(centre_of(boxes_[number])));
}

/// Contains the body until its box_end. One that was kicked lately may be kicked again, and go anywhere: it
/// gets as much room on all sides as the longest way needs, but no more than makes the box as wide as it may
/// be where space repeats.
Box World::Engine::box_until_end(const Body& body) const {
  const MovedBound moved(reach(body), time_);
  // A planned turn is known better than as a larger radius.
  Box box = moved.acceleration == Vec3{} ? box_of_way(moved, body.box_end - time_)
                                         : swept_box(reach(body), time_, body.box_end);
  if (body.turned) {
    const Vec3 up = box.upper - moved.centre;
    const Vec3 down = moved.centre - box.lower;
    const double room = std::max({up.x, up.y, up.z, down.x, down.y, down.z});
    for (int axis = 0; axis < 3; ++axis) {
      const double half = space_.repeats(axis) ? std::min(room, 0.5 * widest_in_period(body, axis)) : room;
      box.lower[axis] = std::min(box.lower[axis], moved.centre[axis] - half);
      box.upper[axis] = std::max(box.upper[axis], moved.centre[axis] + half);
    }
  }
  return space_.within(box);
}

/// Moves the body to the image in which the centre of its box lies in the primary box. Returns the box there.
Box World::Engine::bring_home(std::uint32_t number, const Box& box) {
  if (!space_.repeats()) return box;
  const Vec3 images = space_.wrapped(centre_of(box)).images;
  if (images == Vec3{}) return box;
  bodies_[number].bound.position -= space_.shift_of(images);
  images_[number] += images;
  return box_until_end(bodies_[number]);
}

/// How wide the box of a body may be on an axis that repeats, by space/space.hpp (2); a little less, for
/// rounding.
double World::Engine::widest_in_period(const Body& body, int axis) const {
  return (0.5 - 0x1p-10) * space_.period()[axis] - book_.rule().release_gap() - 4.0 * body.position_error;
}

/// How long a box of a body may last, `length` at most, to be no wider than that: on an axis it grows by at
/// most (|v| + 2 e1) s + (|g| / 2 + A) s^2.
double World::Engine::longest_in_period(const Body& body, double length) const {
  const Bound& bound = body.bound;
  const double radius = reach(body).radius + rounding_room();
  double longest = length;
  for (int axis = 0; axis < 3; ++axis) {
    if (!space_.repeats(axis)) continue;
    const double speed = std::abs(bound.velocity[axis]) + 2.0 * bound.growth_speed;
    const double a = 0.5 * std::abs(bound.planned_acceleration[axis]) + bound.growth_acceleration;
    const double way = std::max(widest_in_period(body, axis) - 2.0 * radius, 0.0);
    if ((speed + a * longest) * longest <= way) continue;
    const double divisor = speed + std::sqrt(speed * speed + 4.0 * a * way);
    if (divisor > 0.0) longest = std::min(longest, 2.0 * way / divisor);
  }
  return longest;
}

/// What brings body b to the image in which body a may meet it while both boxes last: nearest by their boxes.
Vec3 World::Engine::shift_to_meet(std::uint32_t a, std::uint32_t b) const {
  return space_.shift_between_homes(centre_of(box(b)), centre_of(box(a)));
}

/// The bound of body b as body a has to reckon with it, where space repeats.
Bound World::Engine::seen_from(std::uint32_t a, std::uint32_t b) const {
  Bound bound = bodies_[b].bound;
  bound.position += shift_to_meet(a, b);
  return bound;
}

/// Gathers those whom the body touches or senses, and those whose boxes overlap its own.
World::Engine::Crowd World::Engine::gather_candidates(std::uint32_t number) {
  const Box box = this->box(number);
  const double extent = width_of(box);
  std::size_t larger = 0;
  const auto touched = book_.partners_of(number);
  partners_.assign(touched.begin(), touched.end());
  const auto crossed = book_.crossings_of(number);
  for (std::size_t k = 0; k < crossed.size(); ++k)
    if (k == 0 || crossed[k].partner != crossed[k - 1].partner) partners_.push_back(crossed[k].partner);
  const std::size_t known = partners_.size();
  space_.for_each_overlap(grid_, box, [&](std::uint32_t other, double extent_of_other) {
    if (other == number) return;
    prefetch(sketches_[other]);
    neighbours_.fetch(other);
    partners_.push_back(other);
    if (Horizon::is_larger(extent_of_other, extent)) ++larger;
  });
  return {.candidates = partners_.size() - known, .larger = larger, .extent = extent};
}

/// Where a box meets a crowd, makes the way of the next one so short that few would overlap it if their boxes
/// were no larger. Returns whether that is shorter than it was.
bool World::Engine::shorten_way(std::uint32_t number, std::span<const std::uint32_t> crowd) {
  Body& body = bodies_[number];
  const double width = 2.0 * reach(body).radius;
  if (body.is_fixed() || !body.horizon.is_crowded(crowd.size(), width)) return false;
  const Vec3 centre = centre_of(box(number));
  const auto near = [&] {
    return static_cast<std::size_t>(std::count_if(crowd.begin(), crowd.end(), [&](std::uint32_t other) {
      const Vec3 way = centre_of(box(other)) - centre;
      return std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)}) <= width + body.horizon.way();
    }));
  };
  const double before = body.horizon.way();
  while (body.horizon.is_crowded(near(), width)) body.horizon.halve(definition_.contact_tolerance);
  return body.horizon.way() < before;
}

/// Of bodies that others have found in a crowd: a slow body alone has a large box for a long time, into which
/// a whole crowd may come. Such a box ends now.
void World::Engine::shrink_boxes(const std::vector<std::uint32_t>& crowded) {
  for (const std::uint32_t number : crowded) {
    const Body& body = bodies_[number];
    if (!body.present() || body.is_resting() || marks_[number].dirty) continue;
    partners_.clear();
    for (const Neighbour& one : neighbours_.of(number)) partners_.push_back(one.partner);
    if (!shorten_way(number, partners_)) continue;
    bodies_[number].box_end = time_;
    mark_dirty(number);
  }
}

/// The first boxes of new bodies are of about one size, which follows from the distance between all of them.
/// Where bodies lie in clusters that is too large, and boxes are made smaller before neighbours are linked.
/// Every so many bodies are looked at first, as most crowds have no clusters.
void World::Engine::shrink_first_boxes(const std::vector<std::uint32_t>& searching) {
  constexpr std::size_t few = 64;
  if (searching.size() < few) return;
  const auto is_too_large = [this](std::uint32_t number) {
    gather_candidates(number);
    return shorten_way(number, partners_);
  };
  const auto step = static_cast<std::size_t>(std::sqrt(static_cast<double>(searching.size())));
  bool any = false;
  for (std::size_t k = 0; k < searching.size() && !any; k += step) any = is_too_large(searching[k]);
  if (!any) return;
  for (const std::uint32_t number : searching) {
    if (bodies_[number].is_fixed()) continue;
    is_too_large(number);
    register_box(number, box_length(bodies_[number]));
    sketch_box(number);
  }
}

/// Those whose boxes overlap the body's new one, and those that it touches or senses. The box is made smaller
/// if it is far too large.
void World::Engine::find_neighbours(std::uint32_t number) {
  for (;;) {
    ++counters_.searches;
    const Crowd crowd = gather_candidates(number);
    counters_.candidates += crowd.candidates;
    Body& body = bodies_[number];
    if (shorten_way(number, partners_)) {
      register_box(number, box_length(body));
      sketch_box(number);
      continue;
    }
    if (!body.is_fixed())
      body.horizon.learn(crowd.candidates, crowd.larger, crowd.extent, 2.0 * reach(body).radius,
                         definition_.contact_tolerance, definition_.dimensions);
    break;
  }
  neighbours_.replace(number, partners_);
}

}  // namespace kinesphere
