// Approaches by a cylinder.
#include "simulation/tracks/cylinder_approaches.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/oracle/gap_course.hpp"

namespace kinesphere {
namespace {

struct TimeSpan {
  double begin, end;
};

/// Returns the horizontal or the vertical part of a motion.
Trajectory part_of(Trajectory trajectory, bool vertical) {
  const auto keep = [vertical](Vec3& vector) {
    vector = vertical ? Vec3{0, 0, vector.z} : Vec3{vector.x, vector.y, 0};
  };
  for (Segment& segment : trajectory)
    for (Vec3* vector : {&segment.position, &segment.velocity, &segment.acceleration, &segment.jerk})
      keep(*vector);
  return trajectory;
}

/// Returns the spans from where a distance is at most `limit` and half the tolerance to where it is larger by
/// the tolerance. Rounding then does not decide about bodies that keep exactly the limit.
std::vector<TimeSpan> spans_within(const Trajectory& first, const Trajectory& second, double limit,
                                   double tolerance, double from, double to) {
  const GapCourse course(first, second, limit);
  std::vector<TimeSpan> spans;
  for (double now = from; now <= to;) {
    const auto begin = course.first_time(LevelCrossing::falls_to, 0.5 * tolerance, now, to);
    if (!begin) break;
    const auto end = course.first_time(LevelCrossing::rises_to, tolerance, *begin, to);
    spans.push_back({*begin, end.value_or(to)});
    if (!end) break;
    now = *end;
  }
  return spans;
}

/// Returns the spans in which one of each holds. Both are sorted and disjoint.
std::vector<TimeSpan> common_spans(const std::vector<TimeSpan>& a, const std::vector<TimeSpan>& b) {
  std::vector<TimeSpan> common;
  for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
    const TimeSpan both{std::max(a[i].begin, b[k].begin), std::min(a[i].end, b[k].end)};
    if (both.begin <= both.end) common.push_back(both);
    if (a[i].end < b[k].end) {
      ++i;
    } else {
      ++k;
    }
  }
  return common;
}

}  // namespace

CylinderEnclosure enclosure_of(const CylinderLimits& limits) {
  const double stretch = std::exp2(std::round(std::log2(limits.horizontal / limits.vertical)));
  return {stretch, std::hypot(limits.horizontal, limits.vertical * stretch)};
}

std::vector<Approach> approaches_within(const CylinderLimits& limits, const Motion& motion,
                                        const std::vector<Approach>& enclosing) {
  const double vertical_tolerance = limits.tolerance * (limits.vertical / limits.horizontal);
  std::vector<Approach> approaches;
  for (const Approach& sphere : enclosing) {
    const Trajectory first = motion.trajectory(sphere.first, sphere.begin, sphere.end);
    const Trajectory second = motion.trajectory(sphere.second, sphere.begin, sphere.end);
    const auto level = spans_within(part_of(first, false), part_of(second, false), limits.horizontal,
                                    limits.tolerance, sphere.begin, sphere.end);
    const auto upright = spans_within(part_of(first, true), part_of(second, true), limits.vertical,
                                      vertical_tolerance, sphere.begin, sphere.end);
    for (const TimeSpan& span : common_spans(level, upright)) {
      approaches.push_back({.first = sphere.first,
                            .second = sphere.second,
                            .begin = span.begin,
                            .end = span.end,
                            .begins_with_track = sphere.begins_with_track && span.begin == sphere.begin,
                            .ends_with_track = sphere.ends_with_track && span.end == sphere.end});
    }
  }
  std::stable_sort(approaches.begin(), approaches.end(),
                   [](const Approach& a, const Approach& b) { return a.begin < b.begin; });
  return approaches;
}

}  // namespace kinesphere
