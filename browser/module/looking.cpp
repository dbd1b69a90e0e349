// Reading a world: bodies, counters, certificates and defects.
#include "body.hpp"
#include "exchange.hpp"
#include "kinesphere/inspection.hpp"

namespace kinesphere::browser {

KINESPHERE_EXPORT(world_bodies) void world_bodies(const World* world) { answer_ids(world->bodies()); }

/// Numbers for each body; WorldView.bodyViews() in package/src/world.ts reads them.
constexpr std::size_t view_numbers = 34;
KINESPHERE_EXPORT(world_views) bool world_views(const World* world, std::size_t count, const double* bodies) {
  auto& numbers = answer();
  numbers.assign(count * view_numbers, 0.0);
  for (std::size_t k = 0; k < count; ++k) {
    const auto view = world->body(body_of(bodies[k]));
    if (!is_good(view)) return false;
    double* const at = numbers.data() + k * view_numbers;
    put(view->bound.centre_at(world->time()), at);
    at[3] = view->is_static ? view->definition.radius : view->bound.radius_at(world->time());
    at[4] = view->definition.radius;
    at[5] = view->bound.time;
    put({view->definition.position, view->definition.velocity}, at + 6);
    put(view->box.lower, at + 12);
    put(view->box.upper, at + 15);
    at[18] = view->box_end;
    at[19] = view->enabled ? 1.0 : 0.0;
    at[20] = view->is_static ? 1.0 : 0.0;
    at[21] = view->sleeping ? 1.0 : 0.0;
    at[22] = view->definition.acceleration_limit;
    at[23] = static_cast<double>(view->definition.sensor_class);
    at[24] = static_cast<double>(view->definition.user_data);
    for (std::size_t axis = 0; axis < 3; ++axis) at[25 + axis] = static_cast<double>(view->image[axis]);
    at[28] = view->definition.solid ? 1.0 : 0.0;
    at[29] = view->definition.mass;
    NumberWriter(at + 30).put(view->definition.filter);
    at[33] = view->rigid ? 1.0 : 0.0;
  }
  return true;
}

/// Answers the kind of a body's shape and its numbers, as shape_at() of world.cpp takes them.
KINESPHERE_EXPORT(world_shape_of) bool world_shape_of(const World* world, double body) {
  const auto view = world->body(body_of(body));
  if (!is_good(view)) return false;
  const Shape& shape = view->shape;
  auto& numbers = answer();
  numbers.assign(10, static_cast<double>(shape.index()));
  double* const at = numbers.data() + 1;
  if (const auto* ball = std::get_if<Ball>(&shape)) {
    put(ball->centre, at);
    at[3] = ball->radius;
  } else if (const auto* side = std::get_if<HalfSpace>(&shape)) {
    put(side->normal, at);
    at[3] = side->offset;
  } else if (const auto* box = std::get_if<Box>(&shape)) {
    put(box->lower, at);
    put(box->upper, at + 3);
  } else if (const auto* triangle = std::get_if<Triangle>(&shape)) {
    put(triangle->a, at);
    put(triangle->b, at + 3);
    put(triangle->c, at + 6);
  } else if (const auto* mesh = std::get_if<Mesh>(&shape)) {
    numbers.resize(3);
    numbers[1] = static_cast<double>(mesh->vertices().size());
    numbers[2] = static_cast<double>(mesh->size());
    for (const Vec3& vertex : mesh->vertices()) numbers.insert(numbers.end(), {vertex.x, vertex.y, vertex.z});
    for (const auto& triple : mesh->corners()) numbers.insert(numbers.end(), triple.begin(), triple.end());
  }
  return true;
}

KINESPHERE_EXPORT(world_touching) bool world_touching(const World* world, double body) {
  const auto ids = world->touching(body_of(body));
  if (!is_good(ids)) return false;
  answer_ids(*ids);
  return true;
}

/// Answers pairs of a body and a distance.
KINESPHERE_EXPORT(world_sensor_overlaps) bool world_sensor_overlaps(const World* world, double body) {
  const auto overlaps = world->sensor_overlaps(body_of(body));
  if (!is_good(overlaps)) return false;
  answer().clear();
  for (const SensorOverlap& overlap : *overlaps)
    answer().insert(answer().end(), {number_of(overlap.body), overlap.distance});
  return true;
}

KINESPHERE_EXPORT(world_counters) void world_counters(const World* world) {
  const Counters& counters = world->counters();
  auto& numbers = answer();
  numbers.clear();
  for (const std::uint64_t events : counters.events) numbers.push_back(static_cast<double>(events));
  for (const std::uint64_t count :
       {counters.probes, counters.window_ends, counters.starts, counters.restarts, counters.pair_checks,
        counters.wall_checks, counters.searches, counters.candidates, counters.hot_pairs,
        counters.certificates, counters.zeno_steps, counters.repeated_contacts, counters.jammed_contacts})
    numbers.push_back(static_cast<double>(count));
}

/// Answers triples of two ids and a time; and boxes (6 numbers) with their number of bodies.
KINESPHERE_EXPORT(world_certificates) void world_certificates(const World* world) {
  answer().clear();
  for (const Certificate& certificate : world->inspection().certificates())
    answer().insert(answer().end(),
                    {number_of(certificate.first), number_of(certificate.second), certificate.until});
}
/// Numbers for each body that World.inspection().busiest() in package/src/world.ts reads.
KINESPHERE_EXPORT(world_busiest) bool world_busiest(const World* world, std::size_t count) {
  const auto busiest = world->inspection().busiest(count);
  if (!is_good(busiest)) return false;
  answer().clear();
  for (const BusyBody& busy : *busiest) {
    answer().insert(answer().end(), {number_of(busy.body), static_cast<double>(busy.reason)});
    for (const std::uint64_t counted :
         {busy.probes, busy.touching, busy.near, busy.windows, busy.changes, busy.queries, busy.contacts})
      answer().push_back(static_cast<double>(counted));
    answer().insert(answer().end(), {busy.acceleration_limit, busy.largest_acceleration});
  }
  return true;
}
/// Answers the advice on a reason.
KINESPHERE_EXPORT(advice) void advice(unsigned reason) {
  answer_bytes().clear();
  for (const char c : advice_on(static_cast<ProbeReason>(reason)))
    answer_bytes().push_back(static_cast<std::byte>(c));
}
KINESPHERE_EXPORT(world_cells) void world_cells(const World* world) {
  answer().clear();
  for (const CellView& cell : world->inspection().cells())
    answer().insert(answer().end(), {cell.box.lower.x, cell.box.lower.y, cell.box.lower.z, cell.box.upper.x,
                                     cell.box.upper.y, cell.box.upper.z, static_cast<double>(cell.bodies)});
}

/// Answers an empty text if there is no defect.
KINESPHERE_EXPORT(world_audit) void world_audit(const World* world) {
  answer_bytes().clear();
  const auto finding = world->inspection().audit();
  if (!finding) return;
  for (const char c : finding->where + ": " + finding->what)
    answer_bytes().push_back(static_cast<std::byte>(c));
}

}  // namespace kinesphere::browser
