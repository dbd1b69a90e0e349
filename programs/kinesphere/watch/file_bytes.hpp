// Reads bytes of an open file, without moving its position.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

namespace kinesphere::program {

/// Returns at most `most` bytes from a position; fewer if the file ends or cannot be read.
inline std::string bytes_at(int descriptor, std::uint64_t position, std::size_t most) {
  std::string bytes(most, '\0');
  const auto got = ::pread(descriptor, bytes.data(), most, static_cast<off_t>(position));
  bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(0, got)));
  return bytes;
}

}  // namespace kinesphere::program
