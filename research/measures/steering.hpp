// A crowd that is steered anew in each frame: all velocities change, as those of flocks and players do.
// Beside the world, the grid of cells that a programmer would write for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "kinesphere/random.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere {

struct SteeringSettings {
  std::uint32_t bodies = 10'000;  ///< > 0, of radius 0.5
  int dimensions = 3;             ///< 2 or 3
  double packing = 0.03;          ///< part of the room (its area, its volume) that they fill
  std::uint32_t frames = 60;      ///< 60 in a unit of time
  std::uint64_t seed = 1;
  int threads = 1;  ///< of the world, if it is steered by World::set_velocities(); they share the probe, too
};

/// How the news of a frame reaches the world.
enum class SteeringBy : std::uint8_t {
  velocities,  ///< World::set_velocities()
  frames,      ///< BodyMap::push(): positions of frames
  game,        ///< GameWorld::set_velocities(): the world moves the crowd itself
};

struct SteeredFrames {
  std::vector<double> seconds{};       ///< CPU time of each frame, without that of the crowd itself
  std::vector<double> wall_seconds{};  ///< of each frame by the wall, where SteeringSettings::threads counts
  /// Those that met at some time, each pair once and in ascending order.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs{};
};

/// Steers the crowd in a world, which looks at all times. Throws BadResult for what the world refuses.
SteeredFrames steer_world(const SteeringSettings& settings, SteeringBy by);
/// Steers the same crowd, and looks for overlaps at the end of each frame only, in a uniform grid.
SteeredFrames steer_grid(const SteeringSettings& settings);

/// Balls of one size in cells, sorted by counting. Two that overlap are in the same cell or in cells beside
/// each other.
class UniformGrid {
 public:
  /// The room has this edge, and begins at the origin.
  UniformGrid(double edge, int dimensions, double diameter, std::size_t balls);
  /// Appends the pairs that overlap.
  void find(std::span<const Vec3> centres, std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs);

 private:
  std::size_t cell_along(double coordinate) const;

  int dimensions_;
  double square_;      ///< of the diameter
  std::size_t cells_;  ///< on an axis
  double cells_per_length_;
  std::vector<std::size_t> starts_, cell_of_;
  std::vector<std::uint32_t> sorted_;
  std::vector<Vec3> centres_;  ///< in their order
};

}  // namespace kinesphere
