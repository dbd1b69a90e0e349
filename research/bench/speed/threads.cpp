#include "research/bench/speed/threads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>

#include "base/program_error.hpp"
#include "kinesphere/workers.hpp"
#include "research/bench/measurement.hpp"
#include "research/measures/games.hpp"

namespace kinesphere::program {
namespace {

/// A whole simulation, timed from the first window starts, with all bodies in, to the end (seconds).
struct TimedRun {
  double seconds = 0.0;
  double cpu_seconds = 0.0;  ///< of all threads
  std::uint64_t events = 0;
  std::uint64_t hash = 0;
};

TimedRun time_run(const Scene& scene, Workers* workers) {
  using Clock = std::chrono::steady_clock;
  TimedRun timed;
  Clock::time_point begin;
  double cpu_begin = 0.0;
  SceneObserver observer;
  // The second call is the one between the adding of the bodies and the run.
  int calls = 0;
  observer.between_events = [&](const Detector&) {
    if (++calls != 2) return;
    begin = Clock::now();
    cpu_begin = cpu_seconds();
  };
  observer.at_end = [&](Detector&) -> Result<void> {
    timed.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    timed.cpu_seconds = cpu_seconds() - cpu_begin;
    return {};
  };
  const SceneResult result = require(run_scene(scene, make_world_detector, observer, workers));
  const auto& events = result.counters.events;
  timed.events = std::accumulate(events.begin(), events.end(), std::uint64_t{0});
  timed.hash = result.contact_hash;
  return timed;
}

/// Fills the row's turns: time(workers) is a simulation by World::run, or by a loop if `workers` is null.
template <class Time>
ThreadsRow compare(ThreadsRow row, const SpeedSettings& settings, const Time& time) {
  Workers one = require(Workers::create(1)), many = require(Workers::create(row.threads));
  // With several threads windows find contacts, and times differ by rounding.
  std::uint64_t hash_of_many = 0;
  for (int turn = 0; turn < settings.repetitions; ++turn) {
    const TimedRun runs[] = {time(nullptr), time(&one), time(&many)};
    row.turns.push_back(
        {runs[0].seconds, runs[1].seconds, runs[2].seconds, runs[1].cpu_seconds, runs[2].cpu_seconds});
    row.events = runs[0].events;
    row.hash = runs[0].hash;
    if (turn == 0) hash_of_many = runs[2].hash;
    for (const auto& [found, expected] :
         {std::pair(runs[1].hash, row.hash), std::pair(runs[2].hash, hash_of_many)}) {
      if (found == expected) continue;
      throw ProgramError(
          fmt::format("bench speed --threads: expected the hash {:016x} in {}, but got {:016x}", expected,
                      row.scene, found));
    }
  }
  return row;
}

}  // namespace

ThreadsRow compare_threads(const SpeedScene& entry, int threads, const SpeedSettings& settings) {
  const Scene scene = entry.make(entry.response);
  return compare({entry.name, entry.bodies, threads, {}, 0, 0}, settings,
                 [&](Workers* workers) { return time_run(scene, workers); });
}

ThreadsRow compare_threads_in_game(int threads, const SpeedSettings& settings) {
  ShootingSettings game;
  game.bodies /= settings.divide;
  return compare({shooting_name, game.bodies, threads, {}, 0, 0}, settings, [&](Workers* workers) {
    const ShootingResult played = workers ? run_shooting(game, workers) : loop_shooting(game);
    return TimedRun{played.seconds, played.cpu_seconds, played.events, played.hash};
  });
}

}  // namespace kinesphere::program
