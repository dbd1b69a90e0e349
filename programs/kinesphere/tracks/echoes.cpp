// Samples that a second receiver has passed on later.
#include "tracks/echoes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace kinesphere::program {
namespace {

constexpr std::size_t looked_back = 4;
constexpr std::size_t fewest = 5;
constexpr double least_part = 0.1;
/// Longer runs of one place are a rest.
constexpr std::size_t longest_run = 3;

/// For each sample the time since the sample of that place that it repeats; nothing where it does not.
std::vector<std::optional<double>> lags_in(const Piece& samples) {
  std::vector<std::optional<double>> lags(samples.size());
  for (std::size_t begin = 0; begin < samples.size();) {
    const TrackSample& first = samples[begin].sample;
    std::size_t end = begin + 1;
    while (end < samples.size() && samples[end].sample.position == first.position) ++end;
    if (end - begin <= longest_run) {
      for (std::size_t k = begin + 1; k < end; ++k) lags[k] = samples[k].sample.time - first.time;
      for (std::size_t back = 2; back <= std::min(looked_back, begin) && !lags[begin]; ++back) {
        const TrackSample& earlier = samples[begin - back].sample;
        if (earlier.position == first.position) lags[begin] = first.time - earlier.time;
      }
    }
    begin = end;
  }
  return lags;
}

/// Returns a speed that this part of the steps between samples do not exceed.
double speed_of(const Piece& samples, double part) {
  std::vector<double> speeds;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const TrackSample &from = samples[k - 1].sample, &to = samples[k].sample;
    speeds.push_back(norm(to.position - from.position) / (to.time - from.time));
  }
  const auto at = speeds.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(speeds.size() - 1));
  std::nth_element(speeds.begin(), at, speeds.end());
  return *at;
}

/// True if the lags are about as long as the times before samples that repeat nothing.
bool are_in_rhythm(const Piece& samples, const std::vector<std::optional<double>>& lags) {
  std::vector<double> others, repeated;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    if (lags[k])
      repeated.push_back(*lags[k]);
    else
      others.push_back(samples[k].sample.time - samples[k - 1].sample.time);
  }
  const double lag = median_interval(std::move(repeated)), usual = median_interval(std::move(others));
  return std::abs(lag - usual) <= 0.2 * usual;
}

}  // namespace

void leave_out_echoes(Piece& samples, const RawTrackSet& raw, Tally& echoes) {
  const auto lags = lags_in(samples);
  const auto repeated = static_cast<std::size_t>(
      std::count_if(lags.begin(), lags.end(), [](const auto& lag) { return lag.has_value(); }));
  const double part = static_cast<double>(repeated) / static_cast<double>(samples.size());
  if (repeated < fewest || part < least_part || are_in_rhythm(samples, lags)) return;
  Piece kept;
  for (std::size_t k = 0; k < samples.size(); ++k)
    if (!lags[k]) kept.push_back(samples[k]);
  // A third of the steps that echoes make faster are faster than this.
  const double fast = 1.0 - part / 3.0;
  if (kept.size() < 2 || speed_of(samples, fast) < 1.2 * speed_of(kept, fast)) return;
  for (std::size_t k = 0; k < samples.size(); ++k)
    if (lags[k]) raw.count(echoes, samples[k].place);
  samples = std::move(kept);
}

}  // namespace kinesphere::program
