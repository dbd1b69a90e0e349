// Questions about space at the current time: a search finds candidates, what is known of each decides.
#pragma once

#include <optional>
#include <vector>

#include "engine/engine.hpp"
#include "query/certain_sphere.hpp"

namespace kinesphere {

/// The way of a sphere from `origin` along the unit vector `direction`.
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
  std::vector<CastHit> cast(const SweptRay& way) const;

 private:
  double finest_length() const;
  CertainSphere certain_sphere(std::uint32_t number, const Vec3& point) const;
  /// Those whose distance from the region, `distance_to(place centre)`, may be or is below their radius, and
  /// fixed bodies whose shape may have or has no gap to it, `gap_to(shape)`.
  template <class Distance, class ShapeGap>
  std::vector<OverlapHit> overlapping(const Box& box, Distance distance_to, ShapeGap gap_to) const;
  std::optional<CastHit> hit(const SweptRay& way, const Box& piece, std::uint32_t number) const;
  std::vector<std::uint32_t> around(const Vec3& point, std::size_t count) const;
  std::vector<NearestHit> distances(const std::vector<std::uint32_t>& numbers, const Vec3& point) const;

  const Engine& engine_;
  double now_;
};

}  // namespace kinesphere
