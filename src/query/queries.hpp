// Spatial queries at the present time: a search finds candidates, and their certain spheres or shapes decide.
#pragma once

#include <optional>
#include <vector>

#include "engine/engine.hpp"
#include "query/certain_sphere.hpp"

namespace kinesphere {

/// Path of a sphere: from `origin` along the unit vector `direction`, for `length`.
struct SweptRay {
  Vec3 origin;
  double radius;
  Vec3 direction;
  double length;
};

class World::Engine::Queries {
 public:
  explicit Queries(const Engine& engine) : engine_(engine), now_(engine.time()) {}

  std::vector<OverlapHit> overlapping(const Vec3& centre, double radius) const;
  std::vector<OverlapHit> overlapping(const Box& region) const;
  std::vector<NearestHit> nearest(const Vec3& point, std::size_t count) const;
  std::vector<CastHit> cast(const SweptRay& ray) const;

 private:
  double finest_length() const;
  CertainSphere certain_sphere(std::uint32_t number, const Vec3& point) const;
  /// Returns the bodies that overlap a region, certainly or possibly. `distance_to(centre)` is the distance
  /// of a point from the region, `gap_to(shape)` the gap limits of a CertainShape. `box` contains the
  /// region.
  template <class Distance, class ShapeGap>
  std::vector<OverlapHit> overlapping(const Box& box, Distance distance_to, ShapeGap gap_to) const;
  std::optional<CastHit> hit(const SweptRay& ray, const Box& piece, std::uint32_t number) const;
  std::vector<std::uint32_t> around(const Vec3& point, std::size_t count) const;
  std::vector<NearestHit> distances(const std::vector<std::uint32_t>& numbers, const Vec3& point) const;

  const Engine& engine_;
  double now_;
};

}  // namespace kinesphere
