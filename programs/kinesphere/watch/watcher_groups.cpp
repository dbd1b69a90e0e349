// Crowds of slow tracks that are watched as one.
#include "watch/watcher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace kinesphere::program {

/// Returns cells so small that two tracks in one are within the smallest separation, with room for errors.
TrackGroups::Cutting Watcher::cutting() const {
  TrackGroups::Cutting cutting{.edge = std::numeric_limits<double>::infinity()};
  constexpr double part = 0.25;
  double height = cutting.edge;
  for (const NamedSeparation& named : settings_.separations) {
    cutting.edge = std::min(cutting.edge, part * named.separation.horizontal);
    height = std::min(height, part * named.separation.vertical);
  }
  if (dimensions_ == 3) cutting.height = height;
  cutting.slow = cutting.edge / settings_.silence;
  constexpr double walking_pace = 1.0;  // metres per second
  if (is_geographic_) cutting.slow = std::min(cutting.slow, walking_pace);
  return cutting;
}

std::string Watcher::group_name(const TrackGroups::Cell& group) const {
  const Vec3 centre = groups_->centre_of(group);
  if (!frame_) return fmt::format("group at {:.6g},{:.6g},{:.6g}", centre.x, centre.y, centre.z);
  const Vec3 at = frame_->geographic(centre);
  return fmt::format("group at {:.5f},{:.5f},{:.0f}", at.y, at.x, at.z);
}

/// Returns true for a report of a track that is watched in a group. Then the track that stands for the group
/// gets it, as a report of the cell's centre with an error that reaches all of the cell.
bool Watcher::watch_as_group(const SourceReport& report, TrackId id, const TrackReport& on_map,
                             const NamedTrack& track) {
  if (report.id == settings_.own) return false;
  if (groups_->size() >= settings_.most_tracks && !groups_->contains(id)) return false;
  std::optional<double> speed;
  if (report.velocity) speed = norm(*report.velocity);
  const auto outcome = groups_->take(id, on_map.state.position, speed, on_map.timestamp);
  if (outcome.dissolved) end_group(*outcome.dissolved);
  if (!outcome.group) return false;
  if (outcome.is_new) begin_group(outcome);
  for (const TrackId member : outcome.joined)
    if (monitor_->contains(member)) remove(member, {"group"});
  if (!groups_->is_due(*outcome.group, on_map.timestamp, 0.5 * settings_.window)) {
    ++counts_.grouped;
    return true;
  }
  const auto [edge, height, slow] = groups_->cutting();
  TrackReport of_group = on_map;
  // Members may have several classes.
  of_group.track_class = 0;
  of_group.state = {groups_->centre_of(*outcome.group), {}};
  if (height == 0.0) of_group.state.position.z = on_map.state.position.z;
  of_group.position_error = on_map.position_error + ErrorBound::cylinder(std::sqrt(0.5) * edge, 0.5 * height);
  if (std::isfinite(on_map.velocity_error.total()))
    of_group.velocity_error = on_map.velocity_error + ErrorBound(slow);
  const std::string name = group_name(*outcome.group);
  const TrackId group_id = track_id_of(name);
  if (!monitor_->report(group_id, of_group)) return true;
  group_tracks_[group_id] = *outcome.group;
  NamedTrack* const known = names_.find(group_id);
  NamedTrack& named = known != nullptr ? *known : names_.add(group_id, name);
  named = track;
  named.motion_class = 0;
  named.text = name;
  named.stamp = report.stamp;
  named.position = report.position;
  named.rest.is_at_rest = rest_.speed > 0.0;
  return true;
}

void Watcher::begin_group(const TrackGroups::Outcome& outcome) {
  ++counts_.groups;
  const std::string name = group_name(*outcome.group);
  const TrackId id = track_id_of(name);
  if (!settings_.share.contains(id)) return;
  ++counts_.alerts;
  write(id, group_line(context(), monitor_->time(), name, outcome.joined.size()));
}

void Watcher::end_group(const TrackGroups::Cell& group) {
  const TrackId id = track_id_of(group_name(group));
  group_tracks_.erase(id);
  if (monitor_->contains(id)) remove(id, {"dissolved"});
}

}  // namespace kinesphere::program
