// Damage with a mended envelope: changes bytes and numbers in snapshots and recordings of varied worlds, and
// corrects all lengths and checksums, so that the damage reaches the decoder.
#pragma once

#include <cstdint>
#include <span>

namespace kinesphere::stream {

/// Damages a snapshot or a recording: the first byte chooses it; then each edit takes twelve bytes: place
/// (3), kind (1) and value (8). The result must be refused with the error of its kind, or be safe to use:
/// advanced, queried, changed, audited, saved and restored, and replayed to its end. Throws std::logic_error
/// if it is not.
void try_mended(std::span<const std::uint8_t> bytes);

}  // namespace kinesphere::stream
