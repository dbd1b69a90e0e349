// Regions of a monitor's tracks: where a track stays, for how long, and which others are near it.
#include <algorithm>
#include <cmath>

#include "bound/rounding.hpp"
#include "monitor/engine.hpp"

namespace kinesphere {
namespace {

/// A region stays where it is if its track stays in it for this part of the time for which it was made. Less
/// leads to more tests, more to more searches.
constexpr double stay_worth_keeping = 0.25;
/// A track near which few others have come by its last region gets the next one for twice the time, unless
/// there are many around already; after many, for half of it. Wide regions last long, but bring more pairs
/// near each other. Measured with the streams of docs/monitoring.md.
constexpr std::size_t few_fresh = 1, many_fresh = 6, many_around = 16;
/// A silent track gets a region for at least this part of the time since its last report, so that a gap
/// takes a number of regions like the logarithm of its length.
constexpr double part_of_silence = 0.125;
/// No region is made for a longer time: twice the longest one that there is.
constexpr double longest_stay = 4.0 * limits::largest_time;

/// Returns a region that contains a zone until `end`, with some room for rounding.
Region region_around(const Bound& ball, double end) {
  const double half = 0.5 * (end - ball.time);
  const Vec3 centre = ball.centre_at(ball.time + half);
  const double way =
      (norm(ball.velocity_at(ball.time + half)) + 0.5 * norm(ball.planned_acceleration) * half) * half;
  const double sizes =
      norm_one(ball.position) + (norm_one(ball.velocity) + norm_one(ball.planned_acceleration) * half) * half;
  return {centre, (way + ball.radius_at(end)) * (1.0 + 0x1p-20) + sizes * 0x1p-40};
}

}  // namespace

/// Returns the zone of a track: a ball that contains it, with the space around it in which others matter,
/// from now until `end`, if the hypothesis is true: the margin of its class and, for well clear, the way that
/// it may go in the modified tau.
Bound Monitor::Engine::zone_of(std::uint32_t number, const Hypothesis& hypothesis, double end) const {
  Bound zone = TrackEstimate::bound(hypothesis, time_, end);
  const std::size_t track_class = tracks_[number].track_class;
  zone.radius += separations_.margin(track_class);
  if (const double modified_tau = separations_.modified_tau(track_class); modified_tau > 0.0)
    zone.radius += modified_tau * TrackEstimate::largest_speed(hypothesis, time_, end) * (1.0 + 0x1p-40);
  return zone;
}

/// Returns the time until which a track certainly stays in its regions, up to `end`. Sets its zones.
double Monitor::Engine::stays(std::uint32_t number, double end) {
  double until = end;
  const std::span<const Hypothesis> hypotheses = tracks_[number].estimate.hypotheses();
  for (std::size_t k = 0; k < hypotheses.size(); ++k) {
    Bound zone = zone_of(number, hypotheses[k], end);
    near_.set_zone(number, k, zone, end);
    const Region region = near_.region(number, k);
    const double room = rounding::sum_down(region.radius, -zone.radius);
    zone.radius = 0.0;
    const Bound middle{.time = time_, .position = region.centre};
    until = std::min(until, earliest_separation(zone, middle, time_, end, room));
  }
  return until;
}

/// A track stays in its regions until `time`, and in its zones. Certifies all pairs with tracks near it until
/// one of the two may leave its regions: those that may not be apart so long get a record.
void Monitor::Engine::set_own(std::uint32_t number, double time) {
  tracks_[number].own = time;
  add_due({time, DueTime::About::region, number});
  for (const auto& [other, apart] : near_.meetings(number, time_, time - time_ + resolution())) {
    const double both_stay = std::min(time, tracks_[other].own) - time_;
    if (apart >= both_stay + resolution() || levels_of(number, other).empty() ||
        pairs_.find(number, other) != nullptr)
      continue;
    certify(number, other, pairs_.add(number, other));
  }
}

/// A track may leave its regions: it gets others, unless it stays for long by what is known of it now.
void Monitor::Engine::leave_regions(std::uint32_t number) {
  const double stay = tracks_[number].stay;
  const double end = time_ + stay, until = stays(number, end);
  if (until >= end) tracks_[number].stay *= 2.0;
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
  std::vector<Bound> zones;
  regions_.clear();
  for (const Hypothesis& hypothesis : track.estimate.hypotheses()) {
    zones.push_back(zone_of(number, hypothesis, end));
    regions_.push_back(region_around(zones.back(), end));
  }
  counters_.searches += regions_.size();
  const std::size_t around = near_.place(number, regions_, {});
  for (const std::uint32_t other : near_.gone()) {
    near_.part(number, other);
    const PairRecord* pair = pairs_.find(number, other);
    if (pair != nullptr && pair->is_open()) continue;
    pairs_.remove(number, other);
  }
  const std::vector<std::uint32_t>& fresh = near_.fresh();
  counters_.near_pairs += fresh.size();
  for (std::size_t k = 0; k < zones.size(); ++k) near_.set_zone(number, k, zones[k], end);
  set_own(number, end);
  const bool is_wide = fresh.size() > many_fresh,
             is_narrow = fresh.size() <= few_fresh && around < many_around;
  track.stay *= is_wide ? 0.5 : is_narrow ? 2.0 : 1.0;
}

}  // namespace kinesphere
