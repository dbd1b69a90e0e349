// Any bytes as the snapshot of a monitor.
#pragma once

#include <cstdint>
#include <span>

namespace kinesphere::any_monitor {

/// The snapshot of a monitor (chosen by the first byte) with edits of four bytes each: place (2), how, and
/// with what; length and checksum are made right. Monitor::restore refuses it, or what comes out is safe to
/// use. Throws std::logic_error.
void try_as_monitor(std::span<const std::uint8_t> bytes);

/// The same with one edit at a time: each whole number below 4 in the snapshot of a monitor becomes each
/// other one, as far as it is not zero; of zeros, one in eight does. Slots, counts, verdicts and the numbers
/// of tracks are such numbers.
void try_small_numbers(std::uint64_t seed);

}  // namespace kinesphere::any_monitor
