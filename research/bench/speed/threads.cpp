#include "research/bench/speed/threads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <numeric>

#include "kinesphere/workers.hpp"
#include "program_error.hpp"
#include "research/bench/measurement.hpp"

namespace kinesphere::program {
namespace {

struct TimedSimulation {
  SimulationResult result;
  double seconds = 0.0;  ///< from the first window starts, with all bodies in, to the end
};

TimedSimulation time_simulation(const Scene& scene, Workers* workers) {
  using Clock = std::chrono::steady_clock;
  TimedSimulation timed;
  Clock::time_point begin;
  SimulationObserver observer;
  // The second call is the one between the adding of the bodies and the run.
  int calls = 0;
  observer.between_events = [&](const Detector&) {
    if (++calls == 2) begin = Clock::now();
  };
  observer.at_end = [&](Detector&) -> Result<void> {
    timed.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    return {};
  };
  timed.result = require(simulate(scene, make_world_detector, observer, workers));
  return timed;
}

template <class Quotient>
double median_of(const std::vector<ThreadsTurn>& turns, Quotient quotient) {
  std::vector<double> quotients;
  quotients.reserve(turns.size());
  for (const ThreadsTurn& turn : turns) quotients.push_back(quotient(turn));
  return median(std::move(quotients));
}

}  // namespace

double ThreadsRow::one_to_loop() const {
  return median_of(turns, [](const ThreadsTurn& turn) { return turn.one / turn.loop; });
}

double ThreadsRow::one_to_many() const {
  return median_of(turns, [](const ThreadsTurn& turn) { return turn.one / turn.many; });
}

ThreadsRow compare_threads(const SpeedScene& entry, int threads, const SpeedSettings& settings) {
  const Scene scene = entry.make(entry.response);
  Workers one = require(Workers::create(1)), many = require(Workers::create(threads));
  ThreadsRow row{entry.name, entry.bodies, threads, {}, 0, 0};
  for (int turn = 0; turn < settings.repetitions; ++turn) {
    const TimedSimulation runs[] = {time_simulation(scene, nullptr), time_simulation(scene, &one),
                                    time_simulation(scene, &many)};
    row.turns.push_back({runs[0].seconds, runs[1].seconds, runs[2].seconds});
    const auto& events = runs[0].result.counters.events;
    row.events = std::accumulate(events.begin(), events.end(), std::uint64_t{0});
    row.hash = runs[0].result.contact_hash;
    for (const TimedSimulation& run : runs) {
      if (run.result.contact_hash == row.hash) continue;
      throw ProgramError(
          fmt::format("bench speed --threads: expected the hash {:016x} in {}, but got {:016x}", row.hash,
                      entry.name, run.result.contact_hash));
    }
  }
  return row;
}

std::vector<Verdict> verdicts_of_threads(const std::vector<ThreadsRow>& rows) {
  std::vector<Verdict> all;
  for (const ThreadsRow& row : rows) {
    all.push_back({"6", "run on one thread to a loop", row.scene, "", true, 1.1, row.one_to_loop()});
    if (row.threads == 2)
      all.push_back({"6", "times faster on two threads", row.scene, "", false, 1.6, row.one_to_many()});
  }
  return all;
}

}  // namespace kinesphere::program
