// Any bytes as a snapshot: World::restore refuses them, or what comes out of it is safe to use.
#pragma once

#include <cstdint>
#include <span>

namespace kinesphere::stream {

/// The bytes themselves; then, with mark, version, length and checksum made right, either the bytes as
/// content (first byte odd) or the snapshot of a world (chosen by the first byte) with edits: four bytes
/// each, place, how, and with what. Edits stay of use when the format changes. Throws std::logic_error.
void try_as_snapshot(std::span<const std::uint8_t> bytes);

}  // namespace kinesphere::stream
