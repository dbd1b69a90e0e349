// Prints the hash of the events of a run that has something of everything: random forces, bounces of all
// sizes, sensors, a zone and a fixed triangle. It needs nothing but the installed library, and
// scripts/same_hash.sh and the consumer test build it many times over:
//   scene_hash                     runs it
//   scene_hash record <recording>  the same, and writes a recording
//   scene_hash replay <recording>  the hash of a recording, gone through again without its motion
#include <kinesphere/event_hash.hpp>
#include <kinesphere/kinesphere.hpp>

#include <cinttypes>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <ios>
#include <iterator>
#include <limits>
#include <span>
#include <vector>

namespace {

using namespace kinesphere;

constexpr double edge = 200.0;
constexpr double end_time = 2.0;

struct Bodies {
  std::vector<State> start;
  std::vector<double> radii, limits;
};

/// Returns bodies on a lattice with space for the largest.
Bodies drawn() {
  constexpr int rows = 6;
  constexpr double pitch = edge / rows;
  Bodies bodies;
  Random random(1);
  for (int x = 0; x < rows; ++x)
    for (int y = 0; y < rows; ++y)
      for (int z = 0; z < rows; ++z) {
        bodies.start.push_back({Vec3{x + 0.5, y + 0.5, z + 0.5} * pitch, random.point_in_ball() * 40.0});
        bodies.radii.push_back(random.uniform(0.1, 10.0));
        bodies.limits.push_back(random.uniform(10.0, 20.0));
      }
  return bodies;
}

World world_of(const Bodies& bodies, const RandomForces& motion) {
  World world =
      World::create({.box = Box{{0, 0, 0}, {edge, edge, edge}}, .contacts = ContactEvents::impacts}).value();
  world.set_sensor(0, {.distances = {0.5, 2.0}}).value();
  for (std::uint32_t body = 0; body < motion.size(); ++body) {
    BodyDefinition definition = motion.definition(body, 0.0);
    definition.radius = bodies.radii[body];
    world.add(definition).value();
  }
  world.add_static({.shape = Triangle{{100, 10, 100}, {190, 100, 100}, {100, 100, 101}}}).value();
  world.add_zone(Box{{20, 20, 20}, {60, 60, 60}}).value();
  return world;
}

std::uint64_t run(const char* recording) {
  const Bodies bodies = drawn();
  RandomForces motion =
      RandomForces::create({.start = bodies.start, .acceleration_limits = bodies.limits}).value();
  World world = world_of(bodies, motion);
  if (recording != nullptr) world.start_recording().value();

  const auto turn = [&](BodyId body, double time, const Vec3& velocity) {
    if (body.index >= motion.size()) return;
    motion.set_velocity(body.index, time, velocity).value();
    world.set_velocity(body, velocity).value();
  };
  const auto mass = [&](BodyId body) {
    return body != no_body && body.index < motion.size() ? bodies.radii[body.index]
                                                         : std::numeric_limits<double>::infinity();
  };
  EventHash hash;
  for (const Event& event : world.events(end_time, motion.probe())) {
    hash.add(event);
    if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) continue;
    const Bounce after = bounce(event, mass(event.first), mass(event.second), 1.0);
    turn(event.first, event.time, after.first_velocity);
    if (event.second != no_body) turn(event.second, event.time, after.second_velocity);
  }
  if (recording != nullptr) {
    const std::vector<std::byte> bytes = world.stop_recording().value();
    std::ofstream file(recording, std::ios::binary);
    for (const std::byte byte : bytes) file.put(static_cast<char>(byte));
    if (!file.flush()) std::perror(recording);
  }
  return hash.value();
}

std::uint64_t replayed(const char* recording) {
  std::ifstream file(recording, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  Replay replay = Replay::open(std::as_bytes(std::span(bytes))).value();
  EventHash hash;
  while (!replay.finished())
    if (const auto event = replay.advance().value()) hash.add(*event);
  return hash.value();
}

}  // namespace

int main(int argc, char** argv) {
  const char* command = argc == 3 ? argv[1] : "";
  const bool replays = std::strcmp(command, "replay") == 0, records = std::strcmp(command, "record") == 0;
  if (argc != 1 && !replays && !records) return 2;
  const std::uint64_t hash = replays ? replayed(argv[2]) : run(records ? argv[2] : nullptr);
  std::printf("%016" PRIx64 "\n", hash);
  return 0;
}
