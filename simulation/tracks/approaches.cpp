// Approaches of recorded tracks: times and closest points.
#include "simulation/tracks/approaches.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "simulation/oracle/gap_course.hpp"

namespace kinesphere {
namespace {

Approach begun(const Scene& scene, const Event& event) {
  const SceneBody& first = scene.bodies[event.first.index];
  const SceneBody& second = scene.bodies[event.second.index];
  return {
      .first = event.first.index,
      .second = event.second.index,
      .begin = event.time,
      .end = std::min({first.vanishes, second.vanishes, scene.end_time}),
      .begins_with_track = event.time <= std::max({first.appears, second.appears, scene.world.start_time}),
      .ends_with_track = true};
}

/// The curves of two tracks during an approach.
class ApproachCourse {
 public:
  ApproachCourse(const Motion& motion, const Approach& approach, const std::vector<double>& radii)
      : approach_(approach),
        radii_(radii.empty() ? 0.0 : radii[approach.first] + radii[approach.second]),
        first_(motion.trajectory(approach.first, approach.begin, approach.end)),
        second_(motion.trajectory(approach.second, approach.begin, approach.end)) {}

  ClosestApproach closest() const {
    const GapCourse::Least least = GapCourse(first_, second_, radii_).least(approach_.begin, approach_.end);
    return minimum(least.time, least.gap).closest;
  }

  std::vector<DistanceMinimum> minima() const {
    std::vector<DistanceMinimum> result;
    for (const auto& each : GapCourse(first_, second_, radii_).minima(approach_.begin, approach_.end)) {
      const bool is_cut_off = (each.time == approach_.begin && approach_.begins_with_track) ||
                              (each.time == approach_.end && approach_.ends_with_track);
      result.push_back(minimum(each.time, each.gap));
      result.back().is_cut_off = each.is_at_end && is_cut_off;
    }
    return result;
  }

 private:
  DistanceMinimum minimum(double time, double distance) const {
    const State a = segment_at(first_, time).state_at(time);
    const State b = segment_at(second_, time).state_at(time);
    return {.closest = {.time = time,
                        .distance = distance,
                        .first = a.position,
                        .second = b.position,
                        .relative_speed = norm(a.velocity - b.velocity)},
            .first_velocity = a.velocity,
            .second_velocity = b.velocity};
  }

  const Approach& approach_;
  double radii_;
  Trajectory first_, second_;
};

}  // namespace

std::vector<Approach> approaches_in(const Scene& scene, const std::vector<Event>& events) {
  std::vector<Approach> approaches;
  std::map<std::pair<BodyId, BodyId>, std::size_t> last;
  for (const Event& event : events) {
    const std::pair bodies{event.first, event.second};
    if (event.already_touching) continue;
    if (event.kind == EventKind::contact_begin) {
      last[bodies] = approaches.size();
      approaches.push_back(begun(scene, event));
    } else if (const auto found = last.find(bodies);
               event.kind == EventKind::contact_end && found != last.end()) {
      Approach& approach = approaches[found->second];
      approach.ends_with_track = event.time >= approach.end;
      approach.end = event.time;
    }
  }
  return approaches;
}

void find_closest(const Motion& motion, std::vector<Approach>& approaches, const std::vector<double>& radii) {
  for (Approach& approach : approaches) approach.closest = ApproachCourse(motion, approach, radii).closest();
}

std::vector<DistanceMinimum> minima_in(const Motion& motion, const std::vector<Approach>& approaches,
                                       const std::vector<double>& radii) {
  std::vector<DistanceMinimum> all;
  for (std::size_t k = 0; k < approaches.size(); ++k) {
    for (DistanceMinimum& minimum : ApproachCourse(motion, approaches[k], radii).minima()) {
      minimum.approach = k;
      all.push_back(minimum);
    }
  }
  return all;
}

std::vector<std::size_t> closest_of(const std::vector<Approach>& approaches, std::size_t most) {
  std::vector<std::size_t> order(approaches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto closer = [&](std::size_t a, std::size_t b) {
    const double difference = approaches[a].closest.distance - approaches[b].closest.distance;
    return difference != 0.0 ? difference < 0.0 : a < b;
  };
  const auto shown = static_cast<std::ptrdiff_t>(std::min(most, order.size()));
  std::partial_sort(order.begin(), order.begin() + shown, order.end(), closer);
  order.resize(static_cast<std::size_t>(shown));
  return order;
}

}  // namespace kinesphere
