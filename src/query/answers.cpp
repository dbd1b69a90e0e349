#include "query/answers.hpp"

#include <algorithm>
#include <cmath>

#include "bound/relative_motion.hpp"
#include "number/infinity.hpp"
#include "query/certain_sphere.hpp"
#include "space/stretch_grid.hpp"

namespace kinesphere {
namespace {

/// Calls visit(image) for a bound and for its images up to one period away.
template <class Visit>
void for_each_image(const Space& space, Bound bound, Visit visit) {
  const auto most = [&](int axis) { return space.repeats(axis) ? 1.0 : 0.0; };
  const Vec3 place = bound.position;
  for (double x = -most(0); x <= most(0); ++x)
    for (double y = -most(1); y <= most(1); ++y)
      for (double z = -most(2); z <= most(2); ++z) {
        bound.position = place + space.shift_of({x, y, z}, bound.time);
        visit(bound);
      }
}

/// Returns the collision shape with another bound.
CollisionShape moved(const CollisionShape& shape, const Bound& bound) {
  return {bound, shape.is_static, shape.shape, shape.carried_radius, shape.rigid};
}

}  // namespace

World::Engine::Answers::Answers(const Engine& engine) : engine_(engine), now_(engine.time()) {
  for (const auto& [a, b] : engine.main().events().changed()) open_.insert(std::minmax(a, b));
  engine.main().events().pending().for_each([this](const Event& event) {
    const std::uint32_t a = event.first.index;
    open_.insert(std::minmax(a, event.second == no_body ? a : event.second.index));
  });
}

Bound World::Engine::Answers::present(std::uint32_t number) const {
  return present_bound(body(number), engine_.bodies().changes.find(engine_.bodies()[number]),
                       engine_.bodies().radius_rate(number), now_);
}

/// Inflates the present bound so that, while two such bounds do not meet, no contact begins. A begin is
/// reported when the gap between fresh reports is at most the tolerance; each report may be position_error
/// away from the true body, and adds position_error to its radius.
Bound World::Engine::Answers::guarded(std::uint32_t number) const {
  Bound bound = present(number);
  bound.radius += engine_.definition().contact_tolerance + 2.0 * body(number).position_error;
  return bound;
}

bool World::Engine::Answers::is_certified(std::uint32_t a, std::uint32_t b) const {
  return !body(a).dirty && !body(b).dirty && !open_.contains(std::minmax(a, b));
}

/// Returns a time before which no contact of the pair begins, as the engine does not recheck the pair
/// earlier. Returns the present time if the pair has no valid certificate.
double World::Engine::Answers::recorded(std::uint32_t a, std::uint32_t b) const {
  return is_certified(a, b) ? std::max(engine_.claimed_until(a, b), now_) : now_;
}

double World::Engine::Answers::recorded_of_walls(std::uint32_t number) const {
  return is_certified(number, number) ? std::max(engine_.core().balls()[number].own, now_) : now_;
}

void World::Engine::Answers::consider_touching(std::uint32_t number, ContactBoundary& first) const {
  if (first.touching) return;
  const auto partners = engine_.contacts().partners_of(number);
  const auto has_lower_number = [](const ContactRecord& a, const ContactRecord& b) {
    return a.partner < b.partner;
  };
  if (!partners.empty())
    first = {now_, number, std::min_element(partners.begin(), partners.end(), has_lower_number)->partner,
             Wall::none, true};
  for (const Wall wall : walls)
    if (!first.touching && engine_.contacts().touches_wall(number, wall))
      first = {now_, number, std::nullopt, wall, true};
}

void World::Engine::Answers::consider_walls(std::uint32_t number, ContactBoundary& first) const {
  if (!body(number).present() || !engine_.bodies().meets_walls(number)) return;
  const double known = recorded_of_walls(number);
  if (known >= first.time) return;
  const Bound bound = guarded(number);
  for (const Wall wall : walls) {
    if (!stands(*engine_.bodies().walls(), wall)) continue;
    const HalfSpace inside = half_space(*engine_.bodies().walls(), wall);
    const double meets =
        visit_wall(shape_of(number, bound), inside, [this](const Bound& moving, const auto& partner) {
          return earliest_meeting(moving, partner, now_, infinity);
        });
    const double time = std::max(known, meets);
    if (time < first.time) first = {time, number, std::nullopt, wall, false};
  }
}

/// Returns the collision shape of a body with another bound. That of a rigid body whose state has changed
/// since its last report is the ball around it.
CollisionShape World::Engine::Answers::shape_of(std::uint32_t number, const Bound& bound) const {
  if (body(number).has_parts() && bound.time != body(number).bound.time) return {bound};
  return collision_shape_of(engine_.bodies(), number, bound);
}

/// Returns the earliest_meeting of the two shapes over all periodic images.
double World::Engine::Answers::meeting(const CollisionShape& extent_of_a,
                                       const CollisionShape& extent_of_b) const {
  const Space& space = engine_.bodies().space();
  if (!space.repeats()) {
    return visit_shapes(extent_of_a, extent_of_b, [this](const Bound& bound, const auto& partner) {
      return earliest_meeting(bound, partner, now_, infinity);
    });
  }
  const Bound& a = extent_of_a.bound;
  const Bound& b = extent_of_b.bound;
  Bound image = b;
  image.position += space.shift_to_nearest(b.centre_at(now_), a.centre_at(now_), now_);
  const RelativeMotion motion(a, image, now_);
  // The loop below covers all images up to one period from the nearest one. Any other image is at least two
  // periods away on some axis, and cannot be met before the bounds have closed that distance.
  double first = infinity;
  for (int axis = 0; axis < 3; ++axis) {
    if (!space.repeats(axis)) continue;
    const double way =
        2.0 * space.period()[axis] - std::abs(motion.offset[axis]) - motion.radii - motion.growth;
    const double speed = std::abs(motion.velocity[axis]) + motion.growth_speed;
    const double acceleration = std::abs(motion.acceleration[axis]) + motion.acceleration_limit;
    constexpr double margin = rounding::margin;
    const double until = rounding::first_crossing(
        way - margin * (motion.offset_size + 2.0 * space.period()[axis]),
        -(speed + margin * motion.velocity_size), -(acceleration + margin * motion.acceleration_size));
    first = std::min(first, rounding::sum_down(now_, until));
  }
  for_each_image(space, image, [&](const Bound& seen) {
    const double time =
        visit_shapes(extent_of_a, moved(extent_of_b, seen), [&](const Bound& bound, const auto& partner) {
          return earliest_meeting(bound, partner, now_, std::max(first, now_));
        });
    first = std::min(first, time);
  });
  return std::max(first, now_);
}

void World::Engine::Answers::consider(std::uint32_t a, std::uint32_t b, ContactBoundary& first) const {
  if (!body(a).present() || !body(b).present() || !engine_.bodies().may_touch(a, b)) return;
  const double known = recorded(a, b);
  if (known >= first.time) return;
  const Bound bound_of_a = guarded(a);
  const Bound bound_of_b = guarded(b);
  const double time = std::max(known, meeting(shape_of(a, bound_of_a), shape_of(b, bound_of_b)));
  if (time < first.time) first = {time, a, b, Wall::none, false};
}

ContactBoundary World::Engine::Answers::of_pair(std::uint32_t a, std::uint32_t b) const {
  if (engine_.contacts().touch(a, b)) return {now_, a, b, Wall::none, true};
  ContactBoundary first;
  consider(a, b, first);
  return first;
}

ContactBoundary World::Engine::Answers::of_body(std::uint32_t number) const {
  ContactBoundary first;
  consider_touching(number, first);
  if (first.touching) return first;
  consider_walls(number, first);
  consider_due(number, first);
  for (std::uint32_t other = 0; other < engine_.bodies().numbers(); ++other)
    if (other != number && body(other).present()) consider(number, other, first);
  return first;
}

ContactBoundary World::Engine::Answers::of_world() const {
  std::vector<std::uint32_t> present;
  for (std::uint32_t number = 0; number < engine_.bodies().numbers(); ++number)
    if (body(number).present()) present.push_back(number);
  ContactBoundary first;
  for (const std::uint32_t number : present) consider_touching(number, first);
  if (first.touching) return first;
  // Any pair gives an upper limit for the answer. Pairs that are due and neighbouring numbers give a good
  // one.
  for (const std::uint32_t number : present) consider_due(number, first);
  for (std::size_t k = 0; k < present.size(); ++k) {
    consider_walls(present[k], first);
    if (k > 0) consider(present[k - 1], present[k], first);
  }
  consider_all_within(present, first);
  return first;
}

/// Considers the pair that the body is due about, if there is one. Its early time makes most others cheap to
/// dismiss.
void World::Engine::Answers::consider_due(std::uint32_t number, ContactBoundary& first) const {
  const auto due = engine_.core().certificate_of(number);
  if (due && due->other != core::none) consider(number, due->other, first);
}

/// Returns the way of a body up to the horizon, in the periodic image whose middle is in the primary box.
Stretch World::Engine::Answers::way_of(std::uint32_t number, double horizon) const {
  const Bound bound =
      body(number).is_static() ? ball_around_static(engine_.bodies(), number, now_) : guarded(number);
  const BoundAt now(bound, now_);
  const Vec3 half_way = body(number).is_static() ? Vec3{} : 0.5 * (horizon - now_) * now.velocity;
  const double radius = body(number).is_static() ? bound.radius : now.radius_after(horizon - now_);
  return {number, engine_.bodies().space().wrapped(now.centre + half_way, now_).position, half_way, radius};
}

/// Searches for pairs whose bounds may come to the same place before first.time. No other pair can lower it.
void World::Engine::Answers::consider_all_within(const std::vector<std::uint32_t>& numbers,
                                                 ContactBoundary& first) const {
  if (first.time <= now_) return;
  const double horizon = first.time;
  const Space& space = engine_.bodies().space();
  std::vector<Stretch> ways;
  std::vector<std::uint32_t> anywhere;
  for (const std::uint32_t number : numbers) {
    const bool is_static = body(number).is_static();
    const Box box = swept_box(guarded(number), now_, horizon);
    if (!is_static &&
        !(horizon < infinity && is_finite(box.lower) && is_finite(box.upper) && space.is_narrow(box))) {
      anywhere.push_back(number);
      continue;
    }
    const Stretch way = way_of(number, horizon);
    const Vec3 half = Vec3{std::abs(way.half_way.x), std::abs(way.half_way.y), std::abs(way.half_way.z)} +
                      Vec3{way.radius, way.radius, way.radius};
    // Two that meet beyond a border of the primary box do so in two of the images that reach into it.
    space.for_each_image({way.middle - half, way.middle + half}, 0.0, now_,
                         [&](const Box&, const Vec3& shift) {
                           ways.push_back({number, way.middle + shift, way.half_way, way.radius});
                         });
  }
  StretchGrid grid;
  grid.fill(ways);
  for (std::uint32_t slot = 0; slot < grid.slots(); ++slot)
    for (const std::uint32_t other : grid.search_behind(slot))
      if (grid.number_at(slot) != grid.number_at(other))
        consider(grid.number_at(slot), grid.number_at(other), first);
  for (const std::uint32_t number : anywhere)
    for (const std::uint32_t other : numbers)
      if (other != number) consider(number, other, first);
}

/// Returns true for a static body that is not a ball.
bool World::Engine::Answers::is_shape_at_rest(std::uint32_t number) const {
  return body(number).is_static() && !std::holds_alternative<Ball>(engine_.bodies().shapes.of(body(number)));
}

DistanceLimits World::Engine::Answers::distance(std::uint32_t a, std::uint32_t b, double time) const {
  const Bound first = present(a);
  Bound second = present(b);
  const Space& space = engine_.bodies().space();
  second.position += space.shift_to_nearest(second.centre_at(time), first.centre_at(time), time);
  const CollisionShape extent_of_a = shape_of(a, first);
  const CollisionShape extent_of_b = shape_of(b, second);
  // No certificate knows the distance of two shapes at rest.
  if (is_shape_at_rest(a) && is_shape_at_rest(b)) return {-infinity, infinity, false};
  GapLimits gap{infinity, infinity};
  const auto look_at = [&](const Bound& seen) {
    const GapLimits own = visit_shapes(
        extent_of_a, moved(extent_of_b, seen),
        [time](const Bound& bound, const auto& partner) { return gap_limits(bound, partner, time); });
    gap = {std::min(gap.lower, own.lower), std::min(gap.upper, own.upper)};
  };
  // Where the positions are nearest, the parts of rigid bodies need not be.
  if (extent_of_a.rigid || extent_of_b.rigid)
    for_each_image(space, second, look_at);
  else
    look_at(second);
  // The upper limit applies to the bodies as reported. The true bodies may differ by the error parts of the
  // radii.
  // A rigid body that counts as a ball has a point within that ball only.
  const auto missing = [this](std::uint32_t number, const CollisionShape& extent) {
    return body(number).has_parts() && !extent.rigid ? body(number).radius : 0.0;
  };
  const double excess = (first.radius - body(a).radius) + (second.radius - body(b).radius) +
                        missing(a, extent_of_a) + missing(b, extent_of_b);
  const double upper = rounding::sum_up(gap.upper, 2.0 * excess);
  if (!std::isfinite(gap.lower) || !std::isfinite(upper)) return {-infinity, infinity, false};
  return {gap.lower, upper, false};
}

void World::Engine::Answers::consider_approach(std::uint32_t a, std::uint32_t b, double distance,
                                               ContactBoundary& first) const {
  if (first.touching || !body(a).present() || !body(b).present()) return;
  Bound bound_of_a = present(a);
  Bound bound_of_b = present(b);
  // A shape at rest has no radius to enlarge by the distance. In that case the other body is enlarged
  // instead.
  double& radius = is_shape_at_rest(a) ? bound_of_b.radius : bound_of_a.radius;
  radius = rounding::sum_up(radius, distance);
  const CollisionShape extent_of_a = shape_of(a, bound_of_a);
  const CollisionShape extent_of_b = shape_of(b, bound_of_b);
  const bool known = !(is_shape_at_rest(a) && is_shape_at_rest(b));
  const double time = known ? meeting(extent_of_a, extent_of_b) : now_;
  const bool within = time <= now_ && known && this->distance(a, b, now_).upper <= distance;
  if (time < first.time || within) first = {time, a, b, Wall::none, within};
}

void World::Engine::Answers::consider_approach_to_walls(std::uint32_t number, double distance,
                                                        ContactBoundary& first) const {
  if (!body(number).present() || !engine_.bodies().meets_walls(number)) return;
  const Bound bound = present(number);
  for (const Wall wall : walls) {
    if (first.touching || !stands(*engine_.bodies().walls(), wall)) continue;
    const HalfSpace inside = half_space(*engine_.bodies().walls(), wall);
    const CollisionShape shape = shape_of(number, bound);
    const double time = visit_wall(shape, inside, [this, distance](const Bound& moving, const auto& partner) {
      return earliest_meeting(moving, partner, now_, infinity, distance);
    });
    // The upper limit applies to the body as reported. The true body may differ by the error part of the
    // radius.
    const double missing = body(number).has_parts() && !shape.rigid ? body(number).radius : 0.0;
    const double excess = 2.0 * (bound.radius - body(number).radius + missing);
    const bool within =
        time <= now_ && rounding::sum_up(gap_to_wall(shape, inside, now_).upper, excess) <= distance;
    if (time < first.time || within) first = {time, number, std::nullopt, wall, within};
  }
}

ContactBoundary World::Engine::Answers::approach_of_pair(std::uint32_t a, std::uint32_t b,
                                                         double distance) const {
  ContactBoundary first;
  consider_approach(a, b, distance, first);
  return first;
}

ContactBoundary World::Engine::Answers::approach_of_body(std::uint32_t number, double distance) const {
  ContactBoundary first;
  consider_approach_to_walls(number, distance, first);
  for (std::uint32_t other = 0; other < engine_.bodies().numbers(); ++other) {
    const bool counts = other != number && body(other).present() && engine_.bodies().may_meet(number, other);
    if (counts) consider_approach(number, other, distance, first);
  }
  return first;
}

std::vector<std::uint32_t> World::Engine::Answers::concerned(const ContactBoundary& boundary) {
  std::vector<std::uint32_t> numbers;
  if (!boundary.exists() || boundary.touching) return numbers;
  numbers.push_back(boundary.body);
  if (boundary.partner) numbers.push_back(*boundary.partner);
  return numbers;
}

}  // namespace kinesphere
