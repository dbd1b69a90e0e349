// Spatial queries: checks the calls, and probes if the facet has a probe.
#include <algorithm>
#include <cmath>

#include "bodies/validation.hpp"
#include "input/input_check.hpp"
#include "kinesphere/limits.hpp"
#include "kinesphere/queries.hpp"
#include "query/queries.hpp"
#include "world/preconditions.hpp"

namespace kinesphere {
namespace {

Result<void> check_sphere(const Vec3& centre, double radius, const WorldDefinition& world) {
  InputCheck check("overlapping");
  check.within({"centre"}, centre, coordinate_limit(world));
  require_plane(check, {"centre"}, centre, world);
  return require_length(check, "radius", radius, world).result();
}

Result<void> check_region(const Box& box, const WorldDefinition& world) {
  InputCheck check("overlapping");
  check.within({"box", no_body, "lower"}, box.lower, coordinate_limit(world))
      .within({"box", no_body, "upper"}, box.upper, coordinate_limit(world));
  for (int axis = 0; axis < 3; ++axis)
    check.require(box.lower[axis] <= box.upper[axis], ErrorCode::out_of_range, {"box"},
                  "must have lower <= upper on each axis", box);
  return check.result();
}

Result<void> check_point(const Vec3& point, const WorldDefinition& world) {
  InputCheck check("nearest");
  check.within({"point"}, point, coordinate_limit(world));
  require_plane(check, {"point"}, point, world);
  return check.result();
}

Result<void> check_ray(const Vec3& origin, double radius, const Vec3& direction, double length,
                       const WorldDefinition& world, std::string_view call) {
  InputCheck check(call);
  check.within({"origin"}, origin, coordinate_limit(world));
  require_length(check, "radius", radius, world)
      .within({"direction"}, direction, limits::largest_direction)
      .require(direction != Vec3{}, ErrorCode::out_of_range, {"direction"}, "must not be zero", direction);
  require_plane(check, {"origin"}, origin, world);
  require_plane(check, {"direction"}, direction, world);
  require_length(check, "length", length, world);
  for (int axis = 0; axis < 3; ++axis) {
    if (!world.periodic[axis]) continue;
    const double period = world.box->upper[axis] - world.box->lower[axis];
    check
        .require(radius <= 0.5 * period, ErrorCode::out_of_range, {"radius"},
                 "must be at most half of the periodic box, which is", 0.5 * period, radius)
        .require(length <= 64.0 * period, ErrorCode::out_of_range, {"length"},
                 "must be at most 64 times the periodic box, which is", 64.0 * period, length);
  }
  return check.result();
}

/// Returns the unit vector. Scaling by the largest component first prevents underflow of the squares.
Vec3 unit(const Vec3& direction) {
  const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  const Vec3 scaled = direction / largest;
  return scaled / norm(scaled);
}

/// True if a probe of the body may improve the hit: an uncertain overlap may become certain; a distance may
/// become exact.
bool leaves_open(const OverlapHit& found) { return found.certainty == Certainty::possibly; }
bool leaves_open(const NearestHit&) { return true; }
bool leaves_open(const CastHit&) { return true; }

}  // namespace

/// Evaluates a query into `found`. With a probe, repeats it after probing the bodies that leave it open,
/// until the answer rests on fresh reports. `valid` checks the arguments.
template <class Hit, class Valid, class Ask>
Result<std::vector<Hit>> World::Queries::answer(std::string_view call, const QueryOptions& options,
                                                std::vector<Hit> found, Valid valid, Ask ask) const {
  if (auto callable = Preconditions(*facet_.world, call).may_ask(facet_); !callable) return callable.error();
  const Engine& engine = *facet_.world->engine_;
  if (const Result<void> fit = valid(engine.definition()); !fit) return fit.error();
  for (;;) {
    found.clear();
    ask(Engine::Queries(engine, options), found);
    if (!facet_.probing) return found;
    std::vector<std::uint32_t> open;
    for (const Hit& each : found)
      if (leaves_open(each)) open.push_back(each.body.index);
    const auto probed = facet_.refresh(open, call);
    if (!probed) return probed.error();
    if (!*probed) return found;
  }
}

Result<std::vector<OverlapHit>> World::Queries::overlapping(const Vec3& centre, double radius,
                                                            const QueryOptions& options,
                                                            std::vector<OverlapHit> storage) const {
  return answer(
      "overlapping", options, std::move(storage),
      [&](const WorldDefinition& world) { return check_sphere(centre, radius, world); },
      [&](const auto& queries, auto& found) { queries.overlapping(centre, radius, found); });
}

Result<std::vector<OverlapHit>> World::Queries::overlapping(const Box& box, const QueryOptions& options,
                                                            std::vector<OverlapHit> storage) const {
  return answer(
      "overlapping", options, std::move(storage),
      [&](const WorldDefinition& world) { return check_region(box, world); },
      [&](const auto& queries, auto& found) { queries.overlapping(box, found); });
}

Result<std::vector<NearestHit>> World::Queries::nearest(const Vec3& point, std::size_t count,
                                                        const QueryOptions& options,
                                                        std::vector<NearestHit> storage) const {
  return answer(
      "nearest", options, std::move(storage),
      [&](const WorldDefinition& world) { return check_point(point, world); },
      [&](const auto& queries, auto& found) { queries.nearest(point, count, found); });
}

Result<std::vector<CastHit>> World::Queries::ray_cast(const Vec3& origin, const Vec3& direction,
                                                      double length, const QueryOptions& options,
                                                      std::vector<CastHit> storage) const {
  return answer(
      "ray_cast", options, std::move(storage),
      [&](const WorldDefinition& world) {
        return check_ray(origin, 0.0, direction, length, world, "ray_cast");
      },
      [&](const auto& queries, auto& found) {
        queries.cast({origin, 0.0, unit(direction), length}, found);
      });
}

Result<std::vector<CastHit>> World::Queries::sphere_cast(const Vec3& origin, double radius,
                                                         const Vec3& direction, double length,
                                                         const QueryOptions& options,
                                                         std::vector<CastHit> storage) const {
  return answer(
      "sphere_cast", options, std::move(storage),
      [&](const WorldDefinition& world) {
        return check_ray(origin, radius, direction, length, world, "sphere_cast");
      },
      [&](const auto& queries, auto& found) {
        queries.cast({origin, radius, unit(direction), length}, found);
      });
}

Result<bool> World::Queries::refresh(BodyIds bodies) const {
  const Preconditions check(*facet_.world, "refresh");
  auto valid = check.may_ask(facet_.probe);
  std::vector<std::uint32_t> numbers;
  for (const BodyId body : bodies) {
    if (valid) valid = check.known(body);
    numbers.push_back(body.index);
  }
  if (!valid) return valid.error();
  return facet_.refresh(numbers, "refresh");
}

}  // namespace kinesphere
