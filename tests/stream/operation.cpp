#include "stream/operation.hpp"

#include <algorithm>

#include "stream/player.hpp"

namespace kinesphere::stream {
namespace {

// Places in the header.
constexpr std::size_t seed_size = 8;
constexpr std::size_t left_out = seed_size;
constexpr std::size_t most_bodies = 14;
constexpr std::size_t crowds = 15;
constexpr std::size_t header_size = 16;

std::uint8_t header(std::span<const std::uint8_t> bytes, std::size_t k) {
  return k < bytes.size() ? bytes[k] : std::uint8_t{0};
}

}  // namespace

Random Operation::random() const {
  std::uint64_t seed = 0;
  for (const std::uint8_t byte : bytes) seed = seed << 8 | byte;
  return Random(seed);
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

Scenario scenario_of(std::span<const std::uint8_t> bytes) {
  std::uint64_t seed = 0;
  for (std::size_t k = seed_size; k-- > 0;) seed = seed << 8 | header(bytes, k);
  Scenario scenario = draw_scenario(seed);
  if (header(bytes, crowds) % 2 == 1) scenario.make_crowd();
  for (std::size_t k = 0; k < features().size(); ++k)
    if (header(bytes, left_out + k / 8) >> k % 8 & 1) scenario.*features()[k].is_on = false;
  scenario.clear_contradictions();
  if (const int most = header(bytes, most_bodies); most > 0)
    scenario.bodies = std::min(scenario.bodies, most);
  return scenario;
}

Bytes random_stream(std::uint64_t seed, std::size_t operations) {
  Random random(~seed);
  Bytes bytes(header_size + operations * Operation::size);
  for (std::size_t k = 0; k < bytes.size(); ++k)
    if (k < seed_size)
      bytes[k] = static_cast<std::uint8_t>(seed >> 8 * k);
    else if (k >= header_size)
      bytes[k] = static_cast<std::uint8_t>(random.bits());
  return bytes;
}

Bytes crowd_stream(std::uint64_t seed, std::size_t operations) {
  Bytes bytes = random_stream(seed, operations);
  bytes[crowds] = 1;
  for (std::size_t k = 0; k < operations; k += 2) bytes[header_size + k * Operation::size] = Player::run_code;
  return bytes;
}

Bytes without_feature(Bytes bytes, std::size_t feature) {
  bytes.resize(std::max(bytes.size(), header_size));
  bytes[left_out + feature / 8] |= static_cast<std::uint8_t>(1u << feature % 8);
  return bytes;
}

Bytes with_bodies(Bytes bytes, int most) {
  bytes.resize(std::max(bytes.size(), header_size));
  bytes[most_bodies] = static_cast<std::uint8_t>(most);
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
