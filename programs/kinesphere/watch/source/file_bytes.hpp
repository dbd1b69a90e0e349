// Bytes of open files, and their checksum.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "archive/checksum.hpp"

namespace kinesphere::program {

/// Returns at most `most` bytes from a position; fewer if the file ends or cannot be read. The position of
/// the file stays.
inline std::string bytes_at(int descriptor, std::uint64_t position, std::size_t most) {
  std::string bytes(most, '\0');
  const auto got = ::pread(descriptor, bytes.data(), most, static_cast<off_t>(position));
  bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(0, got)));
  return bytes;
}

inline std::uint64_t checksum_of(std::string_view bytes) { return checksum(std::as_bytes(std::span(bytes))); }

}  // namespace kinesphere::program
