// Table 1: the paper's algorithm against Hubbard's broad phase, with others beside them.
#include <fmt/format.h>

#include <utility>

#include "research/bench/measurement.hpp"
#include "research/bench/sections.hpp"
#include "simulation/oracle/oracle.hpp"

namespace kinesphere::program {
namespace {

/// Contacts of one kind, and the number of them that steps overlook.
struct Misses {
  std::uint64_t contacts = 0;
  std::uint64_t with_game_steps = 0;
  std::uint64_t with_long_steps = 0;

  void add(const ContactCounts& truth, const ContactCounts& game, const ContactCounts& slow) {
    contacts += total(truth);
    with_game_steps += missed(truth, game);
    with_long_steps += missed(truth, slow);
  }
};

struct MissesByKind {
  Misses bodies, walls;
};

/// Counts the contacts that steps overlook in scenes without bounces: with bounces there is no common truth
/// for long.
MissesByKind count_misses(SceneParameters parameters, std::uint64_t seeds) {
  parameters.response = SceneResponse::pass_through;
  MissesByKind misses;
  for (const Scene& scene : seeded_scenes(parameters, seeds)) {
    const ContactCounts truth = count_contacts(scene, make_oracle);
    const ContactCounts game = count_contacts(scene, fixed_step_engine(game_step).make);
    const ContactCounts slow = count_contacts(scene, fixed_step_engine(long_step).make);
    misses.bodies.add(body_contacts(truth), body_contacts(game), body_contacts(slow));
    misses.walls.add(wall_contacts(truth), wall_contacts(game), wall_contacts(slow));
  }
  return misses;
}

}  // namespace

void bench_table1(const Report& report, const BenchSettings& settings) {
  ResultTable ours({"n", "seconds", "seeds", "paper_s", "hubbard_s", "ratio", "ratio_low", "ratio_high",
                    "published_paper_s", "published_hubbard_s", "published_ratio", "contacts", "paper_hash",
                    "hubbard_hash"});
  ResultTable others({"n", "seconds", "seeds", "paper_ms", "world_ms", "world_ms_low", "world_ms_high",
                      "paper_to_world", "paper_to_world_low", "paper_to_world_high", "hayward_ms",
                      "fixed_step_ms", "contacts", "step_contacts", "paper_hash", "world_hash"});
  ResultTable overlooked({"n", "seconds", "seeds", "kind", "contacts", "missed_by_steps", "by_long_steps"});
  for (const Trial& trial : settings.table1) {
    const SceneParameters parameters = first_experiment(trial.bodies, trial.seconds);
    const auto series = measure(
        {paper_engine(), hubbard_engine(), world_engine(), hayward_engine(), fixed_step_engine(game_step)},
        seeded_scenes(parameters, trial.seeds), 1);
    const Series &paper = series[0], &hubbard = series[1], &world = series[2], &hayward = series[3],
                 &steps = series[4];
    const Spread to_paper = ratio(hubbard, paper);
    const auto published = published_times(trial.bodies);
    const auto cell = [&](double PublishedTimes::*value) {
      return published ? Cell((*published).*value) : Cell();
    };
    ours.row({std::uint64_t{trial.bodies}, trial.seconds, trial.seeds, paper.per_simulated_second(),
              hubbard.per_simulated_second(), to_paper.median, to_paper.low, to_paper.high,
              cell(&PublishedTimes::proposed), cell(&PublishedTimes::hubbard), cell(&PublishedTimes::ratio),
              paper.contacts(), paper.hash(), hubbard.hash()});
    const Spread spent = world.spread(), to_world = ratio(paper, world);
    others.row({std::uint64_t{trial.bodies}, trial.seconds, trial.seeds, 1e3 * paper.per_simulated_second(),
                1e3 * spent.median, 1e3 * spent.low, 1e3 * spent.high, to_world.median, to_world.low,
                to_world.high, 1e3 * hayward.per_simulated_second(), 1e3 * steps.per_simulated_second(),
                paper.contacts(), steps.contacts(), paper.hash(), world.hash()});
    const MissesByKind misses =
        count_misses(first_experiment(trial.bodies, settings.miss_seconds), trial.seeds);
    for (const auto& [kind, one] :
         {std::pair("two bodies", misses.bodies), std::pair("a wall", misses.walls)})
      overlooked.row({std::uint64_t{trial.bodies}, settings.miss_seconds, trial.seeds, std::string(kind),
                      one.contacts, one.with_game_steps, one.with_long_steps});
  }
  report.table("table1", ours);
  report.table("table1_others", others);
  report.table("table1_overlooked", overlooked);
  report.note(
      fmt::format("Times are per simulated second, medians over the seeds, low and high their quartiles; "
                  "\"seconds\" is how long was "
                  "simulated; contacts are those of seed 1. Published: averages over 50 simulations. "
                  "Fixed steps take {:.4g} s, long ones {:.4g} s; what they miss is counted against the "
                  "oracle in the same scenes without bounces, over {} s.",
                  game_step, long_step, settings.miss_seconds));
}

}  // namespace kinesphere::program
