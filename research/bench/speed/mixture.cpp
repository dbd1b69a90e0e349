#include "research/bench/speed/mixture.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/program_error.hpp"
#include "kinesphere/motion/piecewise_acceleration.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/placement.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::program {
namespace {

/// Independent streams of random numbers, one for each thing that is drawn.
enum Stream : std::uint64_t { placement_stream, body_stream, force_stream, walk_stream };

Scene empty_scene(SceneResponse response, double seconds) {
  Scene scene;
  scene.response = response;
  scene.end_time = seconds;
  scene.world.contacts =
      response == SceneResponse::bounce ? ContactEvents::impacts : ContactEvents::begin_and_end;
  return scene;
}

constexpr double people_radius_min = 0.2, people_radius_max = 0.3;
constexpr double walking_speed = 1.4;
constexpr double walking_limit = 2.0;
constexpr double walking_interval = 0.5;  ///< time between two changes of acceleration
constexpr double response_time = 0.5;     ///< time to reach the wanted velocity
constexpr std::int64_t mind_intervals = 8;

/// Walkers turn each body towards a wanted velocity, which it keeps for some seconds.
class Walkers final : public PiecewiseAcceleration {
 public:
  Walkers(const std::vector<State>& start, std::uint64_t seed)
      : PiecewiseAcceleration(start, 0.0, walking_interval), seed_(seed) {}

  BodyDefinition definition(std::uint32_t body, double t) const override {
    return definition_with(body, t, walking_limit);
  }
  std::unique_ptr<Motion> clone() const override { return std::make_unique<Walkers>(*this); }

  static Vec3 wanted_velocity(std::uint64_t seed, std::uint32_t body, std::int64_t mind) {
    Random random = Random::at(seed, body, static_cast<std::uint64_t>(mind));
    Vec3 direction = random.point_in_ball();
    direction.z = 0.0;
    return direction * walking_speed;
  }

 private:
  Vec3 acceleration(std::uint32_t body, std::int64_t k, const State& state) const override {
    // The bodies change their wanted velocity at different times.
    const std::int64_t mind = (k + static_cast<std::int64_t>(body % mind_intervals)) / mind_intervals;
    const Vec3 wanted = (wanted_velocity(seed_, body, mind) - state.velocity) / response_time;
    const double length = norm(wanted);
    constexpr double most = walking_limit * (1.0 - 1e-12);
    return length > most ? wanted * (most / length) : wanted;
  }

  std::uint64_t seed_;
};

/// Returns a centre in the plane, in the body's own square, so that bodies do not overlap.
Vec3 place_in_square(std::uint32_t body, std::uint32_t squares, double edge, Random& random) {
  const double room = edge - 2.0 * people_radius_max;
  const auto column = static_cast<double>(body % squares);
  const std::uint32_t full_rows = body / squares;
  const auto row = static_cast<double>(full_rows);
  return {column * edge + people_radius_max + room * random.uniform(),
          row * edge + people_radius_max + room * random.uniform(), 0.0};
}

}  // namespace

Scene make_mixture(const MixtureParameters& p, SceneResponse response) {
  Scene scene = empty_scene(response, p.seconds);
  if (p.walls) scene.world.box = p.box;
  std::vector<double> radii, limits;
  std::vector<Vec3> velocities;
  for (const BodyKind& kind : p.kinds) {
    for (std::uint32_t k = 0; k < kind.bodies; ++k) {
      Random random = Random::at(p.seed, body_stream, radii.size());
      radii.push_back(random.uniform(kind.radius_min, kind.radius_max));
      velocities.push_back(random.unit_vector() * random.uniform(kind.speed_min, kind.speed_max));
      limits.push_back(kind.limit);
    }
  }
  const auto centres = place_spheres(radii, p.box,
                                     {.gap = std::max(p.gap, 4.0 * scene.world.contact_tolerance),
                                      .seed = Random::at(p.seed, placement_stream, 0).bits()});
  if (!centres) throw ProgramError("bench: the bodies of a scene do not fit into its box");
  std::vector<State> start;
  for (std::size_t body = 0; body < radii.size(); ++body) {
    start.push_back({(*centres)[body], velocities[body]});
    scene.bodies.push_back({.radius = radii[body]});
  }
  scene.motion = std::make_unique<RandomForces>(
      require(RandomForces::create({.start = std::move(start),
                                    .acceleration_limits = std::move(limits),
                                    .interval = p.redraw_interval,
                                    .seed = Random::at(p.seed, force_stream, 0).bits()})));
  return scene;
}

Scene make_crowd(const CrowdParameters& p, SceneResponse response) {
  Scene scene = empty_scene(response, p.seconds);
  const double edge = std::sqrt(p.area_each);
  const auto squares = static_cast<std::uint32_t>(std::ceil(std::sqrt(p.people)));
  const std::uint64_t walk = Random::at(p.seed, walk_stream, 0).bits();
  std::vector<State> start;
  for (std::uint32_t body = 0; body < p.people; ++body) {
    Random random = Random::at(p.seed, body_stream, body);
    scene.bodies.push_back({.radius = random.uniform(people_radius_min, people_radius_max)});
    start.push_back({place_in_square(body, squares, edge, random), Walkers::wanted_velocity(walk, body, 0)});
  }
  scene.motion = std::make_unique<Walkers>(start, walk);
  return scene;
}

}  // namespace kinesphere::program
