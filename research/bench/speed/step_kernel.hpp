// Interface of hand-tuned fixed-step detectors, and the last tests of spheres, which all of them share.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kinesphere/vec3.hpp"

namespace kinesphere::program {

/// Centres of all spheres at one step, by body, in single precision as such programs keep them.
struct Frame {
  const float* x;
  const float* y;
  const float* z;
};

struct SpherePair {
  std::uint32_t first;
  std::uint32_t second;
};

enum class SphereTest {
  at_steps,  ///< spheres touch if they overlap at a step; contacts in between are not seen
  swept,     ///< spheres touch if they overlap anywhere on their straight ways from one step to the next
};

/// A detector for fixed steps, and nothing else: its caller moves the spheres and answers contacts.
class StepKernel {
 public:
  virtual ~StepKernel() = default;

  virtual std::string name() const = 0;
  /// Appends the pairs that touch in the step from `before` to `now`, each once, in any order. `before` is
  /// the `now` of the last call; in the first call it equals `now`.
  virtual void look(const Frame& before, const Frame& now, std::vector<SpherePair>& touching) = 0;
  /// Returns the memory of the detector (bytes).
  virtual std::size_t bytes() const = 0;
};

/// Returns true if the centres are nearer than `reach`.
inline bool touch_at(const Frame& now, float reach, std::uint32_t a, std::uint32_t b) {
  const float x = now.x[a] - now.x[b];
  const float y = now.y[a] - now.y[b];
  const float z = now.z[a] - now.z[b];
  return x * x + y * y + z * z < reach * reach;
}

/// Returns true if the centres are nearer than `reach` anywhere on the straight ways from `before` to `now`.
inline bool touch_between(const Frame& before, const Frame& now, float reach, std::uint32_t a,
                          std::uint32_t b) {
  const float x = before.x[a] - before.x[b];
  const float y = before.y[a] - before.y[b];
  const float z = before.z[a] - before.z[b];
  const float u = now.x[a] - now.x[b] - x;
  const float v = now.y[a] - now.y[b] - y;
  const float w = now.z[a] - now.z[b] - z;
  // The centres are nearest at the fraction s of the step.
  const float length_squared = u * u + v * v + w * w;
  const float closing = -(x * u + y * v + z * w);
  const float s = closing <= 0.0f ? 0.0f : closing >= length_squared ? 1.0f : closing / length_squared;
  const float nearest_x = x + s * u;
  const float nearest_y = y + s * v;
  const float nearest_z = z + s * w;
  return nearest_x * nearest_x + nearest_y * nearest_y + nearest_z * nearest_z < reach * reach;
}

/// Appends the bodies that reach over a wall, in order.
void find_at_walls(const Frame& now, const std::vector<float>& radii, const Box& box,
                   std::vector<std::uint32_t>& found);

}  // namespace kinesphere::program
