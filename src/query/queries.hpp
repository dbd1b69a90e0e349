// Spatial queries at the present time: a search finds candidates, and their certain spheres or shapes decide.
#pragma once

#include <optional>
#include <vector>

#include "engine/engine.hpp"
#include "kinesphere/queries.hpp"
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
  Queries(const Engine& engine, const QueryOptions& options)
      : engine_(engine), options_(options), now_(engine.time()) {}

  // Each appends its results to an empty list.
  void overlapping(const Vec3& centre, double radius, std::vector<OverlapHit>& found) const;
  void overlapping(const Box& region, std::vector<OverlapHit>& found) const;
  void nearest(const Vec3& point, std::size_t count, std::vector<NearestHit>& all) const;
  void cast(const SweptRay& ray, std::vector<CastHit>& hits) const;

 private:
  /// Removes the bodies that the options leave out.
  void restrict(std::vector<std::uint32_t>& numbers) const;
  double finest_length() const;
  CertainSphere certain_sphere(std::uint32_t number, const Vec3& middle, double height,
                               auto distance_to) const;
  /// Finds the bodies that overlap a region, certainly or possibly. `distance_to(centre)` is the distance
  /// of a point from the region, `gap_to(shape)` the gap limits of a CertainShape. `box` contains the
  /// region. `height`: on y (length), 0 of one of which the nearest point is its middle.
  template <class Distance, class ShapeGap>
  void overlapping(const Box& box, double height, Distance distance_to, ShapeGap gap_to,
                   std::vector<OverlapHit>& found) const;
  std::optional<CastHit> hit(const SweptRay& ray, const Box& piece, std::uint32_t number) const;
  void add_around(const Vec3& point, std::size_t count, std::vector<NearestHit>& all) const;
  void add_distances(const std::vector<std::uint32_t>& numbers, const Vec3& point,
                     std::vector<NearestHit>& all) const;

  const Engine& engine_;
  const QueryOptions& options_;
  double now_;
};

}  // namespace kinesphere
