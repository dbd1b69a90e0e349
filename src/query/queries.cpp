#include "query/queries.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "bodies/validation.hpp"
#include "number/infinity.hpp"
#include "number/roots.hpp"
#include "query/shape_queries.hpp"

namespace kinesphere {
namespace {

/// Exceeds the summed rounding errors of a distance or a ray, relative to the operands' magnitudes.
constexpr double part_lost = 0x1p-45;

/// Maximum pieces into which a ray is split. More pieces make each search smaller, and let a cast stop sooner
/// after a hit, but cost more searches.
constexpr int most_pieces = 64;

double distance_to_box(const Vec3& point, const Box& box) {
  Vec3 away;
  for (int axis = 0; axis < 3; ++axis)
    away[axis] = std::max({box.lower[axis] - point[axis], point[axis] - box.upper[axis], 0.0});
  return norm(away);
}

Bound resting(const Vec3& centre, double radius) { return {.position = centre, .radius = radius}; }

/// Calls visit(solid) for a shape that is not a ball, which is not looked up as a shape.
template <class Visit>
auto visit_solid(const Shape& shape, Visit visit) {
  return std::visit(
      [&]<class Solid>(const Solid& solid) {
        if constexpr (std::is_same_v<Solid, Ball>)
          return visit(HalfSpace{});
        else
          return visit(solid);
      },
      shape);
}

/// Gap between a sphere and a shape.
GapLimits limits_of(const Vec3& centre, double radius, const CertainShape& at) {
  const GapLimits gap = visit_solid(at.shape, [&](const auto& solid) {
    return gap_limits(resting(centre - at.origin, radius), solid, 0.0);
  });
  return {gap.lower - at.spread, gap.upper + at.spread};
}

/// Gap between a box and a shape, of which only the signs count. A shape that may be elsewhere is compared
/// with the box enlarged and, for what is certain, shrunk.
GapLimits limits_of(const Box& region, const CertainShape& at) {
  const Vec3 spread{at.spread, at.spread, at.spread};
  const Box outer{region.lower - at.origin - spread, region.upper - at.origin + spread};
  const Box inner{region.lower - at.origin + spread, region.upper - at.origin - spread};
  const auto gap_to = [&](const Box& box) {
    return visit_solid(at.shape, [&](const auto& solid) { return gap_limits(box, solid); });
  };
  const bool is_box =
      inner.lower.x <= inner.upper.x && inner.lower.y <= inner.upper.y && inner.lower.z <= inner.upper.z;
  return {gap_to(outer).lower, is_box ? gap_to(inner).upper : infinity};
}

RayLimits touch_of(const SweptRay& ray, const CertainShape& at) {
  const auto touch = [&](double radius) {
    const Bound sphere{.position = ray.origin - at.origin, .velocity = ray.direction, .radius = radius};
    return visit_solid(at.shape, [&](const auto& solid) { return first_touch(sphere, solid, ray.length); });
  };
  if (at.spread == 0.0) return touch(ray.radius);
  return {touch(ray.radius + at.spread).lower,
          ray.radius >= at.spread ? touch(ray.radius - at.spread).upper : infinity};
}

Box box_around(const Vec3& a, const Vec3& b, double radius) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const double margin = radius + part_lost * (std::abs(a[axis]) + std::abs(b[axis]) + radius);
    box.lower[axis] = std::min(a[axis], b[axis]) - margin;
    box.upper[axis] = std::max(a[axis], b[axis]) + margin;
  }
  return box;
}

/// Part of a ray inside a ball, as distances from the origin.
struct Passage {
  double enter;
  double leave;
};

/// Intersects a ray with a ball; nullopt if it misses. `wrong` widens the result on either side (narrows it
/// if negative).
std::optional<Passage> passage(const SweptRay& ray, const Vec3& centre, double radius, double wrong) {
  if (!(radius >= 0.0)) return std::nullopt;
  const Vec3 offset = centre - ray.origin;
  const double along = dot(offset, ray.direction);
  const double across = norm(offset - ray.direction * along);
  const double square = (radius - across) * (radius + across);
  if (!(square >= 0.0)) return std::nullopt;
  const double half = std::sqrt(square);
  const Passage found{std::max(0.0, along - half - wrong), along + half + wrong};
  if (found.leave < 0.0 || found.enter > ray.length) return std::nullopt;
  return found;
}

/// Merges hits of the same body, which may come from several pieces of the ray and several images.
void keep_first_of_each_body(std::vector<CastHit>& hits) {
  std::sort(hits.begin(), hits.end(), [](const CastHit& a, const CastHit& b) { return a.body < b.body; });
  std::size_t count = 0;
  for (const CastHit& hit : hits) {
    if (count > 0 && hits[count - 1].body == hit.body) {
      hits[count - 1].lower = std::min(hits[count - 1].lower, hit.lower);
      hits[count - 1].upper = std::min(hits[count - 1].upper, hit.upper);
    } else {
      hits[count++] = hit;
    }
  }
  hits.resize(count);
}

}  // namespace

void World::Engine::Queries::restrict(std::vector<std::uint32_t>& numbers) const {
  if (options_.except == no_body && !options_.filter) return;
  std::erase_if(numbers, [this](std::uint32_t number) {
    return engine_.bodies().id_of(number) == options_.except ||
           (options_.filter && !passes(*options_.filter, engine_.bodies().filters.of(number)));
  });
}

/// Approximate size of the smallest bodies (length).
double World::Engine::Queries::finest_length() const {
  const double tolerance = engine_.definition().contact_tolerance;
  return std::clamp(engine_.core().median_reach(), tolerance, 0x1p30 * tolerance);
}

/// Returns the certain sphere of a body in the image that is nearest to a region with this middle and height
/// (length, on y), as distance_to(point) tells.
CertainSphere World::Engine::Queries::certain_sphere(std::uint32_t number, const Vec3& middle, double height,
                                                     auto distance_to) const {
  CertainSphere place = certain_sphere_of(engine_.bodies()[number], now_);
  const Space& space = engine_.bodies().space();
  Vec3 nearest = place.centre + space.shift_to_nearest(place.centre, middle, now_);
  if (space.slides())
    space.for_each_near_row(place.centre, middle, height, now_, [&](const Vec3& shift) {
      const Vec3 image = place.centre + shift;
      if (distance_to(image) < distance_to(nearest)) nearest = image;
    });
  place.centre = nearest;
  return place;
}

template <class Distance, class ShapeGap>
void World::Engine::Queries::overlapping(const Box& box, double height, Distance distance_to, ShapeGap gap_to,
                                         std::vector<OverlapHit>& found) const {
  const Vec3 middle = 0.5 * (box.lower + box.upper);
  const double size = norm_one(box.lower) + norm_one(box.upper);
  std::vector<std::uint32_t> numbers = engine_.bodies_in(box);
  restrict(numbers);
  for (const std::uint32_t number : numbers) {
    if (const auto shape = certain_shape_of(engine_.bodies(), number, now_)) {
      const GapLimits gap = gap_to(*shape);
      if (gap.lower > 0.0) continue;
      found.push_back(
          {engine_.bodies().id_of(number), gap.upper <= 0.0 ? Certainty::certainly : Certainty::possibly});
      continue;
    }
    const CertainSphere at = certain_sphere(number, middle, height, distance_to);
    const double distance = distance_to(at.centre);
    const double wrong = part_lost * (size + norm_one(at.centre) + at.outer);
    if (distance - wrong > at.outer) continue;
    const bool certain = distance + wrong <= at.inner;
    found.push_back({engine_.bodies().id_of(number), certain ? Certainty::certainly : Certainty::possibly});
  }
}

void World::Engine::Queries::overlapping(const Vec3& centre, double radius,
                                         std::vector<OverlapHit>& found) const {
  overlapping(
      box_around(centre, centre, radius), 0.0,
      [&](const Vec3& point) { return norm(point - centre) - radius; },
      [&](const CertainShape& shape) { return limits_of(centre, radius, shape); }, found);
}

void World::Engine::Queries::overlapping(const Box& region, std::vector<OverlapHit>& found) const {
  const Box box = engine_.bodies().space().within(region);
  overlapping(
      box, box.upper.y - box.lower.y, [&](const Vec3& point) { return distance_to_box(point, box); },
      [&](const CertainShape& shape) { return limits_of(box, shape); }, found);
}

void World::Engine::Queries::add_distances(const std::vector<std::uint32_t>& numbers, const Vec3& point,
                                           std::vector<NearestHit>& all) const {
  for (const std::uint32_t number : numbers) {
    if (const auto shape = certain_shape_of(engine_.bodies(), number, now_)) {
      const GapLimits gap = limits_of(point, 0.0, *shape);
      all.push_back({engine_.bodies().id_of(number), Certainty::possibly, gap.lower, gap.upper});
      continue;
    }
    const CertainSphere at =
        certain_sphere(number, point, 0.0, [&](const Vec3& centre) { return norm(centre - point); });
    const double distance = norm(at.centre - point);
    const double wrong = part_lost * (norm_one(point) + norm_one(at.centre) + at.outer);
    all.push_back({engine_.bodies().id_of(number), Certainty::possibly, distance - at.outer - wrong,
                   distance - at.inner + wrong});
  }
}

/// Finds a superset of the `count` nearest bodies: the half edge of a cube is enlarged until `count` bodies
/// are certainly within that distance. All bodies not found are outside the cube.
void World::Engine::Queries::add_around(const Vec3& point, std::size_t count,
                                        std::vector<NearestHit>& all) const {
  const BodyTable& table = engine_.bodies().table();
  const double farthest = 8.0 * coordinate_limit(engine_.definition());
  // A body has about one other within the size of the smallest ones, in open space.
  double reach = finest_length() * cube_root(static_cast<double>(count));
  for (; reach <= farthest; reach *= 2.0) {
    std::vector<std::uint32_t> numbers = engine_.bodies_in(box_around(point, point, reach));
    // All are counted only where a part of them has been found.
    const bool is_everyone = 8 * numbers.size() >= table.numbers() && numbers.size() == table.present_count();
    restrict(numbers);
    all.clear();
    add_distances(numbers, point, all);
    const auto within =
        std::count_if(all.begin(), all.end(), [=](const NearestHit& n) { return n.upper <= reach; });
    if (static_cast<std::size_t>(within) >= count || is_everyone) return;
  }
  std::vector<std::uint32_t> present;
  for (std::uint32_t number = 0; number < engine_.bodies().numbers(); ++number)
    if (engine_.bodies()[number].present()) present.push_back(number);
  restrict(present);
  all.clear();
  add_distances(present, point, all);
}

void World::Engine::Queries::nearest(const Vec3& point, std::size_t count,
                                     std::vector<NearestHit>& all) const {
  count = std::min<std::size_t>(count, engine_.bodies().table().numbers());
  if (count == 0) return;
  add_around(point, count, all);
  count = std::min(count, all.size());
  if (count == 0) return;
  std::vector<double> uppers;
  uppers.reserve(all.size());
  for (const NearestHit& near : all) uppers.push_back(near.upper);
  std::nth_element(uppers.begin(), uppers.begin() + static_cast<std::ptrdiff_t>(count - 1), uppers.end());
  const double enough = uppers[count - 1];
  std::erase_if(all, [=](const NearestHit& near) { return near.lower > enough; });
  std::sort(all.begin(), all.end(), [](const NearestHit& a, const NearestHit& b) {
    return a.lower != b.lower ? a.lower < b.lower : a.body < b.body;
  });
  // A body is certainly among the nearest if at most `count` bodies, itself included, may be as near. Sorting
  // by `lower` puts these at the front of the list.
  for (NearestHit& near : all) {
    const auto not_farther =
        std::upper_bound(all.begin(), all.end(), near.upper,
                         [](double limit, const NearestHit& other) { return limit < other.lower; });
    if (static_cast<std::size_t>(std::distance(all.begin(), not_farther)) <= count)
      near.certainty = Certainty::certainly;
  }
}

/// Intersects the ray with a body, in those of its images that come near this piece of the ray. Returns the
/// earliest limits over these images, or nullopt if none can be hit.
std::optional<CastHit> World::Engine::Queries::hit(const SweptRay& ray, const Box& piece,
                                                   std::uint32_t number) const {
  if (const auto shape = certain_shape_of(engine_.bodies(), number, now_)) {
    const RayLimits touch = touch_of(ray, *shape);
    if (touch.lower == infinity) return std::nullopt;
    return CastHit{engine_.bodies().id_of(number), Certainty::possibly, touch.lower, touch.upper};
  }
  const CertainSphere at = certain_sphere_of(engine_.bodies()[number], now_);
  std::optional<CastHit> first;
  engine_.bodies().space().for_each_shift(
      box_around(at.centre, at.centre, at.outer), piece, [&](const Vec3& shift) {
        const Vec3 centre = at.centre + shift;
        const double wrong = part_lost * (norm_one(ray.origin) + norm_one(centre) + at.outer + ray.radius);
        const auto may = passage(ray, centre, at.outer + ray.radius + wrong, wrong);
        if (!may) return;
        const auto must = passage(ray, centre, at.inner + ray.radius - wrong, -wrong);
        const CastHit image{engine_.bodies().id_of(number), Certainty::possibly, may->enter,
                            must ? must->enter : infinity};
        if (!first) first = image;
        first->lower = std::min(first->lower, image.lower);
        first->upper = std::min(first->upper, image.upper);
      });
  return first;
}

void World::Engine::Queries::cast(const SweptRay& ray, std::vector<CastHit>& hits) const {
  double sure = infinity;  // something is certainly hit within this distance
  const double piece = std::max({ray.length / most_pieces, 2.0 * ray.radius, finest_length()});
  std::vector<std::uint32_t> seen;
  for (int k = 0; k < most_pieces && k * piece <= std::min(ray.length, sure); ++k) {
    const double end = k + 1 == most_pieces ? ray.length : std::min(ray.length, (k + 1) * piece);
    const Box box =
        box_around(ray.origin + ray.direction * (k * piece), ray.origin + ray.direction * end, ray.radius);
    std::vector<std::uint32_t> fresh;
    std::vector<std::uint32_t> here = engine_.bodies_in(box);
    restrict(here);
    std::set_difference(here.begin(), here.end(), seen.begin(), seen.end(), std::back_inserter(fresh));
    for (const std::uint32_t number : fresh) {
      const std::optional<CastHit> found = hit(ray, box, number);
      if (!found) continue;
      hits.push_back(*found);
      sure = std::min(sure, found->upper);
    }
    // In periodic space, a body missed in this piece may be hit later in another image, so none is skipped.
    if (engine_.bodies().space().repeats()) continue;
    const auto middle = static_cast<std::ptrdiff_t>(seen.size());
    seen.insert(seen.end(), fresh.begin(), fresh.end());
    std::inplace_merge(seen.begin(), seen.begin() + middle, seen.end());
  }
  if (engine_.bodies().space().repeats()) keep_first_of_each_body(hits);
  std::erase_if(hits, [=](const CastHit& hit) { return hit.lower > sure; });
  std::sort(hits.begin(), hits.end(), [](const CastHit& a, const CastHit& b) {
    return a.lower != b.lower ? a.lower < b.lower : a.body < b.body;
  });
  if (hits.size() == 1 && hits[0].upper < infinity) hits[0].certainty = Certainty::certainly;
}

}  // namespace kinesphere
