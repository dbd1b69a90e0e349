// Gain of several threads: whole simulations, motion and response included, by World::run and by a loop.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "research/bench/measurement.hpp"
#include "research/bench/speed/speed_scenes.hpp"

namespace kinesphere::program {

/// Real time of one simulation in three ways, which took turns (seconds).
struct ThreadsTurn {
  double loop;      ///< an advance() for each event
  double one;       ///< World::run with one thread
  double many;      ///< World::run with all threads
  double one_cpu;   ///< CPU time of World::run with one thread
  double many_cpu;  ///< CPU time of all threads
};

struct ThreadsRow {
  std::string scene;
  std::uint32_t bodies;
  int threads;
  std::vector<ThreadsTurn> turns;
  std::uint64_t events;
  std::uint64_t hash;  ///< equal in all ways

  /// Returns the median of quotient(turn) over the turns.
  template <class Quotient>
  double median_of(Quotient quotient) const {
    std::vector<double> quotients;
    for (const ThreadsTurn& turn : turns) quotients.push_back(quotient(turn));
    return median(std::move(quotients));
  }
};

/// The name of the game of research/measures/games.hpp among the scenes.
constexpr const char* shooting_name = "shooting";

/// Runs the scene in the three ways. Throws ProgramError, also if their hashes differ.
ThreadsRow compare_threads(const SpeedScene& entry, int threads, const SpeedSettings& settings);

/// The same for a game in which bodies vanish and appear.
ThreadsRow compare_threads_in_game(int threads, const SpeedSettings& settings);

}  // namespace kinesphere::program
