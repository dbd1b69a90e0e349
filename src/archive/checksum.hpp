// The checksum of saved bytes: XXH64, which shows damage and is no protection against malice.
//
// XXH64 is the 64-bit hash of Yann Collet's xxHash, as https://github.com/Cyan4973/xxHash
// (doc/xxhash_spec.md) specifies it. Every bit of the input reaches every bit of the sum, so damage of any
// kind goes unnoticed with a chance of about 2^-64.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace kinesphere {

/// XXH64 of the bytes. With the sum over what came before as `seed`, it stands for all of it. Cost: about a
/// quarter of a nanosecond a byte.
std::uint64_t checksum(std::span<const std::byte> bytes, std::uint64_t seed = 0);

}  // namespace kinesphere
