// A shooting game at 60 frames a second, in which the world runs by itself: bullets vanish where they hit,
// and what they hit vanishes too, or bursts into fragments. Play is steady: in each frame new balls take the
// places of those that vanished.
#pragma once

#include <cstdint>

#include "kinesphere/workers.hpp"

namespace kinesphere {

struct ShootingSettings {
  std::uint32_t bodies = 50'000;  ///< > 0; one ball in 16 is a rock, which bursts
  double packing = 0.03;          ///< part of the room's volume that they fill, as PlacementOptions::packing
  std::uint32_t frames = 120;
  std::uint64_t seed = 1;
};

struct ShootingResult {
  double seconds = 0.0;      ///< real time of all frames, from when all balls are in
  double cpu_seconds = 0.0;  ///< the same of all threads
  std::uint64_t events = 0;
  std::uint64_t hits = 0;   ///< bullets and balls that vanished
  std::uint64_t stops = 0;  ///< rocks that burst: there the world stops, and fragments are added
  std::uint64_t hash = 0;   ///< of all events
};

/// Plays the game by World::run, with or without workers. Throws BadResult where balls do not fit into the
/// room.
ShootingResult run_shooting(const ShootingSettings& settings, Workers* workers);
/// Plays the same game by a loop over World::advance.
ShootingResult loop_shooting(const ShootingSettings& settings);

}  // namespace kinesphere
