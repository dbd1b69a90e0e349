// Damage to bytes as numbers and lists are in snapshots and recordings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace kinesphere::stream {

/// Bytes that say what one damage is: where (3), how (1) and with what (8).
inline constexpr std::size_t damage_size = 12;

/// Does one damage to the content of `bytes`, which begins at `first` and ends `behind` bytes before the end:
/// another byte, one more or less, a strange double in the place of a double, another number or count.
void damage(std::vector<std::byte>& bytes, std::size_t first, std::size_t behind,
            std::span<const std::uint8_t> how);

}  // namespace kinesphere::stream
