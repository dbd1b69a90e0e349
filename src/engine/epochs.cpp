// Epochs: windows end, and new windows start for their bodies, or for all bodies if many were relocated.
#include <algorithm>

#include "engine/engine.hpp"
#include "engine/window_start.hpp"

namespace kinesphere {

/// Restarts all windows if many bodies were relocated since the last window start. Recertifying that many
/// bodies one by one would cost more.
Result<void> World::Engine::start_with_arrivals(PoolLease& lease) {
  std::vector<std::uint32_t> joining = main_.dirty().arrivals(bodies());
  const bool anew = are_many(joining.size(), broad_phase().size());
  if (anew) {
    std::erase_if(joining, [this](std::uint32_t number) {
      return bodies()[number].is_static() || bodies()[number].stands_still();
    });
  }
  WindowStart starting(state_, main_, lease, found_);
  // A window policy that was chosen for few bodies may be far off for many.
  const bool was_for_few = anew && 2 * joining.size() >= broad_phase().moving();
  if (!joining.empty() && (was_for_few || !state_.window_policy.is_chosen()))
    starting.choose_policy(starting.measure(joining));
  if (!anew || joining.empty()) return {};
  if (auto probed = main_.probe_stale(joining, ProbeCause::change, lease); !probed) return probed.error();
  if (auto started = start_windows(lease, true, joining); !started) return started;
  // Bodies for which no window was found stay dirty.
  for (const std::uint32_t number : joining)
    if (broad_phase().contains(number)) state_.bodies[number].mark_visited();
  return {};
}

/// Starts new windows for the bodies whose windows have ended, or for all if `all`, together with the bodies
/// `joining`.
Result<void> World::Engine::start_windows(PoolLease& lease, bool all,
                                          std::span<const std::uint32_t> joining) {
  BroadPhase& windows = state_.broad_phase;
  WindowPolicy& window_policy = state_.window_policy;
  const double now = time();
  WindowStart starting(state_, main_, lease, found_);
  std::vector<std::uint32_t> numbers = windows.ended(now, all);
  const bool most = 2 * (numbers.size() + joining.size()) > windows.moving();
  if (auto probed = starting.refresh(numbers); !probed) return probed;
  if (most) window_policy.start_main(now, std::exchange(main_.work().recertified, {}));
  windows.end_windows(now, all);
  // A body that violated its bound is dirty and is recertified separately.
  std::erase_if(numbers, [this](std::uint32_t number) { return bodies()[number].dirty; });
  ++main_.work().counters.window_ends;
  main_.work().counters.starts += numbers.size();
  main_.work().counters.restarts += joining.size();
  const auto ended = static_cast<std::ptrdiff_t>(numbers.size());
  numbers.insert(numbers.end(), joining.begin(), joining.end());
  std::inplace_merge(numbers.begin(), numbers.begin() + ended, numbers.end());
  for (const std::uint32_t number : joining)
    if (windows.contains(number)) windows.leave(number);
  WindowPolicy::Sample round(window_policy, most);
  const auto starters = starting.choose_windows(numbers, windows.held_rungs(), round);
  const std::uint64_t near = starting.start(starters);
  window_policy.finish_start(round, near, windows.size());
  main_.begin_epoch(windows.next_end());
  return {};
}

}  // namespace kinesphere
