// Epochs: windows end, and new windows start for their bodies, or for all bodies if many were relocated.
#include <algorithm>
#include <numeric>

#include "engine/engine.hpp"
#include "number/infinity.hpp"
#include "processor/window_start.hpp"

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
  // If most bodies are in windows whose next start is prepared, the others do not count as most.
  const bool most = (all || !prepared_) && 2 * (numbers.size() + joining.size()) > windows.moving();
  if (auto probed = starting.refresh(numbers); !probed) return probed;
  if (most) window_policy.start_main(now, std::exchange(main_.work().recertified, {}));
  // A body that violated its bound is dirty and is recertified separately.
  std::erase_if(numbers, [this](std::uint32_t number) { return bodies()[number].dirty; });
  if (all) discard_prepared_start();
  windows.end_windows(now, all);
  const std::vector<std::uint32_t> slow = prepared_ ? take_slow(numbers) : std::vector<std::uint32_t>();
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
  if (!slow.empty()) main_.restart(slow);
  if (most) plan_next_start();
  return {};
}

/// Takes the bodies that suit main windows out of `numbers`, and returns them. While the start of these is
/// prepared, they enter them one by one.
std::vector<std::uint32_t> World::Engine::take_slow(std::vector<std::uint32_t>& numbers) {
  const WindowPolicy& policy = state_.window_policy;
  const auto slow = std::stable_partition(numbers.begin(), numbers.end(), [&](std::uint32_t number) {
    return policy.rung_for(speed_bound_of(BoundAt(bodies()[number].bound, time()))) < policy.main_rung();
  });
  std::vector<std::uint32_t> taken(slow, numbers.end());
  numbers.erase(slow, numbers.end());
  return taken;
}

/// Does what is due of the preparation of the next start, starts windows at the end of the epoch, and checks
/// exact bodies when that is due.
Result<void> World::Engine::end_epoch(PoolLease& lease) {
  while (prepared_ && prepared_->next_slice() <= time()) {
    if (auto done = prepared_->prepare_slice({state_, main_, lease, found_}); !done) return done;
    main_.set_next_slice(prepared_->next_slice());
    if (prepared_->is_done()) plan_next_start();
  }
  if (main_.epoch_end() <= time()) {
    if (auto started = start_windows(lease, false); !started) return started;
  }
  // Bodies that have arrived enter their windows first: the window policy says when they are checked.
  if (state_.spot_checks.next() > time() || !main_.is_recertified()) return {};
  std::vector<std::uint32_t> all(bodies().numbers());
  std::iota(all.begin(), all.end(), 0u);
  const std::uint64_t& probes = main_.work().counters.probes;
  const auto census = main_.spot_check_due(all, probes, lease);
  if (!census) return census.error();
  const double pace = state_.core ? state_.core->count_stays().median() : state_.window_policy.main_length();
  state_.spot_checks.note_check(pace, time(), *census, probes);
  return {};
}

/// Prepares the next start of most bodies from now on, if they are many.
void World::Engine::plan_next_start() {
  discard_prepared_start();
  const Window present = Window::at(time(), state_.window_policy.main_rung());
  const std::size_t bodies = may_prepare_starts() ? broad_phase().size_of(present) : 0;
  if (!PreparedStart::pays(bodies)) return;
  prepared_.emplace(state_.bodies.space(), state_.window_policy, present, time(), bodies);
  main_.set_next_slice(prepared_->next_slice());
}

void World::Engine::discard_prepared_start() {
  state_.broad_phase.record_changes(false);
  state_.broad_phase.end_search();
  prepared_.reset();
  main_.set_next_slice(infinity);
}

}  // namespace kinesphere
