#include "research/bench/arcs.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "kinesphere/random.hpp"

namespace kinesphere::program {
namespace {

constexpr double gravity = 398600.4418;  ///< of the earth (km^3 / s^2)
constexpr double arc_angle = 0.65;       ///< longest arc (radians, at the angular speed of the perigee)
constexpr std::size_t fitted_terms = 12;
constexpr double fit_error = 1e-3;  ///< declared (km)

using Values = std::array<double, fitted_terms>;

/// Kepler's ellipse: two axes of its plane, and where it is at time 0.
struct Ellipse {
  double semimajor, eccentricity, rate, mean_anomaly;
  Vec3 to_perigee, across;

  Vec3 at(double time) const {
    const double mean = mean_anomaly + rate * time;
    // Newton's method, from a start (Danby's) from which it converges for each ellipse.
    double anomaly = mean + std::copysign(0.85 * eccentricity, std::sin(mean));
    for (int k = 0; k < 8; ++k) {
      const double wrong = anomaly - eccentricity * std::sin(anomaly) - mean;
      anomaly -= wrong / (1.0 - eccentricity * std::cos(anomaly));
    }
    const double minor = semimajor * std::sqrt(1.0 - eccentricity * eccentricity);
    return semimajor * (std::cos(anomaly) - eccentricity) * to_perigee + minor * std::sin(anomaly) * across;
  }
  /// Returns the angular speed at the perigee.
  double fastest() const {
    const double e = eccentricity;
    return rate * (1.0 + e) * (1.0 + e) / std::pow(1.0 - e * e, 1.5);
  }
};

/// Draws one: seven of eight are low and nearly round, the others go far out.
Ellipse drawn(Random random) {
  constexpr double tau = 2.0 * std::numbers::pi, degree = std::numbers::pi / 180.0;
  constexpr double inclinations[] = {53.0, 70.0, 86.4, 97.8};
  const bool is_low = random.uniform() < 0.875;
  const double perigee = is_low ? random.uniform(6778.0, 7578.0) : random.uniform(6678.0, 7378.0);
  const double e = is_low ? 0.003 * random.uniform() : random.uniform(0.1, 0.73);
  const double semimajor = perigee / (1.0 - e);
  const double shell = inclinations[random.bits() % 4];
  const double inclination = degree * (shell + random.uniform(-1.0, 1.0));
  const double node = tau * random.uniform(), argument = tau * random.uniform();
  const Vec3 ascending{std::cos(node), std::sin(node), 0.0};
  const Vec3 beyond{-std::cos(inclination) * std::sin(node), std::cos(inclination) * std::cos(node),
                    std::sin(inclination)};
  return {.semimajor = semimajor,
          .eccentricity = e,
          .rate = std::sqrt(gravity / (semimajor * semimajor * semimajor)),
          .mean_anomaly = tau * random.uniform(),
          .to_perigee = std::cos(argument) * ascending + std::sin(argument) * beyond,
          .across = std::cos(argument) * beyond - std::sin(argument) * ascending};
}

/// Appends the Chebyshev coefficients that have these values at the Chebyshev nodes.
void fit(const Values& values, std::vector<double>& coefficients) {
  for (std::size_t k = 0; k < fitted_terms; ++k) {
    double sum = 0.0;
    for (std::size_t n = 0; n < fitted_terms; ++n) {
      sum += values[n] * std::cos(std::numbers::pi * static_cast<double>(k) * (static_cast<double>(n) + 0.5) /
                                  fitted_terms);
    }
    coefficients.push_back((k == 0 ? 1.0 : 2.0) / fitted_terms * sum);
  }
}

void append_arc(const Ellipse& ellipse, std::uint32_t body, double begin, double end, Arcs& arcs) {
  std::array<Values, 3> values;
  for (std::size_t n = 0; n < fitted_terms; ++n) {
    const double node = std::cos(std::numbers::pi * (static_cast<double>(n) + 0.5) / fitted_terms);
    const Vec3 place = ellipse.at(0.5 * (begin + end) + 0.5 * (end - begin) * node);
    values[0][n] = place.x;
    values[1][n] = place.y;
    values[2][n] = place.z;
  }
  arcs.bodies.push_back(body);
  arcs.begins.push_back(begin);
  arcs.ends.push_back(end);
  for (const Values& axis : values) fit(axis, arcs.coefficients);
}

}  // namespace

PolynomialPaths Arcs::paths() const {
  PolynomialPaths paths;
  paths.terms = terms;
  paths.bodies = bodies;
  paths.begins = begins;
  paths.ends = ends;
  paths.coefficients = coefficients;
  paths.errors = errors;
  return paths;
}

std::size_t Arcs::bytes() const {
  return sizeof(double) * (errors.size() + begins.size() + ends.size() + coefficients.size()) +
         sizeof(std::uint32_t) * bodies.size();
}

Arcs satellite_arcs(std::uint32_t satellites, double seconds, std::uint64_t seed) {
  Arcs arcs{.terms = fitted_terms, .errors = std::vector<double>(satellites, fit_error)};
  for (std::uint32_t body = 0; body < satellites; ++body) {
    const Ellipse ellipse = drawn(Random::at(seed, 0, body));
    const double count = std::ceil(seconds * ellipse.fastest() / arc_angle);
    double begin = 0.0;
    for (double k = 1.0; k <= count; ++k) {
      const double end = k == count ? seconds : seconds * k / count;
      append_arc(ellipse, body, begin, end, arcs);
      begin = end;
    }
  }
  return arcs;
}

}  // namespace kinesphere::program
