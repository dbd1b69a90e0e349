// Verlet lists: pairs nearer than the skins of the two spheres are listed, and the list is valid until a
// sphere has left its skin.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

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

}  // namespace kinesphere::program
