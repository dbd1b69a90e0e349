// Packs spheres into a box by pushing them apart, for boxes too full for random placement.
#include "simulation/scene/relaxation.hpp"

#include <limits>

#include "kinesphere/random.hpp"
#include "simulation/scene/sphere_room.hpp"

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
  Relaxation(const std::vector<double>& radii, const Box& box, double clearance, std::uint64_t seed,
             bool periodic)
      : count_(static_cast<std::uint32_t>(radii.size())),
        room_(radii, box, clearance, periodic),
        random_(Random::at(seed, 1, 0)) {}

  std::optional<std::vector<Vec3>> run() {
    for (std::uint32_t sphere = 0; sphere < count_; ++sphere) {
      const auto range = room_.range(sphere);
      if (!range) return std::nullopt;
      room_.move_to(sphere, SphereRoom::random_point(*range, random_));
    }
    double to_beat = std::numeric_limits<double>::infinity();
    for (int sweeps = 1;; ++sweeps) {
      const double overlap = sweep();
      if (overlap == 0.0) return room_.centres();
      if (sweeps % patience != 0) continue;
      if (!(overlap < to_beat)) return std::nullopt;
      to_beat = least_progress * overlap;
    }
  }

 private:
  /// Pushes every overlapping pair apart once. Returns the sum of the overlaps as they were found.
  double sweep() {
    double overlap = 0.0;
    for (std::uint32_t sphere = 0; sphere < count_; ++sphere) {
      near_.clear();
      room_.for_each_near(sphere, room_.centres()[sphere], [&](std::uint32_t other) {
        if (other != sphere) near_.push_back(other);
      });
      for (const std::uint32_t other : near_) overlap += push_apart(sphere, other);
    }
    return overlap;
  }

  /// Pushes two spheres apart if they overlap, and returns their overlap. The smaller one moves more, as its
  /// cross-section is smaller.
  double push_apart(std::uint32_t a, std::uint32_t b) {
    const Vec3 apart = room_.offset(room_.centres()[a], b);
    const double needed = room_.least_distance(a, b);
    if (norm_squared(apart) > needed * needed) return 0.0;
    const double distance = norm(apart);
    const Vec3 direction = distance > 0.0 ? apart / distance : random_.unit_vector();
    const double push = (1.0 + overshoot) * needed - distance;
    const double area_a = room_.radius(a) * room_.radius(a);
    const double area_b = room_.radius(b) * room_.radius(b);
    const double share = area_a + area_b > 0.0 ? area_b / (area_a + area_b) : 0.5;
    room_.move_to(a, room_.centres()[a] - direction * (push * share));
    room_.move_to(b, room_.centres()[b] + direction * (push * (1.0 - share)));
    return push;
  }

  std::uint32_t count_;
  SphereRoom room_;
  Random random_;
  std::vector<std::uint32_t> near_;  ///< scratch memory of sweep()
};

}  // namespace

std::optional<std::vector<Vec3>> relax_spheres(const std::vector<double>& radii, const Box& box,
                                               double clearance, std::uint64_t seed, bool periodic) {
  return Relaxation(radii, box, clearance, seed, periodic).run();
}

}  // namespace kinesphere
