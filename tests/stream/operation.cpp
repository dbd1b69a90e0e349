// Parses streams of bytes: the kind of world, and the operations.
#include "stream/operation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "support/needles.hpp"

namespace kinesphere::stream {
namespace {

constexpr std::size_t header_size = 5;

std::uint8_t header(std::span<const std::uint8_t> bytes, std::size_t k) {
  return k < bytes.size() ? bytes[k] : std::uint8_t{0};
}

/// Moves a periodic world by whole periods, so that queries near the origin meet images of bodies.
void move_far(WorldDefinition& world) {
  const double away = world_size * std::floor(far_away * world.contact_tolerance / world_size);
  for (int axis = 0; axis < 3; ++axis) {
    if (!world.periodic[axis]) continue;
    world.box->lower[axis] -= away;
    world.box->upper[axis] -= away;
  }
}

}  // namespace

double Operation::radius() const {
  switch (byte(6) % 16) {
    case 1:
      return 1.5 * fraction(6);
    case 2:
      return 0.0;
    default:
      return 0.5 * fraction(6);
  }
}

MotionLimits Operation::motion_limits() const {
  MotionLimits promise;
  if (byte(7) % 4 != 0) promise.acceleration_limit = 5.0 * fraction(7);
  if (byte(7) % 16 < 4) promise.planned_acceleration = {0, 0, -3};
  if (byte(7) % 16 == 4) promise.planned_acceleration = {2.0 * fraction(3), 1, -2.0 * fraction(4)};
  return promise;
}

Filter Operation::filter() const {
  Filter filter;
  if (byte(9) % 4 != 0) return filter;
  filter.category = 1 + byte(9) / 4 % 3;
  filter.mask = 1 + byte(9) / 16 % 3;
  filter.group = byte(9) / 64 - 1;
  return filter;
}

Sensor Operation::sensor(double reach) const {
  Sensor sensor;
  for (std::size_t k = 0; k < sensor_distances.size(); ++k)
    if ((byte(0) & byte(1)) >> k & 1 && sensor_distances[k] <= reach)
      sensor.distances.push_back(sensor_distances[k]);
  if (byte(3) % 2 == 0) std::reverse(sensor.distances.begin(), sensor.distances.end());
  if (byte(3) % 8 == 1 && !sensor.distances.empty()) sensor.distances.push_back(sensor.distances[0]);
  if (byte(2) % 4 == 0) sensor.mask = 1 + byte(2) / 4 % 3;
  return sensor;
}

Shape Operation::shape(bool flat) const {
  const Vec3 at = position();
  const Vec3 edges = (velocity() + Vec3{4, 4, 4}) * 0.125;
  switch (byte(7) % 4) {
    case 0: {
      // The plane is turned so that most of the world is in front of it.
      Vec3 normal = Vec3{0.5, 0.5, 0.5} * world_size - at;
      if (flat) normal.z = 0.0;
      const double length = norm(normal);
      normal = length > 0.25 ? normal / length : Vec3{1, 0, 0};
      return HalfSpace{normal, dot(normal, at)};
    }
    case 1:
      return Box{at, at + edges};
    case 2:
      if (!flat && byte(7) / 4 % 4 == 3) return needle();
      if (!flat && edges.x > 0.1 && edges.y > 0.1 && byte(7) / 4 % 4 == 2) return tent(at, edges);
      if (!flat && edges.x > 0.1 && edges.y > 0.1)
        return Triangle{at, at + Vec3{edges.x, 0, edges.z}, at + Vec3{0, edges.y, -edges.z}};
      return Box{at, at + 0.5 * edges};
    default:
      return Ball{at, radius()};
  }
}

/// Returns the four sides of a pyramid, over a rectangle that may stand beside its foot.
Mesh Operation::tent(const Vec3& at, const Vec3& edges) const {
  const std::array vertices{at, at + Vec3{edges.x, 0, 0}, at + Vec3{edges.x, edges.y, 0.1 * edges.z},
                            at + Vec3{0, edges.y, 0}, at + Vec3{0.4 * edges.x, 0.6 * edges.y, edges.z}};
  const std::array<std::array<std::uint32_t, 3>, 4> corners{{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
  return Mesh::create(vertices, corners).value();
}

/// Returns a triangle through the position, a sixteenth to four times as long as the world, and as thin as a
/// world allows or slightly thinner.
Triangle Operation::needle() const {
  Random random = this->random();
  const Needle needle = random_needle(random, 0.0);
  const double scale = world_size * std::exp2(random.uniform(-4.0, 2.0)) / needle.length;
  const Vec3 to = position() - needle.point(random) * scale;
  const auto& [a, b, c] = needle.triangle;
  return {to + a * scale, to + b * scale, to + c * scale};
}

std::vector<RigidPart> Operation::parts(double reach, bool flat) const {
  Random random = this->random();
  const auto in_space = [=](Vec3 point) {
    if (flat) point.z = 0.0;
    return point;
  };
  const Vec3 a = in_space(0.7 * reach * random.point_in_ball());
  const Vec3 b = in_space(0.7 * reach * random.point_in_ball());
  const double radius = 0.3 * reach * random.uniform();
  const RigidPart capsule{a, b, radius};
  const Vec3 corner = 0.4 * reach * Vec3{random.uniform(), random.uniform(), flat ? 0.0 : random.uniform()};
  const RigidPart box = box_part({-corner, corner}, random.bits() % 2 == 0 ? 0.0 : radius);
  switch (random.bits() % 6) {
    case 0:
      return {{a, a, radius}, {b, b, radius}};
    case 1:
      return {capsule};
    case 2: {
      const Vec3 end = 0.99 * reach * (flat ? Vec3{0.6, 0.8, 0} : random.unit_vector());
      return {{-end, end, 0.001 * reach}};
    }
    case 3:
      return {box};
    case 4: {
      std::vector<Vec3> points{a, b};
      for (auto count = 1 + random.bits() % (flat ? 1 : 3); count > 0; --count)
        points.push_back(in_space(0.7 * reach * random.point_in_ball()));
      return {hull_part(points, random.bits() % 2 == 0 ? 0.0 : radius)};
    }
    default:
      return {capsule, box};
  }
}

Rotation Operation::rotation(bool flat) const {
  Random random = this->random();
  const Vec3 axis = flat ? Vec3{0, 0, 1} : random.unit_vector();
  static constexpr std::array speeds{0.0, 1.0, 4.0, 10.0, 10.0, 4.0, 1.0, 100.0};
  const double speed = speeds[random.bits() % speeds.size()] * (random.bits() % 2 == 0 ? 1.0 : -0.7);
  const Quaternion half_turn{0.0, 0.0, 0.0, -1.0};
  const Vec3 turn = (3.0 * random.uniform()) * (flat ? axis : random.unit_vector());
  return {random.bits() % 4 == 0 ? half_turn : rotation_by(turn), speed * axis};
}

Random Operation::random() const {
  std::uint64_t seed = 0;
  for (const std::uint8_t byte : bytes) seed = seed * 0x100000001b3u + byte;
  return Random(seed);
}

Operation random_operation(Random& random) {
  Operation operation;
  for (std::uint8_t& byte : operation.bytes) byte = static_cast<std::uint8_t>(random.bits());
  return operation;
}

std::vector<Operation> operations_of(std::span<const std::uint8_t> bytes) {
  std::vector<Operation> operations;
  for (std::size_t at = header_size; at < bytes.size(); at += Operation::size) {
    Operation operation;
    const auto record = bytes.subspan(at, std::min(Operation::size, bytes.size() - at));
    std::copy(record.begin(), record.end(), operation.bytes.begin());
    operations.push_back(operation);
  }
  return operations;
}

WorldKind kind_of(std::span<const std::uint8_t> bytes) {
  static constexpr std::array tolerances{1e-5, 1e-6, 1e-3, 1e-9};
  const std::uint8_t choices = header(bytes, 0);
  const std::uint8_t bodies = header(bytes, 1);
  const std::uint8_t lengths = header(bytes, 2);
  const std::uint8_t features = header(bytes, 4);
  WorldKind kind{};
  WorldDefinition& world = kind.definition;
  world.contacts = choices % 2 == 1  ? ContactEvents::impacts
                   : bodies % 2 == 0 ? ContactEvents::begin_and_end
                                     : ContactEvents::all;
  if (choices / 2 % 2 == 0) world.box = Box{{0, 0, 0}, {world_size, world_size, world_size}};
  kind.crowd = bodies == 255 && choices / 64 % 2 == 1;
  kind.rigid = !kind.crowd && features / 4 % 4 == 2;
  kind.swings = kind.rigid && lengths / 64 % 2 == 1;
  world.allow_overlap = kind.rigid || choices / 4 % 4 != 3;
  world.contact_tolerance = std::max(tolerances[choices / 16 % 4], kind.rigid ? 1e-6 : 0.0);
  if (lengths % 4 == 1) world.separation_distance = 1.5 * world.contact_tolerance;
  if (lengths % 4 == 2) world.separation_distance = 0.1;
  if (lengths / 4 % 4 == 1) world.zeno_interval = 0.01;
  world.spread_window_starts = lengths / 4 % 4 >= 2;
  world.start_time = lengths / 16 - 3.0;
  kind.most_bodies = kind.crowd ? 240 : bodies >= 252 ? 100 : 3 + bodies % 32;
  const std::size_t first = header(bytes, 3);
  kind.first_bodies = kind.crowd ? std::min(kind.most_bodies, 2 * first) : first % kind.most_bodies;
  kind.sensors = features % 2 == 1;
  kind.fixed = features / 2 % 2 == 1;
  if (features / 4 % 4 == 1 || (kind.rigid && choices / 64 == 2)) world.dimensions = 2;
  if (!kind.crowd && features / 4 % 4 == 3) world.wall_filter = Filter{.category = 2, .mask = 3};
  if (world.box && features / 16 % 2 == 1)
    world.periodic = {true, features / 32 % 2 == 1, features / 64 % 2 == 1 && world.dimensions == 3};
  if (features / 128 == 1 && choices / 128 == 1) move_far(world);
  return kind;
}

Bytes random_stream(std::uint64_t seed, std::size_t operations) {
  Random random(seed);
  Bytes bytes(header_size + operations * Operation::size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.bits());
  return bytes;
}

Bytes crowd_stream(std::uint64_t seed, std::size_t operations) {
  Bytes bytes = random_stream(seed, operations);
  bytes[0] |= 64;
  bytes[1] = 255;
  bytes[3] |= 64;
  constexpr std::uint8_t run = 60;
  for (std::size_t k = 0; k < operations; k += 2) bytes[header_size + k * Operation::size] = run;
  return bytes;
}

Bytes without(const Bytes& bytes, std::size_t from, std::size_t to) {
  const auto place = [&](std::size_t operation) {
    return bytes.begin() +
           static_cast<std::ptrdiff_t>(std::min(bytes.size(), header_size + operation * Operation::size));
  };
  Bytes rest(bytes.begin(), place(from));
  rest.insert(rest.end(), place(to), bytes.end());
  return rest;
}

}  // namespace kinesphere::stream
