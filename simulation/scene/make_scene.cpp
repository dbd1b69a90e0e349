// Makes scenes from parameters, and lists the built-in ones.
#include <algorithm>
#include <string>
#include <utility>

#include "input/input_check.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/motion/velocity_field.hpp"
#include "kinesphere/placement.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/response.hpp"
#include "number/roots.hpp"
#include "simulation/scene/make_scene.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {
namespace {

/// Independent streams of random numbers, one for each thing that is drawn.
enum Stream : std::uint64_t { placement_stream, radius_stream, velocity_stream, limit_stream, force_stream };

Result<void> check(const SceneParameters& p) {
  InputCheck check("make_scene");
  const auto range = [&](std::string_view name, double least, double greatest) {
    check.not_negative({name}, least)
        .finite({name}, greatest)
        .require(least <= greatest, ErrorCode::out_of_range, {name},
                 "must be a range with min <= max =", greatest, least);
  };
  range("radius", p.radius_min, p.radius_max);
  range("speed", p.speed_min, p.speed_max);
  range("limit", p.limit_min, p.limit_max);
  return check.not_negative({"seconds"}, p.seconds)
      .positive({"redraw_interval"}, p.redraw_interval)
      .finite({"gravity"}, p.gravity)
      .box({"box"}, p.box)
      .positive({"contact_tolerance"}, p.contact_tolerance)
      .not_negative({"resting_speed"}, p.resting_speed)
      .not_negative({"zeno_interval"}, p.zeno_interval)
      .require(p.packing >= 0.0 && p.packing < 1.0, ErrorCode::out_of_range, {"packing"},
               "must lie in [0, 1)", p.packing)
      .require(p.restitution >= 0.0 && p.restitution <= 1.0, ErrorCode::out_of_range, {"restitution"},
               "must lie in [0, 1]", p.restitution)
      .result();
}

double drawn(const SceneParameters& p, Stream stream, std::uint32_t body, double least, double greatest) {
  return Random::at(p.seed, stream, body).uniform(least, greatest);
}

Result<std::unique_ptr<const Motion>> make_motion(const SceneParameters& p, std::vector<State> start) {
  std::vector<double> limits;
  for (std::uint32_t body = 0; body < p.bodies; ++body)
    limits.push_back(drawn(p, limit_stream, body, p.limit_min, p.limit_max));
  const auto moved = [](auto&& motion) -> Result<std::unique_ptr<const Motion>> {
    if (!motion) return motion.error();
    using Kind = std::remove_cvref_t<decltype(*motion)>;
    return std::unique_ptr<const Motion>(std::make_unique<Kind>(std::move(*motion)));
  };
  switch (p.motion) {
    case SceneParameters::MotionKind::random_forces:
      return moved(RandomForces::create({.start = std::move(start),
                                         .acceleration_limits = std::move(limits),
                                         .interval = p.redraw_interval,
                                         .seed = Random::at(p.seed, force_stream, 0).bits()}));
    case SceneParameters::MotionKind::velocity_field:
      return moved(VelocityField::create({.field = Circulation{p.box, p.speed_max},
                                          .start = std::move(start),
                                          .acceleration_limits = std::move(limits),
                                          .interval = p.redraw_interval}));
    case SceneParameters::MotionKind::ballistic:
      break;
  }
  return moved(Ballistic::create({.start = std::move(start), .gravity = p.gravity}));
}

/// Returns the mass of a body, up to a common factor.
double cube(double radius) { return radius * radius * radius; }

/// Returns the box, scaled from its lower corner so that the bodies fill the part `packing` of it.
Box packed(const Box& box, const std::vector<double>& radii, double packing) {
  constexpr double ball = 4.1887902047863905;  // volume of the ball of radius 1
  double filled = 0.0;
  for (const double radius : radii) filled += ball * cube(radius);
  const Vec3 size = box.upper - box.lower;
  return {box.lower, box.lower + size * cube_root(filled / (packing * size.x * size.y * size.z))};
}

void remove_momentum(std::vector<State>& start, const std::vector<double>& radii) {
  Vec3 momentum{};
  double mass = 0.0;
  for (std::size_t body = 0; body < start.size(); ++body) {
    momentum += cube(radii[body]) * start[body].velocity;
    mass += cube(radii[body]);
  }
  if (mass <= 0.0) return;
  for (State& state : start) state.velocity -= momentum / mass;
}

SceneParameters with_name(std::string name, SceneParameters parameters) {
  parameters.name = std::move(name);
  return parameters;
}

}  // namespace

Result<Scene> make_scene(const SceneParameters& parameters) {
  if (auto valid = check(parameters); !valid) return valid.error();
  SceneParameters p = parameters;
  std::vector<double> radii;
  for (std::uint32_t body = 0; body < p.bodies; ++body)
    radii.push_back(drawn(p, radius_stream, body, p.radius_min, p.radius_max));
  if (p.packing > 0.0) p.box = packed(p.box, radii, p.packing);
  Scene scene;
  scene.name = p.name;
  scene.response = p.response;
  scene.restitution = p.restitution;
  const double least = least_resting_speed(p.contact_tolerance, p.limit_max + norm(p.gravity));
  if (p.resting_speed > 0.0) scene.resting_speed = std::max(p.resting_speed, least);
  scene.end_time = p.seconds;
  if (p.walls || p.periodic) scene.world.box = p.box;
  if (p.periodic) scene.world.periodic = {true, true, true};
  scene.world.contact_tolerance = p.contact_tolerance;
  scene.world.zeno_interval = p.zeno_interval;
  scene.world.contacts =
      p.response == SceneResponse::bounce ? ContactEvents::impacts : ContactEvents::begin_and_end;

  const auto centres = place_spheres(radii, p.box,
                                     {.periodic = scene.world.periodic,
                                      .gap = 4.0 * p.contact_tolerance,
                                      .seed = Random::at(p.seed, placement_stream, 0).bits()});
  if (!centres) {
    return Error{ErrorCode::out_of_range, "bodies", no_body,
                 "make_scene: bodies must fit into the box without overlap, but no room was found for " +
                     std::to_string(p.bodies) + " of these radii"};
  }
  std::vector<State> start;
  for (std::uint32_t body = 0; body < p.bodies; ++body) {
    Random random = Random::at(p.seed, velocity_stream, body);
    const double speed = random.uniform(p.speed_min, p.speed_max);
    // In a velocity field bodies start at rest: the field sets them in motion.
    const bool at_rest = p.motion == SceneParameters::MotionKind::velocity_field;
    start.push_back({(*centres)[body], at_rest ? Vec3{} : random.unit_vector() * speed});
    scene.bodies.push_back({.radius = radii[body]});
  }
  if (p.periodic) remove_momentum(start, radii);
  auto motion = make_motion(p, std::move(start));
  if (!motion) return motion.error();
  scene.motion = std::move(*motion);
  return scene;
}

const std::vector<SceneParameters>& built_in_scenes() {
  using Kind = SceneParameters::MotionKind;
  static const std::vector<SceneParameters> scenes{
      with_name("paper1", {}),
      with_name("paper2", {.motion = Kind::velocity_field,
                           .radius_min = 1.0,
                           .speed_min = 0.0,
                           .speed_max = 40.0,
                           .limit_min = 30.0,
                           .limit_max = 30.0,
                           .redraw_interval = 0.1,
                           .seconds = 7.0}),
      with_name("gas", {.motion = Kind::ballistic,
                        .bodies = 4000,
                        .radius_min = 5.0,
                        .radius_max = 5.0,
                        .limit_min = 0.0,
                        .limit_max = 0.0,
                        .box = {{0, 0, 0}, {204, 204, 204}},
                        .seconds = 5.0}),
      // Hard spheres in the units of theory: diameter, mass and temperature are 1.
      with_name("periodic_gas", {.motion = Kind::ballistic,
                                 .bodies = 4000,
                                 .radius_min = 0.5,
                                 .radius_max = 0.5,
                                 .speed_min = 1.7320508075688772,
                                 .speed_max = 1.7320508075688772,
                                 .limit_min = 0.0,
                                 .limit_max = 0.0,
                                 .packing = 0.25,
                                 .periodic = true,
                                 .seconds = 5.0}),
      with_name("rain", {.motion = Kind::ballistic,
                         .bodies = 500,
                         .radius_min = 0.5,
                         .radius_max = 2.0,
                         .speed_min = 0.0,
                         .speed_max = 5.0,
                         .limit_min = 0.0,
                         .limit_max = 0.0,
                         .gravity = {0, 0, -9.81},
                         .box = {{0, 0, 0}, {100, 100, 100}},
                         .restitution = 0.9,
                         .seconds = 10.0}),
      // The bodies fall into a heap 6 spheres deep and come to rest.
      with_name("pile", {.motion = Kind::ballistic,
                         .radius_min = 0.45,
                         .radius_max = 0.55,
                         .speed_min = 0.0,
                         .speed_max = 1.0,
                         .limit_min = 0.0,
                         .limit_max = 0.0,
                         .gravity = {0, 0, -9.81},
                         .box = {{0, 0, 0}, {12, 12, 20}},
                         .restitution = 0.5,
                         .resting_speed = 0.5,
                         .contact_tolerance = 5e-4,
                         .zeno_interval = 0.1,
                         .seconds = 20.0}),
  };
  return scenes;
}

}  // namespace kinesphere
