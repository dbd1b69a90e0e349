// Section 4.3: particles in a velocity field; the time they take, and the pictures of figures 7 and 8.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/program_error.hpp"
#include "research/bench/measurement.hpp"
#include "research/bench/sections.hpp"

namespace kinesphere::program {
namespace {

enum class Shown { spheres, bounds };

void draw(const Report& report, const std::string& name, const Scene& scene, const Detector& detector,
          const Motion& motion, double time, Shown shown) {
  struct Drawn {
    Vec3 centre;
    double radius;
  };
  std::vector<Drawn> drawn;
  for (std::uint32_t body = 0; body < scene.bodies.size(); ++body) {
    const Bound bound = require(detector.bound(body));
    drawn.push_back(shown == Shown::spheres
                        ? Drawn{motion.state(body, time).position, scene.bodies[body].radius}
                        : Drawn{bound.centre_at(time), bound.radius_at(time)});
  }
  std::stable_sort(drawn.begin(), drawn.end(),
                   [](const Drawn& a, const Drawn& b) { return a.centre.y > b.centre.y; });
  ResultTable table({"x", "y", "z", "radius"});
  for (const Drawn& sphere : drawn)
    table.row({sphere.centre.x, sphere.centre.y, sphere.centre.z, sphere.radius});
  const char* what = shown == Shown::spheres ? "spheres" : "time-varying bounds";
  report.plot({.name = name, .title = fmt::format("{} at t = {:g} s", what, time), .box = *scene.world.box},
              table);
}

/// Calls show(detector, motion, time) at every multiple of `interval`.
template <class Show>
void watch(const Scene& scene, double interval, Show show) {
  SceneObserver observer;
  observer.frame_interval = interval;
  observer.on_frame = show;
  require(run_scene(scene, paper_engine().make, observer));
}

void draw_figure7(const Report& report, const BenchSettings& settings, const Scene& scene) {
  const double shown = settings.snapshot_time;
  watch(scene, shown, [&](const Detector& detector, const Motion& motion, double time) {
    if (time == 0.0) draw(report, "figure7a", scene, detector, motion, time, Shown::spheres);
    if (time != shown) return;
    draw(report, "figure7b", scene, detector, motion, time, Shown::spheres);
    draw(report, "figure7c", scene, detector, motion, time, Shown::bounds);
  });
}

void draw_figure8(const Report& report, const BenchSettings& settings, const Scene& scene) {
  int shown = 0;
  watch(scene, settings.sequence_interval, [&](const Detector& detector, const Motion& motion, double time) {
    draw(report, fmt::format("figure8_{}", shown++), scene, detector, motion, time, Shown::spheres);
  });
  report.note(fmt::format(
      "Pictures: figure7a, figure7b, figure7c, figure8_0 ... figure8_{} (.csv, .gp, .png)", shown - 1));
}

}  // namespace

void bench_circulation(const Report& report, const BenchSettings& settings) {
  const auto scenes =
      seeded_scenes(second_experiment(settings.circulation_bodies, settings.circulation_seconds), 1);
  const auto series = measure({paper_engine(), world_engine()}, scenes, settings.repetitions);
  ResultTable table({"detector", "n", "seconds", "seed", "s_per_second", "s_per_second_low",
                     "s_per_second_high", "ratio", "published_s", "speedup", "contacts",
                     "probes_per_body_second", "hash"});
  for (const auto& [name, one] : {std::pair("paper", &series[0]), std::pair("world", &series[1])}) {
    const Spread spent = one->spread();
    const bool comparable = one == &series[0] && settings.circulation_bodies == 1000;
    table.row({std::string(name), std::uint64_t{settings.circulation_bodies}, settings.circulation_seconds,
               std::uint64_t{1}, spent.median, spent.low, spent.high, ratio(*one, series[0]).median,
               comparable ? Cell(published_circulation) : Cell(),
               comparable ? Cell(published_circulation / spent.median) : Cell(), one->contacts(),
               static_cast<double>(one->result().counters.probes) / one->result().body_time, one->hash()});
  }
  report.table("circulation", table);
  draw_figure7(report, settings, scenes.front());
  draw_figure8(report, settings, scenes.front());
}

}  // namespace kinesphere::program
