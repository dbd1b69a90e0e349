// Section 4.3: particles in a velocity field; how long they take, and the pictures of figures 7 and 8.
#include <fmt/format.h>

#include <utility>

#include "program_error.hpp"
#include "research/bench/measurement.hpp"
#include "research/bench/published.hpp"
#include "research/bench/sections.hpp"
#include "research/bench/sphere_picture.hpp"

namespace kinesphere::program {
namespace {

std::string picture(const Scene& scene, const Detector& detector, const Motion& motion, double time,
                    SphereStyle style) {
  std::vector<DrawnSphere> spheres;
  for (std::uint32_t body = 0; body < scene.bodies.size(); ++body) {
    const Bound bound = require(detector.bound(body));
    spheres.push_back(style == SphereStyle::bodies
                          ? DrawnSphere{motion.state(body, time).position, scene.bodies[body].radius}
                          : DrawnSphere{bound.centre_at(time), bound.radius_at(time)});
  }
  const char* what = style == SphereStyle::bodies ? "spheres" : "time-varying bounds";
  return sphere_picture(std::move(spheres), *scene.world.box, style,
                        fmt::format("{} at t = {:g} s", what, time));
}

/// Calls show(detector, motion, time) at every multiple of `interval`.
template <class Show>
void watch(const Scene& scene, double interval, Show show) {
  SimulationObserver observer;
  observer.frame_interval = interval;
  observer.on_frame = show;
  require(simulate(scene, paper_engine().make, observer));
}

void draw_figure7(const Report& report, const BenchSettings& settings, const Scene& scene) {
  const double shown = settings.snapshot_time;
  watch(scene, shown, [&](const Detector& detector, const Motion& motion, double time) {
    if (time == 0.0) report.file("figure7a.svg", picture(scene, detector, motion, time, SphereStyle::bodies));
    if (time != shown) return;
    report.file("figure7b.svg", picture(scene, detector, motion, time, SphereStyle::bodies));
    report.file("figure7c.svg", picture(scene, detector, motion, time, SphereStyle::bounds));
  });
}

void draw_figure8(const Report& report, const BenchSettings& settings, const Scene& scene) {
  int shown = 0;
  watch(scene, settings.sequence_interval, [&](const Detector& detector, const Motion& motion, double time) {
    report.file(fmt::format("figure8_{}.svg", shown++),
                picture(scene, detector, motion, time, SphereStyle::bodies));
  });
  report.note(fmt::format(
      "Pictures: figure7a.svg, figure7b.svg, figure7c.svg, figure8_0.svg ... figure8_{}.svg", shown - 1));
}

}  // namespace

void bench_circulation(const Report& report, const BenchSettings& settings) {
  const auto scenes =
      seeded_scenes(second_experiment(settings.circulation_bodies, settings.circulation_seconds), 1);
  const auto series = measure({paper_engine(), world_engine()}, scenes, settings.repetitions);
  ResultTable table({"detector", "n", "seconds", "seed", "s_per_second", "ratio", "published_s", "speedup",
                     "contacts", "probes_per_body_second", "hash"});
  for (const auto& [name, one] : {std::pair("paper", &series[0]), std::pair("world", &series[1])}) {
    const double spent = one->per_simulated_second();
    const bool comparable = one == &series[0] && settings.circulation_bodies == 1000;
    table.row({std::string(name), std::uint64_t{settings.circulation_bodies}, settings.circulation_seconds,
               std::uint64_t{1}, spent, ratio(*one, series[0]),
               comparable ? Cell(published_circulation) : Cell(),
               comparable ? Cell(published_circulation / spent) : Cell(), one->contacts(),
               static_cast<double>(one->result().counters.probes) / one->result().body_time, one->hash()});
  }
  report.table("circulation", table);
  draw_figure7(report, settings, scenes.front());
  draw_figure8(report, settings, scenes.front());
}

}  // namespace kinesphere::program
