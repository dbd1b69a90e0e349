// Turns bytes into operations on a world: any bytes are a stream, so that a fuzzer may write them.
//
// A stream is a header of 5 bytes, which chooses the kind of world, and records of 12 bytes, one for each
// operation; missing bytes of the last are zero. All records have one size, so removing one leaves the others
// unchanged.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/rigid_body.hpp"
#include "kinesphere/shape.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere::stream {

using Bytes = std::vector<std::uint8_t>;

/// Edge of the cube in which the world lies; without walls, bodies stay near it.
inline constexpr double world_size = 4.0;

/// Distance of some periodic worlds from their origin, in contact tolerances: a sixteenth of the limit.
inline constexpr double far_away = 0x1p37;

/// All sensor distances in streams. Periodic space has no room for the last.
inline constexpr std::array sensor_distances{0.0, 0.02, 0.1, 0.3, 1.0};
inline constexpr SensorClass sensor_classes = 3;

/// One operation: kind, body, and numbers. Positions lie on a grid of 1/64, velocities on one of 1/32, so
/// that many events have equal times or distances.
struct Operation {
  static constexpr std::size_t size = 12;
  std::array<std::uint8_t, size> bytes{};

  std::uint8_t code() const { return bytes[0]; }
  std::uint8_t body() const { return bytes[1]; }
  std::uint8_t byte(std::size_t k) const { return bytes[2 + k]; }
  /// Range: [0, 1).
  double fraction(std::size_t k) const { return byte(k) / 256.0; }

  // Each kind of number has its own bytes, in every operation.
  Vec3 position() const { return Vec3{fraction(0), fraction(1), fraction(2)} * world_size; }
  Vec3 velocity() const { return {speed(3), speed(4), speed(5)}; }
  /// One radius in sixteen is 0, and one is large.
  double radius() const;
  MotionLimits motion_limits() const;
  /// Returns an acceleration within the limits.
  Vec3 acceleration(const MotionLimits& promise) const {
    return promise.planned_acceleration +
           0.999 * promise.acceleration_limit * Random(byte(8)).point_in_ball();
  }
  Filter filter() const;
  bool solid() const { return byte(8) / 8 % 8 != 0; }
  SensorClass sensor_class() const { return static_cast<SensorClass>(byte(9) / 8 % sensor_classes); }
  /// Returns a sensor without the distances beyond `reach`.
  Sensor sensor(double reach) const;
  /// Returns a shape; no triangle in the plane. One in sixteen is a needle, a long and thin triangle.
  Shape shape(bool flat) const;
  /// Returns parts within `reach` of the position: balls, capsules, hulls, and needles 1:1000.
  std::vector<RigidPart> parts(double reach, bool flat) const;
  /// Returns an orientation, one in four by half a turn, and an angular velocity of up to 100.
  Rotation rotation(bool flat) const;
  /// Returns random numbers that depend on this operation alone.
  Random random() const;

 private:
  Triangle needle() const;
  Mesh tent(const Vec3& at, const Vec3& edges) const;
  double speed(std::size_t k) const { return (byte(k) - 128) / 32.0; }
};

Operation random_operation(Random& random);

/// Returns the operations of a stream.
std::vector<Operation> operations_of(std::span<const std::uint8_t> bytes);

struct WorldKind {
  WorldDefinition definition;
  std::size_t most_bodies;
  std::size_t first_bodies;  ///< bodies present from the start
  bool sensors;              ///< some bodies sense others, and some are not solid
  bool fixed;                ///< there are static bodies
  bool crowd;                ///< hundreds of small awake bodies, among which World::run finds clusters
  bool rigid;                ///< some bodies are rigid
  bool swings;  ///< angular velocities of rigid bodies change, and a rotation probe tells of them
};
/// Returns the kind of world that the header of a stream chooses.
WorldKind kind_of(std::span<const std::uint8_t> bytes);

/// Returns a stream with this number of random operations.
Bytes random_stream(std::uint64_t seed, std::size_t operations);

/// Returns a stream for a crowd of hundreds, in which every other operation is a run.
Bytes crowd_stream(std::uint64_t seed, std::size_t operations);

/// Returns the stream without operations [from, to).
Bytes without(const Bytes& bytes, std::size_t from, std::size_t to);

}  // namespace kinesphere::stream
