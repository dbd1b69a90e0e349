#include "engine/starting.hpp"

#include <algorithm>
#include <optional>

namespace kinesphere {
namespace {

/// So many are worth the while of a thread.
constexpr std::size_t bodies_at_once = 256;

/// Window::free_at(), of which most bodies ask for the same one.
class FreeWindows {
 public:
  FreeWindows(std::span<const int> held, double now) : held_(held), now_(now) {}

  const Window& of(int tier) {
    if (!found_ || tier != asked_) found_ = Window::free_at(now_, tier, held_);
    asked_ = tier;
    return *found_;
  }

 private:
  std::span<const int> held_;
  double now_;
  int asked_ = 0;
  std::optional<Window> found_;
};

}  // namespace

Survey Starting::survey(std::span<const std::uint32_t> numbers) const {
  Survey survey;
  for (const std::uint32_t number : numbers) {
    const MovedBound moved(bodies()[number].bound, time());
    survey.note(moved.centre, pace_of(moved));
  }
  return survey;
}

void Starting::choose_tempo(const Survey& survey) {
  const double way = std::max(0.25 * survey.spacing(), 0x1p8 * bodies().definition().contact_tolerance);
  tables_.tempo.choose(way, survey.typical());
}

Result<void> Starting::refresh(std::span<const std::uint32_t> ending) {
  const Pacing pacing(tables_, time());
  std::vector<std::uint8_t> is_asked(ending.size());
  shift_.for_each(ending.size(), bodies_at_once, [&](std::size_t from, std::size_t to, std::size_t) {
    for (std::size_t k = from; k < to; ++k)
      is_asked[k] = !bodies()[ending[k]].dirty && pacing.needs_report(ending[k]) ? 1 : 0;
  });
  std::vector<std::uint32_t> asked;
  for (std::size_t k = 0; k < ending.size(); ++k)
    if (is_asked[k] != 0) asked.push_back(ending[k]);
  if (asked.empty()) return {};
  return everybody_.probe(asked, shift_);
}

std::vector<Windows::Starter> Starting::choose_windows(std::span<const std::uint32_t> numbers,
                                                       std::span<const int> held, Tempo::Round& round) {
  const double now = time();
  const Pacing pacing(tables_, now);
  std::vector<Windows::Starter> starters(numbers.size());
  const std::size_t parts = (numbers.size() + bodies_at_once - 1) / bodies_at_once;
  std::vector<Tempo::Round> rounds(parts, round);
  shift_.for_each(parts, 1, [&](std::size_t from, std::size_t to, std::size_t) {
    FreeWindows free(held, now);
    for (std::size_t part = from; part < to; ++part) {
      const std::size_t end = std::min((part + 1) * bodies_at_once, numbers.size());
      for (std::size_t k = part * bodies_at_once; k < end; ++k) {
        const std::uint32_t number = numbers[k];
        const RoomyBound bound = room_for(bodies(), number, MovedBound(bodies()[number].bound, now));
        const Pace pace = pace_of(bound.moved);
        const Window& window = free.of(pacing.tier_for(number, pace));
        starters[k] = {number, 0, window};
        if (window.end == now) continue;
        if (bodies().space().repeats()) bodies().bring_home(number, now, window.end - now);
        starters[k].level = SizeLevels::level_of(bound, window);
        rounds[part].note(pace, 2.0 * (bound.moved.radius + bound.room), window.tier);
      }
    }
  });
  for (const Tempo::Round& one : rounds) round += one;
  std::erase_if(starters, [&](const Windows::Starter& starter) {
    if (starter.window.end > now) return false;
    everybody_.unsettled().add(bodies(), starter.number);
    return true;
  });
  return starters;
}

std::uint64_t Starting::start(std::span<const Windows::Starter> starters,
                              const std::vector<std::uint8_t>* others) {
  tables_.windows.start(
      starters, time(), [&](std::uint32_t number) { return roomy_bound(bodies(), number, time()); }, shift_);
  found_.resize(shift_.count());
  const std::uint64_t near = find_pairs(others);
  find_links_and_walls(starters);
  for (FoundPairs& found : found_) found.hand_over(everybody_.agenda(), everybody_.work().counters);
  return near;
}

/// The hot pairs that searches find of those that have started.
std::uint64_t Starting::find_pairs(const std::vector<std::uint8_t>* others) {
  const double now = time();
  const Windows& windows = tables_.windows;
  const Facts facts = everybody_.facts();
  const auto is_counted = [&](std::uint32_t a, std::uint32_t b) {
    return others == nullptr || (*others)[bodies().table().comes_before(a, b) ? a : b] == 0;
  };
  std::vector<std::uint64_t> uncounted(shift_.count());
  shift_.for_each(
      windows.started(), bodies_at_once, [&](std::size_t from, std::size_t to, std::size_t worker) {
        FoundPairs& found = found_[worker];
        const auto bound_of = [&](std::uint32_t number) { return roomy_bound(bodies(), number, now); };
        found.searches += to - from;
        for (const auto& [a, b] : found.search.near_started(windows, from, to, now, bound_of)) {
          const std::uint64_t before = found.near;
          facts.find_hot_pair(a, b, found);
          if (found.near != before && !is_counted(a, b)) ++uncounted[worker];
        }
      });
  std::uint64_t near = 0;
  for (const FoundPairs& found : found_) near += found.near;
  for (const std::uint64_t some : uncounted) near -= some;
  return near;
}

/// Pairs that touch or sense each other, and walls, of those that have started.
void Starting::find_links_and_walls(std::span<const Windows::Starter> starters) {
  const Facts facts = everybody_.facts();
  const auto is_linked = [this](std::uint32_t number) {
    return !tables_.book.partners_of(number).empty() || !tables_.book.crossings_of(number).empty();
  };
  // Of most bodies nothing is read then.
  const auto mark = [&](bool settled) {
    shift_.for_each(starters.size(), bodies_at_once, [&](std::size_t from, std::size_t to, std::size_t) {
      for (const Windows::Starter& starter : starters.subspan(from, to - from))
        if (is_linked(starter.number)) bodies()[starter.number].settled = settled;
    });
  };
  mark(true);
  shift_.for_each(starters.size(), bodies_at_once, [&](std::size_t from, std::size_t to, std::size_t worker) {
    for (std::size_t k = from; k < to; ++k) {
      facts.find_known_pairs(starters[k].number, found_[worker]);
      facts.find_walls(starters[k].number, found_[worker]);
    }
  });
  mark(false);
}

}  // namespace kinesphere
