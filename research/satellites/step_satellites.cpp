#include "research/satellites/step_satellites.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace kinesphere {

std::vector<SatelliteApproach> step_satellites(SatelliteMotion motion, double until, double distance,
                                               double step) {
  struct Place {
    Vec3 position;
    std::uint32_t number;
  };
  /// Consecutive steps at which a pair is within the distance.
  struct Seen {
    std::int64_t first, last;
  };
  std::vector<Place> places(motion.size());
  for (std::uint32_t k = 0; k < places.size(); ++k) places[k].number = k;
  std::unordered_map<std::uint64_t, Seen> seen;
  std::vector<SatelliteApproach> approaches;
  const auto finish = [&](std::uint64_t pair, const Seen& steps) {
    approaches.push_back({.first = static_cast<std::uint32_t>(pair >> 32),
                          .second = static_cast<std::uint32_t>(pair),
                          .begin = static_cast<double>(steps.first) * step,
                          .end = static_cast<double>(steps.last) * step});
  };
  const auto steps = static_cast<std::int64_t>(std::floor(until / step));
  for (std::int64_t k = 0; k <= steps; ++k) {
    const double time = static_cast<double>(k) * step;
    for (Place& place : places) place.position = motion.arc(place.number, time).position_at(time);
    // Along one axis no two that are close are farther apart than the distance.
    std::sort(places.begin(), places.end(),
              [](const Place& a, const Place& b) { return a.position.x < b.position.x; });
    for (std::size_t a = 0; a < places.size(); ++a) {
      const double end = places[a].position.x + distance;
      for (std::size_t b = a + 1; b < places.size() && places[b].position.x <= end; ++b) {
        if (!(norm_squared(places[a].position - places[b].position) <= distance * distance)) continue;
        const auto [first, second] = std::minmax(places[a].number, places[b].number);
        const std::uint64_t pair = std::uint64_t{first} << 32 | second;
        const auto [at, is_new] = seen.try_emplace(pair, Seen{k, k});
        if (is_new) continue;
        if (at->second.last + 1 < k) {
          finish(pair, at->second);
          at->second.first = k;
        }
        at->second.last = k;
      }
    }
  }
  for (const auto& [pair, last] : seen) finish(pair, last);
  sort_by_pair(approaches);
  return approaches;
}

}  // namespace kinesphere
