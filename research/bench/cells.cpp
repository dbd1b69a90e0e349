// Section 3.2: quality of the cell size that the cost model chooses, and accuracy of its rates. Section 3.3:
// candidates that come after the reset of their bound need not enter the event tree.
#include "research/bench/measurement.hpp"
#include "research/bench/sections.hpp"
#include "research/rivals/event_driven/cost_model.hpp"

namespace kinesphere::program {
namespace {

/// Factor of cost within which a chosen edge counts as good, compared with the other edges tried. Smaller
/// factors would count noise of the model, larger ones hide bad choices.
constexpr double good_enough = 1.25;

CostModel model_of(const Scene& scene) {
  std::vector<MovingSphere> spheres;
  for (std::uint32_t body = 0; body < scene.bodies.size(); ++body) {
    const BodyDefinition definition = scene.motion->definition(body, scene.world.start_time);
    spheres.push_back({.radius = scene.bodies[body].radius + definition.position_error,
                       .speed = norm(definition.velocity),
                       .growth_speed = definition.velocity_error,
                       .limit = definition.acceleration_limit});
  }
  return {spheres, *scene.world.box, true};
}

struct Case {
  std::uint32_t bodies;
  double speed;  ///< factor of the paper's speeds
};

struct Tables {
  ResultTable sweep{
      {"n", "speed", "edge", "edge_to_chosen", "ms_per_second", "model_ms_per_second", "contacts", "hash"}};
  ResultTable choice{{"n", "speed", "chosen_edge", "best_edge", "time_to_best", "within_a_quarter"}};
  ResultTable rates{{"n", "speed", "rate", "expected", "measured", "expected_to_measured"}};
};

void add_rates(ResultTable& table, const Case& what, const ExpectedRates& expected, const Run& run) {
  const auto add = [&](const char* name, double rate, std::uint64_t DetectorCounters::*count) {
    const double measured = static_cast<double>(run.count(count)) / run.result.simulated_time;
    table.row({std::uint64_t{what.bodies}, what.speed, std::string(name), rate, measured, rate / measured});
  };
  add("entering", expected.entering, &DetectorCounters::entering);
  add("leaving", expected.leaving, &DetectorCounters::leaving);
  add("resetting", expected.resetting, &DetectorCounters::resetting);
  add("colliding", expected.colliding, &DetectorCounters::colliding);
  add("pair tests", expected.pair_tests, &DetectorCounters::certificates);
}

void add_case(Tables& tables, const Case& what, const BenchSettings& settings) {
  SceneParameters parameters = first_experiment(what.bodies, settings.cell_body_seconds / what.bodies);
  parameters.speed_min *= what.speed;
  parameters.speed_max *= what.speed;
  const auto scenes = seeded_scenes(parameters, 1);
  const Scene& scene = scenes.front();
  const CostModel model = model_of(scene);
  const double chosen = model.choose_cell_edge();

  std::vector<NamedDetector> detectors;
  for (const double factor : settings.cell_factors)
    detectors.push_back(paper_engine({.cell_edge = factor * chosen}));
  const auto series = measure(detectors, scenes, settings.repetitions);
  std::size_t best = 0, own = 0;
  for (std::size_t k = 0; k < settings.cell_factors.size(); ++k) {
    const double factor = settings.cell_factors[k];
    if (series[k].per_simulated_second() < series[best].per_simulated_second()) best = k;
    if (factor == 1.0) own = k;
    tables.sweep.row({std::uint64_t{what.bodies}, what.speed, factor * chosen, factor,
                      1e3 * series[k].per_simulated_second(),
                      1e-6 * model.expected_rates(factor * chosen).cost, series[k].contacts(),
                      series[k].hash()});
  }
  const double to_best = ratio(series[own], series[best]).median;
  tables.choice.row({std::uint64_t{what.bodies}, what.speed, chosen, settings.cell_factors[best] * chosen,
                     to_best, to_best <= good_enough});
  add_rates(tables.rates, what, model.expected_rates(chosen), series[own].runs.front());
}

}  // namespace

void bench_cells(const Report& report, const BenchSettings& settings) {
  Tables tables;
  for (const std::uint32_t bodies : settings.cell_bodies) {
    for (const double speed : settings.cell_speeds) add_case(tables, {bodies, speed}, settings);
  }
  report.note(
      "The first experiment with edges of the finest grid around the model's choice; speed: factor of the "
      "paper's.");
  report.table("cells_sweep", tables.sweep);
  report.note("The choice against the best edge tried:");
  report.table("cells_choice", tables.choice);
  report.note("Per simulated second, at the chosen edge:");
  report.table("cells_rates", tables.rates);
}

void bench_trimming(const Report& report, const BenchSettings& settings) {
  ResultTable table({"n", "seconds", "trimming", "inserted", "removed", "largest_tree", "ms_per_second",
                     "time_ratio", "contacts", "hash"});
  bool same = true;
  for (const Trial& trial : settings.trimming) {
    const auto scenes = seeded_scenes(first_experiment(trial.bodies, trial.seconds), trial.seeds);
    const auto series =
        measure({paper_engine(), paper_engine({.trimming = false})}, scenes, settings.repetitions);
    for (const bool trimming : {true, false}) {
      const Series& one = series[trimming ? 0 : 1];
      const DetectorCounters& c = one.result().counters;
      table.row({std::uint64_t{trial.bodies}, trial.seconds, std::string(trimming ? "on" : "off"),
                 c.event_insertions, c.event_removals, c.largest_queue, 1e3 * one.per_simulated_second(),
                 ratio(one, series[0]).median, one.contacts(), one.hash()});
    }
    same = same && series[0].hash() == series[1].hash();
  }
  report.table("trimming", table);
  report.note(same ? "With and without, the contacts are the same to the last bit."
                   : "With and without, the contacts are NOT the same to the last bit.");
}

}  // namespace kinesphere::program
