// Makes bytes look like a snapshot, and uses the world that they restore.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "archive/checksum.hpp"
#include "kinesphere/inspection.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

inline void write_number(std::vector<std::byte>& bytes, std::size_t at, std::uint64_t number) {
  for (std::size_t k = 0; k < 8; ++k) bytes[at + k] = static_cast<std::byte>(number >> (8 * k));
}

inline constexpr std::size_t snapshot_header_size = 20;  ///< mark, version, length
inline constexpr std::size_t snapshot_frame_size = 28;   ///< and the checksum

/// Corrects length and checksum of a snapshot.
inline std::vector<std::byte> sealed(std::vector<std::byte> bytes) {
  write_number(bytes, 12, bytes.size() - snapshot_frame_size);
  write_number(bytes, bytes.size() - 8, checksum(std::span(bytes).first(bytes.size() - 8)));
  return bytes;
}

/// Gives rotations at random, to a world that may have rigid bodies.
inline void give_random_rotations(World& world, Random& random) {
  const bool flat = world.definition().dimensions == 2;
  world
      .set_rotation_probe([&random, flat](std::span<const BodyId>, double, std::span<Rotation> rotations) {
        for (Rotation& rotation : rotations) {
          Vec3 turn = 3.0 * random.point_in_ball(), spin = 2.0 * random.point_in_ball();
          if (flat) turn.x = turn.y = spin.x = spin.y = 0.0;
          rotation = {rotation_by(turn), spin};
        }
      })
      .value();
}

/// Returns a duration of at most `longest` in which no rigid body turns many times. Where others are between
/// its parts, it is checked in each turn, which is too often for spins that no caller has chosen.
inline double duration_of_few_turns(const World& world, double longest) {
  constexpr double most_turned = 1000.0;
  for (const BodyId id : world.bodies()) {
    const auto rigid = world.body(id)->rigid;
    if (!rigid) continue;
    const double swings = rigid->angular_acceleration_limit > 0.0 ? rigid->largest_angular_speed : 0.0;
    const double spin = std::max(norm(rigid->rotation.angular_velocity), swings);
    if (spin * longest > most_turned) longest = most_turned / spin;
  }
  return longest;
}

/// Uses a world that may be nonsense, with a probe that gives up after a while. Throws std::logic_error if
/// the world does what no world may do.
inline void use_for_a_while(World world, Random& random) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
  };
  int left = 300;
  const auto probe = [&](std::span<const BodyId> ids, double, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      require(world.contains(ids[k]), "a probe asks for a body that is not there");
      if (--left < 0) throw std::runtime_error("enough");
      states[k] = {5.0 * random.point_in_ball(), random.point_in_ball()};
    }
  };
  if (random.bits() % 2 == 0) give_random_rotations(world, random);
  require(static_cast<bool>(World::restore(world.save().value())), "what was restored cannot be saved");
  (void)world.inspection().audit();
  try {
    for (int k = 0; k < 50; ++k) {
      const auto event = world.advance(world.time() + duration_of_few_turns(world, 1.0), probe);
      if (!event) break;
      const auto bodies = world.bodies();
      if (bodies.empty()) break;
      const BodyId body = bodies[random.bits() % bodies.size()];
      (void)world.body(body);
      if (k % 3 == 0) (void)world.set_velocity(body, random.point_in_ball());
      if (k % 5 == 0) (void)world.remove(body);
      if (k % 7 == 0) (void)world.add({.position = 5.0 * random.point_in_ball()});
    }
  } catch (const std::runtime_error&) {
  }
  (void)world.inspection().audit();
  (void)world.save();
}

}  // namespace kinesphere
