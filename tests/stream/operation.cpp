// Parses streams of bytes: the kind of world, and the operations.
#include "stream/operation.hpp"

#include <algorithm>
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
      if (!flat && edges.x > 0.1 && edges.y > 0.1)
        return Triangle{at, at + Vec3{edges.x, 0, edges.z}, at + Vec3{0, edges.y, -edges.z}};
      return Box{at, at + 0.5 * edges};
    default:
      return Ball{at, radius()};
  }
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
  WorldKind kind;
  WorldDefinition& world = kind.definition;
  world.contacts = choices % 2 == 1  ? ContactEvents::impacts
                   : bodies % 2 == 0 ? ContactEvents::begin_and_end
                                     : ContactEvents::all;
  if (choices / 2 % 2 == 0) world.box = Box{{0, 0, 0}, {world_size, world_size, world_size}};
  world.allow_overlap = choices / 4 % 4 != 3;
  world.contact_tolerance = tolerances[choices / 16 % 4];
  if (lengths % 4 == 1) world.separation_distance = 1.5 * world.contact_tolerance;
  if (lengths % 4 == 2) world.separation_distance = 0.1;
  if (lengths / 4 % 4 == 1) world.zeno_interval = 0.01;
  world.spread_window_starts = lengths / 4 % 4 >= 2;
  world.start_time = lengths / 16 - 3.0;
  kind.crowd = bodies == 255 && choices / 64 % 2 == 1;
  kind.most_bodies = kind.crowd ? 240 : bodies >= 252 ? 100 : 3 + bodies % 32;
  const std::size_t first = header(bytes, 3);
  kind.first_bodies = kind.crowd ? std::min(kind.most_bodies, 2 * first) : first % kind.most_bodies;
  kind.sensors = features % 2 == 1;
  kind.fixed = features / 2 % 2 == 1;
  if (features / 4 % 4 == 1) world.dimensions = 2;
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
