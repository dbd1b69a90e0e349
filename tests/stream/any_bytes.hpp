// Turns any bytes into damaged snapshots and recordings: each is refused with the error of its kind, or what
// is restored is safe to use. All functions throw std::logic_error if it is not.
#pragma once

#include <cstdint>
#include <span>

namespace kinesphere {

namespace stream {

/// Tries the bytes themselves; then, with mark, version, length and checksum made right, either the bytes as
/// content (first byte odd) or the snapshot of a world (chosen by the first byte) with edits of four bytes
/// each: place, kind, and value. The edits stay useful when the format changes.
void try_as_snapshot(std::span<const std::uint8_t> bytes);

/// Damages a snapshot or a recording, and corrects all lengths and checksums, so that the damage reaches the
/// decoder: the first byte chooses it; then each edit takes twelve bytes: place (3), kind (1) and value (8).
/// What is restored is advanced, queried, changed, audited, saved and restored, and replayed to its end.
void try_mended(std::span<const std::uint8_t> bytes);

}  // namespace stream

namespace any_monitor {

/// Makes edits of four bytes each in the snapshot of a monitor, chosen by the first byte: place (2), kind,
/// and value; corrects length and checksum.
void try_as_monitor(std::span<const std::uint8_t> bytes);

/// Makes one edit at a time: replaces each whole number below 4 in the snapshot of a monitor by each other
/// one; of zeros only one in eight. Slots, counts, verdicts and numbers of tracks are such numbers.
void try_small_numbers(std::uint64_t seed);

}  // namespace any_monitor

}  // namespace kinesphere
