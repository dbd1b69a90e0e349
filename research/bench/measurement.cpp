#include "research/bench/measurement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <optional>
#include <utility>

#include "base/program_error.hpp"
#include "research/rivals/rivals.hpp"
#include "scenes/scene_file.hpp"
#include "simulation/run/run_scene.hpp"

namespace kinesphere::program {
namespace {

NamedDetector named(const std::string& name, const DetectorSettings& settings = {}) {
  return {name, require(detector_maker(name, settings))};
}

Run run_once(const NamedDetector& detector, const Scene& scene) {
  Run run;
  const double begin = cpu_seconds();
  std::optional<double> start;
  // Counters and times are read at the start, when all bodies are in, and at the end, before destruction.
  SceneObserver observer;
  observer.frame_interval = scene.end_time - scene.world.start_time;
  observer.on_frame = [&](const Detector& watching, const Motion&, double) {
    const double now = cpu_seconds();
    if (start) {
      run.simulating = now - *start;
      return;
    }
    run.preparing = now - begin;
    run.prepared = watching.counters();
    start = cpu_seconds();
  };
  run.result = require(run_scene(scene, detector.make, observer));
  return run;
}

template <class Value>
std::vector<double> values_of(const std::vector<Run>& runs, Value Run::*value) {
  std::vector<double> values(runs.size());
  std::ranges::transform(runs, values.begin(), value);
  return values;
}

SceneParameters built_in(std::string_view name, std::uint32_t bodies, double seconds) {
  SceneParameters parameters = find_scene(std::string(name)).parameters;
  parameters.bodies = bodies;
  parameters.seconds = seconds;
  return parameters;
}

}  // namespace

NamedDetector paper_engine(const PaperOptions& options) { return named("paper", {.paper = options}); }

NamedDetector hubbard_engine() { return named("hubbard"); }

NamedDetector hayward_engine() { return named("hayward"); }

NamedDetector fixed_step_engine(double step) { return named("fixed-step", {.step = step}); }

NamedDetector world_engine() { return named("world"); }

NamedDetector alarm_engine(double distance) {
  return {"world", [distance](const WorldDefinition& definition, const Motion& motion) {
            return make_sensing_detector(definition, motion, {.distances = {distance}});
          }};
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t quarter = values.size() / 4;
  return {median(values), values[quarter], values[values.size() - 1 - quarter]};
}

Spread Series::spread() const { return program::spread(values_of(runs, &Run::per_simulated_second)); }

double Series::preparing() const { return median(values_of(runs, &Run::preparing)); }

std::uint64_t Series::contacts() const {
  const Counters& counters = result().counters;
  return counters.count(EventKind::contact_begin) + counters.count(EventKind::wall_begin);
}

std::string Series::hash() const { return fmt::format("{:016x}", result().contact_hash); }

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

Spread ratio(const Series& series, const Series& other) {
  std::vector<double> ratios;
  for (std::size_t k = 0; k < series.runs.size(); ++k)
    ratios.push_back(series.runs[k].simulating / other.runs[k].simulating);
  return spread(std::move(ratios));
}

std::vector<Series> measure(const std::vector<NamedDetector>& detectors, const std::vector<Scene>& scenes,
                            int repetitions) {
  std::vector<Series> series(detectors.size());
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    for (const Scene& scene : scenes) {
      for (std::size_t k = 0; k < detectors.size(); ++k)
        series[k].runs.push_back(run_once(detectors[k], scene));
    }
  }
  return series;
}

std::vector<Scene> seeded_scenes(SceneParameters parameters, std::uint64_t seeds) {
  std::vector<Scene> scenes;
  for (parameters.seed = 1; parameters.seed <= seeds; ++parameters.seed)
    scenes.push_back(require(make_scene(parameters)));
  return scenes;
}

SceneParameters first_experiment(std::uint32_t bodies, double seconds) {
  return built_in("paper1", bodies, seconds);
}

SceneParameters second_experiment(std::uint32_t bodies, double seconds) {
  return built_in("paper2", bodies, seconds);
}

ContactCounts count_contacts(const Scene& scene, const DetectorMaker& make) {
  ContactCounts counts;
  SceneObserver observer;
  observer.on_event = [&](const Event& event) {
    if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) return;
    const BodyId second = event.second == no_body ? event.first : event.second;
    ++counts[{event.first.index, second.index, event.wall}];
  };
  require(run_scene(scene, make, observer));
  return counts;
}

ContactCounts body_contacts(const ContactCounts& counts) {
  ContactCounts found = counts;
  std::erase_if(found, [](const auto& entry) { return std::get<2>(entry.first) != Wall::none; });
  return found;
}

ContactCounts wall_contacts(const ContactCounts& counts) {
  ContactCounts found = counts;
  std::erase_if(found, [](const auto& entry) { return std::get<2>(entry.first) == Wall::none; });
  return found;
}

std::uint64_t total(const ContactCounts& counts) {
  std::uint64_t sum = 0;
  for (const auto& [pair, count] : counts) sum += count;
  return sum;
}

std::uint64_t missed(const ContactCounts& truth, const ContactCounts& seen) {
  std::uint64_t missed = 0;
  for (const auto& [pair, count] : truth) {
    const auto found = seen.find(pair);
    missed += count - std::min(count, found == seen.end() ? 0 : found->second);
  }
  return missed;
}

}  // namespace kinesphere::program
