#include "research/bench/speed/verlet_list.hpp"

#include <algorithm>
#include <cmath>

#include "research/bench/speed/multiversion.hpp"

namespace kinesphere::program {
namespace {

constexpr std::size_t skin_lanes = 16;

struct Skins {
  Frame centres;
  const float* radii_squared;
  std::size_t size;
};

KINESPHERE_INLINE int has_left(const Skins& skins, const Frame& now, std::size_t at) {
  const float x = now.x[at] - skins.centres.x[at];
  const float y = now.y[at] - skins.centres.y[at];
  const float z = now.z[at] - skins.centres.z[at];
  return x * x + y * y + z * z < skins.radii_squared[at] ? 0 : 1;
}

KINESPHERE_INLINE void find_leaving_generic(const Skins& skins, const Frame& now, bool& any_has) {
  std::size_t at = 0;
  int any = 0;
  for (; any == 0 && at + skin_lanes <= skins.size; at += skin_lanes)
    for (std::size_t lane = 0; lane < skin_lanes; ++lane) any |= has_left(skins, now, at + lane);
  for (; at < skins.size; ++at) any |= has_left(skins, now, at);
  any_has = any != 0;
}
KINESPHERE_VERSIONS(find_leaving, (const Skins& skins, const Frame& now, bool& any_has),
                    (skins, now, any_has))

}  // namespace

void VerletList::follow(const Frame& before, const Frame& now, const std::vector<float>& radii) {
  if (x_.empty() || !serves(now)) rebuild(before, now, radii);
}

bool VerletList::serves(const Frame& now) const {
  bool any_has_left = false;
  find_leaving({{x_.data(), y_.data(), z_.data()}, skins_squared_.data(), x_.size()}, now, any_has_left);
  return !any_has_left;
}

/// Rebuilds the list for `now`. The list also holds the pairs that touch on the way from `before`.
void VerletList::rebuild(const Frame& before, const Frame& now, const std::vector<float>& radii) {
  const std::size_t size = radii.size();
  x_.assign(now.x, now.x + size);
  y_.assign(now.y, now.y + size);
  z_.assign(now.z, now.z + size);
  skins_squared_.resize(size);
  wide_radii_.resize(size);
  const float steps = std::max(1.001f, settings_.steps);
  for (std::size_t at = 0; at < size; ++at) {
    const float x = now.x[at] - before.x[at];
    const float y = now.y[at] - before.y[at];
    const float z = now.z[at] - before.z[at];
    const float skin = settings_.skin + steps * std::sqrt(x * x + y * y + z * z);
    skins_squared_[at] = skin * skin;
    wide_radii_[at] = 1.0001f * (radii[at] + skin);
  }
  grid_.find(now, wide_radii_, pairs_);
}

std::size_t VerletList::bytes() const {
  return grid_.bytes() + sizeof(float) * (5 * x_.capacity()) + sizeof(SpherePair) * pairs_.capacity();
}

}  // namespace kinesphere::program
