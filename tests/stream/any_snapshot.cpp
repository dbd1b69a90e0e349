// Feeds a world snapshots that no world has written.
#include "stream/any_bytes.hpp"

#include <utility>

#include "stream/player.hpp"
#include "support/sealed_snapshot.hpp"

namespace kinesphere::stream {
namespace {

using Snapshot = std::vector<std::byte>;

void restore_and_use(const Snapshot& snapshot, std::uint64_t seed) {
  auto restored = World::restore(snapshot);
  if (!restored) {
    if (restored.error().code != ErrorCode::bad_snapshot) throw std::logic_error(restored.error().message);
    return;
  }
  Random random(seed);
  use_for_a_while(std::move(*restored), random);
}

/// Returns the snapshot of a world in use.
Snapshot snapshot_of_stream(std::uint64_t seed) {
  return snapshot_after(with_bodies(random_stream(seed, 40), 8));
}

void edit(Snapshot& snapshot, std::span<const std::uint8_t> edit) {
  const std::size_t margin = snapshot.size() - snapshot_frame_size;
  const std::size_t at = snapshot_header_size + (256u * edit[0] + edit[1]) % margin;
  const auto place = snapshot.begin() + static_cast<std::ptrdiff_t>(at);
  const std::byte value{edit[3]};
  switch (edit[2] % 4) {
    case 0:
      *place = value;
      break;
    case 1:
      *place ^= value;
      break;
    case 2:
      snapshot.insert(place, value);
      break;
    default:
      if (margin > 1) snapshot.erase(place);
  }
}

}  // namespace

void try_as_snapshot(std::span<const std::uint8_t> bytes) {
  const auto* data = reinterpret_cast<const std::byte*>(bytes.data());
  restore_and_use({data, data + bytes.size()}, 1);
  if (bytes.empty()) return;
  Snapshot snapshot = snapshot_of_stream(bytes[0] / 2);
  if (bytes[0] % 2 == 1) {
    snapshot.resize(snapshot_header_size);
    snapshot.insert(snapshot.end(), data + 1, data + bytes.size());
    snapshot.resize(snapshot.size() + snapshot_frame_size - snapshot_header_size);
  } else {
    for (std::size_t at = 1; at + 4 <= bytes.size(); at += 4) edit(snapshot, bytes.subspan(at, 4));
  }
  restore_and_use(sealed(std::move(snapshot)), bytes.size());
}

}  // namespace kinesphere::stream
