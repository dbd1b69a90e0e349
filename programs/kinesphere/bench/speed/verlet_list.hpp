// Verlet lists: pairs that are nearer than a skin are listed, and the list serves until a sphere has moved
// half the skin.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bench/speed/strip_grid.hpp"

namespace kinesphere::program {

class VerletList {
 public:
  /// `skin` > 0 (length).
  VerletList(const StripSettings& settings, float skin) : grid_(settings), skin_(skin) {}

  /// Makes the list hold all pairs that touch anywhere on the way from `before` to `now`.
  void follow(const Frame& before, const Frame& now, const std::vector<float>& radii);
  const std::vector<SpherePair>& pairs() const { return pairs_; }
  std::size_t bytes() const;

 private:
  bool serves(const Frame& now) const;
  void rebuild(const Frame& before, const Frame& now, const std::vector<float>& radii);

  StripGrid grid_;
  float skin_;
  float reach_ = -1.0f;  ///< how far a sphere may be from its place in the list
  std::vector<float> x_, y_, z_;  ///< places that the list was made for
  std::vector<float> wide_radii_;
  std::vector<SpherePair> pairs_;
};

}  // namespace kinesphere::program
