#include "research/measures/game_loop.hpp"

#include <algorithm>
#include <deque>
#include <utility>
#include <vector>

#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/placement.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/response.hpp"
#include "kinesphere/simulation.hpp"
#include "research/measures/room.hpp"

namespace kinesphere {
namespace {

constexpr double frames_per_second = 60.0;
constexpr double ball_radius = 0.5;
constexpr double ball_speed = 5.0;  ///< of the fastest balls (length / time)
constexpr double bullet_radius = 0.05;
constexpr double bullet_speed = 100.0;
constexpr std::uint32_t frames_between_bullets = 6;
constexpr std::size_t most_bullets = 10;
constexpr std::uint32_t spawned_in_a_frame = 2;
constexpr std::size_t most_spawned = 100;
constexpr std::size_t blown_away = 500;
constexpr double blast_speed = 20.0;

class Game {
 public:
  Game(const GameLoopSettings& settings, double edge)
      : settings_(settings),
        room_{{0, 0, 0}, {edge, edge, edge}},
        random_(settings.seed),
        simulation_(World::create({.box = room_,
                                   .contact_tolerance = 1e-3,
                                   .contacts = ContactEvents::impacts,
                                   .spread_window_starts = settings.spread_window_starts})
                        .value()) {
    const std::vector<double> radii(settings.bodies, ball_radius);
    std::vector<State> start;
    for (const Vec3& centre : place_spheres(radii, room_, {.seed = settings.seed}).value())
      start.push_back({centre, ball_speed * random_.point_in_ball()});
    flight_ = simulation_.add_motion(Ballistic::create({.start = start, .gravity = {}}).value());
    balls_ = simulation_.add_all(flight_, {.radius = ball_radius}).value();
  }

  void play_frame(std::uint32_t frame) {
    if (settings_.eventful) {
      if (frame % frames_between_bullets == 0)
        spawn(bullets_, most_bullets, bullet_radius, 8.0, bullet_speed * random_.unit_vector());
      for (std::uint32_t k = 0; k < spawned_in_a_frame; ++k)
        spawn(spawned_, most_spawned, ball_radius, 1.0, ball_speed * random_.point_in_ball());
      if (frame == settings_.frames / 2) explode();
    }
    for (const Event& event : simulation_.events((frame + 1) / frames_per_second)) {
      if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) continue;
      const Bounce after = bounce(event, 1.0);
      simulation_.set_velocity(event.first, after.first_velocity).value();
      if (event.second != no_body) simulation_.set_velocity(event.second, after.second_velocity).value();
    }
  }

  const Counters& counters() const { return simulation_.world().counters(); }

 private:
  /// Adds a body at a random place, and removes the oldest of its kind if there are more than `most`.
  void spawn(std::deque<BodyId>& kind, std::size_t most, double radius, double mass, const Vec3& velocity) {
    Vec3 place;
    for (int axis = 0; axis < 3; ++axis) place[axis] = random_.uniform(radius, room_.upper[axis] - radius);
    const std::uint32_t number =
        simulation_.motion(flight_).add(simulation_.world().time(), {place, velocity}).value();
    kind.push_back(simulation_.add(flight_, number, {.radius = radius, .mass = mass}).value());
    if (kind.size() <= most) return;
    simulation_.remove(kind.front()).value();
    kind.pop_front();
  }

  /// Gives the balls nearest to the centre of the room velocities away from it.
  void explode() {
    const Vec3 centre = 0.5 * room_.upper;
    const double now = simulation_.world().time();
    std::vector<std::pair<double, std::size_t>> distances;
    for (std::size_t k = 0; k < balls_.size(); ++k)
      distances.push_back({norm(simulation_.state(balls_[k], now).position - centre), k});
    std::sort(distances.begin(), distances.end());
    distances.resize(std::min(distances.size(), blown_away));
    for (const auto& [distance, k] : distances) {
      const Vec3 away = simulation_.state(balls_[k], now).position - centre;
      if (distance > 0.0) simulation_.set_velocity(balls_[k], away * (blast_speed / distance)).value();
    }
  }

  const GameLoopSettings settings_;
  const Box room_;
  Random random_;
  Simulation simulation_;
  MotionId<Ballistic> flight_;
  std::vector<BodyId> balls_;
  std::deque<BodyId> bullets_;
  std::deque<BodyId> spawned_;
};

}  // namespace

void play_game(const GameLoopSettings& settings, const std::function<void(const Counters&)>& visit) {
  Game game(settings, edge_of_room(settings.bodies, ball_radius, settings.packing));
  visit(game.counters());
  for (std::uint32_t frame = 0; frame < settings.frames; ++frame) {
    game.play_frame(frame);
    visit(game.counters());
  }
}

double estimated_work(const Counters& work) {
  // Of a steady game of 10,000 balls, 3 % filled, under callgrind. Starts and restarts have their searches,
  // and checks their probes.
  constexpr double start = 3.2;
  constexpr double restart = 5.2;
  constexpr double check = 2.8;
  constexpr double event = 1.2;
  double events = 0.0;
  for (const std::uint64_t count : work.events) events += static_cast<double>(count);
  return start * static_cast<double>(work.starts) + restart * static_cast<double>(work.restarts) +
         check * static_cast<double>(work.pair_checks + work.wall_checks) + event * events;
}

}  // namespace kinesphere
