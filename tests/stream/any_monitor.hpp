// Any bytes as the snapshot of a monitor.
#pragma once

#include <cstdint>
#include <span>

namespace kinesphere::any_monitor {

/// The snapshot of a monitor (chosen by the first byte) with edits of four bytes each: place (2), how, and
/// with what; length and checksum are made right. Monitor::restore refuses it, or what comes out is safe to
/// use. Throws std::logic_error.
void try_as_monitor(std::span<const std::uint8_t> bytes);

}  // namespace kinesphere::any_monitor
