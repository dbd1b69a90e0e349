#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/program_error.hpp"
#include "research/bench/benchmark.hpp"
#include "research/bench/commands.hpp"
#include "research/bench/measurement.hpp"
#include "research/bench/shapes/pair_methods.hpp"

namespace kinesphere::program {
namespace {

constexpr std::uint64_t shapes_seed = 44;

struct ShapesSettings {
  std::size_t pairs;  ///< of each kind
  int repetitions;
};

const ShapesSettings& shapes_settings(Effort effort) {
  static constexpr ShapesSettings quick{24, 1};
  static constexpr ShapesSettings usual{2000, 5};
  static constexpr ShapesSettings full{20000, 5};
  return chosen(effort, quick, usual, full);
}

/// Answers and times of one method.
struct MethodResult {
  std::vector<std::optional<double>> contacts;  ///< by pair
  std::vector<double> microseconds;             ///< for each pair, by repetition
};

std::vector<MethodResult> run_in_turns(const std::vector<PairMethod>& methods,
                                       const std::vector<TurningPair>& pairs, int repetitions) {
  std::vector<MethodResult> results(methods.size());
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    for (std::size_t k = 0; k < methods.size(); ++k) {
      results[k].contacts.clear();
      const double begin = cpu_seconds();
      for (const TurningPair& pair : pairs) results[k].contacts.push_back(methods[k].first_contact(pair));
      results[k].microseconds.push_back(1e6 * (cpu_seconds() - begin) / static_cast<double>(pairs.size()));
    }
  }
  return results;
}

/// What is wrong with the answers of a method.
struct Mistakes {
  std::uint64_t missed = 0;    ///< pairs that touch, of which the method says that they do not
  std::uint64_t invented = 0;  ///< pairs that do not touch, of which it says that they do
  double invented_gap = 0.0;   ///< largest least gap of these
  std::vector<double> errors;  ///< of the times of the other contacts: 0 within what is certain of the truth
  double earliest = 0.0;       ///< largest error to the early side
  double latest = 0.0;         ///< largest error to the late side
};

Mistakes mistakes(const std::vector<std::optional<double>>& contacts, const std::vector<TurningPair>& pairs) {
  Mistakes found;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const FirstContact& truth = pairs[k].truth;
    found.missed += truth.exists && !contacts[k];
    if (!truth.exists && contacts[k]) {
      ++found.invented;
      found.invented_gap = std::max(found.invented_gap, least_gap(pairs[k]));
    }
    if (!truth.exists || !contacts[k]) continue;
    const double early = std::max(truth.from - *contacts[k], 0.0);
    const double late = std::max(*contacts[k] - truth.to, 0.0);
    found.errors.push_back(early + late);
    found.earliest = std::max(found.earliest, early);
    found.latest = std::max(found.latest, late);
  }
  return found;
}

void add_rows(ResultTable& table, const PairKind& kind, const ShapesSettings& settings) {
  const std::vector<TurningPair> pairs = draw_pairs(kind, settings.pairs, shapes_seed);
  const auto touching = static_cast<std::uint64_t>(
      std::count_if(pairs.begin(), pairs.end(), [](const TurningPair& pair) { return pair.truth.exists; }));
  std::vector<PairMethod> methods = world_methods();
  for (PairMethod& method : fcl_methods()) methods.push_back(std::move(method));
  const auto results = run_in_turns(methods, pairs, settings.repetitions);
  for (std::size_t k = 0; k < methods.size(); ++k) {
    const Mistakes found = mistakes(results[k].contacts, pairs);
    table.row({std::string(kind.name), methods[k].name, pairs.size(), touching,
               median(results[k].microseconds), found.missed, found.invented, found.invented_gap,
               found.errors.empty() ? Cell{} : median(found.errors), found.earliest, found.latest});
  }
}

void bench_shapes(const BenchOptions& options, const Report& report) {
  const ShapesSettings& settings = shapes_settings(options.effort());
  report.note(
      fmt::format("{} pairs of each kind, seed {}, for one unit of time. Microseconds are CPU time for each "
                  "pair, medians of {} turns. Missed and invented contacts are against intervals that "
                  "certainly have the first contact, at most 1e-9 wide; the invented gap is the largest "
                  "least gap of a pair that is said to touch. Errors are of the times of all other contacts: "
                  "their median, the most that one came too early, and too late.",
                  settings.pairs, shapes_seed, settings.repetitions));
  ResultTable table({"kind", "method", "pairs", "touching", "microseconds", "missed", "invented",
                     "invented_gap", "median_error", "too_early", "too_late"});
  for (const PairKind& kind : pair_kinds)
    if (options.has(kind.name)) add_rows(table, kind, settings);
  report.table("shapes", table);
  if (fcl_methods().empty())
    report.note("FCL is left out: it was not installed when this program was built (libfcl-dev).");
}

}  // namespace

Command add_shapes(CLI::App& app) {
  return add_benchmark(
      app,
      {.name = "shapes",
       .description =
           "First contacts of capsules, clusters of balls and boxes that turn, beside FCL; takes minutes",
       .full_description = "Ten times as many pairs",
       .parts = names_of_parts(pair_kinds),
       .run = bench_shapes});
}

}  // namespace kinesphere::program
