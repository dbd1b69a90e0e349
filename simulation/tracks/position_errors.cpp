// How far the positions of recorded tracks may be off.
#include "simulation/tracks/position_errors.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {

double PositionErrors::at(std::uint32_t track, double t) const {
  const std::vector<double>& times = samples[track];
  const auto next = std::ranges::lower_bound(times, t);
  double away = next == times.end() ? t - times.back() : *next - t;
  if (next != times.begin()) away = std::min(away, t - *(next - 1));
  return at_samples + growth * away;
}

double PositionErrors::largest(std::uint32_t track, double begin, double end) const {
  double largest = std::max(at(track, begin), at(track, end));
  const std::vector<double>& times = samples[track];
  for (std::size_t k = 1; k < times.size(); ++k)
    largest = std::max(largest, at_samples + 0.5 * growth * (times[k] - times[k - 1]));
  return largest;
}

}  // namespace kinesphere
