// Windows end, and new ones start.
#include <algorithm>
#include <optional>

#include "engine/engine.hpp"

namespace kinesphere {
namespace {

/// So many are worth the while of a thread.
constexpr std::size_t bodies_at_once = 256;

/// Windows::free_window(), of which most bodies ask for the same one.
class FreeWindows {
 public:
  FreeWindows(const Windows& windows, double now) : windows_(windows), now_(now) {}

  const Window& of(int tier) {
    if (!found_ || tier != asked_) found_ = windows_.free_window(now_, tier);
    asked_ = tier;
    return *found_;
  }

 private:
  const Windows& windows_;
  double now_;
  int asked_ = 0;
  std::optional<Window> found_;
};

}  // namespace

/// The first main window lets most new bodies go about a quarter of the distance between them.
void World::Engine::choose_tempo(std::span<const std::uint32_t> round) {
  // One that was chosen for few bodies may be far too slow for many.
  if (round.empty() || (tables_.tempo.is_chosen() && 2 * round.size() < windows().moving())) return;
  Survey survey;
  for (const std::uint32_t number : round) {
    const MovedBound moved(bodies()[number].bound, time());
    survey.note(moved.centre, pace_of(moved));
  }
  const double way = std::max(0.25 * survey.spacing(), 0x1p8 * definition().contact_tolerance);
  tables_.tempo.choose(way, survey.typical());
}

/// Where many have arrived since windows started, all start anew with them: those that have arrived one by
/// one would cost more.
Result<void> World::Engine::start_with_arrivals(Shift& shift) {
  constexpr std::size_t many = 8;
  std::vector<std::uint32_t> joining = everybody_.arrivals();
  const bool anew = joining.size() > many && many * joining.size() > windows().size();
  if (anew) {
    std::erase_if(joining, [this](std::uint32_t number) {
      return bodies()[number].is_fixed() || bodies()[number].stands_still();
    });
  }
  if (anew || !tables_.tempo.is_chosen()) choose_tempo(joining);
  if (!anew || joining.empty()) return {};
  if (auto probed = everybody_.probe_stale(joining, shift); !probed) return probed.error();
  if (auto started = start_windows(shift, true, joining); !started) return started;
  // For some there was no window.
  for (const std::uint32_t number : joining)
    if (windows().contains(number)) tables_.bodies[number].settled_now();
  return {};
}

/// Probes those for whom a larger capsule would cost more.
Result<void> World::Engine::refresh(std::span<const std::uint32_t> ending, Shift& shift) {
  const Pacing pacing(tables_, time());
  std::vector<std::uint8_t> is_asked(ending.size());
  shift.for_each(ending.size(), bodies_at_once, [&](std::size_t from, std::size_t to, std::size_t) {
    for (std::size_t k = from; k < to; ++k)
      is_asked[k] = !bodies()[ending[k]].dirty && pacing.needs_report(ending[k]) ? 1 : 0;
  });
  std::vector<std::uint32_t> asked;
  for (std::size_t k = 0; k < ending.size(); ++k)
    if (is_asked[k] != 0) asked.push_back(ending[k]);
  if (asked.empty()) return {};
  return everybody_.probe(asked, shift);
}

/// The windows that suit the bodies of a round, which are in none.
std::vector<Windows::Starter> World::Engine::choose_windows(std::span<const std::uint32_t> numbers, bool most,
                                                            Tempo::Round& round, Shift& shift) {
  const double now = time();
  const Pacing pacing(tables_, now);
  std::vector<Windows::Starter> starters(numbers.size());
  const std::size_t parts = (numbers.size() + bodies_at_once - 1) / bodies_at_once;
  std::vector<Tempo::Round> rounds(parts, Tempo::Round(tables_.tempo, most));
  shift.for_each(parts, 1, [&](std::size_t from, std::size_t to, std::size_t) {
    FreeWindows free(windows(), now);
    for (std::size_t part = from; part < to; ++part) {
      const std::size_t end = std::min((part + 1) * bodies_at_once, numbers.size());
      for (std::size_t k = part * bodies_at_once; k < end; ++k) {
        const std::uint32_t number = numbers[k];
        const RoomyBound bound = room_for(bodies(), number, MovedBound(bodies()[number].bound, now));
        const Pace pace = pace_of(bound.moved);
        const Window& window = free.of(pacing.tier_for(number, pace));
        starters[k] = {number, 0, window};
        if (window.end == now) continue;
        if (bodies().space().repeats()) tables_.bodies.bring_home(number, now, window.end - now);
        starters[k].level = Windows::level_of(bound, window);
        rounds[part].note(pace, 2.0 * (bound.moved.radius + bound.room), window.tier);
      }
    }
  });
  for (const Tempo::Round& one : rounds) round += one;
  return starters;
}

/// New windows for those whose windows have ended, or for all, and for some that join them.
Result<void> World::Engine::start_windows(Shift& shift, bool all, std::span<const std::uint32_t> joining) {
  Windows& windows = tables_.windows;
  Tempo& tempo = tables_.tempo;
  const double now = time();
  std::vector<std::uint32_t> numbers = windows.ended(now, all);
  const bool most = 2 * (numbers.size() + joining.size()) > windows.moving();
  if (auto probed = refresh(numbers, shift); !probed) return probed;
  if (most) tempo.start_main(now, everybody_.take_kicks());
  windows.end_windows(now, all);
  // Those with a broken promise, too, are settled by themselves.
  std::erase_if(numbers, [this](std::uint32_t number) { return bodies()[number].dirty; });
  ++everybody_.counters().window_ends;
  everybody_.counters().starts += numbers.size();
  everybody_.counters().restarts += joining.size();
  const auto ended = static_cast<std::ptrdiff_t>(numbers.size());
  numbers.insert(numbers.end(), joining.begin(), joining.end());
  std::inplace_merge(numbers.begin(), numbers.begin() + ended, numbers.end());
  for (const std::uint32_t number : joining)
    if (windows.contains(number)) windows.leave(number);
  Tempo::Round round(tempo, most);
  std::vector<Windows::Starter> starters = choose_windows(numbers, most, round, shift);
  std::erase_if(starters, [&](const Windows::Starter& starter) {
    if (starter.window.end > now) return false;
    // There is no window for the body: it is settled by itself.
    everybody_.mark_dirty(starter.number);
    return true;
  });
  windows.start(
      starters, now, [&](std::uint32_t number) { return roomy_bound(bodies(), number, now); }, shift);
  tempo.finish_start(round, find_pairs_of_started(shift), windows.size());
  find_others_of(starters, shift);
  for (FoundPairs& found : found_) everybody_.take(found);
  everybody_.begin_phase(windows.next_end());
  return {};
}

/// The hot pairs that searches find of those that have started, and how many pairs are near.
std::uint64_t World::Engine::find_pairs_of_started(Shift& shift) {
  const double now = time();
  const Windows& windows = tables_.windows;
  const Facts facts = everybody_.facts();
  found_.resize(shift.count());
  shift.for_each(
      windows.started(), bodies_at_once, [&](std::size_t from, std::size_t to, std::size_t worker) {
        FoundPairs& found = found_[worker];
        const auto bound_of = [&](std::uint32_t number) { return roomy_bound(bodies(), number, now); };
        found.searches += to - from;
        for (const auto& [a, b] : windows.near_started(from, to, now, bound_of, found.scratch))
          facts.find_hot_pair(a, b, found);
      });
  std::uint64_t near = 0;
  for (const FoundPairs& found : found_) near += found.near;
  return near;
}

/// Pairs that touch or sense each other, and walls, of those that have started.
void World::Engine::find_others_of(std::span<const Windows::Starter> starters, Shift& shift) {
  const Facts facts = everybody_.facts();
  for (const Windows::Starter& starter : starters) tables_.bodies[starter.number].settled = true;
  shift.for_each(starters.size(), bodies_at_once, [&](std::size_t from, std::size_t to, std::size_t worker) {
    for (std::size_t k = from; k < to; ++k) {
      facts.find_known_pairs(starters[k].number, found_[worker]);
      facts.find_walls(starters[k].number, found_[worker]);
    }
  });
  for (const Windows::Starter& starter : starters) tables_.bodies[starter.number].settled = false;
}

}  // namespace kinesphere
