// Damage with a mended envelope: snapshots and recordings of varied worlds, with bytes and numbers in them
// changed and all lengths and checksums made right again, so that the damage reaches the decoder.
#pragma once

#include <cstdint>
#include <span>

namespace kinesphere::stream {

/// Damages a snapshot or a recording as `bytes` says: the first byte chooses which one; then twelve bytes for
/// each edit: where (3), how (1), and with what (8). What is damaged is refused with the error of its kind,
/// or can be used: advanced, asked, changed, audited, saved and restored again, and replayed to its end.
/// Throws std::logic_error where that is not so.
void try_mended(std::span<const std::uint8_t> bytes);

}  // namespace kinesphere::stream
