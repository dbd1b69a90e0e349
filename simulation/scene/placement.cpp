#include "simulation/scene/placement.hpp"

#include <algorithm>
#include <numeric>

#include "kinesphere/random.hpp"
#include "simulation/scene/relaxation.hpp"
#include "simulation/scene/sphere_room.hpp"

namespace kinesphere {
namespace {

/// Tries for one sphere before random placement is given up: fewer give up boxes with room left, more waste
/// time before relax_spheres().
constexpr int max_tries = 200000;

std::optional<std::vector<Vec3>> place_at_random(SphereRoom& room, std::size_t count, Random random) {
  const auto is_free = [&](std::uint32_t sphere, const Vec3& centre) {
    bool free = true;
    room.for_each_near(sphere, centre, [&](std::uint32_t other) {
      const double distance = room.least_distance(sphere, other);
      free = free && norm_squared(room.offset(centre, other)) > distance * distance;
    });
    return free;
  };
  const auto place = [&](std::uint32_t sphere) {
    const auto range = room.range(sphere);
    if (!range) return false;
    for (int tries = 0; tries < max_tries; ++tries) {
      const Vec3 centre = SphereRoom::random_point(*range, random);
      if (!is_free(sphere, centre)) continue;
      room.move_to(sphere, centre);
      return true;
    }
    return false;
  };
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return room.radius(a) > room.radius(b); });
  if (!std::all_of(order.begin(), order.end(), place)) return std::nullopt;
  return room.centres();
}

/// Returns the part of the box that the spheres fill.
double filled_part(const std::vector<double>& radii, const Box& box) {
  const double ball = 4.1887;  // volume of the ball of radius 1, rounded down
  double volume = 0.0;
  for (const double radius : radii) volume += ball * radius * radius * radius;
  const Vec3 size = box.upper - box.lower;
  return volume / (size.x * size.y * size.z);
}

/// Returns true if random placement is likely to fail: spheres of one size that are placed at random jam at
/// 38 % of a large box, and take long well before that.
bool will_jam(const std::vector<double>& radii, double filled) {
  const auto differs = [&](double radius) { return radius != radii.front(); };
  return filled > 0.28 && std::none_of(radii.begin(), radii.end(), differs);
}

}  // namespace

std::optional<std::vector<Vec3>> place_spheres(const std::vector<double>& radii, const Box& box,
                                               double clearance, std::uint64_t seed, bool periodic) {
  const double filled = filled_part(radii, box);
  if (filled > 1.0) return std::nullopt;  // spheres cannot fill more than the box
  if (!will_jam(radii, filled)) {
    SphereRoom room(radii, box, clearance, periodic);
    if (auto centres = place_at_random(room, radii.size(), Random::at(seed, 0, 0))) return centres;
  }
  return relax_spheres(radii, box, clearance, seed, periodic);
}

}  // namespace kinesphere
