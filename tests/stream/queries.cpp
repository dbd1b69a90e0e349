// Compares spatial queries with distances from all bodies.
#include <cmath>

#include "number/infinity.hpp"
#include "stream/player.hpp"

namespace kinesphere::stream {

double Player::query_slack() const {
  return truth_.slack() + 1e-11 * (lengths(1.0) + 1e-4 * norm(scenario().origin()));
}

void Player::check_queries(bool asks) {
  const auto queries = asks ? world_.queries(probe()) : world_.queries();
  const Vec3 point = draw_.place();
  check_overlaps(queries, point, asks);
  check_box(queries, point);
  check_nearest(queries, point);
  check_cast(queries, point);
}

QueryOptions Player::any_options() {
  QueryOptions options;
  if (scenario().filters && draw_.one_in(2)) options.filter = draw_.filter();
  if (draw_.one_in(3)) options.except = draw_.any_of(truth_.present());
  return options;
}

bool Player::is_sought(BodyId id, const QueryOptions& options) const {
  return id != options.except &&
         (!options.filter || passes(*options.filter, truth_.at(id).definition.filter));
}

void Player::check_overlaps(const World::Queries& queries, const Vec3& point, bool asks) {
  const double radius = draw_.one_in(5) ? 0.0 : lengths(draw_.uniform(0.0, 0.5));
  const QueryOptions options = any_options();
  const auto hits = queries.overlapping(point, radius, options).value();
  const double slack = query_slack();
  for (const BodyId id : truth_.present()) {
    if (!is_sought(id, options)) {
      if (std::ranges::count(hits, id, &OverlapHit::body))
        truth_.fail("overlapping found too much", {id}, 0, now());
      continue;
    }
    const Real gap = truth_.gaps.to_point(truth_.at(id), vector(point), now()) - radius;
    const auto hit = std::ranges::find(hits, id, &OverlapHit::body);
    if (hit == hits.end()) {
      if (gap < -slack) truth_.fail("overlapping misses a body", {id}, gap, now());
      continue;
    }
    if (hit->certainty == Certainty::certainly && gap > slack + truth_.report_errors({id}))
      truth_.fail("overlapping is wrongly certain", {id}, gap, now());
    const bool is_decided = asks && !scenario().errors && truth_.at(id).is_ball() && !scenario().far;
    if (is_decided && hit->certainty == Certainty::possibly && std::abs(gap) > lengths(1e-6))
      truth_.fail("overlapping remains undecided", {id}, gap, now());
  }
}

/// For balls and rigid bodies.
void Player::check_box(const World::Queries& queries, const Vec3& corner) {
  const Box box{corner,
                corner + lengths(0.6) * Vec3{draw_.uniform(), draw_.uniform(), scenario().flat ? 0.0 : 0.5}};
  const auto hits = queries.overlapping(box).value();
  const double slack = query_slack();
  Thing solid{.sort = Sort::fixed};
  solid.set_shape(box, now(), scenario().unit_length(), scenario().flat);
  for (const BodyId id : truth_.present()) {
    if (truth_.at(id).has_shape() || truth_.definition().periodic.any()) continue;
    const Real gap = truth_.gaps.between(solid, truth_.at(id), now());
    const auto hit = std::ranges::find(hits, id, &OverlapHit::body);
    if (hit == hits.end() && gap < -slack) truth_.fail("a box misses a body", {id}, gap, now());
    if (hit != hits.end() && hit->certainty == Certainty::certainly &&
        gap > slack + truth_.report_errors({id}))
      truth_.fail("a box is wrongly certain", {id}, gap, now());
  }
}

void Player::check_nearest(const World::Queries& queries, const Vec3& point) {
  std::vector<Near> all;
  for (const BodyId id : truth_.present())
    all.push_back({truth_.gaps.to_point(truth_.at(id), vector(point), now()), id});
  std::ranges::sort(all, {}, &Near::distance);
  const std::size_t count = 1 + draw_.below(4);
  const auto hits = queries.nearest(point, count).value();
  const Real last = all[std::min(count, all.size()) - 1].distance;
  const double slack = query_slack();
  for (const auto& [distance, id] : all) {
    const auto hit = std::ranges::find(hits, id, &NearestHit::body);
    const double errors = truth_.report_errors({id});
    // Depths inside bodies are no order: hulls do not know them.
    if (hit == hits.end()) {
      if (distance < last - slack && last > 0) truth_.fail("nearest misses a body", {id}, distance, now());
      continue;
    }
    if (distance > 0 && hit->lower > distance + slack)
      truth_.fail("nearest: a lower limit is too large", {id}, distance, now());
    if (distance > 0 && hit->upper + errors < distance - slack)
      truth_.fail("nearest: an upper limit is too small", {id}, distance, now());
    if (last > 0 && hit->certainty == Certainty::certainly && distance > last + slack + errors)
      truth_.fail("nearest is wrongly certain", {id}, distance, now());
  }
}

/// Returns how far a sphere gets before it hits the body: infinity beyond `most`, and NaN if it grazes the
/// body for so long that this is not known.
Real Player::way_to_hit(const Thing& thing, const Vector& from, const Vector& along, double radius,
                        double most) {
  const Real near = lengths(1e-9) + 4.0 * query_slack();
  Real way = 0;
  for (int step = 0; step < 400; ++step) {
    const Real gap = truth_.gaps.to_point(thing, from + along * way, now()) - radius;
    if (gap <= near) return way;
    way += gap;
    if (way > most) return infinity;
  }
  return std::numeric_limits<Real>::quiet_NaN();
}

void Player::check_cast(const World::Queries& queries, const Vec3& point) {
  const Vec3 direction = draw_.direction();
  if (norm(direction) < 0.1) return;
  const Vector from = vector(point);
  const Vector along = vector(direction) * (1 / length(vector(direction)));
  const double most = lengths(2.0 * scenario().edge * draw_.uniform());
  const double radius = draw_.one_in(2) ? 0.0 : lengths(draw_.uniform(0.0, 0.2));
  const auto hits = (radius == 0.0 ? queries.ray_cast(point, direction, most)
                                   : queries.sphere_cast(point, radius, direction, most))
                        .value();
  const Real slack = lengths(1e-3) + query_slack();
  // True if the sphere goes deep into the body, and does not only graze it.
  const auto enters = [&](BodyId id, Real way) {
    const Vector inside = from + along * (way + lengths(1e-4));
    return way < infinity && truth_.gaps.to_point(truth_.at(id), inside, now()) - radius < -lengths(1e-6);
  };
  std::vector<Near> all;
  Real first = infinity;
  for (const BodyId id : truth_.present()) {
    const Real way = way_to_hit(truth_.at(id), from, along, radius, most);
    all.push_back({way, id});
    if (enters(id, way)) first = std::min(first, way);
  }
  for (const auto& [way, id] : all) {
    const auto hit = std::ranges::find(hits, id, &CastHit::body);
    const double errors = truth_.report_errors({id});
    const auto is_earlier = [&, own = id, limit = way + slack](const Near& other) {
      return other.body != own && !(other.distance >= limit);
    };
    if (hit == hits.end()) {
      if (way <= first && way < most - slack && enters(id, way) && std::ranges::none_of(all, is_earlier))
        truth_.fail("a cast misses a body", {id}, way, now());
      continue;
    }
    if (std::isnan(way)) continue;
    if (hit->lower > way + slack) truth_.fail("a cast: a lower limit is too large", {id}, way, now());
    if (hit->upper < infinity && hit->upper < std::min<Real>(way, most) - slack - errors)
      truth_.fail("a cast: an upper limit is too small", {id}, way, now());
    if (hit->certainty == Certainty::certainly && first < infinity && way > first + slack + errors)
      truth_.fail("a cast is wrongly certain", {id}, way, now());
  }
}

}  // namespace kinesphere::stream
