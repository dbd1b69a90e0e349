#include "paths/near_pairs.hpp"

#include <algorithm>

namespace kinesphere {
namespace {

/// Measured on the catalogue of satellites (docs/satellites.md), in nanoseconds: a body's path in a step and
/// its place in the grid, a slot that is compared, a pair that is found, and one that is followed along its
/// arcs.
constexpr double cost_of_body = 150.0, cost_of_slot = 0.5, cost_of_found = 15.0, cost_of_pair = 4000.0;

/// Returns a stretch that contains the path, with half the distance around it.
Stretch stretch_of(std::uint32_t body, const StepPath& path, double distance) {
  const Vec3 half = 0.5 * path.bend;
  return {.number = body,
          .middle = 0.5 * (path.begin + path.end) + half,
          .half_way = 0.5 * (path.end - path.begin),
          .radius = path.radius + norm(half) + 0.5 * distance};
}

}  // namespace

NearPairs::NearPairs(double distance, std::optional<std::uint32_t> only) : distance_(distance), only_(only) {}

/// Along the chord of the pair's relative path, in the middle between it and its parabola.
bool NearPairs::may_meet(const StepPath& a, const StepPath& b) const {
  const Vec3 half = 0.5 * (a.bend - b.bend);
  const Vec3 begin = a.begin - b.begin;
  const Vec3 way = a.end - b.end - begin;
  const double reach = (distance_ + a.radius + b.radius + norm(half)) * (1.0 + 0x1p-40);
  const double least = norm_squared(way);
  const double x = least > 0.0 ? std::clamp(-dot(begin + half, way) / least, 0.0, 1.0) : 0.0;
  return !(norm_squared(begin + half + way * x) > reach * reach);
}

void NearPairs::find_of_one(std::span<const StepPath> paths) {
  work_ = cost_of_body * static_cast<double>(paths.size());
  const StepPath& one = paths[*only_];
  if (!one.exists()) return;
  for (std::uint32_t body = 0; body < paths.size(); ++body)
    if (body != *only_ && paths[body].exists() && may_meet(one, paths[body]))
      found_.push_back({*only_, body});
  work_ += cost_of_pair * static_cast<double>(found_.size());
}

void NearPairs::find_of_all(std::span<const StepPath> paths) {
  stretches_.clear();
  for (std::uint32_t body = 0; body < paths.size(); ++body)
    if (paths[body].exists()) stretches_.push_back(stretch_of(body, paths[body], distance_));
  grid_.fill(stretches_);
  std::size_t count = 0;
  for (std::uint32_t slot = 0; slot < grid_.slots(); ++slot) {
    const std::uint32_t body = grid_.number_at(slot);
    const std::span<const std::uint32_t> candidates = grid_.search_behind(slot);
    count += candidates.size();
    for (const std::uint32_t behind : candidates) {
      const std::uint32_t other = grid_.number_at(behind);
      if (may_meet(paths[body], paths[other])) found_.push_back({body, other});
    }
  }
  work_ = cost_of_body * static_cast<double>(paths.size()) +
          cost_of_slot * static_cast<double>(grid_.compared()) + cost_of_found * static_cast<double>(count) +
          cost_of_pair * static_cast<double>(found_.size());
}

}  // namespace kinesphere
