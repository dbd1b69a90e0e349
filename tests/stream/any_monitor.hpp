// Turns any bytes into the snapshot of a monitor.
#pragma once

#include <cstdint>
#include <span>

namespace kinesphere::any_monitor {

/// Makes edits of four bytes each in the snapshot of a monitor, chosen by the first byte: place (2), kind,
/// and value; corrects length and checksum. Checks that Monitor::restore refuses it, or that the restored
/// monitor is safe to use. Throws std::logic_error.
void try_as_monitor(std::span<const std::uint8_t> bytes);

/// Makes one edit at a time: replaces each whole number below 4 in the snapshot of a monitor by each other
/// one; of zeros only one in eight. Slots, counts, verdicts and numbers of tracks are such numbers.
void try_small_numbers(std::uint64_t seed);

}  // namespace kinesphere::any_monitor
