#include "paths/near_pairs.hpp"

#include <algorithm>
#include <functional>

#include "number/powers.hpp"

namespace kinesphere {
namespace {

/// Measured on the catalogue of satellites (docs/satellites.md), in nanoseconds: a body's path in a step and
/// its place in the grid, a vector of swept spheres that is read, a pair that is compared, and one that is
/// followed along its arcs.
constexpr double cost_of_body = 150.0, cost_of_vector = 5.0, cost_of_comparison = 15.0, cost_of_pair = 4000.0;

SweptSphereFrame frame_around(double extent) {
  return {.per_length = power_of_two(-std::clamp(exponent_of(extent), -1000, 1000))};
}

SweptSphere swept_sphere_of(const StepPath& path, double distance, const SweptSphereFrame& frame) {
  const Vec3 half = 0.5 * path.bend;
  const Bound bound{
      .position = path.begin + half, .velocity = path.end - path.begin, .radius = path.radius + norm(half)};
  return swept_sphere_of(BoundAt(bound, 0.0), 0.0, 1.0, 0.5 * distance, frame);
}

}  // namespace

NearPairs::NearPairs(double distance, double extent, std::optional<std::uint32_t> only)
    : distance_(distance), only_(only), grid_(frame_around(extent)) {}

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

/// Moves the few bodies whose swept spheres are far wider than all others from spheres_ to widest_: cells as
/// wide as they are would hold too many of the others.
void NearPairs::set_widest_apart(std::span<const StepPath> paths) {
  constexpr std::size_t few = 16;
  constexpr float far_wider = 4.0f;
  const auto width = [](const SweptSphere& sphere) { return float_aabb_of(sphere, 0.0f, 1.0f).widest(); };
  widest_.clear();
  widths_.clear();
  if (spheres_.spheres.size() <= 4 * few) return;
  for (const SweptSphere& sphere : spheres_.spheres) widths_.push_back(width(sphere));
  std::nth_element(widths_.begin(), widths_.begin() + few, widths_.end(), std::greater<>());
  if (!(*std::max_element(widths_.begin(), widths_.begin() + few) > far_wider * widths_[few])) return;
  const float limit = far_wider * widths_[few];
  std::size_t kept = 0;
  for (std::size_t k = 0; k < spheres_.spheres.size(); ++k) {
    if (width(spheres_.spheres[k]) > limit) {
      widest_.push_back(spheres_.numbers[k]);
    } else {
      spheres_.numbers[kept] = spheres_.numbers[k];
      spheres_.spheres[kept++] = spheres_.spheres[k];
    }
  }
  spheres_.numbers.resize(kept);
  spheres_.spheres.resize(kept);
  for (std::size_t k = 0; k < widest_.size(); ++k) {
    const auto compare = [&](std::uint32_t other) {
      if (may_meet(paths[widest_[k]], paths[other])) found_.push_back({widest_[k], other});
    };
    std::for_each(spheres_.numbers.begin(), spheres_.numbers.end(), compare);
    std::for_each(widest_.begin() + static_cast<std::ptrdiff_t>(k) + 1, widest_.end(), compare);
  }
}

void NearPairs::find_of_all(std::span<const StepPath> paths) {
  constexpr std::uint32_t searches_at_once = 32;
  spheres_.numbers.clear();
  spheres_.spheres.clear();
  for (std::uint32_t body = 0; body < paths.size(); ++body) {
    if (!paths[body].exists()) continue;
    spheres_.numbers.push_back(body);
    spheres_.spheres.push_back(swept_sphere_of(paths[body], distance_, grid_.frame()));
  }
  set_widest_apart(paths);
  PoolLease alone;
  grid_.fill(spheres_, alone, [](std::uint32_t, std::uint32_t) {});
  const SweptSphereTable& table = grid_.table();
  std::size_t vectors = 0, compared = widest_.size() * spheres_.numbers.size();
  for (std::uint32_t slot = 0; slot < table.slots(); slot += searches_at_once) {
    searches_.clear();
    for (std::uint32_t k = slot; k < std::min(slot + searches_at_once, table.slots()); ++k)
      grid_.add_search_behind(k, searches_);
    grid_.make(searches_);
    for (const SlotRange& range : searches_.ranges) vectors += 1 + (range.end - range.begin) / search_lanes;
    searches_.for_each_found([&](std::uint32_t query, std::uint32_t other) {
      const Pair pair{table.number_at(slot + query), table.number_at(other)};
      ++compared;
      if (may_meet(paths[pair.a], paths[pair.b])) found_.push_back(pair);
    });
  }
  work_ = cost_of_body * static_cast<double>(paths.size()) + cost_of_vector * static_cast<double>(vectors) +
          cost_of_comparison * static_cast<double>(compared) +
          cost_of_pair * static_cast<double>(found_.size());
}

}  // namespace kinesphere
