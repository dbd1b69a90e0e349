// Regions of a monitor's tracks: where a track stays, for how long, and which others are near it.
#include <algorithm>
#include <cmath>

#include "bound/quick_reject.hpp"
#include "bound/rounding.hpp"
#include "monitor/engine.hpp"

namespace kinesphere {
namespace {

/// A region stays where it is if its track stays in it for this part of the time for which it was made. Less
/// leads to more tests, more to more searches.
constexpr double stay_worth_keeping = 0.25;
/// A track with fewer tracks around gets a region for twice the time, one with more for half of it: wide
/// regions last long, but bring more pairs near each other. Measured with the streams of docs/monitoring.md.
constexpr std::size_t few_around = 2, many_around = 12;
/// A silent track gets a region for at least this part of the time since its last report, so that a gap
/// takes a number of regions like the logarithm of its length.
constexpr double part_of_silence = 0.125;
/// No region is made for a longer time: twice the longest one that there is.
constexpr double longest_stay = 4.0 * limits::largest_time;

/// Returns a region that contains a ball until `end`, with some room for rounding.
Region region_around(const Bound& ball, double end) {
  const double half = 0.5 * (end - ball.time);
  const Vec3 centre = ball.centre_at(ball.time + half);
  const double way =
      (norm(ball.velocity_at(ball.time + half)) + 0.5 * norm(ball.planned_acceleration) * half) * half;
  const double sizes =
      norm_one(ball.position) + (norm_one(ball.velocity) + norm_one(ball.planned_acceleration) * half) * half;
  return {centre, (way + ball.radius_at(end)) * (1.0 + 0x1p-20) + sizes * 0x1p-40};
}

/// Returns more than all lengths of a ball in the next `duration`.
double size_of(const BoundAt& ball, double duration) {
  return norm_one(ball.centre) + norm_one(ball.velocity) * duration + ball.radius_after(duration);
}

}  // namespace

/// Returns a ball that contains a track, with the space around it in which others matter, from now until
/// `end`, if the hypothesis is true: the margin of its class and, for well clear, the way that it may go in
/// the modified tau.
Bound Monitor::Engine::zone_of(std::uint32_t number, const Hypothesis& hypothesis, double end) const {
  Bound zone = TrackEstimate::bound(hypothesis, time_, end);
  const std::size_t track_class = tracks_[number].track_class;
  zone.radius += separations_.margin(track_class);
  if (const double modified_tau = separations_.modified_tau(track_class); modified_tau > 0.0)
    zone.radius += modified_tau * TrackEstimate::largest_speed(hypothesis, time_, end) * (1.0 + 0x1p-40);
  return zone;
}

/// Returns the time until which a track certainly stays in its regions, up to `end`.
double Monitor::Engine::stays(std::uint32_t number, double end) const {
  double until = end;
  const std::span<const Hypothesis> hypotheses = tracks_[number].estimate.hypotheses();
  for (std::size_t k = 0; k < hypotheses.size(); ++k) {
    Bound zone = zone_of(number, hypotheses[k], end);
    const auto [centre, radius] = near_.region(number, k);
    const double room = rounding::sum_down(radius, -zone.radius);
    zone.radius = 0.0;
    const Bound middle{.time = time_, .position = centre};
    until = std::min(until, earliest_separation(zone, middle, time_, end, room));
  }
  return until;
}

/// Returns a time until which the zones of two tracks are apart, and so the tracks, or now. It may be much
/// earlier than the forecast at their separations, which costs some times as much.
double Monitor::Engine::zones_apart_until(std::uint32_t a, std::uint32_t b) const {
  const double duration = 8.0 * std::max(tracks_[a].stay, tracks_[b].stay);
  const double end = time_ + duration;
  double apart = duration;
  for (const Hypothesis& one : tracks_[a].estimate.hypotheses())
    for (const Hypothesis& other : tracks_[b].estimate.hypotheses()) {
      const BoundAt first(zone_of(a, one, end), time_), second(zone_of(b, other, end), time_);
      const double margin = (size_of(first, duration) + size_of(second, duration)) * 0x1p-46;
      apart = std::min(apart, QuickReject(first, second).meeting(duration, margin));
    }
  return rounding::sum_down(time_, apart);
}

void Monitor::Engine::set_own(std::uint32_t number, double time) {
  tracks_[number].own = time;
  add_due({time, DueTime::About::region, number});
}

/// A track may leave its regions: it gets others, unless it stays for long by what is known of it now.
void Monitor::Engine::leave_regions(std::uint32_t number) {
  const double stay = tracks_[number].stay;
  const double until = stays(number, time_ + stay);
  if (until >= time_ + stay_worth_keeping * stay) return set_own(number, until);
  move_regions(number);
}

/// Gives a track regions that contain it from now on, and certifies all pairs that are near by them. Call it
/// when a track is new, may leave its regions, or may be outside of them.
void Monitor::Engine::move_regions(std::uint32_t number) {
  KnownTrack& track = tracks_[number];
  const double silence = time_ - track.estimate.timestamp();
  track.stay = std::clamp(track.stay, power_of_two(rung_), longest_stay);
  track.stay = std::max({track.stay, part_of_silence * silence, std::abs(time_) * 0x1p-40});
  const double end = time_ + track.stay;
  regions_.clear();
  for (const Hypothesis& hypothesis : track.estimate.hypotheses())
    regions_.push_back(region_around(zone_of(number, hypothesis, end), end));
  counters_.searches += regions_.size();
  const std::size_t around = near_.place(
      number, regions_, [this](std::uint32_t a, std::uint32_t b) { return !levels_of(a, b).empty(); });
  for (const std::uint32_t other : near_.gone()) {
    if (pairs_.find(number, other)->is_open()) continue;
    pairs_.remove(number, other);
    near_.part(number, other);
  }
  counters_.near_pairs += near_.fresh().size();
  for (const std::uint32_t other : near_.fresh()) certify(number, other, pairs_.add(number, other));
  set_own(number, end);
  const std::size_t closed = around - std::min(around, track.open.size());
  track.stay *= closed < few_around ? 2.0 : closed > many_around ? 0.5 : 1.0;
}

}  // namespace kinesphere
