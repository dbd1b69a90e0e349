#include "bench/speed/verlet_list.hpp"

#include <algorithm>
#include <cmath>

#include "bench/speed/multiversion.hpp"

namespace kinesphere::program {
namespace {

constexpr std::size_t lanes = 16;

/// The largest squared distance between two frames.
KINESPHERE_INLINE void largest_move_generic(const Frame& a, const Frame& b, std::size_t size, float& largest) {
  float most[lanes] = {};
  std::size_t at = 0;
  for (; at + lanes <= size; at += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const float x = a.x[at + lane] - b.x[at + lane];
      const float y = a.y[at + lane] - b.y[at + lane];
      const float z = a.z[at + lane] - b.z[at + lane];
      const float moved = x * x + y * y + z * z;
      most[lane] = moved > most[lane] ? moved : most[lane];
    }
  }
  for (; at < size; ++at) {
    const float x = a.x[at] - b.x[at];
    const float y = a.y[at] - b.y[at];
    const float z = a.z[at] - b.z[at];
    most[0] = std::max(most[0], x * x + y * y + z * z);
  }
  largest = *std::max_element(most, most + lanes);
}
KINESPHERE_VERSIONS(largest_move, (const Frame& a, const Frame& b, std::size_t size, float& largest),
                    (a, b, size, largest))

}  // namespace

void VerletList::follow(const Frame& before, const Frame& now, const std::vector<float>& radii) {
  if (reach_ < 0.0f || !serves(now)) rebuild(before, now, radii);
}

bool VerletList::serves(const Frame& now) const {
  float moved = 0.0f;
  largest_move({x_.data(), y_.data(), z_.data()}, now, x_.size(), moved);
  return moved < reach_ * reach_;
}

/// The list is made for `now`. It must also serve the way that has led there, which a sphere that is very
/// fast widens.
void VerletList::rebuild(const Frame& before, const Frame& now, const std::vector<float>& radii) {
  const std::size_t size = radii.size();
  float moved = 0.0f;
  largest_move(before, now, size, moved);
  reach_ = std::max(0.5f * skin_, 1.001f * std::sqrt(moved));
  x_.assign(now.x, now.x + size);
  y_.assign(now.y, now.y + size);
  z_.assign(now.z, now.z + size);
  wide_radii_.resize(size);
  std::transform(radii.begin(), radii.end(), wide_radii_.begin(),
                 [this](float radius) { return 1.0001f * (radius + reach_); });
  grid_.find(now, wide_radii_, pairs_);
}

std::size_t VerletList::bytes() const {
  return grid_.bytes() + sizeof(float) * (4 * x_.capacity()) + sizeof(SpherePair) * pairs_.capacity();
}

}  // namespace kinesphere::program
