// Games at 60 frames a second in a room of bouncing balls.
#pragma once

#include <cstdint>
#include <functional>

#include "kinesphere/counters.hpp"
#include "kinesphere/workers.hpp"

namespace kinesphere {

struct GameLoopSettings {
  std::uint32_t bodies = 1000;  ///< > 0
  double packing = 0.03;        ///< part of the room's volume that they fill, as PlacementOptions::packing
  std::uint32_t frames = 600;
  /// With bullets, which are 20 times as fast as most balls and fly for a second, with balls that come and
  /// go, and with an explosion amid the frames that blows the 500 balls nearest to the centre away.
  bool eventful = false;
  std::uint64_t seed = 1;
};

/// Runs the game. Calls visit() with the counters of the world so far when all balls are in, before the first
/// frame, and after each frame. Throws BadResult where balls do not fit into the room, or for what the world
/// refuses.
void play_game(const GameLoopSettings& settings, const std::function<void(const Counters&)>& visit);

/// Returns roughly how many thousand instructions the counted work takes. It is linear: the work of a frame
/// is the difference of two calls.
double estimated_work(const Counters& work);

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
  std::uint64_t hash = 0;  ///< of all events
};

/// Plays the game by World::run, with or without workers. Throws BadResult where balls do not fit into the
/// room.
ShootingResult run_shooting(const ShootingSettings& settings, Workers* workers);
/// Plays the same game by a loop over World::advance.
ShootingResult loop_shooting(const ShootingSettings& settings);

}  // namespace kinesphere
