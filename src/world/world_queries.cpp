// World's queries: checks the calls, and probes if the caller provides a probe.
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "engine/validation.hpp"
#include "input/input_check.hpp"
#include "kinesphere/limits.hpp"
#include "query/queries.hpp"
#include "world/preconditions.hpp"
#include "world/stale_prober.hpp"

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

/// Evaluates a query. With a probe, repeats it after probing the bodies that leave it open, until the answer
/// rests on fresh reports. `callable` is the result of checking the call, and `valid` checks the arguments.
template <class Queries, class Engine, class Valid, class Refresh, class Ask>
auto answer(const Engine* engine, const Result<void>& callable, Valid valid, Refresh refresh, Ask ask)
    -> Result<decltype(ask(Queries(*engine)))> {
  if (!callable) return callable.error();
  if (const Result<void> fit = valid(engine->definition()); !fit) return fit.error();
  for (;;) {
    auto found = ask(Queries(*engine));
    if constexpr (std::is_same_v<Refresh, WithoutProbe>) return found;
    std::vector<std::uint32_t> open;
    for (const auto& each : found)
      if (leaves_open(each)) open.push_back(each.body.index);
    const auto probed = refresh(open);
    if (!probed) return probed.error();
    if (!probed.value()) return found;
  }
}

auto fit_sphere(const Vec3& centre, double radius) {
  return [=](const WorldDefinition& world) { return check_sphere(centre, radius, world); };
}

auto fit_box(const Box& box) {
  return [=](const WorldDefinition& world) { return check_region(box, world); };
}

auto fit_point(const Vec3& point) {
  return [=](const WorldDefinition& world) { return check_point(point, world); };
}

auto fit_ray(const Vec3& origin, double radius, const Vec3& direction, double length, std::string_view call) {
  return
      [=](const WorldDefinition& world) { return check_ray(origin, radius, direction, length, world, call); };
}

auto about_sphere(const Vec3& centre, double radius) {
  return [=](const auto& queries) { return queries.overlapping(centre, radius); };
}

auto about_box(const Box& box) {
  return [=](const auto& queries) { return queries.overlapping(box); };
}

auto about_nearest(const Vec3& point, std::size_t count) {
  return [=](const auto& queries) { return queries.nearest(point, count); };
}

auto about_ray(const Vec3& origin, double radius, const Vec3& direction, double length) {
  return [=](const auto& queries) { return queries.cast(SweptRay{origin, radius, unit(direction), length}); };
}

}  // namespace

Result<std::vector<OverlapHit>> World::overlapping(const Vec3& centre, double radius) const {
  return answer<Engine::Queries>(engine_.get(), Preconditions(*this, "overlapping").idle(),
                                 fit_sphere(centre, radius), without_probe, about_sphere(centre, radius));
}

Result<std::vector<OverlapHit>> World::overlapping(const Vec3& centre, double radius, Probe probe) {
  return answer<Engine::Queries>(engine_.get(), Preconditions(*this, "overlapping").may_ask(probe),
                                 fit_sphere(centre, radius), StaleProber(*this, probe, "overlapping"),
                                 about_sphere(centre, radius));
}

Result<std::vector<OverlapHit>> World::overlapping(const Box& box) const {
  return answer<Engine::Queries>(engine_.get(), Preconditions(*this, "overlapping").idle(), fit_box(box),
                                 without_probe, about_box(box));
}

Result<std::vector<OverlapHit>> World::overlapping(const Box& box, Probe probe) {
  return answer<Engine::Queries>(engine_.get(), Preconditions(*this, "overlapping").may_ask(probe),
                                 fit_box(box), StaleProber(*this, probe, "overlapping"), about_box(box));
}

Result<std::vector<NearestHit>> World::nearest(const Vec3& point, std::size_t count) const {
  return answer<Engine::Queries>(engine_.get(), Preconditions(*this, "nearest").idle(), fit_point(point),
                                 without_probe, about_nearest(point, count));
}

Result<std::vector<NearestHit>> World::nearest(const Vec3& point, std::size_t count, Probe probe) {
  return answer<Engine::Queries>(engine_.get(), Preconditions(*this, "nearest").may_ask(probe),
                                 fit_point(point), StaleProber(*this, probe, "nearest"),
                                 about_nearest(point, count));
}

Result<std::vector<CastHit>> World::ray_cast(const Vec3& origin, const Vec3& direction, double length) const {
  return answer<Engine::Queries>(engine_.get(), Preconditions(*this, "ray_cast").idle(),
                                 fit_ray(origin, 0.0, direction, length, "ray_cast"), without_probe,
                                 about_ray(origin, 0.0, direction, length));
}

Result<std::vector<CastHit>> World::ray_cast(const Vec3& origin, const Vec3& direction, double length,
                                             Probe probe) {
  return answer<Engine::Queries>(engine_.get(), Preconditions(*this, "ray_cast").may_ask(probe),
                                 fit_ray(origin, 0.0, direction, length, "ray_cast"),
                                 StaleProber(*this, probe, "ray_cast"),
                                 about_ray(origin, 0.0, direction, length));
}

Result<std::vector<CastHit>> World::sphere_cast(const Vec3& origin, double radius, const Vec3& direction,
                                                double length) const {
  return answer<Engine::Queries>(engine_.get(), Preconditions(*this, "sphere_cast").idle(),
                                 fit_ray(origin, radius, direction, length, "sphere_cast"), without_probe,
                                 about_ray(origin, radius, direction, length));
}

Result<std::vector<CastHit>> World::sphere_cast(const Vec3& origin, double radius, const Vec3& direction,
                                                double length, Probe probe) {
  return answer<Engine::Queries>(engine_.get(), Preconditions(*this, "sphere_cast").may_ask(probe),
                                 fit_ray(origin, radius, direction, length, "sphere_cast"),
                                 StaleProber(*this, probe, "sphere_cast"),
                                 about_ray(origin, radius, direction, length));
}

}  // namespace kinesphere
