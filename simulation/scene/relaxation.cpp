// Packs spheres into a box by pushing them apart, for boxes too full for random placement.
#include "simulation/scene/relaxation.hpp"

#include <algorithm>
#include <limits>

#include "kinesphere/random.hpp"
#include "simulation/grid/hash_grid.hpp"

namespace kinesphere {
namespace {

/// Extra distance of a pushed pair, as a part of the distance it needs. Without it the last overlaps would
/// shrink for ever and never vanish; a larger one pushes spheres into their other neighbours.
constexpr double overshoot = 1e-3;
/// Sweeps after which the total overlap must have shrunk by the factor `least_progress`; fewer give up
/// packings that would succeed, more delay the failure of the others.
constexpr int patience = 100;
constexpr double least_progress = 0.9;

class Relaxation {
 public:
  Relaxation(const std::vector<double>& radii, const Box& box, double clearance, std::uint64_t seed)
      : radii_(radii),
        box_(box),
        clearance_(clearance),
        random_(Random::at(seed, 1, 0)),
        centres_(radii.size()) {}

  std::optional<std::vector<Vec3>> run() {
    for (std::uint32_t sphere = 0; sphere < centres_.size(); ++sphere) {
      const Box margin = room_of(sphere);
      if (!(margin.lower.x <= margin.upper.x && margin.lower.y <= margin.upper.y &&
            margin.lower.z <= margin.upper.z))
        return std::nullopt;
      move_to(sphere, random_point(margin));
    }
    double to_beat = std::numeric_limits<double>::infinity();
    for (int sweeps = 1;; ++sweeps) {
      const double overlap = sweep();
      if (overlap == 0.0) return centres_;
      if (sweeps % patience != 0) continue;
      if (!(overlap < to_beat)) return std::nullopt;
      to_beat = least_progress * overlap;
    }
  }

 private:
  /// Returns the box in which the sphere's centre may be.
  Box room_of(std::uint32_t sphere) const {
    const double reach = radii_[sphere] + clearance_;
    const Vec3 half{reach, reach, reach};
    return {box_.lower + half, box_.upper - half};
  }

  Vec3 random_point(const Box& margin) {
    return {random_.uniform(margin.lower.x, margin.upper.x), random_.uniform(margin.lower.y, margin.upper.y),
            random_.uniform(margin.lower.z, margin.upper.z)};
  }

  void move_to(std::uint32_t sphere, const Vec3& centre) {
    const Box margin = room_of(sphere);
    for (int axis = 0; axis < 3; ++axis)
      centres_[sphere][axis] = std::clamp(centre[axis], margin.lower[axis], margin.upper[axis]);
    const double reach = radii_[sphere] + clearance_;
    const Vec3 half{reach, reach, reach};
    grid_.set(sphere, {centres_[sphere] - half, centres_[sphere] + half});
  }

  /// Pushes every overlapping pair apart once. Returns the sum of the overlaps as they were found.
  double sweep() {
    double overlap = 0.0;
    for (std::uint32_t sphere = 0; sphere < centres_.size(); ++sphere) {
      const double reach = radii_[sphere] + clearance_;
      const Vec3 half{reach, reach, reach};
      near_.clear();
      grid_.for_each_overlap({centres_[sphere] - half, centres_[sphere] + half}, [&](std::uint32_t other) {
        if (other != sphere) near_.push_back(other);
      });
      for (const std::uint32_t other : near_) overlap += push_apart(sphere, other);
    }
    return overlap;
  }

  /// Pushes two spheres apart if they overlap, and returns their overlap. The smaller one moves more, as its
  /// cross-section is smaller.
  double push_apart(std::uint32_t a, std::uint32_t b) {
    const Vec3 apart = centres_[b] - centres_[a];
    const double needed = radii_[a] + radii_[b] + clearance_;
    if (norm_squared(apart) > needed * needed) return 0.0;
    const double distance = norm(apart);
    const Vec3 direction = distance > 0.0 ? apart / distance : random_.unit_vector();
    const double push = (1.0 + overshoot) * needed - distance;
    const double area_a = radii_[a] * radii_[a];
    const double area_b = radii_[b] * radii_[b];
    const double share = area_a + area_b > 0.0 ? area_b / (area_a + area_b) : 0.5;
    move_to(a, centres_[a] - direction * (push * share));
    move_to(b, centres_[b] + direction * (push * (1.0 - share)));
    return push;
  }

  const std::vector<double>& radii_;
  Box box_;
  double clearance_;
  Random random_;
  HashGrid grid_;
  std::vector<Vec3> centres_;
  std::vector<std::uint32_t> near_;  ///< scratch memory of sweep()
};

}  // namespace

std::optional<std::vector<Vec3>> relax_spheres(const std::vector<double>& radii, const Box& box,
                                               double clearance, std::uint64_t seed) {
  return Relaxation(radii, box, clearance, seed).run();
}

}  // namespace kinesphere
