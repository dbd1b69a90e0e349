// Prints the hash of the events of a built-in scene, as `kinesphere run --hash-only` does, with nothing but
// the library: scripts/same_hash.sh builds this many times over. Usage: scene_hash <scene> <bodies> <seconds>
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "kinesphere/scene.hpp"

int main(int argc, char** argv) {
  using namespace kinesphere;

  if (argc != 4) return 2;
  const auto& scenes = built_in_scenes();
  const auto found =
      std::find_if(scenes.begin(), scenes.end(), [&](const auto& scene) { return scene.name == argv[1]; });
  if (found == scenes.end()) return 2;

  SceneParameters parameters = *found;
  parameters.bodies = static_cast<std::uint32_t>(std::strtoul(argv[2], nullptr, 10));
  parameters.seconds = std::strtod(argv[3], nullptr);
  const Scene scene = make_scene(parameters).value();
  std::printf("%016" PRIx64 "\n", simulate(scene, make_world_detector).value().contact_hash);
  return 0;
}
