// The envelope around the content of every saved format, by which foreign, truncated and damaged bytes are
// refused:
//   mark (8 bytes), format version (4), length of the content (8), content, checksum of all before (8).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinesphere/result.hpp"

namespace kinesphere {

struct Envelope {
  std::array<std::uint8_t, 8> mark;  ///< ends with "\r\n", which a transfer as text would change
  std::uint32_t format_version;
  std::string_view noun;  ///< kind of content, as in "world"
  // For error messages: the call that opens the envelope, and the name and error code of its argument.
  std::string_view call;
  std::string_view argument;
  ErrorCode code;

  std::vector<std::byte> seal(std::span<const std::byte> content) const;
  /// Returns the content, or an error if the mark, version, length or checksum is wrong. The span points into
  /// `bytes`.
  Result<std::span<const std::byte>> open(std::span<const std::byte> bytes) const;
  /// Returns an error with the message "<call>: <argument> <what>".
  Error refusal(const std::string& what) const;
};

}  // namespace kinesphere
