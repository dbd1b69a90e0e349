// Bytes to operations on a world: any bytes are a stream, so that a fuzzer may write them.
//
// A stream is a header of 5 bytes, which chooses the kind of world, and records of 12 bytes, one for each
// operation; what is missing of the last is zero. As all records are of one size, leaving one out leaves the
// others what they are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/shape.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere::stream {

using Bytes = std::vector<std::uint8_t>;

/// The world is a cube of this size, or, without walls, the bodies keep near it.
inline constexpr double world_size = 4.0;

/// How far from its origin space repeats in some worlds, in contact tolerances: a sixteenth of what may be.
inline constexpr double far_away = 0x1p37;

/// All distances that sensors in a stream may have. Where space repeats there is no room for the last.
inline constexpr std::array sensor_distances{0.0, 0.02, 0.1, 0.3, 1.0};
inline constexpr SensorClass sensor_classes = 3;

/// One operation: what to do, to whom, and numbers for it. Positions lie on a grid of 1/64, velocities on one
/// of 1/32, so that things often happen at one instant and at exactly equal distances.
struct Operation {
  static constexpr std::size_t size = 12;
  std::array<std::uint8_t, size> bytes{};

  std::uint8_t code() const { return bytes[0]; }
  std::uint8_t body() const { return bytes[1]; }
  std::uint8_t byte(std::size_t k) const { return bytes[2 + k]; }
  /// In [0, 1).
  double fraction(std::size_t k) const { return byte(k) / 256.0; }

  // Each number takes the same bytes in every operation.
  Vec3 position() const { return Vec3{fraction(0), fraction(1), fraction(2)} * world_size; }
  Vec3 velocity() const { return {speed(3), speed(4), speed(5)}; }
  /// One in sixteen is a point, one is large.
  double radius() const;
  MotionLimits motion_limits() const;
  /// An acceleration within a promise.
  Vec3 acceleration(const MotionLimits& promise) const {
    return promise.planned_acceleration +
           0.999 * promise.acceleration_limit * Random(byte(8)).point_in_ball();
  }
  Filter filter() const;
  bool solid() const { return byte(8) / 8 % 8 != 0; }
  SensorClass sensor_class() const { return static_cast<SensorClass>(byte(9) / 8 % sensor_classes); }
  /// Without the distances beyond `reach`.
  Sensor sensor(double reach) const;
  /// In a plane it is not a triangle. One in sixteen is a needle, a triangle that is long and thin.
  Shape shape(bool flat) const;
  /// Draws that belong to this operation.
  Random random() const;

 private:
  Triangle needle() const;
  double speed(std::size_t k) const { return (byte(k) - 128) / 32.0; }
};

Operation random_operation(Random& random);

/// The operations of a stream.
std::vector<Operation> operations_of(std::span<const std::uint8_t> bytes);

struct WorldKind {
  WorldDefinition definition;
  std::size_t most_bodies;
  std::size_t first_bodies;  ///< there from the start
  bool sensors;              ///< some bodies sense others, and some are not solid
  bool fixed;                ///< there are bodies that never move
  bool crowd;                ///< hundreds of small bodies, among whom World::run finds islands: none rests
};
/// What the header of a stream asks for.
WorldKind kind_of(std::span<const std::uint8_t> bytes);

/// A stream of this many random operations.
Bytes random_stream(std::uint64_t seed, std::size_t operations);

/// The same in a crowd of hundreds, in which every other operation is a run.
Bytes crowd_stream(std::uint64_t seed, std::size_t operations);

/// The same stream without operations [from, to).
Bytes without(const Bytes& bytes, std::size_t from, std::size_t to);

}  // namespace kinesphere::stream
