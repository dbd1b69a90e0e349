// Says what of a recording was not looked at.
#include "tracks/coverage_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>

#include "base/escaped_text.hpp"
#include "tracks/track_cells.hpp"

namespace kinesphere::program {
namespace {

/// Part of the time of all pairs above which a warning tells that it was not looked at.
constexpr double much_time = 0.03;

/// Returns the texts of the first items, and how many more there are.
template <class Items, class Text>
std::string first_of(const Items& items, std::size_t count, Text text) {
  constexpr std::size_t most = 3;
  std::string all;
  for (std::size_t k = 0; k < std::min(most, items.size()); ++k)
    all += fmt::format("{}{}", k == 0 ? "" : ", ", text(items[k]));
  return count > most ? fmt::format("{} and {} more", all, grouped(count - most)) : all;
}

std::string ids_text(const std::vector<LostSamples>& ids) {
  return first_of(ids, ids.size(), [](const LostSamples& lost) { return fmt::format("'{}'", lost.id); });
}

std::string thinned_text(const std::vector<LostSamples>& ids) {
  return first_of(ids, ids.size(), [](const LostSamples& lost) {
    return fmt::format("'{}' {} of {}", lost.id, grouped(lost.lost), grouped(lost.samples));
  });
}

std::string pairs_text(const Coverage& coverage) {
  return first_of(coverage.first_never_looked_at, coverage.pairs_never_looked_at,
                  [](const auto& pair) { return fmt::format("'{}' and '{}'", pair.first, pair.second); });
}

std::string hole_text(const Hole& hole, const TrackSet& track_set) {
  return fmt::format("id '{}' from {} to {}", hole.id, track_set.times.text(hole.from, 6),
                     track_set.times.text(hole.until, 6));
}

std::string handovers_text(const TrackSet& track_set) {
  return first_of(track_set.handovers, track_set.handovers.size(), [&](const Handover& handover) {
    return fmt::format("'{}' goes on as '{}' at {}", track_set.presences[handover.from].id,
                       track_set.presences[handover.to].id, track_set.times.text(handover.time, 6));
  });
}

std::string vanishing_text(const Vanishing& vanishing, const TrackSet& track_set) {
  return fmt::format("'{}' {} {}, '{}' {} from there at {}", vanishing.id,
                     vanishing.has_appeared ? "appears at" : "vanishes at",
                     track_set.times.text(vanishing.time, 6), vanishing.other, number(vanishing.distance),
                     track_set.times.text(vanishing.other_time, 6));
}

std::string vanishings_text(const std::vector<Vanishing>& vanishings, const TrackSet& track_set) {
  constexpr std::size_t most = 2;
  std::string text;
  for (std::size_t k = 0; k < std::min(most, vanishings.size()); ++k)
    text += fmt::format("{}{}", k == 0 ? "" : "; ", vanishing_text(vanishings[k], track_set));
  return vanishings.size() > most ? fmt::format("{}; and {} more", text, grouped(vanishings.size() - most))
                                  : text;
}

template <class Items, class Text>
std::string json_array(const Items& items, Text text) {
  std::string all;
  for (const auto& item : items) all += fmt::format("{}{}", all.empty() ? "" : ", ", text(item));
  return "[" + all + "]";
}

std::string json_of(const LostSamples& lost) {
  return fmt::format(R"({{"id": {}, "lost": {}, "samples": {}}})", json_text(lost.id), lost.lost,
                     lost.samples);
}

}  // namespace

void add_coverage(Summary& summary, const Coverage& coverage, const TrackSet& track_set) {
  if (!coverage.without_track.empty())
    summary.row("without a track", grouped(coverage.without_track.size()),
                fmt::format("ids, all of whose samples are left out: {}", ids_text(coverage.without_track)));
  if (!coverage.thinned.empty())
    summary.row(
        "thinned", grouped(coverage.thinned.size()),
        fmt::format("ids that lost a tenth of their samples or more: {}", thinned_text(coverage.thinned)));
  if (coverage.not_looked_at() > 0.0)
    summary.row("not looked at", fmt::format("{} s", number(coverage.not_looked_at())),
                fmt::format("of the {} s that pairs are there together ({}), most of it for {}",
                            number(coverage.together), percent(coverage.not_looked_at(), coverage.together),
                            hole_text(coverage.largest, track_set)));
  if (coverage.pairs_never_looked_at > 0)
    summary.row("pairs", grouped(coverage.pairs_never_looked_at),
                fmt::format("of {} that are there together were never looked at: {}", grouped(coverage.pairs),
                            pairs_text(coverage)));
}

void add_handovers(Summary& summary, const TrackSet& track_set, std::size_t left_out) {
  if (track_set.handovers.empty()) return;
  summary.row(
      "one body", grouped(track_set.handovers.size()),
      fmt::format("ids that begin where and when another ends: {}; approaches of the two are left out: {}",
                  handovers_text(track_set), grouped(left_out)));
}

std::string warning_of_handovers(const TrackSet& track_set, std::size_t left_out) {
  return fmt::format(
      "{} approaches are left out, as of one body under two ids, of which one begins where and when the "
      "other ends: {}: --count-handovers counts them, and --same A=B makes two ids one body",
      grouped(left_out), handovers_text(track_set));
}

std::string json_of_handovers(const TrackSet& track_set, std::size_t left_out) {
  const auto json_handover = [&](const Handover& handover) {
    return fmt::format(
        R"({{"from": {}, "to": {}, "at": {}}})", json_text(track_set.presences[handover.from].id),
        json_text(track_set.presences[handover.to].id), json_of_time(track_set.times, handover.time));
  };
  return fmt::format(R"("handovers": {}, "left_out_by_handover": {})",
                     json_array(track_set.handovers, json_handover), left_out);
}

void add_vanishings(Summary& summary, const std::vector<Vanishing>& vanishings, const TrackSet& track_set) {
  if (vanishings.empty()) return;
  summary.row("outside", grouped(vanishings.size()),
              fmt::format("first or last samples near which another is when their id is not there: {}",
                          vanishings_text(vanishings, track_set)));
}

std::vector<std::string> warnings_of(const std::vector<Vanishing>& vanishings, const TrackSet& track_set) {
  if (vanishings.empty()) return {};
  return {
      fmt::format("near {} first or last samples there is another body when their id is not there: {}: "
                  "--outside stay or go-on looks for such approaches",
                  grouped(vanishings.size()), vanishings_text(vanishings, track_set))};
}

std::vector<std::string> warnings_of(const Coverage& coverage, const TrackSet& track_set, bool found_none) {
  std::vector<std::string> warnings;
  if (!coverage.without_track.empty())
    warnings.push_back(fmt::format("{} of {} ids have no track, as all of their samples are left out: {}",
                                   grouped(coverage.without_track.size()),
                                   grouped(track_set.presences.size()), ids_text(coverage.without_track)));
  if (coverage.pairs_never_looked_at > 0)
    warnings.push_back(fmt::format("{} of {} pairs that are there together were never looked at: {}",
                                   grouped(coverage.pairs_never_looked_at), grouped(coverage.pairs),
                                   pairs_text(coverage)));
  const double lost = coverage.not_looked_at();
  if (lost > much_time * coverage.together || (found_none && lost > 0.0))
    warnings.push_back(fmt::format(
        "approaches were not looked for in {} s of the {} s that pairs are there together ({}), most "
        "of it for {}: a longer --max-gap looks there, and --plan where rows are waypoints",
        number(lost), number(coverage.together), percent(lost, coverage.together),
        hole_text(coverage.largest, track_set)));
  return warnings;
}

std::string json_members_of(const Coverage& coverage, const TrackSet& track_set) {
  const auto json_id = [](const LostSamples& lost) { return json_text(lost.id); };
  const auto json_pair = [](const auto& pair) {
    return fmt::format("[{}, {}]", json_text(pair.first), json_text(pair.second));
  };
  const Hole& hole = coverage.largest;
  const std::string largest =
      hole.from < hole.until
          ? fmt::format(R"({{"id": {}, "from": {}, "until": {}}})", json_text(hole.id),
                        json_of_time(track_set.times, hole.from), json_of_time(track_set.times, hole.until))
          : "null";
  return fmt::format(
      R"("ids_without_track": {}, "ids_thinned": {}, "pairs": {}, "pairs_never_looked_at": {}, )"
      R"("first_never_looked_at": {}, "together_s": {}, "not_looked_at_s": {}, "largest_hole": {})",
      json_array(coverage.without_track, json_id), json_array(coverage.thinned, json_of), coverage.pairs,
      coverage.pairs_never_looked_at, json_array(coverage.first_never_looked_at, json_pair),
      coverage.together, coverage.not_looked_at(), largest);
}

std::string json_members_of(const std::vector<Vanishing>& vanishings, const TrackSet& track_set) {
  constexpr std::size_t most = 10;
  const std::vector<Vanishing> first(
      vanishings.begin(),
      vanishings.begin() + static_cast<std::ptrdiff_t>(std::min(most, vanishings.size())));
  return fmt::format(R"("near_ends": {}, "closest_near_ends": {})", vanishings.size(),
                     json_array(first, [&](const Vanishing& each) {
                       return fmt::format(
                           R"({{"id": {}, "{}": {}, "other": {}, "other_at": {}, "distance": {}}})",
                           json_text(each.id), each.has_appeared ? "appears" : "vanishes",
                           json_of_time(track_set.times, each.time), json_text(each.other),
                           json_of_time(track_set.times, each.other_time), each.distance);
                     }));
}

}  // namespace kinesphere::program
