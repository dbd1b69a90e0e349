#include "watch/monitor/track_groups.hpp"
#include "formats/fields/wrong_input.hpp"

#include <cmath>
#include <limits>

namespace kinesphere::program {

Vec3 TrackGroups::centre_of(const Cell& cell) const {
  const auto middle = [](std::int64_t index, double edge) {
    return (static_cast<double>(index) + 0.5) * edge;
  };
  return {middle(cell[0], cutting_.edge), middle(cell[1], cutting_.edge), middle(cell[2], cutting_.height)};
}

/// Returns nothing for a position so far off that its cell has no number.
std::optional<TrackGroups::Cell> TrackGroups::cell_of(const Vec3& position) const {
  constexpr double most = 0x1p53;
  const double parts[] = {position.x / cutting_.edge, position.y / cutting_.edge,
                          cutting_.height > 0.0 ? position.z / cutting_.height : 0.0};
  Cell cell;
  for (std::size_t k = 0; k < cell.size(); ++k) {
    if (!(std::abs(parts[k]) < most)) return std::nullopt;
    cell[k] = static_cast<std::int64_t>(std::floor(parts[k]));
  }
  return cell;
}

TrackGroups::Outcome TrackGroups::take(TrackId track, const Vec3& position,
                                       const std::optional<double>& speed, double time) {
  Outcome outcome;
  const std::optional<Cell> cell = cell_of(position);
  const auto known = standing_.find(track);
  const bool was_here = known != standing_.end() && cell && known->second.cell == *cell;
  const auto is_latest = [&] {
    const auto place = places_.find(*cell);
    return place == places_.end() || place->second.latest == position;
  };
  const bool stands = cell && (speed ? *speed <= cutting_.slow : was_here || is_latest());
  if (known != standing_.end() && (!stands || !was_here)) outcome.dissolved = leave(track);
  if (!stands) return outcome;
  Place& here = places_[*cell];
  here.latest = position;
  standing_[track] = {*cell, time};
  const bool is_added = here.tracks.insert(track).second;
  if (!here.is_group && here.tracks.size() < least_members) return outcome;
  outcome.group = cell;
  if (here.is_group) {
    if (is_added) outcome.joined = {track};
    return outcome;
  }
  here.is_group = outcome.is_new = true;
  here.reported = -std::numeric_limits<double>::infinity();
  outcome.joined.assign(here.tracks.begin(), here.tracks.end());
  return outcome;
}

bool TrackGroups::is_due(const Cell& group, double time, double period) {
  Place& place = places_.at(group);
  if (time < place.reported + period) return false;
  place.reported = time;
  return true;
}

/// Removes a standing track from its cell. Returns the cell if it was a group and is none any more.
std::optional<TrackGroups::Cell> TrackGroups::leave(TrackId track) {
  const auto known = standing_.find(track);
  const Cell cell = known->second.cell;
  standing_.erase(known);
  const auto at = places_.find(cell);
  Place& place = at->second;
  place.tracks.erase(track);
  if (place.is_group && place.tracks.size() < least_members / 2) {
    dissolve(cell);
    return cell;
  }
  if (place.tracks.empty()) places_.erase(at);
  return std::nullopt;
}

void TrackGroups::dissolve(const Cell& group) {
  const auto at = places_.find(group);
  for (const TrackId track : at->second.tracks) standing_.erase(track);
  places_.erase(at);
}

std::vector<TrackGroups::Cell> TrackGroups::forget_before(double time) {
  std::vector<TrackId> old;
  for (const auto& [track, standing] : standing_)
    if (standing.time < time) old.push_back(track);
  std::vector<Cell> dissolved;
  for (const TrackId track : old)
    // A group that has been dissolved has left none of its members.
    if (standing_.contains(track))
      if (const auto cell = leave(track)) dissolved.push_back(*cell);
  return dissolved;
}

void TrackGroups::check() const {
  std::size_t tracks = 0;
  bool is_sound = true;
  for (const auto& [cell, place] : places_) {
    tracks += place.tracks.size();
    for (const TrackId track : place.tracks) {
      const auto standing = standing_.find(track);
      is_sound = is_sound && standing != standing_.end() && standing->second.cell == cell;
    }
  }
  if (!is_sound || tracks != standing_.size())
    throw WrongInput("expected each track that stands at one place in the snapshot");
}

}  // namespace kinesphere::program
