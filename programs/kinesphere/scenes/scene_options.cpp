// The options that choose and change a scene on the command line.
#include "scenes/scene_options.hpp"

#include <limits>
#include <tuple>
#include <utility>

#include "base/validators.hpp"

namespace kinesphere::program {
namespace {

using Range = std::pair<double, double>;
constexpr const char* scene_group = "Scene";

/// Declares an option; `set` puts its value into the parameters, in place of the scene's `field`.
template <class Value, class Set>
CLI::Option* add_change(CLI::App& command, SceneOptions& options, const std::string& flag,
                        const std::string& field, const std::string& description, Set set) {
  const auto note = [&options, field, set](const Value& value) {
    options.changes.push_back([field, set, value](SceneSource& source) {
      source.lines.erase(field);
      set(source.parameters, value);
    });
  };
  return command.add_option_function<Value>(flag, note, description)->group(scene_group);
}

}  // namespace

SceneSource SceneOptions::source() const {
  SceneSource source = find_scene(scene);
  for (const auto& change : changes) change(source);
  return source;
}

void add_scene_options(CLI::App& command, SceneOptions& options) {
  command.add_option("SCENE", options.scene, "A built-in scene (see `kinesphere scenes`) or a JSON file")
      ->required();
  add_change<std::uint32_t>(command, options, "--bodies", "bodies", "How many bodies",
                            [](SceneParameters& p, std::uint32_t n) { p.bodies = n; })
      ->check(whole_number(std::numeric_limits<std::uint32_t>::max()));
  add_change<std::uint64_t>(command, options, "--seed", "seed", "Seed of the random numbers",
                            [](SceneParameters& p, std::uint64_t seed) { p.seed = seed; })
      ->check(whole_number(std::numeric_limits<std::uint64_t>::max()));
  add_change<double>(command, options, "--seconds", "seconds", "How long to simulate",
                     [](SceneParameters& p, double seconds) { p.seconds = seconds; })
      ->check(finite_number());
  add_change<Range>(command, options, "--radius", "radius", "Least and largest radius",
                    [](SceneParameters& p, Range r) { std::tie(p.radius_min, p.radius_max) = r; })
      ->type_name("MIN MAX")
      ->check(finite_number());
  add_change<Range>(command, options, "--speed", "speed", "Least and largest speed at the start",
                    [](SceneParameters& p, Range r) { std::tie(p.speed_min, p.speed_max) = r; })
      ->type_name("MIN MAX")
      ->check(finite_number());
  add_change<Range>(command, options, "--limit", "limit", "Least and largest acceleration limit",
                    [](SceneParameters& p, Range r) { std::tie(p.limit_min, p.limit_max) = r; })
      ->type_name("MIN MAX")
      ->check(finite_number());
  add_change<double>(command, options, "--packing", "packing",
                     "Scale the box until the bodies fill this part of it, 0 to 1",
                     [](SceneParameters& p, double packing) { p.packing = packing; })
      ->check(finite_number());
  command
      .add_flag_callback(
          "--periodic",
          [&options] {
            options.changes.emplace_back([](SceneSource& source) {
              source.lines.erase("periodic");
              source.parameters.periodic = true;
            });
          },
          "Repeat space with the box, without walls")
      ->group(scene_group);
  add_change<double>(command, options, "--tolerance", "contact_tolerance", "Contact tolerance (length)",
                     [](SceneParameters& p, double tolerance) { p.contact_tolerance = tolerance; })
      ->check(finite_number());
}

void add_response_options(CLI::App& command, SceneOptions& options) {
  add_change<std::string>(
      command, options, "--response", "response", "What bodies do on contact",
      [](SceneParameters& p, const std::string& name) { p.response = response_named(name, "--response"); })
      ->type_name("pass_through|bounce");
  add_change<double>(command, options, "--restitution", "restitution",
                     "Part of the approach speed that a bounce gives back, 0 to 1",
                     [](SceneParameters& p, double restitution) { p.restitution = restitution; })
      ->check(finite_number());
}

}  // namespace kinesphere::program
