// Gaps between bodies of all sorts, in long double, by brute force.
#pragma once

#include "kinesphere/event.hpp"
#include "kinesphere/world_definition.hpp"
#include "number/infinity.hpp"
#include "stream/thing.hpp"

namespace kinesphere::stream {

/// How a gap is measured.
struct Measure {
  bool is_deep = true;     ///< the distance of overlapping hulls is minus their depth, and not 0
  Real enough = infinity;  ///< beyond it, a lower limit will do
};

class TrueGaps {
 public:
  TrueGaps(const WorldDefinition& definition, double unit_length)
      : world_(definition), unit_length_(unit_length) {}

  Real between(const Thing& a, const Thing& b, Real time, const Measure& how = {}) const;
  Real to_wall(const Thing& thing, Wall wall, Real time) const;
  Real to_point(const Thing& thing, const Vector& point, Real time) const;
  /// Returns the way from one point to the nearest image of another.
  Vector nearest_way(const Vector& from, const Vector& to) const;
  /// Work so far, in units of about 0.04 microseconds.
  std::size_t work() const { return work_; }

 private:
  /// A part of a body, or a ball, relative to an origin.
  struct Solid {
    std::vector<Vector> points;
    Real radius;
    const true_hulls::Hull* hull;
  };
  std::vector<Solid> solids(const Thing& thing, Real time, const Vector& origin) const;
  Real between(const Solid& a, const Solid& b, const Measure& how) const;
  Real to_shape(const Thing& shape, const Vector& point, Real time) const;
  template <class Visit>
  void for_each_image(const Vector& way, Visit visit) const;

  WorldDefinition world_;
  double unit_length_;
  mutable std::size_t work_ = 0;
};

}  // namespace kinesphere::stream
