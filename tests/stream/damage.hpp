// Damages bytes in the forms that numbers and lists have in snapshots and recordings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace kinesphere::stream {

/// Bytes that define one damage: place (3), kind (1) and value (8).
inline constexpr std::size_t damage_size = 12;

/// Does one damage to the content of `bytes`, which begins at `first` and ends `behind` bytes before the end:
/// changes, inserts or removes a byte, or replaces a double by a strange one, or a number or count by
/// another.
void damage(std::vector<std::byte>& bytes, std::size_t first, std::size_t behind,
            std::span<const std::uint8_t> how);

}  // namespace kinesphere::stream
