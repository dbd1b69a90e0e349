// What a search computes, one swept sphere at a time: the plain counterpart of swept_sphere_search.cpp.
//
// Two swept spheres are apart during the span if the distance of their centres exceeds the sum of their
// radii. The distance is least at a time s that one division gives. Squares are compared, so no root is
// needed. Nothing is certain, and the bit is set, where numbers are too small or radii too large for their
// squares, or where a number is NaN: then the comparison does not hold.
#include <algorithm>

#include "broadphase/swept_sphere_search.hpp"

namespace kinesphere {

void near_swept_spheres_plain(const SweptSphereColumns& table, std::span<const SweptSphereQuery> queries,
                              std::span<const SlotRange> ranges, std::uint64_t* words) {
  for (const SlotRange& range : ranges) {
    const auto& [sphere, from, to] = queries[range.query];
    const auto& [centre, velocity, radius] = sphere;
    std::fill_n(words, words_for(range), 0);
    for (std::uint32_t k = range.begin; k < range.end; ++k) {
      const float dx = table[0][k] - centre[0], dy = table[1][k] - centre[1], dz = table[2][k] - centre[2];
      const float du = table[3][k] - velocity[0], dv = table[4][k] - velocity[1],
                  dw = table[5][k] - velocity[2];
      const float radii = table[6][k] + radius;
      const float xv = dx * du + dy * dv + dz * dw;
      const float vv = du * du + dv * dv + dw * dw;
      const float nearest = -xv / (vv + swept_sphere_search::least_square);
      const float late = nearest > from ? nearest : from;
      const float s = late < to ? late : to;
      const float px = dx + du * s, py = dy + dv * s, pz = dz + dw * s;
      const float square = px * px + py * py + pz * pz;
      const std::uint32_t at = k - range.begin;
      if (!(square > radii * radii + swept_sphere_search::least_square))
        words[at / slots_in_a_word] |= std::uint64_t{1} << (at % slots_in_a_word);
    }
    words += words_for(range);
  }
}

}  // namespace kinesphere
