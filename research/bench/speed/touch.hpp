// The last test of a pair, in single precision. All fixed-step detectors share it, so all find the same
// pairs.
#pragma once

#include <algorithm>
#include <cstdint>

#include "research/bench/speed/step_kernel.hpp"

namespace kinesphere::program {

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

}  // namespace kinesphere::program
