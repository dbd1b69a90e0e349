// Speeds that samples imply.
#include "tracks/implied_speeds.hpp"

#include <algorithm>
#include <string_view>
#include <unordered_map>

namespace kinesphere::program {
namespace {

/// Returns the speed of the step to sample k from the one before it.
double step_speed(const RecordedTrack& track, std::size_t k) {
  const TrackSample &from = track.samples[k - 1], &to = track.samples[k];
  return norm(to.position - from.position) / (to.time - from.time);
}

/// Returns a speed that three quarters do not exceed. Precondition: there is one.
double usual_speed(std::vector<double>& speeds) {
  const auto at = speeds.begin() + static_cast<std::ptrdiff_t>((speeds.size() - 1) * 3 / 4);
  std::nth_element(speeds.begin(), at, speeds.end());
  return *at;
}

}  // namespace

ImpliedSpeeds::ImpliedSpeeds(const TrackSet& track_set) : track_set_(track_set) {
  constexpr double absurd = 10.0;
  constexpr std::size_t fewest_steps = 8;
  std::vector<double> all;
  std::unordered_map<std::string_view, std::vector<double>> by_id;
  for (const RecordedTrack& track : track_set.tracks) {
    std::vector<double>& own = by_id[track.id];
    for (std::size_t k = 1; k < track.samples.size(); ++k) {
      own.push_back(step_speed(track, k));
      all.push_back(own.back());
    }
  }
  const double usual = usual_speed(all);
  std::unordered_map<std::string_view, double> usual_of;
  for (auto& [id, speeds] : by_id)
    usual_of[id] = speeds.size() < fewest_steps ? usual : std::max(usual, usual_speed(speeds));
  for (const RecordedTrack& track : track_set.tracks) limits_.push_back(absurd * usual_of[track.id]);
}

bool ImpliedSpeeds::is_absurd_at(std::uint32_t track, double time) const {
  const RecordedTrack& recorded = track_set_.tracks[track];
  const auto& samples = recorded.samples;
  const auto after = std::upper_bound(samples.begin(), samples.end(), time,
                                      [](double t, const TrackSample& sample) { return t < sample.time; });
  const auto step = static_cast<std::size_t>(after - samples.begin());
  const std::size_t last = std::min(step + 1, samples.size() - 1);
  for (std::size_t k = std::max<std::size_t>(step, 2) - 1; k <= last; ++k)
    if (step_speed(recorded, k) > limits_[track] && limits_[track] > 0.0) return true;
  return false;
}

}  // namespace kinesphere::program
