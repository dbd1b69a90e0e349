// A 64-bit sum over bytes that shows damage; no protection against malice.
#pragma once

#include <cstdint>
#include <span>

#include "archive/archive.hpp"

namespace kinesphere {

/// 64-bit FNV-1a over words of eight bytes, then the bytes that are left: damage to one word always shows.
class Checksum {
 public:
  Checksum& add(std::uint64_t word) {
    sum_ = (sum_ ^ word) * 0x100000001b3u;
    return *this;
  }
  Checksum& add(std::span<const std::byte> bytes) {
    ByteReader reader(bytes);
    for (std::uint64_t word = 0; reader.remaining() >= sizeof word;) {
      reader(word);
      add(word);
    }
    for (std::uint8_t byte = 0; reader.remaining() > 0;) {
      reader(byte);
      add(std::uint64_t{byte});
    }
    return *this;
  }
  std::uint64_t value() const { return sum_; }

 private:
  std::uint64_t sum_ = 0xcbf29ce484222325u;
};

}  // namespace kinesphere
