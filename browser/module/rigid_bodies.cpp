#include "rigid_bodies.hpp"

#include <limits>
#include <vector>

#include "body.hpp"
#include "exchange.hpp"

namespace kinesphere::browser {
namespace {

/// Returns true if the JavaScript function returned, and false if it threw.
KINESPHERE_IMPORT(rotate)
bool javascript_rotate(std::size_t count, const double* ids, double time, double* rotations);

/// Size of a rotation in numbers: a quaternion and an angular velocity.
constexpr std::size_t rotation_numbers = 7;

Rotation rotation_at(const double* numbers) {
  return {{numbers[0], numbers[1], numbers[2], numbers[3]}, vector_at(numbers + 4)};
}

void put_rotation(const Rotation& rotation, double* numbers) {
  const auto& [w, x, y, z] = rotation.orientation;
  numbers[0] = w;
  put(Vec3{x, y, z}, numbers + 1);
  put(rotation.angular_velocity, numbers + 4);
}

/// Calls the function of the world that is asking. If it throws, NaNs remain, which the world refuses; the
/// package rethrows the exception.
void ask_rotations(std::span<const BodyId> ids, double time, std::span<Rotation> rotations) {
  std::vector<double> numbers;
  for (const BodyId id : ids) numbers.push_back(number_of(id));
  std::vector<double> answers(rotation_numbers * ids.size(), std::numeric_limits<double>::quiet_NaN());
  (void)javascript_rotate(ids.size(), numbers.data(), time, answers.data());
  for (std::size_t k = 0; k < ids.size(); ++k)
    rotations[k] = rotation_at(answers.data() + rotation_numbers * k);
}

/// Reads a part: its kind (0: ball, capsule or hull, 1: box), its radius, the number of its points, and
/// these. Moves `numbers` behind it.
RigidPart part_at(const double*& numbers) {
  const bool is_box = numbers[0] == 1.0;
  const double radius = numbers[1];
  std::vector<Vec3> points(static_cast<std::size_t>(numbers[2]));
  numbers += 3;
  for (Vec3& point : points) {
    point = vector_at(numbers);
    numbers += 3;
  }
  return is_box ? box_part({points[0], points[1]}, radius) : hull_part(points, radius);
}

}  // namespace

RigidBody rigid_body_at(const RigidNumbers& numbers) {
  RigidBody body{.body = body_at(numbers.body),
                 .rotation = rotation_at(numbers.rigid),
                 .angular_acceleration_limit = numbers.rigid[7],
                 .largest_angular_speed = numbers.rigid[8],
                 .inertia = vector_at(numbers.rigid + 9)};
  const double* part = numbers.parts;
  for (std::size_t k = 0; k < numbers.part_count; ++k) body.parts.push_back(part_at(part));
  return body;
}

KINESPHERE_EXPORT(world_add_rigid_body)
double world_add_rigid_body(World* world, const double* body, const double* rigid, std::size_t count,
                            const double* parts) {
  const auto id = world->add_rigid_body(rigid_body_at({body, rigid, count, parts}));
  return is_good(id) ? number_of(*id) : no_id;
}

static Result<RigidBody> rigid_of(const World* world, double body) {
  const auto view = world->body(body_of(body));
  if (!view) return view.error();
  if (view->rigid) return *view->rigid;
  return Error{ErrorCode::unsupported, "body", body_of(body),
               "body must be rigid, but body " + to_string(body_of(body)) + " is not"};
}

/// Answers the rotation at the last report.
KINESPHERE_EXPORT(world_rotation) bool world_rotation(const World* world, double body) {
  const auto rigid = rigid_of(world, body);
  if (!is_good(rigid)) return false;
  answer().resize(rotation_numbers);
  put_rotation(rigid->rotation, answer().data());
  return true;
}

/// Answers for each part its radius, the number of its points, and these.
KINESPHERE_EXPORT(world_parts_of) bool world_parts_of(const World* world, double body) {
  const auto rigid = rigid_of(world, body);
  if (!is_good(rigid)) return false;
  answer().clear();
  for (const auto& [a, b, radius, more] : rigid->parts) {
    answer().insert(answer().end(),
                    {radius, static_cast<double>(2 + more.size()), a.x, a.y, a.z, b.x, b.y, b.z});
    for (const Vec3& point : more) answer().insert(answer().end(), {point.x, point.y, point.z});
  }
  return true;
}

KINESPHERE_EXPORT(world_set_angular_velocity)
bool world_set_angular_velocity(World* world, double body, const double* angular_velocity) {
  return is_good(world->change(body_of(body), {.angular_velocity = vector_at(angular_velocity)}));
}
KINESPHERE_EXPORT(world_set_rotation)
bool world_set_rotation(World* world, double body, const double* rotation) {
  return is_good(world->change(body_of(body), {.rotation = rotation_at(rotation)}));
}
/// Whether the package has a function for this world.
KINESPHERE_EXPORT(world_set_rotation_probe) bool world_set_rotation_probe(World* world, bool exists) {
  return is_good(world->set_rotation_probe(exists ? RotationProbe(ask_rotations) : RotationProbe()));
}

}  // namespace kinesphere::browser
