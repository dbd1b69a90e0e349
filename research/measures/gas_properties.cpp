#include "research/measures/gas_properties.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace kinesphere {
namespace {

/// The sums of a run up to `time`.
struct Mark {
  double time = 0.0;
  std::uint64_t contacts = 0;
  double virial = 0.0;  ///< sum of distance times exchanged momentum, for spheres of mass 1
};

/// Sums over all spheres, of mass 1.
struct Totals {
  double twice_energy = 0.0;
  Vec3 momentum{};
};

Totals totals_of(const Motion& motion, double time) {
  Totals totals;
  for (std::uint32_t body = 0; body < motion.size(); ++body) {
    const Vec3 velocity = motion.state(body, time).velocity;
    totals.twice_energy += norm_squared(velocity);
    totals.momentum += velocity;
  }
  return totals;
}

/// Gauge watches a run and keeps the sums.
class Gauge {
 public:
  void count(const Event& event) {
    if (event.kind != EventKind::contact_begin) return;
    ++now_.contacts;
    // Equal masses exchange the velocities along the line of centres.
    now_.virial += norm(event.second_state.position - event.first_state.position) * event.approach_speed;
  }

  void mark(const Motion& motion, double time) {
    now_.time = time;
    marks.push_back(now_);
    const Totals totals = totals_of(motion, time);
    if (marks.size() == 1) start = totals;
    energy_change = std::max(energy_change, std::abs(totals.twice_energy - start.twice_energy));
    momentum_change = std::max(momentum_change, norm(totals.momentum - start.momentum));
  }

  std::vector<Mark> marks;
  Totals start;
  double energy_change = 0.0;  ///< twice the largest change of the energy
  double momentum_change = 0.0;

 private:
  Mark now_;
};

Estimate estimate_of(const std::vector<double>& blocks) {
  const auto count = static_cast<double>(blocks.size());
  double sum = 0.0;
  for (const double block : blocks) sum += block;
  const double mean = sum / count;
  double scatter = 0.0;
  for (const double block : blocks) scatter += (block - mean) * (block - mean);
  return {mean, std::sqrt(scatter / (count * (count - 1.0)))};
}

GasProperties properties_of(const Scene& scene, const Gauge& gauge, const GasBlocks& blocks) {
  const auto number = static_cast<double>(scene.bodies.size());
  const double diameter = 2.0 * scene.bodies.front().radius;
  // Temperature is that of the motion relative to the centre of mass.
  const double thermal_energy =
      gauge.start.twice_energy - norm_squared(gauge.start.momentum) / number;  // twice the energy
  const double temperature = thermal_energy / (3.0 * (number - 1.0));
  const double thermal_speed = std::sqrt(temperature);
  std::vector<double> rates;
  std::vector<double> compressibilities;
  const auto first = static_cast<std::size_t>(blocks.equilibration);
  const std::size_t end = first + static_cast<std::size_t>(blocks.measured);
  for (std::size_t block = first; block < end; ++block) {
    const Mark& from = gauge.marks[block];
    const Mark& to = gauge.marks[block + 1];
    const double time = to.time - from.time;
    const auto contacts = static_cast<double>(to.contacts - from.contacts);
    rates.push_back(2.0 * contacts / (number * time) * diameter / thermal_speed);
    compressibilities.push_back(1.0 + (to.virial - from.virial) / (3.0 * number * temperature * time));
  }
  const Vec3 size = scene.world.box->upper - scene.world.box->lower;
  GasProperties properties;
  properties.packing =
      number * std::numbers::pi / 6.0 * diameter * diameter * diameter / (size.x * size.y * size.z);
  properties.collision_rate = estimate_of(rates);
  properties.compressibility = estimate_of(compressibilities);
  properties.contacts = gauge.marks[end].contacts - gauge.marks[first].contacts;
  properties.energy_change = gauge.energy_change / gauge.start.twice_energy;
  properties.momentum_change = gauge.momentum_change / (number * thermal_speed);
  return properties;
}

}  // namespace

double hard_sphere_compressibility(double packing) {
  const double x = packing / (1.0 - packing);
  const double x2 = x * x;
  const double x4 = x2 * x2;
  const double x8 = x4 * x4;
  const double to_x3 = 1.0 + x * (4.0 + x * (6.0 + x * 2.3647684));
  const double x4_to_x8 =
      x4 * (-0.8698551 + x * (1.1062803 + x * (-1.1014221 + x * (0.66605866 - x * 0.03633431))));
  return to_x3 + x4_to_x8 + x8 * x2 * (-0.20965164 + x4 * (0.10555569 - x8 * 0.00872380));
}

double hard_sphere_collision_rate(double packing) {
  return 6.0 * (hard_sphere_compressibility(packing) - 1.0) / std::sqrt(std::numbers::pi);
}

Result<GasProperties> measure_gas(const Scene& scene, const DetectorMaker& make, const GasBlocks& blocks) {
  Gauge gauge;
  SceneObserver observer;
  observer.on_event = [&](const Event& event) { gauge.count(event); };
  observer.on_frame = [&](const Detector&, const Motion& motion, double time) { gauge.mark(motion, time); };
  observer.frame_interval =
      (scene.end_time - scene.world.start_time) / static_cast<double>(blocks.equilibration + blocks.measured);
  auto result = run_scene(scene, make, observer);
  if (!result) return result.error();
  GasProperties properties = properties_of(scene, gauge, blocks);
  properties.result = *result;
  return properties;
}

}  // namespace kinesphere
