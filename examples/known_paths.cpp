// Where do two satellites on known paths come near each other, and how fast do they pass?
#include <kinesphere/approaches.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

using namespace kinesphere;

int main() {
  // Units: kilometres and seconds. Two circular orbits of one radius and other inclinations, as Taylor series
  // of degree 8 around the begin of each arc of 200 s: to 2e-7 km.
  constexpr double radius = 6900.0, rate = 0.0011, arc = 200.0;
  constexpr std::size_t terms = 9;
  std::vector<std::uint32_t> bodies;
  std::vector<double> begins, ends, coefficients;
  for (std::uint32_t body = 0; body < 2; ++body) {
    const double inclination = body == 0 ? 0.9 : 1.7, phase = body == 0 ? 0.0 : 0.0004;
    for (int k = 0; k < 30; ++k) {
      bodies.push_back(body);
      begins.push_back(k * arc);
      ends.push_back((k + 1) * arc);
      for (int axis = 0; axis < 3; ++axis) {
        double factor = radius;
        for (std::size_t term = 0; term < terms; ++term) {
          // The derivatives of a cosine are cosines, each a quarter of a turn ahead.
          const double angle = rate * k * arc + phase + 1.5707963267948966 * double(term);
          const double along = axis == 0 ? std::cos(angle) : std::sin(angle);
          const double part = axis == 0 ? 1.0 : axis == 1 ? std::cos(inclination) : std::sin(inclination);
          coefficients.push_back(along * part * factor);
          factor *= rate / double(term + 1);
        }
      }
    }
  }
  const PolynomialPaths paths{.basis = PolynomialPaths::Basis::monomial,
                              .terms = terms,
                              .bodies = bodies,
                              .begins = begins,
                              .ends = ends,
                              .coefficients = coefficients};

  const Approaches found = Approaches::of(paths, 5.0).value();
  for (const Approaches::Minimum& minimum : found.minima) {
    const Vec3 velocity = in_orbital_frame(minimum.first, minimum.relative_velocity());
    std::printf("%8.3f s: %.3f km; radial %.3f, in-track %.3f, cross-track %.3f km/s\n", minimum.time,
                minimum.distance, velocity.x, velocity.y, velocity.z);
  }
}
