// Turns any bytes into a snapshot: World::restore refuses it, or the restored world is safe to use.
#pragma once

#include <cstdint>
#include <span>

namespace kinesphere::stream {

/// Tries the bytes themselves; then, with mark, version, length and checksum made right, either the bytes as
/// content (first byte odd) or the snapshot of a world (chosen by the first byte) with edits of four bytes
/// each: place, kind, and value. The edits stay useful when the format changes. Throws std::logic_error.
void try_as_snapshot(std::span<const std::uint8_t> bytes);

}  // namespace kinesphere::stream
