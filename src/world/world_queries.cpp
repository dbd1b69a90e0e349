// Spatial queries: checks the calls, and probes if the facet has a probe.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "bodies/validation.hpp"
#include "input/input_check.hpp"
#include "kinesphere/limits.hpp"
#include "kinesphere/queries.hpp"
#include "parallel/thread_pool.hpp"
#include "processor/dirty_list.hpp"
#include "query/queries.hpp"
#include "world/preconditions.hpp"

namespace kinesphere {
namespace {

Result<void> check_sphere(const Vec3& centre, double radius, const WorldDefinition& world,
                          std::string_view call) {
  InputCheck check(call);
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
  if (world.shear_rate != 0.0 && !check.error())
    check.require(box.upper.y - box.lower.y <= world.box->upper.y - world.box->lower.y,
                  ErrorCode::out_of_range, {"box"},
                  "must be at most as high on y as the periodic box where images slide", box);
  return check.result();
}

Result<void> check_point(const Vec3& point, const WorldDefinition& world, std::string_view call) {
  InputCheck check(call);
  check.within({"point"}, point, coordinate_limit(world));
  require_plane(check, {"point"}, point, world);
  return check.result();
}

Result<void> check_ray(const Vec3& origin, double radius, const Vec3& direction, double length,
                       const WorldDefinition& world, std::string_view call) {
  if (auto valid = check_no_shear(world, call); !valid) return valid;
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

/// Queries that one worker answers at a stretch: a few microseconds each.
constexpr std::size_t least_queries = 16;

/// Returns the error of a call for one query, said of one of many.
Error of_query(Error error, std::size_t query, std::string_view call) {
  error.message.insert(call.size() + 1, " query " + std::to_string(query) + ",");
  return error;
}

/// Where the hits of a query are, among those that its worker has found.
struct FoundAt {
  std::size_t worker = 0;
  std::size_t begin = 0;
  std::size_t end = 0;
};

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
      [&](const WorldDefinition& world) { return check_sphere(centre, radius, world, "overlapping"); },
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
      [&](const WorldDefinition& world) { return check_point(point, world, "nearest"); },
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

/// Evaluates many queries, as answer() does one. `valid(query, world)` checks a query, and
/// `ask(queries, query, found)` answers it.
template <class Hit, class Query, class Valid, class Ask>
Result<HitLists<Hit>> World::Queries::answer_all(std::string_view call, std::span<const Query> queries,
                                                 const std::optional<Filter>& filter, Workers* workers,
                                                 Valid valid, Ask ask) const {
  if (auto callable = Preconditions(*facet_.world, call).may_ask(facet_); !callable) return callable.error();
  const Engine& engine = *facet_.world->engine_;
  for (std::size_t k = 0; k < queries.size(); ++k)
    if (const Result<void> fit = valid(queries[k], engine.definition()); !fit)
      return of_query(fit.error(), k, call);
  PoolLease lease(workers);
  if (!lease)
    return Error{ErrorCode::workers_busy, "workers", no_body,
                 std::string(call) + ": workers must not be at work elsewhere, but are"};

  std::vector<std::vector<Hit>> found(lease.count());
  std::vector<FoundAt> places(queries.size());
  std::vector<std::size_t> open(queries.size());
  std::iota(open.begin(), open.end(), std::size_t{0});
  for (;;) {
    lease.parallel_for(open.size(), least_queries,
                       [&](std::size_t begin, std::size_t end, std::size_t worker) {
                         std::vector<Hit>& kept = found[worker];
                         std::vector<Hit> hits;
                         for (std::size_t k = begin; k < end; ++k) {
                           const Query& query = queries[open[k]];
                           const QueryOptions options{.filter = filter, .except = query.except};
                           hits.clear();
                           ask(Engine::Queries(engine, options), query, hits);
                           places[open[k]] = {worker, kept.size(), kept.size() + hits.size()};
                           kept.insert(kept.end(), hits.begin(), hits.end());
                         }
                       });
    if (!facet_.probing) break;
    std::vector<std::uint32_t> asked;
    std::erase_if(open, [&](std::size_t query) {
      const std::size_t before = asked.size();
      const FoundAt& at = places[query];
      for (std::size_t k = at.begin; k < at.end; ++k)
        if (const Hit& hit = found[at.worker][k]; leaves_open(hit)) asked.push_back(hit.body.index);
      return asked.size() == before;
    });
    make_ascending(asked);
    const auto probed = facet_.refresh(asked, call);
    if (!probed) return probed.error();
    if (!*probed) break;
  }

  HitLists<Hit> lists;
  lists.ends.reserve(queries.size());
  for (const FoundAt& at : places) {
    const auto begin = found[at.worker].begin();
    lists.hits.insert(lists.hits.end(), begin + static_cast<std::ptrdiff_t>(at.begin),
                      begin + static_cast<std::ptrdiff_t>(at.end));
    lists.ends.push_back(lists.hits.size());
  }
  return lists;
}

Result<HitLists<OverlapHit>> World::Queries::overlapping_all(std::span<const SphereQuery> spheres,
                                                             const std::optional<Filter>& filter,
                                                             Workers* workers) const {
  constexpr std::string_view call = "overlapping_all";
  return answer_all<OverlapHit>(
      call, spheres, filter, workers,
      [=](const SphereQuery& sphere, const WorldDefinition& world) {
        return check_sphere(sphere.centre, sphere.radius, world, call);
      },
      [](const auto& queries, const SphereQuery& sphere, auto& found) {
        queries.overlapping(sphere.centre, sphere.radius, found);
      });
}

Result<HitLists<NearestHit>> World::Queries::nearest_all(std::span<const PointQuery> points,
                                                         std::size_t count,
                                                         const std::optional<Filter>& filter,
                                                         Workers* workers) const {
  constexpr std::string_view call = "nearest_all";
  return answer_all<NearestHit>(
      call, points, filter, workers,
      [=](const PointQuery& at, const WorldDefinition& world) { return check_point(at.point, world, call); },
      [=](const auto& queries, const PointQuery& at, auto& found) {
        queries.nearest(at.point, count, found);
      });
}

Result<HitLists<CastHit>> World::Queries::ray_cast_all(std::span<const RayQuery> rays,
                                                       const std::optional<Filter>& filter,
                                                       Workers* workers) const {
  constexpr std::string_view call = "ray_cast_all";
  return answer_all<CastHit>(
      call, rays, filter, workers,
      [=](const RayQuery& ray, const WorldDefinition& world) {
        return check_ray(ray.origin, ray.radius, ray.direction, ray.length, world, call);
      },
      [](const auto& queries, const RayQuery& ray, auto& found) {
        queries.cast({ray.origin, ray.radius, unit(ray.direction), ray.length}, found);
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
