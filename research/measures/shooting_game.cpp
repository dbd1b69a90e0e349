#include "research/measures/shooting_game.hpp"

#include <chrono>
#include <ctime>
#include <vector>

#include "kinesphere/event_hash.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/placement.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/response.hpp"
#include "kinesphere/simulation.hpp"
#include "research/measures/room.hpp"

namespace kinesphere {
namespace {

/// What bodies are: their user data, and the bit of their category.
enum Kind : std::uint64_t { ball, rock, bullet, fragment };

constexpr double shooting_frame_rate = 60.0;
constexpr double shot_ball_radius = 0.5;
constexpr double shot_ball_speed = 5.0;  ///< of the fastest (length / time)
constexpr std::uint32_t rock_of_balls = 16;
constexpr std::uint32_t balls_of_bullet = 2500;  ///< a bullet in each frame for so many balls
constexpr double bullet_flight_speed = 100.0;
constexpr int fragments_of_rock = 4;

struct Kit {
  double radius;
  std::uint64_t meets;  ///< bits of kinds
  double mass;
};
constexpr Kit kits[] = {
    {shot_ball_radius, 15, 1.0}, {shot_ball_radius, 15, 1.0}, {0.05, 3, 8.0}, {0.1, 3, 0.1}};

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
        edge_(edge_of_room(settings.bodies, shot_ball_radius, settings.packing)),
        random_(settings.seed),
        simulation_(World::create({.box = Box{{0, 0, 0}, {edge_, edge_, edge_}},
                                   .contact_tolerance = 1e-3,
                                   .contacts = ContactEvents::impacts})
                        .value()),
        flight_(simulation_.add_motion(Ballistic::create({}).value())) {
    const std::vector<double> radii(settings.bodies, shot_ball_radius);
    std::uint32_t number = 0;
    for (const Vec3& centre :
         place_spheres(radii, Box{{0, 0, 0}, {edge_, edge_, edge_}}, {.seed = settings.seed}).value())
      add(number++ % rock_of_balls == 0 ? rock : ball, {centre, shot_ball_speed * random_.point_in_ball()});
  }

  /// Calls advance(time) for each frame; it must call receive() with each event.
  template <class Advance>
  ShootingResult play(const Advance& advance) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    const std::clock_t cpu_begin = std::clock();
    for (std::uint32_t frame = 1; frame <= settings_.frames; ++frame) {
      for (std::uint32_t k = 0; k <= settings_.bodies / balls_of_bullet; ++k)
        add(bullet, {anywhere(), bullet_flight_speed * random_.unit_vector()});
      for (; vanished_ > 0; --vanished_) add(ball, {anywhere(), shot_ball_speed * random_.point_in_ball()});
      advance(frame / shooting_frame_rate);
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
    if (response.first_action != BodyAction::none || response.second_action != BodyAction::none)
      ++result_.hits;
    if (!response.stop) return;
    ++result_.stops;
    for (int k = 0; k < fragments_of_rock; ++k)
      add(fragment, {event.point, 2 * shot_ball_speed * random_.unit_vector()});
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
    for (int axis = 0; axis < 3; ++axis)
      place[axis] = random_.uniform(shot_ball_radius, edge_ - shot_ball_radius);
    return place;
  }

  const ShootingSettings settings_;
  const double edge_;
  Random random_;
  Simulation simulation_;
  MotionId<Ballistic> flight_;
  ShootingResult result_;
  EventHash hash_;
  std::uint32_t vanished_ = 0;  ///< balls, without rocks, since the last frame
};

}  // namespace

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
