#include "distributed/window_starts.hpp"

#include <algorithm>
#include <utility>

#include "archive/archive.hpp"
#include "distributed/guarded.hpp"
#include "processor/spot_checks.hpp"

namespace kinesphere {

Arrivals WindowStarts::count_arrivals() {
  std::vector<std::uint32_t> arrived = rank_.main.dirty().arrivals(rank_.bodies());
  const auto exact = std::count_if(arrived.begin(), arrived.end(), [this](std::uint32_t number) {
    return rank_.bodies()[number].bound.is_exact() && !rank_.bodies()[number].is_static();
  });
  std::uint64_t sums[] = {arrived.size(), rank_.own_registered(), rank_.own_moving(),
                          rank_.bodies().are_balls() ? 0u : 1u, static_cast<std::uint64_t>(exact)};
  communicator_.sum(sums);
  // What is certified of two balls depends on whether all bodies of the world are balls.
  if (sums[3] > 0) rank_.bodies().rigid.note_elsewhere();
  return {std::move(arrived), sums[0], sums[1], sums[2], sums[4] > 0};
}

Result<void> WindowStarts::start_with(const Arrivals& arrivals, PoolLease& lease) {
  std::vector<std::uint32_t> joining = arrivals.here;
  const bool anew = are_many(arrivals.everywhere, arrivals.registered);
  if (anew)
    std::erase_if(joining, [this](std::uint32_t number) { return rank_.bodies()[number].stands_still(); });
  const std::uint64_t all_joining = communicator_.sum(joining.size());
  const bool was_for_few = anew && 2 * all_joining >= arrivals.moving;
  if (all_joining > 0 && (was_for_few || !rank_.state.window_policy.is_chosen()))
    choose_policy(joining, lease);
  if (!anew || all_joining == 0) return {};
  const auto probed = guarded([&]() -> Result<void> {
    auto stale = rank_.main.probe_stale(joining, ProbeCause::change, lease);
    return stale ? Result<void>() : stale.error();
  });
  if (auto agreed = consensus_.agree(probed); !agreed) return agreed;
  return start(lease, true, joining);
}

void WindowStarts::choose_policy(std::span<const std::uint32_t> joining, PoolLease& lease) {
  WindowStart starting(rank_.state, rank_.main, lease, found_);
  MotionStatistics statistics = starting.measure(joining);
  statistics.reduce([this](std::span<std::uint64_t> numbers) { communicator_.sum(numbers); },
                    [this](std::span<double> numbers) { communicator_.least(numbers); });
  starting.choose_policy(statistics);
}

void WindowStarts::begin_epoch_of_arrivals() {
  const BroadPhase& windows = rank_.state.broad_phase;
  double end = rank_.main.epoch_end();
  for (std::uint32_t number = 0; number < rank_.bodies().numbers(); ++number)
    if (windows.contains(number) && rank_.directory.is_own(number) && windows.end_of(number) > rank_.time())
      end = std::min(end, windows.end_of(number));
  rank_.main.begin_epoch(communicator_.least(end));
}

/// Starts the main window. Its length depends on the number of bodies of all ranks that were recertified one
/// by one since the last main window started.
void WindowStarts::start_main_window() {
  const RenewalCounts here = std::exchange(rank_.main.work().recertified, {});
  std::uint64_t updates[] = {here.bodies, here.near};
  communicator_.sum(updates);
  rank_.state.window_policy.start_main(rank_.time(), {updates[0], updates[1]});
}

/// Returns the union of the lists of all ranks, in ascending order.
std::vector<int> WindowStarts::union_of(const std::vector<int>& held) {
  ByteWriter writer;
  writer(held);
  std::vector<int> all;
  for (const Communicator::Bytes& bytes : communicator_.gather(writer.bytes())) {
    std::vector<int> some;
    ByteReader reader(bytes);
    reader(some);
    all.insert(all.end(), some.begin(), some.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

Result<void> WindowStarts::start(PoolLease& lease, bool all, std::span<const std::uint32_t> joining) {
  BroadPhase& windows = rank_.state.broad_phase;
  WindowPolicy& window_policy = rank_.state.window_policy;
  EventProcessor& main = rank_.main;
  const double now = rank_.time();
  WindowStart starting(rank_.state, main, lease, found_);
  std::vector<std::uint32_t> numbers = windows.ended(now, all);
  std::uint64_t sums[] = {0, joining.size(), rank_.own_moving()};
  distribution_.drop_ghosts(numbers);
  sums[0] = numbers.size();
  communicator_.sum(sums);
  const bool most = 2 * (sums[0] + sums[1]) > sums[2];
  if (auto probed = consensus_.agree(guarded([&] { return starting.refresh(numbers); })); !probed)
    return probed;
  if (most) start_main_window();
  windows.end_windows(now, all);
  std::erase_if(numbers, [this](std::uint32_t number) { return rank_.bodies()[number].dirty; });
  if (communicator_.rank() == 0) ++main.work().counters.window_ends;
  main.work().counters.starts += numbers.size();
  main.work().counters.restarts += joining.size();
  for (const std::uint32_t number : joining) {
    if (windows.contains(number)) windows.leave(number);
    numbers.push_back(number);
  }
  WindowPolicy::Sample round(window_policy, most);
  std::vector<BroadPhase::Starter> starters =
      starting.choose_windows(numbers, union_of(windows.held_rungs()), round);
  round.reduce([this](std::span<std::uint64_t> sum) { communicator_.sum(sum); });
  for (const BroadPhase::Starter& starter : starters) {
    rank_.bodies()[starter.number].mark_visited();
    rank_.directory[starter.number].cost += 1.0f;
  }
  if (most) distribution_.divide_space(starters);
  if (auto moved = distribution_.migrate(starters); !moved) return moved;
  if (auto known = distribution_.update_ghosts(starters, most); !known) return known;
  std::uint64_t found[] = {starting.start(starters, &rank_.directory.are_ghosts()), 0};
  found[1] = rank_.own_registered();
  communicator_.sum(found);
  window_policy.finish_start(round, found[0], found[1]);
  main.begin_epoch(communicator_.least(windows.next_end()));
  return {};
}

}  // namespace kinesphere
