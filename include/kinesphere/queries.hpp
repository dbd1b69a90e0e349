// Spatial queries at a world's current time.
//
//   for (const OverlapHit& hit : *world.queries().overlapping({1, 2, 3}, 5.0))
//     if (hit.certainty == Certainty::certainly) ...
//   const auto shot = world.queries(probe).ray_cast(muzzle, aim, 100.0, {.except = shooter});
//
// Between probes the world knows a body only as a sphere that contains it. Results are therefore
// three-valued: bodies that are left out certainly do not match; the returned bodies match possibly or
// certainly. World::queries(probe) probes the undecided bodies. Then `possibly` remains only where position
// errors or rounding (relative 2^-45) decide. The world handles these reports like all others
// (certificates.hpp).
//
// A static body counts with its whole shape. A ray through an edge of a triangle is as undecided as one
// that grazes a sphere. On periodic axes, regions, distances and rays extend across the border, and a body
// counts once, in its nearest image or in the first image that is hit.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

/// How sure a result is.
enum class Certainty { possibly, certainly };

/// A body that overlaps a region; touching the region counts as overlap.
struct OverlapHit {
  BodyId body;
  Certainty certainty;

  friend constexpr bool operator==(const OverlapHit&, const OverlapHit&) = default;
};

/// A body that is among the k nearest. Its surface is between `lower` and `upper` (length) from the point;
/// negative distances are depths inside the body.
struct NearestHit {
  BodyId body;
  Certainty certainty;
  double lower;
  double upper;

  friend constexpr bool operator==(const NearestHit&, const NearestHit&) = default;
};

/// A body that a ray or a moving sphere hits first, after a distance between `lower` and `upper` (length):
/// 0 if the ray starts inside the body; `upper` is infinite if the ray may miss the body.
struct CastHit {
  BodyId body;
  Certainty certainty;
  double lower;
  double upper;

  friend constexpr bool operator==(const CastHit&, const CastHit&) = default;
};

/// Which bodies a query looks at. It passes through all others.
struct QueryOptions {
  /// If given, those that a body with this filter may touch by their filters. The pair filter is not asked.
  std::optional<Filter> filter{};
  /// Not this one, such as the body that casts the ray.
  BodyId except = no_body;

  friend constexpr bool operator==(const QueryOptions&, const QueryOptions&) = default;
};

/// A sphere in which to look for bodies (length), except for one.
struct SphereQuery {
  Vec3 centre{};
  double radius = 0.0;
  BodyId except = no_body;

  friend constexpr bool operator==(const SphereQuery&, const SphereQuery&) = default;
};

/// A point whose nearest bodies are looked for, except for one.
struct PointQuery {
  Vec3 point{};
  BodyId except = no_body;

  friend constexpr bool operator==(const PointQuery&, const PointQuery&) = default;
};

/// A ray or, with a radius > 0 (length), the way of a sphere. `direction` may have any length > 0. It passes
/// through one body, such as the one that casts it.
struct RayQuery {
  Vec3 origin{};
  Vec3 direction{};
  double length = 0.0;
  double radius = 0.0;
  BodyId except = no_body;

  friend constexpr bool operator==(const RayQuery&, const RayQuery&) = default;
};

/// The results of many queries of a kind: those of query k are lists[k].
template <class Hit>
struct HitLists {
  std::vector<Hit> hits{};          ///< of all queries, one after the other
  std::vector<std::size_t> ends{};  ///< number of hits up to and with each query

  /// Number of queries.
  std::size_t size() const { return ends.size(); }
  std::span<const Hit> operator[](std::size_t query) const {
    const std::size_t begin = query > 0 ? ends[query - 1] : 0;
    return std::span(hits).subspan(begin, ends[query] - begin);
  }

  friend bool operator==(const HitLists&, const HitLists&) = default;
};

/// What World::queries() returns: the queries of one world, with or without a probe. Each call answers for
/// the present state of the world. Copies cost little. The world must outlive it and keep its address; so
/// must a named probe (callback.hpp), whereas a temporary one is owned.
///
/// Each query takes `storage`, whose memory the returned list reuses, so that a caller that passes the
/// previous list allocates none for results:
///   hits = world.queries().overlapping(centre, radius, {}, std::move(hits)).value();
///
/// Errors of all queries: probe_in_progress; not_finite or out_of_range for points and lengths beyond
/// limits.hpp and for negative lengths; with a probe null_probe, and not_finite or out_of_range for an
/// invalid state, which is discarded. Cost: a search, its results, and the bodies that were added or changed
/// since the last advance, but for those that have only got another velocity.
class [[nodiscard]] World::Queries {
 public:
  /// Returns the bodies that may overlap a sphere, by index. With a probe: one state for each undecided
  /// body.
  Result<std::vector<OverlapHit>> overlapping(const Vec3& centre, double radius,
                                              const QueryOptions& options = {},
                                              std::vector<OverlapHit> storage = {}) const;
  /// Returns the bodies that may overlap a box (lower <= upper on each axis), by index. With a probe: one
  /// state for each undecided body.
  Result<std::vector<OverlapHit>> overlapping(const Box& box, const QueryOptions& options = {},
                                              std::vector<OverlapHit> storage = {}) const;
  /// Returns all bodies that may be among the `count` nearest to a point, ordered by the lower limit of
  /// their distance: at least `count`, or all bodies if there are fewer. With a probe, all returned bodies
  /// are probed, and there are exactly `count` except for ties and position errors. Cost: searches of
  /// doubling size.
  Result<std::vector<NearestHit>> nearest(const Vec3& point, std::size_t count,
                                          const QueryOptions& options = {},
                                          std::vector<NearestHit> storage = {}) const;
  /// Returns all bodies that a ray may hit first, ordered by the lower limit of the distance along the ray.
  /// The result is empty if the ray certainly hits nothing within `length`, and a single body that is
  /// certainly the first is marked Certainty::certainly. `direction` may have any length > 0. With a probe,
  /// all returned bodies are probed. Walls are ignored. Errors: on periodic axes, out_of_range for a length
  /// of more than 64 boxes or a sphere radius of more than half a box; unsupported where images slide. Cost:
  /// at most 64 searches along the ray.
  Result<std::vector<CastHit>> ray_cast(const Vec3& origin, const Vec3& direction, double length,
                                        const QueryOptions& options = {},
                                        std::vector<CastHit> storage = {}) const;
  /// Returns all bodies that a sphere of this radius may hit first on its way along the ray. Errors and
  /// cost: as ray_cast().
  Result<std::vector<CastHit>> sphere_cast(const Vec3& origin, double radius, const Vec3& direction,
                                           double length, const QueryOptions& options = {},
                                           std::vector<CastHit> storage = {}) const;

  // Many queries at once, as a frame of a game asks them. Each is answered as by the call for one, in the
  // order given. With a probe, one call of it serves all queries that are open. Workers share the queries,
  // and change no result; the probe is called in the calling thread alone. Errors: as of the call for one,
  // with the number of the query in the message, before any is answered; workers_busy if the workers are in
  // use.

  /// overlapping(), for many spheres.
  Result<HitLists<OverlapHit>> overlapping_all(std::span<const SphereQuery> spheres,
                                               const std::optional<Filter>& filter = {},
                                               Workers* workers = nullptr) const;
  /// nearest(), for many points.
  Result<HitLists<NearestHit>> nearest_all(std::span<const PointQuery> points, std::size_t count,
                                           const std::optional<Filter>& filter = {},
                                           Workers* workers = nullptr) const;
  /// ray_cast() or sphere_cast(), for many rays.
  Result<HitLists<CastHit>> ray_cast_all(std::span<const RayQuery> rays,
                                         const std::optional<Filter>& filter = {},
                                         Workers* workers = nullptr) const;

  /// Probes those of the bodies whose last report is older than the current time, in one call of the probe,
  /// so that queries and certificates without a probe rest on these reports. Disabled bodies are left out.
  /// Returns true if there were any. Errors: those of a call that names a body; without a probe, null_probe.
  Result<bool> refresh(BodyIds bodies) const;

  /// World::queries() makes it.
  explicit Queries(Facet facet) : facet_(std::move(facet)) {}

 private:
  template <class Hit, class Valid, class Ask>
  Result<std::vector<Hit>> answer(std::string_view call, const QueryOptions& options, std::vector<Hit> found,
                                  Valid valid, Ask ask) const;
  template <class Hit, class Query, class Valid, class Ask>
  Result<HitLists<Hit>> answer_all(std::string_view call, std::span<const Query> queries,
                                   const std::optional<Filter>& filter, Workers* workers, Valid valid,
                                   Ask ask) const;

  Facet facet_;
};

inline World::Queries World::queries() const& { return Queries({this}); }
inline World::Queries World::queries(Probe probe) & { return Queries({this, this, std::move(probe)}); }

}  // namespace kinesphere
