// Certified predictions and queries of a world, from what it knows or with a probe.
#include <utility>

#include "body.hpp"
#include "exchange.hpp"
#include "kinesphere/certificates.hpp"
#include "kinesphere/queries.hpp"
#include "motion_of_bodies.hpp"

namespace kinesphere::browser {
namespace {

/// The facets of a world, for a call that has a probe or none. The probe is a motion, a map or, without both,
/// the function of JavaScript.
class Asked {
 public:
  Asked(World* world, bool asks, const MotionHandle* motion, BodyMapHandle* map)
      : world_(world),
        asks_(asks),
        is_javascript_(motion == nullptr && map == nullptr),
        bodies_(bodies_of(motion, map)) {}
  World::Queries queries() { return asks_ ? world_->queries(probe()) : std::as_const(*world_).queries(); }
  World::Certificates certificates() {
    return asks_ ? world_->certificates(probe()) : std::as_const(*world_).certificates();
  }
  /// Stores the error of a failed result; if a body had no state, that of its motion.
  template <class T>
  bool has(const Result<T>& result) const {
    return result || !bodies_.refused() ? is_good(result) : fail(*bodies_.refused());
  }

 private:
  Probe probe() {
    if (is_javascript_) return static_cast<Probe::Function>(ask_javascript);
    return [this](std::span<const BodyId> ids, double time, std::span<State> states) {
      bodies_.states(ids, time, states);
    };
  }

  World* world_;
  bool asks_;
  bool is_javascript_;
  MotionOfBodies bodies_;
};

/// Reads what queryNumbers() in package/src/answers.ts writes.
QueryOptions options_at(const double* numbers) {
  QueryOptions options{.except = body_of(numbers[4])};
  if (numbers[0] != 0.0) options.filter = filter_at(numbers + 1);
  return options;
}

/// Answers an id, 1 if certain, and two limits for each.
template <class Results>
bool answer_all(const Asked& asked, const Results& results) {
  if (!asked.has(results)) return false;
  answer().clear();
  for (const auto& found : *results)
    answer().insert(answer().end(),
                    {number_of(found.body), found.certainty == Certainty::certainly ? 1.0 : 0.0, found.lower,
                     found.upper});
  return true;
}

/// Answers an id and 1 if certain for each.
bool answer_overlaps(const Asked& asked, const Result<std::vector<OverlapHit>>& results) {
  if (!asked.has(results)) return false;
  answer().clear();
  for (const OverlapHit& found : *results)
    answer().insert(answer().end(),
                    {number_of(found.body), found.certainty == Certainty::certainly ? 1.0 : 0.0});
  return true;
}

}  // namespace

// In all functions below the last three arguments are those of Asked.

// These answer time, partner, wall, touching or within.

KINESPHERE_EXPORT(world_safe_until)
bool world_safe_until(World* world, bool asks, const MotionHandle* motion, BodyMapHandle* map) {
  Asked asked(world, asks, motion, map);
  const auto safe = asked.certificates().safe_until();
  if (safe) answer().assign({safe->time, no_id, 0.0, safe->touching ? 1.0 : 0.0});
  return asked.has(safe);
}
/// A distance of NaN stands for contacts.
KINESPHERE_EXPORT(world_safe_until_of_pair)
bool world_safe_until_of_pair(World* world, double first, double second, double distance, bool asks,
                              const MotionHandle* motion, BodyMapHandle* map) {
  Asked asked(world, asks, motion, map);
  if (distance == distance) {
    const auto safe = asked.certificates().safe_until(body_of(first), body_of(second), distance);
    if (safe) answer().assign({safe->time, no_id, 0.0, safe->within ? 1.0 : 0.0});
    return asked.has(safe);
  }
  const auto safe = asked.certificates().safe_until(body_of(first), body_of(second));
  if (safe) answer().assign({safe->time, no_id, 0.0, safe->touching ? 1.0 : 0.0});
  return asked.has(safe);
}
KINESPHERE_EXPORT(world_earliest_contact)
bool world_earliest_contact(World* world, double body, bool asks, const MotionHandle* motion,
                            BodyMapHandle* map) {
  Asked asked(world, asks, motion, map);
  const auto contact = asked.certificates().earliest_contact(body_of(body));
  if (contact)
    answer().assign({contact->time, number_of(contact->partner), static_cast<double>(contact->wall),
                     contact->touching ? 1.0 : 0.0});
  return asked.has(contact);
}
KINESPHERE_EXPORT(world_earliest_approach)
bool world_earliest_approach(World* world, double body, double distance, bool asks,
                             const MotionHandle* motion, BodyMapHandle* map) {
  Asked asked(world, asks, motion, map);
  const auto approach = asked.certificates().earliest_approach(body_of(body), distance);
  if (approach)
    answer().assign({approach->time, number_of(approach->partner), static_cast<double>(approach->wall),
                     approach->within ? 1.0 : 0.0});
  return asked.has(approach);
}

/// Answers a lower and an upper limit.
KINESPHERE_EXPORT(world_distance_limits)
bool world_distance_limits(World* world, double first, double second, double time, bool asks,
                           const MotionHandle* motion, BodyMapHandle* map) {
  Asked asked(world, asks, motion, map);
  const auto limits = asked.certificates().distance_limits(body_of(first), body_of(second), time);
  if (limits) answer().assign({limits->lower, limits->upper});
  return asked.has(limits);
}

KINESPHERE_EXPORT(world_nearest)
bool world_nearest(World* world, const double* point, const double* options, std::size_t count, bool asks,
                   const MotionHandle* motion, BodyMapHandle* map) {
  Asked asked(world, asks, motion, map);
  return answer_all(asked, asked.queries().nearest(vector_at(point), count, options_at(options)));
}
KINESPHERE_EXPORT(world_ray_cast)
bool world_ray_cast(World* world, const double* origin, const double* direction, const double* options,
                    double length, bool asks, const MotionHandle* motion, BodyMapHandle* map) {
  Asked asked(world, asks, motion, map);
  return answer_all(
      asked, asked.queries().ray_cast(vector_at(origin), vector_at(direction), length, options_at(options)));
}
KINESPHERE_EXPORT(world_sphere_cast)
bool world_sphere_cast(World* world, const double* origin, const double* direction, const double* options,
                       double length, double radius, bool asks, const MotionHandle* motion,
                       BodyMapHandle* map) {
  Asked asked(world, asks, motion, map);
  return answer_all(asked, asked.queries().sphere_cast(vector_at(origin), radius, vector_at(direction),
                                                       length, options_at(options)));
}
KINESPHERE_EXPORT(world_overlapping)
bool world_overlapping(World* world, const double* centre, const double* options, double radius, bool asks,
                       const MotionHandle* motion, BodyMapHandle* map) {
  Asked asked(world, asks, motion, map);
  return answer_overlaps(asked, asked.queries().overlapping(vector_at(centre), radius, options_at(options)));
}
KINESPHERE_EXPORT(world_overlapping_box)
bool world_overlapping_box(World* world, const double* corners, const double* options, bool asks,
                           const MotionHandle* motion, BodyMapHandle* map) {
  Asked asked(world, asks, motion, map);
  return answer_overlaps(asked, asked.queries().overlapping(Box{vector_at(corners), vector_at(corners + 3)},
                                                            options_at(options)));
}

}  // namespace kinesphere::browser
