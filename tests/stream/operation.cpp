// Streams of bytes: what they say of the world, and the operations in them.
#include "stream/operation.hpp"

#include <algorithm>

namespace kinesphere::stream {
namespace {

constexpr std::size_t header_size = 4;

std::uint8_t header(std::span<const std::uint8_t> bytes, std::size_t k) {
  return k < bytes.size() ? bytes[k] : std::uint8_t{0};
}

}  // namespace

MotionPromise Operation::promise() const {
  MotionPromise promise;
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
  WorldKind kind;
  WorldDefinition& world = kind.definition;
  world.contacts = choices % 2 == 0 ? ContactMode::begin_and_end : ContactMode::impacts;
  if (choices / 2 % 2 == 0) world.box = Box{{0, 0, 0}, {world_size, world_size, world_size}};
  world.allow_overlap = choices / 4 % 4 != 3;
  world.contact_tolerance = tolerances[choices / 16 % 4];
  if (lengths % 4 == 1) world.separation_distance = 1.5 * world.contact_tolerance;
  if (lengths % 4 == 2) world.separation_distance = 0.1;
  if (lengths / 4 % 4 == 1) world.zeno_interval = 0.01;
  world.start_time = lengths / 16 - 3.0;
  kind.most_bodies = bodies >= 252 ? 100 : 3 + bodies % 32;
  kind.first_bodies = header(bytes, 3) % kind.most_bodies;
  return kind;
}

Bytes random_stream(std::uint64_t seed, std::size_t operations) {
  Random random(seed);
  Bytes bytes(header_size + operations * Operation::size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.bits());
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
