// Certified answers: predictions and spatial queries.
#include <algorithm>
#include <optional>
#include <vector>

#include "convert.hpp"
#include "exchange.hpp"
#include "kinesphere/certificates.hpp"
#include "kinesphere/queries.hpp"
#include "objects.hpp"
#include "probing.hpp"

namespace kinesphere::c {
namespace {

/// Where the caller wants an answer.
struct Target {
  const void* pointer;
  const char* argument;
};

/// Calls answer(world) or, with a probe, answer(world, probe), and then tell(what that returned).
template <class Answer, class Tell>
ks_status answering(std::string_view call, ks_world world, ks_probe probe, void* user, const Target& target,
                    const Answer& answer, const Tell& tell) {
  if (probe == nullptr) {
    return reading(call, world, [&](const WorldObject& object) {
      require_pointer(call, target.pointer, target.argument);
      tell(answer(object.world()).value());
    });
  }
  return changing(call, world, [&](WorldObject& object) {
    require_pointer(call, target.pointer, target.argument);
    tell(with_probe(call, object.simulation(), probe, user,
                    [&](const Probe& combined) { return answer(object.world(), combined).value(); }));
  });
}

ks_prediction c_prediction(const SafeTime& safe) {
  return {safe.time, c_id(no_body), KS_WALL_NONE, safe.touching, safe.probed};
}
ks_prediction c_prediction(const SafeSeparation& safe) {
  return {safe.time, c_id(no_body), KS_WALL_NONE, safe.within, safe.probed};
}
ks_prediction c_prediction(const EarliestContact& contact) {
  return {contact.time, c_id(contact.partner), static_cast<ks_wall>(contact.wall), contact.touching,
          contact.probed};
}
ks_prediction c_prediction(const EarliestApproach& approach) {
  return {approach.time, c_id(approach.partner), static_cast<ks_wall>(approach.wall), approach.within,
          approach.probed};
}

template <class Answer>
ks_status predict(std::string_view call, ks_world world, ks_probe probe, void* user,
                  ks_prediction* prediction, const Answer& answer) {
  return answering(call, world, probe, user, {prediction, "prediction"}, answer,
                   [&](const auto& found) { *prediction = c_prediction(found); });
}

ks_hit c_hit(const OverlapHit& hit) {
  return {c_id(hit.body), hit.certainty == Certainty::certainly, 0.0, 0.0};
}
/// For NearestHit and CastHit.
template <class Hit>
ks_hit c_hit(const Hit& hit) {
  return {c_id(hit.body), hit.certainty == Certainty::certainly, hit.lower, hit.upper};
}

struct Hits {
  ks_hit* array;
  std::size_t capacity;
  std::size_t* count;
};

template <class Answer>
ks_status query(std::string_view call, ks_world world, ks_probe probe, void* user, const Hits& hits,
                const Answer& answer) {
  return answering(call, world, probe, user, {hits.count, "count"}, answer, [&](const auto& found) {
    write_all(call, found, hits.array, hits.capacity, hits.count, [](const auto& hit) { return c_hit(hit); });
  });
}

/// Many queries of one call: their bodies left out, their filter, and where their answers go.
struct Many {
  const ks_body_id* except;
  std::size_t queries;
  const ks_filter* filter;
  std::size_t* ends;
  Hits hits;

  std::optional<Filter> chosen() const {
    return filter != nullptr ? std::optional(filter_of(*filter)) : std::nullopt;
  }
  BodyId left_out(std::size_t query) const { return except != nullptr ? id_of(except[query]) : no_body; }
};

/// Asks answer(world, probe or nothing) for the hits of many queries, each of which made(query) returns.
template <class Made, class Answer>
ks_status query_all(std::string_view call, ks_world world, ks_probe probe, void* user, const Target& given,
                    const Many& many, const Made& made, const Answer& answer) {
  return answering(
      call, world, probe, user, {many.hits.count, "count"},
      [&](auto& of, const auto&... probes) {
        require_array(call, given.pointer, many.queries, given.argument);
        require_array(call, many.ends, many.queries, "ends");
        std::vector<decltype(made(0))> queries;
        queries.reserve(many.queries);
        for (std::size_t k = 0; k < many.queries; ++k) queries.push_back(made(k));
        return answer(of.queries(probes...), queries);
      },
      [&](const auto& found) {
        std::copy(found.ends.begin(), found.ends.end(), many.ends);
        write_all(call, found.hits, many.hits.array, many.hits.capacity, many.hits.count,
                  [](const auto& hit) { return c_hit(hit); });
      });
}

}  // namespace
}  // namespace kinesphere::c

using namespace kinesphere;
using namespace kinesphere::c;

// `probes` below is a probe, or nothing: World has facets with and without one.

ks_status ks_world_safe_until(ks_world world, ks_probe probe, void* user, ks_prediction* prediction) {
  return predict(__func__, world, probe, user, prediction,
                 [](auto& of, const auto&... probes) { return of.certificates(probes...).safe_until(); });
}

ks_status ks_world_earliest_contact(ks_world world, ks_body_id body, ks_probe probe, void* user,
                                    ks_prediction* prediction) {
  return predict(__func__, world, probe, user, prediction, [&](auto& of, const auto&... probes) {
    return of.certificates(probes...).earliest_contact(id_of(body));
  });
}

ks_status ks_world_earliest_approach(ks_world world, ks_body_id body, double distance, ks_probe probe,
                                     void* user, ks_prediction* prediction) {
  return predict(__func__, world, probe, user, prediction, [&](auto& of, const auto&... probes) {
    return of.certificates(probes...).earliest_approach(id_of(body), distance);
  });
}

ks_status ks_world_pair_safe_until(ks_world world, ks_body_id first, ks_body_id second, double distance,
                                   ks_probe probe, void* user, ks_prediction* prediction) {
  return predict(__func__, world, probe, user, prediction, [&](auto& of, const auto&... probes) {
    return of.certificates(probes...).safe_until(id_of(first), id_of(second), distance);
  });
}

ks_status ks_world_distance_limits(ks_world world, ks_body_id first, ks_body_id second, double time,
                                   ks_probe probe, void* user, double* lower, double* upper) {
  return answering(
      __func__, world, probe, user, lower != nullptr ? Target{upper, "upper"} : Target{lower, "lower"},
      [&](auto& of, const auto&... probes) {
        return of.certificates(probes...).distance_limits(id_of(first), id_of(second), time);
      },
      [&](const DistanceLimits& limits) {
        *lower = limits.lower;
        *upper = limits.upper;
      });
}

ks_status ks_world_overlapping_sphere(ks_world world, ks_vec3 centre, double radius, ks_probe probe,
                                      void* user, ks_hit* hits, size_t capacity, size_t* count) {
  return query(__func__, world, probe, user, {hits, capacity, count}, [&](auto& of, const auto&... probes) {
    return of.queries(probes...).overlapping(vector_of(centre), radius);
  });
}

ks_status ks_world_overlapping_box(ks_world world, const ks_box* box, ks_probe probe, void* user,
                                   ks_hit* hits, size_t capacity, size_t* count) {
  return query(__func__, world, probe, user, {hits, capacity, count},
               [&, call = __func__](auto& of, const auto&... probes) {
                 require_pointer(call, box, "box");
                 return of.queries(probes...).overlapping(box_of(*box));
               });
}

ks_status ks_world_nearest(ks_world world, ks_vec3 point, size_t bodies, ks_probe probe, void* user,
                           ks_hit* hits, size_t capacity, size_t* count) {
  return query(__func__, world, probe, user, {hits, capacity, count}, [&](auto& of, const auto&... probes) {
    return of.queries(probes...).nearest(vector_of(point), bodies);
  });
}

ks_status ks_world_cast(ks_world world, ks_vec3 origin, ks_vec3 direction, double length, double radius,
                        ks_probe probe, void* user, ks_hit* hits, size_t capacity, size_t* count) {
  return query(__func__, world, probe, user, {hits, capacity, count}, [&](auto& of, const auto&... probes) {
    return of.queries(probes...).sphere_cast(vector_of(origin), radius, vector_of(direction), length);
  });
}

ks_status ks_world_overlapping_all(ks_world world, const ks_sphere* spheres, const ks_body_id* except_ids,
                                   size_t queries, const ks_filter* filter, ks_probe probe, void* user,
                                   size_t* ends, ks_hit* hits, size_t capacity, size_t* count) {
  const Many many{except_ids, queries, filter, ends, {hits, capacity, count}};
  return query_all(
      __func__, world, probe, user, {spheres, "spheres"}, many,
      [&](std::size_t k) {
        return SphereQuery{vector_of(spheres[k].centre), spheres[k].radius, many.left_out(k)};
      },
      [&](const auto& of, const auto& all) { return of.overlapping_all(all, many.chosen()); });
}

ks_status ks_world_nearest_all(ks_world world, const ks_vec3* points, const ks_body_id* except_ids,
                               size_t queries, size_t bodies, const ks_filter* filter, ks_probe probe,
                               void* user, size_t* ends, ks_hit* hits, size_t capacity, size_t* count) {
  const Many many{except_ids, queries, filter, ends, {hits, capacity, count}};
  return query_all(
      __func__, world, probe, user, {points, "points"}, many,
      [&](std::size_t k) {
        return PointQuery{vector_of(points[k]), many.left_out(k)};
      },
      [&](const auto& of, const auto& all) { return of.nearest_all(all, bodies, many.chosen()); });
}

ks_status ks_world_cast_all(ks_world world, const ks_ray* rays, const ks_body_id* except_ids, size_t queries,
                            const ks_filter* filter, ks_probe probe, void* user, size_t* ends, ks_hit* hits,
                            size_t capacity, size_t* count) {
  const Many many{except_ids, queries, filter, ends, {hits, capacity, count}};
  return query_all(
      __func__, world, probe, user, {rays, "rays"}, many,
      [&](std::size_t k) {
        return RayQuery{vector_of(rays[k].origin), vector_of(rays[k].direction), rays[k].length,
                        rays[k].radius, many.left_out(k)};
      },
      [&](const auto& of, const auto& all) { return of.ray_cast_all(all, many.chosen()); });
}
