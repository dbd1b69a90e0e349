#include "simulation/oracle/true_contacts.hpp"

#include <algorithm>
#include <optional>

#include "contact/contact_event.hpp"

namespace kinesphere {

TrueMotion::TrueMotion(const Scene& scene) : scene_(scene), rule_(scene.world) {
  trajectories_.resize(scene.bodies.size());
  present_.resize(scene.bodies.size());
  for (std::uint32_t number = 0; number < scene.bodies.size(); ++number) {
    const SceneBody& body = scene.bodies[number];
    const double from = std::max(body.appears, scene.world.start_time);
    const double to = std::min(body.vanishes, scene.end_time);
    if (!(from <= to) || body.vanishes <= scene.world.start_time) continue;
    trajectories_[number] = scene.motion->trajectory(number, from, to);
    const double error = scene.motion->definition(number, from).position_error;
    present_[number] = {&trajectories_[number], from, to, body.radius + error};
  }
}

GapCourse TrueMotion::pair(std::uint32_t first, std::uint32_t second) const {
  return {trajectories_[first], trajectories_[second], present_[first].radius + present_[second].radius};
}

GapCourse TrueMotion::wall(std::uint32_t body, Wall wall) const {
  return {trajectories_[body], half_space(*scene_.world.box, wall), present_[body].radius};
}

double TrueMotion::first_time(std::uint32_t a, std::uint32_t b) const {
  return std::max(present_[a].begin, present_[b].begin);
}

double TrueMotion::last_time(std::uint32_t a, std::uint32_t b) const {
  return std::min(present_[a].end, present_[b].end);
}

std::vector<ContactInterval> TrueMotion::contacts(const GapCourse& gap, std::uint32_t a, std::uint32_t b,
                                                  const std::vector<NearSpan>& spans) const {
  std::vector<ContactInterval> found;
  const double last = last_time(a, b);
  const bool one_vanishes = std::min(scene_.bodies[a].vanishes, scene_.bodies[b].vanishes) <= last;
  double now = first_time(a, b);
  // A body that vanishes at a time is removed before another is added at that time, so they do not touch.
  if (now > last || (now == last && one_vanishes)) return found;
  for (const NearSpan& span : spans) {
    now = std::max(now, span.begin);
    while (now <= std::min(span.end, last)) {
      const auto begin = gap.first_time(LevelCrossing::falls_to, 0.0, now, std::min(span.end, last));
      if (!begin) break;
      const auto end = gap.first_time(LevelCrossing::rises_to, rule_.separation_distance(), *begin, last);
      found.push_back({*begin, end ? *end : one_vanishes ? last : infinity});
      if (!end) return found;
      now = *end;
    }
  }
  return found;
}

NearSpan TrueMotion::whole_span(std::uint32_t a, std::uint32_t b) const {
  return {a, b, first_time(a, b), last_time(a, b)};
}

}  // namespace kinesphere
