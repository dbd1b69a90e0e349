#include "simulation/scene/placement.hpp"

#include <algorithm>
#include <numeric>

#include "kinesphere/random.hpp"
#include "simulation/grid/hash_grid.hpp"
#include "simulation/scene/relaxation.hpp"

namespace kinesphere {
namespace {

/// Tries for one sphere before random placement is given up: fewer give up boxes with room left, more waste
/// time before relax_spheres().
constexpr int max_tries = 200000;

class RandomPlacement {
 public:
  RandomPlacement(const std::vector<double>& radii, const Box& box, double clearance, std::uint64_t seed)
      : radii_(radii),
        box_(box),
        clearance_(clearance),
        random_(Random::at(seed, 0, 0)),
        centres_(radii.size()) {}

  std::optional<std::vector<Vec3>> run() {
    std::vector<std::uint32_t> order(radii_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [this](std::uint32_t a, std::uint32_t b) { return radii_[a] > radii_[b]; });
    for (const std::uint32_t sphere : order)
      if (!place(sphere)) return std::nullopt;
    return centres_;
  }

 private:
  bool place(std::uint32_t sphere) {
    const double reach = radii_[sphere] + clearance_;
    const Vec3 half{reach, reach, reach};
    const Vec3 lower = box_.lower + half;
    const Vec3 upper = box_.upper - half;
    if (!(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z)) return false;
    for (int tries = 0; tries < max_tries; ++tries) {
      const Vec3 centre{random_.uniform(lower.x, upper.x), random_.uniform(lower.y, upper.y),
                        random_.uniform(lower.z, upper.z)};
      const Box box{centre - half, centre + half};
      if (!is_free(sphere, centre, box)) continue;
      centres_[sphere] = centre;
      grid_.set(sphere, box);
      return true;
    }
    return false;
  }

  bool is_free(std::uint32_t sphere, const Vec3& centre, const Box& box) const {
    bool free = true;
    grid_.for_each_overlap(box, [&](std::uint32_t other) {
      const double distance = radii_[sphere] + radii_[other] + clearance_;
      free = free && norm_squared(centre - centres_[other]) > distance * distance;
    });
    return free;
  }

  const std::vector<double>& radii_;
  Box box_;
  double clearance_;
  Random random_;
  HashGrid grid_;
  std::vector<Vec3> centres_;
};

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
                                               double clearance, std::uint64_t seed) {
  const double filled = filled_part(radii, box);
  if (filled > 1.0) return std::nullopt;  // spheres cannot fill more than the box
  if (!will_jam(radii, filled)) {
    if (auto centres = RandomPlacement(radii, box, clearance, seed).run()) return centres;
  }
  return relax_spheres(radii, box, clearance, seed);
}

}  // namespace kinesphere
