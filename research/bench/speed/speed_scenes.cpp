#include "research/bench/speed/speed_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/program_error.hpp"
#include "research/bench/measurement.hpp"
#include "research/bench/speed/mixture.hpp"
#include "scenes/scene_file.hpp"

namespace kinesphere::program {
namespace {

const std::vector<double> game_rates{60.0, 240.0, 1000.0};

/// SceneList makes scenes, smaller and shorter as the settings say.
class SceneList {
 public:
  explicit SceneList(const SpeedSettings& settings) : settings_(settings) {}

  std::vector<SpeedScene> all() {
    paper();
    crowds();
    extremes();
    gases();
    SceneParameters pile = find_scene("pile").parameters;
    pile.seconds = 3.0;  // the spheres lie in a heap and jostle
    // Without bounces the spheres fall out of the box, so no contact can be counted as missed.
    add({.name = "pile", .rates = game_rates, .first_counted = pile.bodies}, pile);
    const auto too_large = [this](const SpeedScene& scene) { return scene.bodies > settings_.most_bodies; };
    scenes_.erase(std::remove_if(scenes_.begin(), scenes_.end(), too_large), scenes_.end());
    for (SpeedScene& scene : scenes_)
      if (scene.bodies > settings_.most_with_rivals) scene.rates.clear();
    return std::move(scenes_);
  }

 private:
  std::uint32_t fewer(std::uint32_t bodies) const { return std::max(bodies / settings_.divide, 10u); }
  double shorter(double seconds) const { return seconds * settings_.shorten; }

  /// Returns the parameters with `bodies` bodies in a box scaled to the original density.
  static SceneParameters with_box(SceneParameters parameters, std::uint32_t bodies) {
    const double scale = std::cbrt(static_cast<double>(bodies) / parameters.bodies);
    parameters.box.upper = parameters.box.lower + (parameters.box.upper - parameters.box.lower) * scale;
    parameters.bodies = bodies;
    return parameters;
  }

  void add(SpeedScene scene, SceneParameters parameters) {
    // Fewer spheres of a gas would not fit between walls, as which they are placed.
    const std::uint32_t least = parameters.periodic ? 1000 : 10;
    parameters = with_box(parameters, std::max(fewer(parameters.bodies), least));
    parameters.seconds = shorter(parameters.seconds);
    scene.bodies = parameters.bodies;
    scene.response = parameters.response;
    scene.make = [parameters](SceneResponse response) mutable {
      parameters.response = response;
      return require(make_scene(parameters));
    };
    scenes_.push_back(std::move(scene));
  }

  void paper() {
    for (const std::uint32_t bodies : {500u, 1000u, 2000u, 3500u}) {
      add({.name = fmt::format("paper1-{}", bodies), .rates = game_rates, .trees = true},
          first_experiment(bodies, 2.0));
    }
    // All last equally long, as the small ones heat up.
    for (const std::uint32_t bodies : {1000u, 10'000u, 100'000u, 1'000'000u}) {
      add({.name = fmt::format("dense-{}", bodies),
           .rates = bodies > 100'000 ? std::vector{60.0} : game_rates,
           .trees = bodies <= 100'000},
          with_box(first_experiment(1000, 0.2), bodies));
    }
    add({.name = "paper2", .rates = game_rates}, second_experiment(1000, 2.0));
  }

  void mixture(SpeedScene scene, const MixtureParameters& parameters) {
    for (const BodyKind& kind : parameters.kinds) scene.bodies += kind.bodies;
    scene.make = [parameters](SceneResponse response) { return make_mixture(parameters, response); };
    scenes_.push_back(std::move(scene));
  }

  void crowds() {
    constexpr double alarm = 10.0;
    const std::uint32_t drones = fewer(100'000);
    const double shrink = std::sqrt(drones / 100'000.0);
    mixture({.name = "drones",
             .response = SceneResponse::pass_through,
             .rates = {1.0, 4.0, 15.0, 60.0, 240.0},
             .alarm = alarm},
            {.box = {{0, 0, 0}, {20'000 * shrink, 20'000 * shrink, 300}},
             .walls = false,
             .kinds = {{drones, 0.5, 0.5, 15.0, 15.0, 5.0}},
             .gap = alarm,
             .seconds = shorter(20.0)});
    const CrowdParameters people{.people = fewer(20'000), .area_each = 4.0, .seconds = shorter(4.0)};
    scenes_.push_back({.name = "crowd",
                       .bodies = people.people,
                       .response = SceneResponse::pass_through,
                       .make = [people](SceneResponse response) { return make_crowd(people, response); },
                       .rates = {10.0, 30.0, 60.0, 240.0}});
  }

  void extremes() {
    const std::uint32_t boulders = fewer(10'000);
    const double edge = 200.0 * std::cbrt(boulders / 10'000.0);
    mixture({.name = "bullets",
             .response = SceneResponse::pass_through,
             .rates = {60.0, 240.0, 1000.0, 4000.0},
             .first_counted = boulders},
            {.box = {{0, 0, 0}, {edge, edge, edge}},
             .kinds = {{boulders, 1.0, 3.0, 0.0, 1.0, 0.5}, {10, 0.01, 0.05, 1000.0, 1000.0, 1.0}},
             .seconds = shorter(0.25)});
    // Each kind is twice as large as the one before, and half as many: sizes 1 to 1024.
    MixtureParameters sizes{.box = {{0, 0, 0}, {100, 100, 100}}, .kinds = {}, .seconds = shorter(2.0)};
    for (std::uint32_t k = 0; k <= 10; ++k) {
      const double radius = 0.01 * static_cast<double>(1u << k);
      sizes.kinds.push_back({std::max(fewer(8192) >> k, 1u), radius, radius, 1.0, 10.0, 10.0});
    }
    mixture({.name = "sizes", .response = SceneResponse::bounce, .rates = game_rates, .trees = true}, sizes);
  }

  /// Adds gases, without rivals: fixed steps do not support periodic space.
  void gases() {
    SceneParameters gas = find_scene("periodic_gas").parameters;
    gas.speed_min = gas.speed_max = 1.0;
    for (const std::uint32_t bodies : {4'000u, 108'000u}) {
      for (const int percent : {25, 49}) {
        gas.bodies = bodies;
        gas.packing = 0.01 * percent;
        gas.seconds = bodies > 4'000 ? 0.2 : 3.0;
        add({.name = fmt::format("gas{}-{}", percent, bodies), .rates = {}}, gas);
      }
    }
  }

  const SpeedSettings& settings_;
  std::vector<SpeedScene> scenes_;
};

}  // namespace

std::vector<SpeedScene> speed_scenes(const SpeedSettings& settings) { return SceneList(settings).all(); }

const SpeedSettings& speed_settings(Effort effort) {
  static constexpr SpeedSettings quick{.name = "quick",
                                       .repetitions = 1,
                                       .least_turn = 0.0,
                                       .divide = 100,
                                       .shorten = 0.1,
                                       .most_bodies = 2000,
                                       .most_with_rivals = 2000,
                                       .most_recorded = 50'000,
                                       .most_looked = 200'000};
  static constexpr SpeedSettings usual{.name = "usual",
                                       .repetitions = 3,
                                       .least_turn = 0.05,
                                       .divide = 1,
                                       .shorten = 1.0,
                                       .most_bodies = 1'000'000,
                                       .most_with_rivals = 108'000,
                                       .most_recorded = 15'000'000,
                                       .most_looked = 130'000'000};
  static const SpeedSettings full = [] {
    SpeedSettings longer = usual;
    longer.name = "full";
    longer.repetitions = 5;
    longer.least_turn = 0.1;
    longer.most_with_rivals = 1'000'000;
    longer.most_recorded = 60'000'000;
    longer.most_looked = 400'000'000;
    return longer;
  }();
  return chosen(effort, quick, usual, full);
}

}  // namespace kinesphere::program
