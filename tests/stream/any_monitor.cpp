// Feeds a monitor snapshots that no monitor has written.
#include "stream/any_bytes.hpp"

#include <array>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/random.hpp"
#include "stream/damage.hpp"
#include "support/sealed_snapshot.hpp"

namespace kinesphere::any_monitor {
namespace {

using Snapshot = std::vector<std::byte>;

/// Returns the snapshot of a monitor in use: pairs of all verdicts, contradictions, plans, stale tracks,
/// undelivered events.
Snapshot snapshot_of_monitor(std::uint64_t seed) {
  Random random(seed);
  Monitor monitor =
      Monitor::create({.dimensions = seed % 4 == 3 ? 2 : 3,
                       .classes = {{.acceleration_limit = 2.0, .largest_speed = 40.0},
                                   {.acceleration_limit = 1.0, .planned_acceleration = {0, 0, -1}}},
                       .separations = {{0, 0, {Separation::sphere(8.0), Separation::cylinder(4.0, 2.0)}},
                                       {0, 1, {Separation::ellipsoid(3.0, 6.0)}}},
                       .stale_after = 2.0,
                       .drop_after = 5.0})
          .value();
  const double start = seed % 2 == 0 ? 0.0 : 1e6;
  for (int k = 0; k < 60; ++k) {
    const double time = start + 0.1 * k;
    for (int left = 20; left > 0 && monitor.advance(time).value(); --left) continue;
    const TrackId id = random.bits() % 7;
    TrackReport report{
        .timestamp = time - random.uniform(-0.2, 0.5), .position_error = 0.2, .velocity_error = 0.3};
    report.track_class = id % 2;
    report.state = {{3.0 * static_cast<double>(id), time - start, 0}, {0, 1, 0}};
    if (k % 9 == 8) report.state.position.x += 300.0;
    if (k % 5 == 4) report.plan = TrackReport::Plan{{0, 0, k % 2 == 0 ? -3.0 : 0.0}, 0.1, time + 2.0};
    monitor.report(id, report).value();
  }
  return monitor.save();
}

void require(bool holds, const std::string& what) {
  if (!holds) throw std::logic_error(what);
}

void use(Monitor monitor, Random& random) {
  const Snapshot snapshot = monitor.save();
  const auto again = Monitor::restore(snapshot);
  require(static_cast<bool>(again) && again->save() == snapshot, "what was restored cannot be saved");
  for (int k = 0; k < 40; ++k) {
    const auto event = monitor.advance(monitor.time() + 0.5);
    if (!event) break;
    const std::vector<TrackId> tracks = monitor.tracks();
    if (tracks.empty()) break;
    const TrackId id = tracks[random.bits() % tracks.size()], other = tracks[random.bits() % tracks.size()];
    static_cast<void>(monitor.track(id).value());
    if (const auto answer = monitor.answer(id, other))
      require(!(answer->until < monitor.time()), "an old answer");
    static_cast<void>(monitor.report(id, {.timestamp = monitor.time(),
                                          .state = {5.0 * random.point_in_ball(), random.point_in_ball()},
                                          .track_class = monitor.track(id)->track_class}));
    if (k % 11 == 10) monitor.remove(other).value();
  }
  static_cast<void>(monitor.open_pairs());
  static_cast<void>(monitor.needed(monitor.time() + 10.0));
  static_cast<void>(Monitor::restore(monitor.save()));
}

void restore_and_use(Snapshot snapshot, std::uint64_t seed) {
  auto restored = Monitor::restore(sealed(std::move(snapshot)));
  if (!restored) {
    require(restored.error().code == ErrorCode::bad_snapshot, "a snapshot is refused for another reason");
    return;
  }
  Random random(seed);
  use(std::move(*restored), random);
}

}  // namespace

void try_as_monitor(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return;
  static const std::array<Snapshot, 8> snapshots = [] {
    std::array<Snapshot, 8> all;
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = snapshot_of_monitor(k);
    return all;
  }();
  Snapshot snapshot = snapshots[bytes[0] % snapshots.size()];
  for (std::size_t at = 1; at + stream::damage_size <= bytes.size(); at += stream::damage_size)
    stream::damage(snapshot, snapshot_header_size, 8, bytes.subspan(at, stream::damage_size));
  restore_and_use(std::move(snapshot), bytes.size());
}

void try_small_numbers(std::uint64_t seed) {
  constexpr std::uint32_t small = 4;
  const Snapshot snapshot = snapshot_of_monitor(seed);
  for (std::size_t at = snapshot_header_size; at + 12 <= snapshot.size(); ++at) {
    std::uint32_t before;
    std::memcpy(&before, snapshot.data() + at, sizeof before);
    if (before >= small) continue;
    for (std::uint32_t other = 0; other < small; ++other) {
      // Most zeros are bytes of larger numbers.
      if (other == before || (before == 0 && (at + other) % 8 != seed % 8)) continue;
      Snapshot damaged = snapshot;
      std::memcpy(damaged.data() + at, &other, sizeof other);
      restore_and_use(std::move(damaged), at);
    }
  }
}

}  // namespace kinesphere::any_monitor
