// A checksum of bytes.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string_view>

namespace kinesphere::program {

/// Returns the CRC-32, as in gzip, of bytes that follow others with the checksum `before`.
inline std::uint32_t checksum(std::string_view bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace kinesphere::program
