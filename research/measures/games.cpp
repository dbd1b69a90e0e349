#include "research/measures/games.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <deque>
#include <utility>
#include <vector>

#include "kinesphere/event_hash.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/placement.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/response.hpp"
#include "kinesphere/simulation.hpp"

namespace kinesphere {
namespace {

/// Returns the edge of a cubic room of which balls of this radius fill the part `packing`, to within 2^-20 of
/// it. Found by bisection, as cube roots differ between machines in their last bits.
double edge_of_room(std::uint32_t balls, double radius, double packing) {
  const double volume_of_ball = 4.0 / 3.0 * 3.14159265358979323846 * radius * radius * radius;
  const double volume = balls * volume_of_ball / packing;
  double low = 0.0;
  double high = std::max(volume, 1.0);
  while (high - low > 0x1p-20 * high) {
    const double middle = 0.5 * (low + high);
    (middle * middle * middle < volume ? low : high) = middle;
  }
  return high;
}

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
        simulation_(
            World::create({.box = room_, .contact_tolerance = 1e-3, .contacts = ContactEvents::impacts})
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
      distances.emplace_back(norm(simulation_.state(balls_[k], now).position - centre), k);
    std::sort(distances.begin(), distances.end());
    distances.resize(std::min(distances.size(), blown_away));
    for (const auto& [distance, k] : distances) {
      const Vec3 away = simulation_.state(balls_[k], now).position - centre;
      if (distance > 0.0) simulation_.set_velocity(balls_[k], away * (blast_speed / distance)).value();
    }
  }

  GameLoopSettings settings_;
  Box room_;
  Random random_;
  Simulation simulation_;
  MotionId<Ballistic> flight_;
  std::vector<BodyId> balls_;
  std::deque<BodyId> bullets_;
  std::deque<BodyId> spawned_;
};

/// What bodies are: their user data, and the bit of their category.
enum Kind : std::uint64_t { ball, rock, bullet, fragment };

constexpr std::uint32_t rock_of_balls = 16;
constexpr std::uint32_t balls_of_bullet = 2500;  ///< a bullet in each frame for so many balls
constexpr int fragments_of_rock = 4;

struct Kit {
  double radius;
  std::uint64_t meets;  ///< bits of kinds
  double mass;
};
constexpr Kit kits[] = {
    {ball_radius, 15, 1.0}, {ball_radius, 15, 1.0}, {bullet_radius, 3, 8.0}, {0.1, 3, 0.1}};

Response respond_in_shooting(const Event& event) {
  if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) return {};
  const bool meets_wall = event.second == no_body;
  const auto first = static_cast<Kind>(event.first_user_data),
             second = static_cast<Kind>(event.second_user_data);
  const auto is = [&](Kind kind) { return first == kind || (!meets_wall && second == kind); };
  Response response;
  if (is(bullet)) {
    response.first_action = BodyAction::remove;
    if (!meets_wall) response.second_action = BodyAction::remove;
    response.stop = is(rock);
  } else if (is(fragment)) {
    (first == fragment ? response.first_action : response.second_action) = BodyAction::remove;
  } else {
    response = response_of(event, bounce(event, 1.0));
  }
  return response;
}

class ShootingGame {
 public:
  explicit ShootingGame(const ShootingSettings& settings)
      : settings_(settings),
        edge_(edge_of_room(settings.bodies, ball_radius, settings.packing)),
        random_(settings.seed),
        simulation_(World::create({.box = Box{{0, 0, 0}, {edge_, edge_, edge_}},
                                   .contact_tolerance = 1e-3,
                                   .contacts = ContactEvents::impacts})
                        .value()),
        flight_(simulation_.add_motion(Ballistic::create({}).value())) {
    const std::vector<double> radii(settings.bodies, ball_radius);
    std::uint32_t number = 0;
    for (const Vec3& centre :
         place_spheres(radii, Box{{0, 0, 0}, {edge_, edge_, edge_}}, {.seed = settings.seed}).value())
      add(number++ % rock_of_balls == 0 ? rock : ball, {centre, ball_speed * random_.point_in_ball()});
  }

  /// Calls advance(time) for each frame; it must call receive() with each event.
  template <class Advance>
  ShootingResult play(const Advance& advance) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    const std::clock_t cpu_begin = std::clock();
    for (std::uint32_t frame = 1; frame <= settings_.frames; ++frame) {
      for (std::uint32_t k = 0; k <= settings_.bodies / balls_of_bullet; ++k)
        add(bullet, {anywhere(), bullet_speed * random_.unit_vector()});
      for (; vanished_ > 0; --vanished_) add(ball, {anywhere(), ball_speed * random_.point_in_ball()});
      advance(frame / frames_per_second);
    }
    result_.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    result_.cpu_seconds = static_cast<double>(std::clock() - cpu_begin) / CLOCKS_PER_SEC;
    result_.hash = hash_.value();
    return result_;
  }

  void receive(const Event& event) {
    hash_.add(event);
    ++result_.events;
    const Response response = respond_in_shooting(event);
    if (response.second_action == BodyAction::remove && event.second_user_data == ball) ++vanished_;
    if (response.first_action == BodyAction::remove && event.first_user_data == ball) ++vanished_;
    if (!response.stop) return;
    for (int k = 0; k < fragments_of_rock; ++k)
      add(fragment, {event.point, 2 * ball_speed * random_.unit_vector()});
    add(rock, {anywhere(), {}});
  }

  Simulation& simulation() { return simulation_; }

 private:
  void add(Kind kind, const State& state) {
    const Kit& kit = kits[kind];
    const std::uint32_t number = simulation_.motion(flight_).add(simulation_.world().time(), state).value();
    simulation_
        .add(flight_, number,
             {.radius = kit.radius,
              .filter = {.category = std::uint64_t{1} << kind, .mask = kit.meets},
              .user_data = kind,
              .mass = kit.mass})
        .value();
  }
  Vec3 anywhere() {
    Vec3 place;
    for (int axis = 0; axis < 3; ++axis) place[axis] = random_.uniform(ball_radius, edge_ - ball_radius);
    return place;
  }

  ShootingSettings settings_;
  double edge_;
  Random random_;
  Simulation simulation_;
  MotionId<Ballistic> flight_;
  ShootingResult result_;
  EventHash hash_;
  std::uint32_t vanished_ = 0;  ///< balls, without rocks, since the last frame
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
  // Of the scene gas under callgrind. Starts have their searches, restarts the scans of their neighbours,
  // and checks their probes.
  constexpr double start = 7.9;
  constexpr double restart = 1.9;
  constexpr double check = 2.4;
  constexpr double event = 2.5;
  double events = 0.0;
  for (const std::uint64_t count : work.events) events += static_cast<double>(count);
  return start * static_cast<double>(work.starts) + restart * static_cast<double>(work.restarts) +
         check * static_cast<double>(work.pair_checks + work.wall_checks) + event * events;
}

ShootingResult run_shooting(const ShootingSettings& settings, Workers* workers) {
  ShootingGame game(settings);
  const auto receive = [&](const Event& event) { game.receive(event); };
  return game.play(
      [&](double time) { game.simulation().run(time, respond_in_shooting, receive, workers).value(); });
}

ShootingResult loop_shooting(const ShootingSettings& settings) {
  ShootingGame game(settings);
  Simulation& simulation = game.simulation();
  return game.play([&](double time) {
    for (const Event& event : simulation.events(time)) {
      const Response response = respond_in_shooting(event);
      const auto apply = [&](BodyId body, const std::optional<Vec3>& velocity, BodyAction action) {
        if (body == no_body || !simulation.world().contains(body)) return;
        if (velocity) simulation.set_velocity(body, *velocity).value();
        if (action == BodyAction::remove) simulation.remove(body).value();
      };
      apply(event.first, response.first_velocity, response.first_action);
      apply(event.second, response.second_velocity, response.second_action);
      game.receive(event);
    }
  });
}

}  // namespace kinesphere
