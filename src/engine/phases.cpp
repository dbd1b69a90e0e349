// Phases: windows end, and new ones start for their bodies, or for all of them where many have arrived.
#include <algorithm>

#include "engine/engine.hpp"
#include "engine/starting.hpp"

namespace kinesphere {

/// Where many have arrived since windows started, all start anew with them: those that have arrived one by
/// one would cost more.
Result<void> World::Engine::start_with_arrivals(Shift& shift) {
  std::vector<std::uint32_t> joining = everybody_.unsettled().arrivals(bodies());
  const bool anew = are_many(joining.size(), windows().size());
  if (anew) {
    std::erase_if(joining, [this](std::uint32_t number) {
      return bodies()[number].is_fixed() || bodies()[number].stands_still();
    });
  }
  Starting starting(tables_, everybody_, shift, found_);
  // A tempo that was chosen for few bodies may be far too slow for many.
  const bool was_for_few = anew && 2 * joining.size() >= windows().moving();
  if (!joining.empty() && (was_for_few || !tables_.tempo.is_chosen()))
    starting.choose_tempo(starting.survey(joining));
  if (!anew || joining.empty()) return {};
  if (auto probed = everybody_.probe_stale(joining, shift); !probed) return probed.error();
  if (auto started = start_windows(shift, true, joining); !started) return started;
  // For some there was no window.
  for (const std::uint32_t number : joining)
    if (windows().contains(number)) tables_.bodies[number].settled_now();
  return {};
}

/// New windows for those whose windows have ended, or for all, and for some that join them.
Result<void> World::Engine::start_windows(Shift& shift, bool all, std::span<const std::uint32_t> joining) {
  Windows& windows = tables_.windows;
  Tempo& tempo = tables_.tempo;
  const double now = time();
  Starting starting(tables_, everybody_, shift, found_);
  std::vector<std::uint32_t> numbers = windows.ended(now, all);
  const bool most = 2 * (numbers.size() + joining.size()) > windows.moving();
  if (auto probed = starting.refresh(numbers); !probed) return probed;
  if (most) tempo.start_main(now, std::exchange(everybody_.work().settled, {}));
  windows.end_windows(now, all);
  // Those with a broken promise, too, are settled by themselves.
  std::erase_if(numbers, [this](std::uint32_t number) { return bodies()[number].dirty; });
  ++everybody_.work().counters.window_ends;
  everybody_.work().counters.starts += numbers.size();
  everybody_.work().counters.restarts += joining.size();
  const auto ended = static_cast<std::ptrdiff_t>(numbers.size());
  numbers.insert(numbers.end(), joining.begin(), joining.end());
  std::inplace_merge(numbers.begin(), numbers.begin() + ended, numbers.end());
  for (const std::uint32_t number : joining)
    if (windows.contains(number)) windows.leave(number);
  Tempo::Round round(tempo, most);
  const auto starters = starting.choose_windows(numbers, windows.held_tiers(), round);
  const std::uint64_t near = starting.start(starters);
  tempo.finish_start(round, near, windows.size());
  everybody_.begin_phase(windows.next_end());
  return {};
}

}  // namespace kinesphere
