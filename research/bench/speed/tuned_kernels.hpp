// The fixed-step detectors to be beaten: structure of arrays, sorted strips, Verlet lists.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "research/bench/speed/step_kernel.hpp"
#include "research/bench/speed/strip_grid.hpp"

namespace kinesphere::program {

struct VerletSettings {
  StripSettings grid;
  /// Way that each sphere may move from its place in the list: `skin` (length) and `steps` steps as long as
  /// the last.
  float skin;
  float steps;
};

class VerletList {
 public:
  explicit VerletList(const VerletSettings& settings) : grid_(settings.grid), settings_(settings) {}

  /// Makes the list hold all pairs that touch anywhere on the way from `before` to `now`.
  void follow(const Frame& before, const Frame& now, const std::vector<float>& radii);
  const std::vector<SpherePair>& pairs() const { return pairs_; }
  std::size_t bytes() const;

 private:
  bool serves(const Frame& now) const;
  void rebuild(const Frame& before, const Frame& now, const std::vector<float>& radii);

  StripGrid grid_;
  VerletSettings settings_;
  std::vector<float> x_, y_, z_;      ///< places for which the list was made
  std::vector<float> skins_squared_;  ///< by body: squared ways allowed from these places
  std::vector<float> wide_radii_;
  std::vector<SpherePair> pairs_;
};

/// Makes a detector that sorts all spheres at each step.
std::unique_ptr<StepKernel> make_grid_kernel(std::vector<float> radii, const StripSettings& settings,
                                             SphereTest test);
/// Makes a detector that keeps a list of the pairs that are near.
std::unique_ptr<StepKernel> make_verlet_kernel(std::vector<float> radii, const VerletSettings& settings,
                                               SphereTest test);

}  // namespace kinesphere::program
