// Random bodies, shapes and changes of a scenario.
#pragma once

#include "kinesphere/random.hpp"
#include "kinesphere/rigid_body.hpp"
#include "kinesphere/sensor.hpp"
#include "kinesphere/shape.hpp"
#include "stream/scenario.hpp"

namespace kinesphere::stream {

class Draws {
 public:
  explicit Draws(const Scenario& scenario) : s_(scenario), random_(~scenario.seed) {}
  /// Draws from `random` from now on.
  void start(const Random& random) { random_ = random; }

  // Numbers.
  bool one_in(unsigned count) { return random_.bits() % count == 0; }
  std::size_t below(std::size_t count) { return random_.bits() % count; }
  double uniform(double lower = 0.0, double upper = 1.0) { return random_.uniform(lower, upper); }
  template <class Range>
  auto any_of(const Range& all) {
    return all[below(std::size(all))];
  }

  // Motion, in the space of the scenario.
  Vec3 middle() const;
  Vec3 point_in_ball() { return in_space(random_.point_in_ball()); }
  Vec3 direction() { return in_space(random_.unit_vector()); }
  Vec3 place();
  Vec3 velocity();
  State state() { return {place(), velocity()}; }
  Quaternion orientation();
  Vec3 axis() { return s_.flat ? Vec3{0, 0, 1} : random_.unit_vector(); }
  double acceleration() { return 2.0 * unit_acceleration() * uniform(); }

  // Bodies and shapes.
  BodyDefinition body(double radius);
  double radius();
  double radius_rate();
  Filter filter();
  std::vector<RigidPart> parts();
  Shape shape();
  Shape carried_shape();
  Sensor sensor();

 private:
  Vec3 in_space(Vec3 v) const;
  Mesh tent(const Vec3& at);
  Triangle needle(const Vec3& through);
  double unit_acceleration() const { return s_.unit_length() / (s_.unit_time() * s_.unit_time()); }
  Vec3 arm();
  RigidPart hull();

  Scenario s_;
  Random random_;
};

}  // namespace kinesphere::stream
