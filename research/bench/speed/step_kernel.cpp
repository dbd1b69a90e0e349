#include "research/bench/speed/step_kernel.hpp"

#include "research/bench/speed/multiversion.hpp"

namespace kinesphere::program {
namespace {

constexpr std::size_t wall_lanes = 16;

struct Spheres {
  const float* x;
  const float* y;
  const float* z;
  const float* radius;
  std::size_t size;
};

struct FloatWalls {
  float lower_x, lower_y, lower_z, upper_x, upper_y, upper_z;
};

KINESPHERE_INLINE int reaches_out(const Spheres& s, const FloatWalls& w, std::size_t at) {
  const float radius = s.radius[at];
  const float lower_x = s.x[at] - w.lower_x, upper_x = w.upper_x - s.x[at];
  const float lower_y = s.y[at] - w.lower_y, upper_y = w.upper_y - s.y[at];
  const float lower_z = s.z[at] - w.lower_z, upper_z = w.upper_z - s.z[at];
  const float least_x = lower_x < upper_x ? lower_x : upper_x;
  const float least_y = lower_y < upper_y ? lower_y : upper_y;
  const float least_z = lower_z < upper_z ? lower_z : upper_z;
  const float least_xy = least_x < least_y ? least_x : least_y;
  return (least_xy < least_z ? least_xy : least_z) < radius ? 1 : 0;
}

KINESPHERE_INLINE void find_outside_generic(const Spheres& spheres, const FloatWalls& walls,
                                            std::vector<std::uint32_t>& found) {
  std::size_t at = 0;
  for (; at + wall_lanes <= spheres.size; at += wall_lanes) {
    int any = 0;
    for (std::size_t lane = 0; lane < wall_lanes; ++lane) any |= reaches_out(spheres, walls, at + lane);
    if (any == 0) continue;
    for (std::size_t lane = 0; lane < wall_lanes; ++lane)
      if (reaches_out(spheres, walls, at + lane) != 0) found.push_back(static_cast<std::uint32_t>(at + lane));
  }
  for (; at < spheres.size; ++at)
    if (reaches_out(spheres, walls, at) != 0) found.push_back(static_cast<std::uint32_t>(at));
}
KINESPHERE_VERSIONS(find_outside,
                    (const Spheres& spheres, const FloatWalls& walls, std::vector<std::uint32_t>& found),
                    (spheres, walls, found))

}  // namespace

void find_at_walls(const Frame& now, const std::vector<float>& radii, const Box& box,
                   std::vector<std::uint32_t>& found) {
  const auto single = [](double value) { return static_cast<float>(value); };
  find_outside({now.x, now.y, now.z, radii.data(), radii.size()},
               {single(box.lower.x), single(box.lower.y), single(box.lower.z), single(box.upper.x),
                single(box.upper.y), single(box.upper.z)},
               found);
}

}  // namespace kinesphere::program
