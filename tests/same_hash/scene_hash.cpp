// With nothing but the library, for scripts/same_hash.sh builds this many times over:
//   scene_hash <scene> <bodies> <seconds>  prints the hash of the events of a built-in scene, as
//                                          `kinesphere run --hash-only` does
//   scene_hash <recording>                 prints that of a recording, as `kinesphere replay --hash-only`
//   does
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "kinesphere/scene.hpp"

namespace {

using namespace kinesphere;

std::uint64_t hash_of_scene(const char* const* arguments) {
  const auto& scenes = built_in_scenes();
  const auto found = std::find_if(scenes.begin(), scenes.end(),
                                  [&](const auto& scene) { return scene.name == arguments[0]; });
  if (found == scenes.end()) std::exit(2);
  SceneParameters parameters = *found;
  parameters.bodies = static_cast<std::uint32_t>(std::strtoul(arguments[1], nullptr, 10));
  parameters.seconds = std::strtod(arguments[2], nullptr);
  const Scene scene = make_scene(parameters).value();
  return simulate(scene, make_world_detector).value().contact_hash;
}

std::uint64_t hash_of_recording(const char* path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  return replay(std::as_bytes(std::span(bytes))).value().contact_hash;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 4) return 2;
  std::printf("%016" PRIx64 "\n", argc == 2 ? hash_of_recording(argv[1]) : hash_of_scene(argv + 1));
  return 0;
}
