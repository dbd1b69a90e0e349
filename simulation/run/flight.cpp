#include "simulation/run/flight.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace kinesphere {
namespace {

class FlightRecorder {
 public:
  explicit FlightRecorder(const Scene& scene)
      : scene_(scene), since_(scene.bodies.size(), scene.world.start_time) {
    flight_.paths.resize(scene.bodies.size());
  }

  Result<Flight> run(const DetectorMaker& make) {
    SceneObserver observer;
    observer.on_event = [this](const Event& event) {
      note_contact(event);
      note_path(event.first.index, event.time);
      if (event.second != no_body) note_path(event.second.index, event.time);
    };
    observer.at_end = [this](Detector&) -> Result<void> {
      for (std::uint32_t body = 0; body < since_.size(); ++body) note_path(body, scene_.end_time);
      return {};
    };
    auto result = run_scene(
        scene_,
        [&](const WorldDefinition& world, const Motion& motion) {
          motion_ = &motion;
          return make(world, motion);
        },
        observer);
    if (!result) return result.error();
    flight_.result = *result;
    return std::move(flight_);
  }

 private:
  /// Adds the path of a body up to an event. It is called before the event changes velocities.
  void note_path(std::uint32_t body, double until) {
    if (until <= since_[body]) return;
    for (Segment piece : motion_->trajectory(body, since_[body], until)) {
      piece.end = std::min(piece.end, until);
      flight_.paths[body].push_back(piece);
    }
    since_[body] = until;
  }

  void note_contact(const Event& event) {
    const bool wall = event.wall != Wall::none;
    const std::uint32_t first = event.first.index;
    const std::uint32_t second = wall ? first : event.second.index;
    if (event.already_touching) return;
    if (event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin) {
      const bool ends = wants_ends(scene_.world.contacts);
      open_[{first, second, event.wall}] = flight_.contacts.size();
      flight_.contacts.push_back({.first = first,
                                  .second = second,
                                  .wall = event.wall,
                                  .begin = event.time,
                                  .end = ends ? std::numeric_limits<double>::infinity() : event.time});
    } else if (event.kind == EventKind::contact_end || event.kind == EventKind::wall_end) {
      flight_.contacts[open_.at({first, second, event.wall})].end = event.time;
    }
  }

  const Scene& scene_;
  const Motion* motion_ = nullptr;  ///< the motion of the run
  std::vector<double> since_;       ///< by body: time up to which its path is noted
  std::map<std::tuple<std::uint32_t, std::uint32_t, Wall>, std::size_t> open_;  ///< last contact of each pair
  Flight flight_;
};

}  // namespace

Result<Flight> record_flight(const Scene& scene, const DetectorMaker& make) {
  return FlightRecorder(scene).run(make);
}

}  // namespace kinesphere
