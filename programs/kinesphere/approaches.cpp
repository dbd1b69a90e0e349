// When which two bodies of a recording were close.
#include "approaches.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace kinesphere::program {
namespace {

Approach begun(const Scene& scene, const Event& event) {
  const SceneBody& first = scene.bodies[event.first.index];
  const SceneBody& second = scene.bodies[event.second.index];
  return {.first = event.first.index,
          .second = event.second.index,
          .begin = event.time,
          .end = std::min({first.vanishes, second.vanishes, scene.end_time}),
          .begins_with_track = event.time <= std::max(first.appears, second.appears),
          .ends_with_track = true};
}

}  // namespace

std::vector<Approach> approaches_in(const Scene& scene, const std::vector<Event>& events) {
  std::vector<Approach> approaches;
  std::map<std::pair<BodyId, BodyId>, std::size_t> last;
  for (const Event& event : events) {
    const std::pair bodies{event.first, event.second};
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

}  // namespace kinesphere::program
