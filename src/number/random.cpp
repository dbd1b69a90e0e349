// Random numbers that take more than one rounding. They are defined here and not in the header, so that every
// compiler of user code yields equal numbers.
#include "kinesphere/random.hpp"

namespace kinesphere {

double Random::uniform(double lower, double upper) { return lower + (upper - lower) * uniform(); }

Vec3 Random::point_in_ball() {
  for (;;) {
    // Braces fix the order in which the coordinates are drawn; arguments of a call would be evaluated in any
    // order.
    const Vec3 point{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    if (norm_squared(point) <= 1.0) return point;
  }
}

Vec3 Random::unit_vector() {
  for (;;) {
    const Vec3 point = point_in_ball();
    const double length = norm(point);
    if (length > 0x1p-20) return point / length;  // nearer the origin the direction has few bits
  }
}

}  // namespace kinesphere
