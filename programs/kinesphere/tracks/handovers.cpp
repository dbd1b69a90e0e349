// Bodies that go on under another id.
#include "tracks/handovers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

namespace kinesphere::program {
namespace {

/// Steps around a handover from which velocity and length of steps are known. A track of fewer says too
/// little.
constexpr std::size_t steps_looked_at = 4;
/// Factors on the median interval: of the time in which neither is there, as for gaps, and of that in which
/// both are, in which they can be compared.
constexpr double largest_gap = 2.5, largest_overlap = 5.0;

/// Returns the place at a time between the first and the last sample, on straight lines.
Vec3 place_in(std::span<const TrackSample> samples, double time) {
  const auto after = std::upper_bound(samples.begin() + 1, samples.end() - 1, time,
                                      [](double t, const TrackSample& sample) { return t < sample.time; });
  const TrackSample &to = *after, &from = *(after - 1);
  return from.position + (to.position - from.position) * ((time - from.time) / (to.time - from.time));
}

/// The first or last samples of an id.
struct TrackEnd {
  std::size_t presence = 0;
  double first = 0.0, last = 0.0;  ///< times of the whole id
  std::span<const TrackSample> samples;
  double interval = 0.0;      ///< median
  double longest_step = 0.0;  ///< length
  Vec3 velocity;              ///< mean

  TrackEnd(std::size_t number, const Presence& id, const TrackSet& track_set, bool is_begin)
      : presence(number),
        first(track_set.tracks[id.first_track].samples.front().time),
        last(track_set.tracks[id.first_track + id.tracks - 1].samples.back().time) {
    const auto& all = track_set.tracks[is_begin ? id.first_track : id.first_track + id.tracks - 1].samples;
    samples = std::span(all);
    const std::size_t count = std::min(all.size(), steps_looked_at + 1);
    const auto looked_at = is_begin ? samples.first(count) : samples.last(count);
    std::vector<double> intervals;
    for (std::size_t k = 1; k < count; ++k) {
      intervals.push_back(looked_at[k].time - looked_at[k - 1].time);
      longest_step = std::max(longest_step, norm(looked_at[k].position - looked_at[k - 1].position));
    }
    const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>((intervals.size() - 1) / 2);
    std::nth_element(intervals.begin(), middle, intervals.end());
    interval = *middle;
    velocity = (looked_at.back().position - looked_at.front().position) /
               (looked_at.back().time - looked_at.front().time);
  }

  /// Returns where the id is, or would be after its last sample.
  Vec3 place_at(double time) const {
    if (time >= last) return samples.back().position + velocity * (time - last);
    return place_in(samples, time);
  }
};

/// One that may go on as another.
struct Candidate {
  double distance;
  const TrackEnd *end, *begin;

  auto order() const { return std::tuple(distance, end->presence, begin->presence); }
};

/// Returns the length within which two ends are one body: half of the mean of their longest steps.
double allowance(const TrackEnd& end, const TrackEnd& begin) {
  return 0.25 * (end.longest_step + begin.longest_step);
}

/// Returns how far apart they are if one may go on as the other.
std::optional<double> distance_if_one(const TrackEnd& end, const TrackEnd& begin) {
  const bool follows = end.first < begin.first && end.last < begin.last;
  if (!follows) return std::nullopt;
  const double step = allowance(end, begin);
  double distance = norm(begin.samples.front().position - end.place_at(begin.first));
  if (begin.first < end.last && end.last < begin.samples.back().time)
    distance = std::max(distance, norm(end.samples.back().position - place_in(begin.samples, end.last)));
  const double turn = norm(begin.velocity - end.velocity) * end.interval;
  if (distance > step || turn > step) return std::nullopt;
  return distance;
}

/// True if a third body is as near to the place of the handover: then it may be of that one, or of none.
bool is_ambiguous(const Candidate& candidate, const TrackSet& track_set) {
  const TrackSample& at = candidate.begin->samples.front();
  const double near = allowance(*candidate.end, *candidate.begin);
  for (std::size_t number = 0; number < track_set.presences.size(); ++number) {
    if (number == candidate.end->presence || number == candidate.begin->presence) continue;
    const Presence& presence = track_set.presences[number];
    for (std::size_t k = 0; k < presence.tracks; ++k) {
      const auto& samples = track_set.tracks[presence.first_track + k].samples;
      const bool is_there = samples.front().time <= at.time && at.time <= samples.back().time;
      if (is_there && norm(place_in(samples, at.time) - at.position) <= near) return true;
    }
  }
  return false;
}

std::vector<Candidate> candidates_among(const std::vector<TrackEnd>& ends,
                                        const std::vector<TrackEnd>& begins, const TrackSet& track_set) {
  std::vector<Candidate> found;
  for (const TrackEnd& end : ends) {
    auto begin = std::lower_bound(begins.begin(), begins.end(), end.last - largest_overlap * end.interval,
                                  [](const TrackEnd& each, double time) { return each.first < time; });
    for (; begin != begins.end() && begin->first <= end.last + largest_gap * end.interval; ++begin) {
      if (begin->presence == end.presence) continue;
      const auto distance = distance_if_one(end, *begin);
      if (distance && !is_ambiguous({*distance, &end, &*begin}, track_set))
        found.push_back({*distance, &end, &*begin});
    }
  }
  std::sort(found.begin(), found.end(),
            [](const Candidate& a, const Candidate& b) { return a.order() < b.order(); });
  return found;
}

}  // namespace

std::vector<Handover> handovers_in(const TrackSet& track_set) {
  std::vector<TrackEnd> ends, begins;
  for (std::size_t number = 0; number < track_set.presences.size(); ++number) {
    const Presence& presence = track_set.presences[number];
    if (presence.tracks == 0) continue;
    const RecordedTrack* const first = &track_set.tracks[presence.first_track];
    if (first[presence.tracks - 1].samples.size() > steps_looked_at)
      ends.emplace_back(number, presence, track_set, false);
    if (first->samples.size() > steps_looked_at) begins.emplace_back(number, presence, track_set, true);
  }
  std::sort(begins.begin(), begins.end(),
            [](const TrackEnd& a, const TrackEnd& b) { return a.first < b.first; });
  std::vector<Handover> handovers;
  std::set<std::size_t> gone_on, begun;
  for (const Candidate& each : candidates_among(ends, begins, track_set)) {
    const std::size_t from = each.end->presence, to = each.begin->presence;
    if (gone_on.contains(from) || begun.contains(to)) continue;
    gone_on.insert(from);
    begun.insert(to);
    handovers.push_back({from, to, each.begin->first, each.distance});
  }
  std::sort(handovers.begin(), handovers.end(), [](const Handover& a, const Handover& b) {
    return std::tie(a.time, a.from) < std::tie(b.time, b.from);
  });
  return handovers;
}

std::size_t leave_out_handovers(std::vector<Approach>& approaches, const TrackSet& track_set) {
  std::set<std::pair<std::string_view, std::string_view>> pairs;
  for (const Handover& handover : track_set.handovers)
    pairs.insert(std::minmax<std::string_view>(track_set.presences[handover.from].id,
                                               track_set.presences[handover.to].id));
  if (pairs.empty()) return 0;
  return std::erase_if(approaches, [&](const Approach& approach) {
    return pairs.contains(std::minmax<std::string_view>(track_set.tracks[approach.first].id,
                                                        track_set.tracks[approach.second].id));
  });
}

}  // namespace kinesphere::program
