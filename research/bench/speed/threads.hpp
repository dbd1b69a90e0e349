// What several threads gain: whole simulations, motion and response included, by World::run and by a loop.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "research/bench/speed/speed_scenes.hpp"
#include "research/bench/speed/verdicts.hpp"

namespace kinesphere::program {

/// What the same simulation took in ways that took turns (seconds of real time).
struct ThreadsTurn {
  double loop;  ///< an advance() for each event
  double one;   ///< by World::run, one thread
  double many;  ///< with all threads
};

struct ThreadsRow {
  std::string scene;
  std::uint32_t bodies;
  int threads;
  std::vector<ThreadsTurn> turns;
  std::uint64_t events;
  std::uint64_t hash;  ///< the same in all ways

  double one_to_loop() const;  ///< time; the median of the turns
  double one_to_many() const;
};

/// Throws ProgramError, also when not all find the same.
ThreadsRow compare_threads(const SpeedScene& entry, int threads, const SpeedSettings& settings);

/// Of goal 6.
std::vector<Verdict> verdicts_of_threads(const std::vector<ThreadsRow>& rows);

}  // namespace kinesphere::program
