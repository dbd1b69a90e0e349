// Serialization of a single body by the library's motions (Motion::write_body, read_body): the mark of the
// motion kind, then the fields of the body, in the byte order of archive/archive.hpp. Each motion lists its
// fields in both functions, in the same order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "archive/archive.hpp"
#include "archive/fields.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

/// Prefix of a serialized body. A motion kind gets a new mark when the fields that it writes change.
struct BodyMark {
  std::uint32_t number;
  std::string_view motion;
};

inline constexpr BodyMark ballistic_mark{1, "Ballistic"};
inline constexpr BodyMark random_forces_mark{2, "RandomForces"};
inline constexpr BodyMark steered_mark{3, "SteeredMotion"};
inline constexpr BodyMark velocity_field_mark{4, "VelocityField"};
inline constexpr BodyMark piecewise_motion_mark{5, "PiecewiseMotion or RecordedTracks"};
inline constexpr BodyMark frames_mark{7, "FrameMotion"};

template <class... Fields>
void append_fields(std::vector<std::byte>& bytes, const Fields&... fields) {
  ByteWriter writer;
  writer(fields...);
  bytes.insert(bytes.end(), writer.bytes().begin(), writer.bytes().end());
}

template <class... Fields>
void append_body(std::vector<std::byte>& bytes, const BodyMark& mark, const Fields&... fields) {
  append_fields(bytes, mark.number, fields...);
}

/// Returns the error of read_body(): "read_body: bytes <what>".
inline Error bad_bytes(const std::string& what) {
  return {ErrorCode::bad_bytes, "bytes", no_body, "read_body: bytes " + what};
}

/// Returns the error of read_body() for bytes with values that no body of the motion can have.
inline Error bad_bytes(const Error& reason) {
  return bad_bytes("hold no body of this motion: " + reason.message);
}

/// Reads the fields that append_fields() wrote, and returns the remaining bytes. The caller checks the
/// values. Errors: bad_bytes for bytes that end too early.
template <class... Fields>
Result<std::span<const std::byte>> take_fields(std::span<const std::byte> bytes, Fields&... fields) {
  ByteReader reader(bytes);
  reader(fields...);
  if (reader.failed()) return bad_bytes("must hold a whole body, but end before it does");
  return bytes.last(reader.remaining());
}

/// Reads the fields that append_body() wrote, and returns the remaining bytes. The caller checks the values.
/// Errors: bad_bytes for another mark, or for bytes that end too early.
template <class... Fields>
Result<std::span<const std::byte>> take_body(std::span<const std::byte> bytes, const BodyMark& mark,
                                             Fields&... fields) {
  ByteReader reader(bytes);
  std::uint32_t number = 0;
  reader(number);
  if (!reader.failed() && number != mark.number) {
    return bad_bytes("must begin with " + std::to_string(mark.number) + ", the mark of a body of " +
                     std::string(mark.motion) + ", but begin with " + std::to_string(number));
  }
  return take_fields(bytes.last(reader.remaining()), fields...);
}

}  // namespace kinesphere
