// What of a recording was looked at for approaches, and what was not.
#include "tracks/coverage.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace kinesphere::program {
namespace {

/// Part of the samples of an id above which their loss is told.
constexpr double thinned_part = 0.1;

/// A span of time in which a body of the choice, or another one, counts.
struct Stay {
  double from, until;
  bool is_chosen;
};

bool is_instant(const Stay& stay) { return stay.from == stay.until; }

/// How many bodies there are at each time, and what follows from that for pairs.
class Headcount {
 public:
  explicit Headcount(const std::vector<Stay>& stays) {
    std::vector<Change> changes;
    for (const Stay& stay : stays) {
      if (!(stay.from < stay.until)) continue;
      const double chosen = stay.is_chosen ? 1.0 : 0.0;
      changes.push_back({stay.from, 1.0, chosen});
      changes.push_back({stay.until, -1.0, -chosen});
    }
    std::sort(changes.begin(), changes.end(),
              [](const Change& a, const Change& b) { return a.time < b.time; });
    double all = 0.0, chosen = 0.0;
    for (const Change& change : changes) {
      Step next{change.time};
      if (!steps_.empty()) {
        const Step& last = steps_.back();
        const double duration = change.time - last.time, others = all - chosen;
        next.pair_time = last.pair_time + 0.5 * duration * (all * (all - 1.0) - others * (others - 1.0));
        next.all_time = last.all_time + duration * all;
        next.chosen_time = last.chosen_time + duration * chosen;
      }
      all += change.all;
      chosen += change.chosen;
      next.all = all;
      next.chosen = chosen;
      steps_.push_back(next);
    }
  }

  /// Seconds, summed over all pairs with a body of the choice.
  double pair_time() const { return steps_.empty() ? 0.0 : steps_.back().pair_time; }
  /// Seconds of the pairs of one body, which is there for the whole stay.
  double pair_time_of(const Stay& stay) const {
    const double alone = stay.until - stay.from;
    return stay.is_chosen ? all_time(stay.until) - all_time(stay.from) - alone
                          : chosen_time(stay.until) - chosen_time(stay.from);
  }

 private:
  struct Change {
    double time, all, chosen;
  };
  /// From `time` on there are so many bodies; the times are integrals until then.
  struct Step {
    double time = 0.0, all = 0.0, chosen = 0.0, pair_time = 0.0, all_time = 0.0, chosen_time = 0.0;
  };

  const Step& step_at(double time) const {
    const auto after = std::upper_bound(steps_.begin(), steps_.end(), time,
                                        [](double t, const Step& step) { return t < step.time; });
    return after == steps_.begin() ? *after : *(after - 1);
  }
  double all_time(double time) const {
    const Step& step = step_at(time);
    return step.all_time + (time - step.time) * step.all;
  }
  double chosen_time(double time) const {
    const Step& step = step_at(time);
    return step.chosen_time + (time - step.time) * step.chosen;
  }

  std::vector<Step> steps_;
};

/// An id within the window.
struct PresentBody {
  const Presence* presence;
  Stay stay;
  std::vector<Stay> looked_at;  ///< in order
  std::vector<Stay> holes;      ///< the rest of its stay
};

/// True if the two share more than the instant at which one ends and the other begins.
bool overlap(const Stay& a, const Stay& b) {
  if (is_instant(a) || is_instant(b)) return a.from <= b.until && b.from <= a.until;
  return a.from < b.until && b.from < a.until;
}

/// What a search of pairs needs of a body, in little memory.
struct PairedBody {
  Stay stay;
  const Stay *looked_at, *behind;  ///< in order
  bool has_holes;
};

bool are_looked_at(const PairedBody& a, const PairedBody& b) {
  const Stay *one = a.looked_at, *other = b.looked_at;
  while (one != a.behind && other != b.behind) {
    if (one->from < other->until && other->from < one->until) return true;
    if (one->until < other->until)
      ++one;
    else
      ++other;
  }
  return false;
}

std::vector<PresentBody> bodies_of(const TrackSet& track_set, const ApproachFilter& filter) {
  const TimeWindow& window = filter.asked();
  const auto cut = [&](double from, double until, bool is_chosen) {
    return Stay{std::max(from, window.from), std::min(until, window.until), is_chosen};
  };
  std::vector<PresentBody> bodies;
  for (const Presence& presence : track_set.presences) {
    const bool is_chosen = filter.wants(presence);
    PresentBody body{&presence, cut(presence.first, presence.last, is_chosen), {}, {}};
    const bool is_cut_to_instant = is_instant(body.stay) && presence.first < presence.last;
    if (body.stay.from > body.stay.until || is_cut_to_instant) continue;
    double until_now = body.stay.from;
    const auto add_hole = [&](double until) {
      if (until_now < until) body.holes.push_back({until_now, until, is_chosen});
    };
    for (std::size_t k = 0; k < presence.tracks; ++k) {
      const RecordedTrack& recorded = track_set.tracks[presence.first_track + k];
      const Stay track = cut(recorded.from(), recorded.until(), is_chosen);
      if (!(track.from < track.until)) continue;
      add_hole(track.from);
      until_now = track.until;
      body.looked_at.push_back(track);
    }
    add_hole(body.stay.until);
    bodies.push_back(std::move(body));
  }
  return bodies;
}

/// Counts the pairs that overlap. The stays are in the order of their begins.
std::uint64_t overlapping_pairs(const std::vector<Stay>& stays) {
  std::vector<double> begins, begins_of_spans;
  for (const Stay& stay : stays) {
    begins.push_back(stay.from);
    if (!is_instant(stay)) begins_of_spans.push_back(stay.from);
  }
  std::uint64_t pairs = 0;
  std::size_t number = 0;
  for (const Stay& stay : stays) {
    auto later = std::upper_bound(begins.begin(), begins.end(), stay.until) - begins.begin();
    if (!is_instant(stay)) {
      const auto at_end = std::equal_range(begins_of_spans.begin(), begins_of_spans.end(), stay.until);
      later -= at_end.second - at_end.first;
    }
    pairs += static_cast<std::uint64_t>(later) - ++number;
  }
  return pairs;
}

void add_pairs(Coverage& coverage, std::vector<PresentBody>& bodies) {
  constexpr std::size_t named = 3;
  std::stable_sort(bodies.begin(), bodies.end(),
                   [](const PresentBody& a, const PresentBody& b) { return a.stay.from < b.stay.from; });
  std::vector<Stay> all, others;
  for (const PresentBody& body : bodies) {
    all.push_back(body.stay);
    if (!body.stay.is_chosen) others.push_back(body.stay);
  }
  coverage.pairs = overlapping_pairs(all) - overlapping_pairs(others);
  std::vector<PairedBody> paired;
  for (const PresentBody& body : bodies) {
    const Stay* const first = body.looked_at.data();
    paired.push_back(
        {body.stay, first, first + body.looked_at.size(), body.looked_at.empty() || !body.holes.empty()});
  }
  for (std::size_t k = 0; k < paired.size(); ++k) {
    const PairedBody& one = paired[k];
    for (std::size_t later = k + 1; later < paired.size() && paired[later].stay.from <= one.stay.until;
         ++later) {
      const PairedBody& other = paired[later];
      if (!(one.has_holes || other.has_holes) || !(one.stay.is_chosen || other.stay.is_chosen)) continue;
      if (are_looked_at(one, other) || !overlap(one.stay, other.stay)) continue;
      if (coverage.pairs_never_looked_at++ < named)
        coverage.first_never_looked_at.emplace_back(bodies[k].presence->id, bodies[later].presence->id);
    }
  }
}

void add_times(Coverage& coverage, const std::vector<PresentBody>& bodies) {
  std::vector<Stay> stays, looked_at;
  for (const PresentBody& body : bodies) {
    stays.push_back(body.stay);
    looked_at.insert(looked_at.end(), body.looked_at.begin(), body.looked_at.end());
  }
  const Headcount present(stays);
  coverage.together = present.pair_time();
  coverage.looked_at = std::min(Headcount(looked_at).pair_time(), coverage.together);
  double most = 0.0;
  for (const PresentBody& body : bodies) {
    for (const Stay& hole : body.holes) {
      const double cost = present.pair_time_of(hole);
      // A body that is alone costs nothing but rounding.
      if (cost <= std::max(most, 1e-9 * (hole.until - hole.from))) continue;
      most = cost;
      coverage.largest = {body.presence->id, hole.from, hole.until};
    }
  }
}

void add_lost_samples(Coverage& coverage, const TrackSet& track_set, const ApproachFilter& filter) {
  for (const Presence& presence : track_set.presences) {
    const LostSamples lost{presence.id, presence.samples - presence.used, presence.samples};
    if (lost.lost == 0 || !filter.wants(presence)) continue;
    if (presence.used == 0)
      coverage.without_track.push_back(lost);
    else if (static_cast<double>(lost.lost) >= thinned_part * static_cast<double>(lost.samples))
      coverage.thinned.push_back(lost);
  }
  std::stable_sort(coverage.thinned.begin(), coverage.thinned.end(),
                   [](const LostSamples& a, const LostSamples& b) {
                     return static_cast<double>(a.lost) * static_cast<double>(b.samples) >
                            static_cast<double>(b.lost) * static_cast<double>(a.samples);
                   });
}

}  // namespace

Coverage coverage_of(const TrackSet& track_set, const ApproachFilter& filter) {
  Coverage coverage;
  add_lost_samples(coverage, track_set, filter);
  std::vector<PresentBody> bodies = bodies_of(track_set, filter);
  add_times(coverage, bodies);
  add_pairs(coverage, bodies);
  return coverage;
}

}  // namespace kinesphere::program
