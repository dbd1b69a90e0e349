// The classes of the tracks of a watch, and the choice of one for each report.
#include "watch/tracks/track_classes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace kinesphere::program {
namespace {

/// Time for which a status is not believed once a speed has contradicted it. Unit: seconds.
constexpr double disbelief = 300.0;

}  // namespace

std::size_t TrackClasses::add(const MotionClass& named) {
  for (std::size_t k = 1; k < classes_.size(); ++k)
    if (classes_[k].name == named.name) return k;
  classes_.push_back(named);
  return classes_.size() - 1;
}

void TrackClasses::begin(std::span<const MotionPreset> sayable) {
  if (has_begun_) return;
  has_begun_ = true;
  sayable_.assign(sayable.begin(), sayable.end());
  for (const MotionPreset preset : sayable_)
    automatic_[static_cast<std::size_t>(preset)] = add(motion_class(preset));
}

std::array<std::size_t, 3> TrackClasses::said(const SourceReport& report) const {
  const auto index = [&](const std::optional<MotionPreset>& preset) {
    return preset ? automatic_[static_cast<std::size_t>(*preset)] : 0;
  };
  return {report.ruled_class, index(report.said_status), index(report.said_kind)};
}

bool TrackClasses::allows(std::size_t index, const SourceReport& report, const NamedTrack* known) const {
  const MotionClass& each = classes_[index];
  if (!report.ground_speed) return !each.is_at_rest;
  const bool has_it = known != nullptr && known->declared.motion_class == index;
  if (*report.ground_speed > (has_it ? each.kept_up_to : each.given_up_to))
    return each.limits.largest_speed.horizontal() >= classes_[0].limits.largest_speed.horizontal();
  if (!each.is_at_rest || has_it || known == nullptr || !known->contradicted_rest) return true;
  return seconds_between(*known->contradicted_rest, report.stamp) > disbelief;
}

std::size_t TrackClasses::choose(const SourceReport& report, const NamedTrack* known) const {
  for (const std::size_t index : said(report))
    if (index != 0 && allows(index, report, known)) return index;
  return 0;
}

bool TrackClasses::contradicts_rest(const SourceReport& report) const {
  const auto all = said(report);
  return report.ground_speed && std::any_of(all.begin(), all.end(), [&](std::size_t index) {
           return classes_[index].is_at_rest && *report.ground_speed > classes_[index].kept_up_to;
         });
}

double TrackClasses::fastest() const {
  double fastest = 0.0;
  for (const MotionClass& each : classes_)
    fastest = std::max(fastest, each.limits.largest_speed.horizontal());
  return fastest;
}

std::string TrackClasses::promise(std::size_t index) const {
  const MotionClass& each = classes_[index];
  const std::string limits = promise_text(each.limits);
  return each.name.empty() ? limits : fmt::format("{} ({})", each.name, limits);
}

std::string TrackClasses::promise(std::size_t first, std::size_t second) const {
  if (first == second) return promise(first);
  return fmt::format("first: {}; second: {}", promise(first), promise(second));
}

}  // namespace kinesphere::program
