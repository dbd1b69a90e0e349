// Planetesimals on Kepler orbits that cross the circular orbit of a planet: how often they hit it, beside the
// probability of Öpik (Proc. R. Irish Acad. 54A, 165, 1951; Wetherill, J. Geophys. Res. 72, 2429, 1967). A
// collision takes a hundredth of an orbit, and no step of time is needed to find it. Units: radius and speed
// of the planet's orbit. The masses of all but the star are neglected, and planetesimals do not meet each
// other.
#include <kinesphere/kinesphere.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

using namespace kinesphere;

namespace {

constexpr double pi = std::numbers::pi;

/// An ellipse around the star.
class Orbit {
 public:
  /// Semi-major axis, eccentricity, inclination, longitude of the node, argument of the periapsis, and mean
  /// anomaly at time 0 (radians).
  Orbit(double a, double e, double i, double node, double periapsis, double anomaly)
      : a_(a), e_(e), anomaly_(anomaly) {
    const auto turned = [=](double angle) {
      const double x = std::cos(angle), y = std::sin(angle) * std::cos(i);
      return Vec3{std::cos(node) * x - std::sin(node) * y, std::sin(node) * x + std::cos(node) * y,
                  std::sin(angle) * std::sin(i)};
    };
    along_ = turned(periapsis);
    across_ = turned(periapsis + pi / 2);
  }
  State at(double time) const {
    const double rate = std::pow(a_, -1.5), wide = std::sqrt(1 - e_ * e_);
    const double mean = std::remainder(anomaly_ + rate * time, 2 * pi);
    double E = mean + e_ * std::sin(mean);  // Kepler's equation by Newton's method
    for (int step = 0; step < 5; ++step) E -= (E - e_ * std::sin(E) - mean) / (1 - e_ * std::cos(E));
    const double speed = a_ * rate / (1 - e_ * std::cos(E));
    return {a_ * ((std::cos(E) - e_) * along_ + wide * std::sin(E) * across_),
            speed * (wide * std::cos(E) * across_ - std::sin(E) * along_)};
  }
  /// Acceleration at the periapsis, the largest one.
  double largest_acceleration() const { return 1 / ((a_ - a_ * e_) * (a_ - a_ * e_)); }

 private:
  double a_, e_, anomaly_;
  Vec3 along_, across_;
};

}  // namespace

int main() {
  const int count = 500, orbits = 50;
  const double a = 1.3, e = 0.4, i = 0.3, radius = 0.05;
  std::vector<Orbit> all{{1, 0, 0, 0, 0, 0}};
  Random random(1);
  const auto angle = [&] { return random.uniform(0, 2 * pi); };
  for (int k = 0; k < count; ++k) {
    const double node = angle(), periapsis = angle();
    all.emplace_back(a, e, i, node, periapsis, angle());
  }
  World world = World::create({}).value();
  for (const Orbit& orbit : all) {
    const bool is_planet = world.size() == 0;
    const State start = orbit.at(0);
    world
        .add({.radius = is_planet ? radius : 0.0,
              .acceleration_limit = orbit.largest_acceleration() * (1 + 1e-9),
              .position = start.position,
              .velocity = start.velocity,
              .filter = {.category = is_planet ? 2u : 1u, .mask = is_planet ? 1u : 2u}})
        .value();
  }
  const auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = all[ids[k].index].at(time);
  };
  int hits = 0;
  bool is_kept = true;
  for (const Event& event : world.events(orbits * 2 * pi * std::pow(a, 1.5), probe)) {
    hits += event.kind == EventKind::contact_begin;
    is_kept = is_kept && event.kind != EventKind::bound_violation;
  }
  const double U = std::sqrt(3 - 1 / a - 2 * std::sqrt(a * (1 - e * e)) * std::cos(i));
  const double radial = std::sqrt(2 - 1 / a - a * (1 - e * e));
  const double expected = count * orbits * radius * radius * U / (pi * std::sin(i) * radial);
  std::printf("%d hits, %.0f +- %.0f by Opik; %.1f questions for each orbit of a planetesimal\n", hits,
              expected, std::sqrt(expected), double(world.counters().probes) / (count * orbits));
  return is_kept && std::abs(hits / expected - 1) < 0.15 ? 0 : 1;
}
