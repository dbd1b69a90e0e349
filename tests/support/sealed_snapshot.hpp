// Makes bytes look like a snapshot, and uses the world that they restore.
#pragma once

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
  require(static_cast<bool>(World::restore(world.save().value())), "what was restored cannot be saved");
  (void)world.inspection().audit();
  try {
    for (int k = 0; k < 50; ++k) {
      const auto event = world.advance(world.time() + 1.0, probe);
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
