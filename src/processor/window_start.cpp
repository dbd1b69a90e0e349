#include "processor/window_start.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

namespace kinesphere {
namespace {

/// Minimum bodies per parallel chunk; below this, dispatch costs more than the work.
constexpr std::size_t bodies_at_once = 256;

/// Caches the last result of Window::free_at(), since most bodies need the same window.
class FreeWindows {
 public:
  FreeWindows(std::span<const int> held, double now) : held_(held), now_(now) {}

  const Window& of(int rung) {
    if (!found_ || rung != asked_) found_ = Window::free_at(now_, rung, held_);
    asked_ = rung;
    return *found_;
  }

 private:
  std::span<const int> held_;
  double now_;
  int asked_ = 0;
  std::optional<Window> found_;
};

}  // namespace

MotionStatistics WindowStart::measure(std::span<const std::uint32_t> numbers) const {
  MotionStatistics statistics;
  for (const std::uint32_t number : numbers) {
    const BoundAt moved(bodies()[number].bound, time_);
    statistics.note(moved.centre, speed_bound_of(moved));
  }
  return statistics;
}

void WindowStart::choose_policy(const MotionStatistics& statistics) {
  const double way = std::max(0.25 * statistics.spacing(), 0x1p8 * bodies().definition().contact_tolerance);
  state_.window_policy.choose(way, statistics.typical());
}

Result<void> WindowStart::refresh(std::span<const std::uint32_t> ending) {
  enum : std::uint8_t { unasked, asked, checked };
  const WindowChoice choice(state_, time_);
  const auto turn = SpotChecks::turn(state_.window_policy, time_);
  const auto is_checked = [&](std::uint32_t number) {
    return turn && (bodies().table().name_of(number) + *turn) % SpotChecks::windows_between == 0 &&
           SpotChecks::may_check(bodies()[number], main_.time());
  };
  std::vector<std::uint8_t> needs(ending.size());
  lease_.parallel_for(ending.size(), bodies_at_once, [&](std::size_t from, std::size_t to, std::size_t) {
    for (std::size_t k = from; k < to; ++k) {
      if (bodies()[ending[k]].dirty) continue;
      if (choice.needs_report(ending[k], main_.time())) {
        needs[k] = asked;
      } else if (is_checked(ending[k])) {
        needs[k] = checked;
      }
    }
  });
  std::vector<std::uint32_t> to_ask;
  std::vector<std::uint32_t> to_check;
  for (std::size_t k = 0; k < ending.size(); ++k)
    if (needs[k] != unasked) (needs[k] == asked ? to_ask : to_check).push_back(ending[k]);
  if (auto done = main_.spot_check(to_check, lease_); !done || to_ask.empty()) return done;
  return main_.probe(to_ask, ProbeCause::window, lease_);
}

std::vector<BroadPhase::Starter> WindowStart::choose_windows(std::span<const std::uint32_t> numbers,
                                                             std::span<const int> held,
                                                             WindowPolicy::Sample& sample) {
  const double now = time_;
  const WindowChoice choice(state_, now);
  std::vector<BroadPhase::Starter> starters(numbers.size());
  const std::size_t chunks = (numbers.size() + bodies_at_once - 1) / bodies_at_once;
  std::vector<WindowPolicy::Sample> samples(chunks, sample);
  lease_.parallel_for(chunks, 1, [&](std::size_t from, std::size_t to, std::size_t) {
    FreeWindows free(held, now);
    for (std::size_t chunk = from; chunk < to; ++chunk) {
      const std::size_t end = std::min((chunk + 1) * bodies_at_once, numbers.size());
      for (std::size_t k = chunk * bodies_at_once; k < end; ++k) {
        const std::uint32_t number = numbers[k];
        const InflatedBound bound = margin_for(bodies(), number, BoundAt(bodies()[number].bound, now));
        const SpeedBound speed_bound = speed_bound_of(bound.moved);
        const Window& window = free.of(choice.rung_for(number, speed_bound));
        starters[k] = {number, 0, window};
        if (window.end == now) continue;
        if (bodies().space().repeats()) bodies().wrap_to_primary(number, now, window.end - now);
        starters[k].size_class = SizeClasses::size_class_of(bound, window);
        samples[chunk].note(speed_bound, 2.0 * (bound.moved.radius + bound.margin), window.rung);
      }
    }
  });
  for (const WindowPolicy::Sample& one : samples) sample += one;
  std::erase_if(starters, [&](const BroadPhase::Starter& starter) {
    if (starter.window.end > now) return false;
    main_.dirty().add(bodies(), starter.number);
    return true;
  });
  return starters;
}

std::uint64_t WindowStart::start(std::span<const BroadPhase::Starter> starters,
                                 const std::vector<std::uint8_t>* others) {
  add_starters(starters);
  windows_.finish_start(lease_);
  const std::uint64_t near = find_pairs(0, windows_.started_slots(), others);
  std::vector<std::uint32_t> numbers;
  numbers.reserve(starters.size());
  for (const BroadPhase::Starter& starter : starters) numbers.push_back(starter.number);
  find_links(numbers);
  find_walls(numbers);
  hand_over();
  return near;
}

void WindowStart::add_starters(std::span<const BroadPhase::Starter> starters) {
  found_.front().searches += starters.size();
  windows_.add_starters(
      starters, time_, [&](std::uint32_t number) { return inflated_bound(bodies(), number, time_); }, lease_);
}

std::uint64_t WindowStart::find_pairs(std::size_t first, std::size_t last,
                                      const std::vector<std::uint8_t>* others) {
  const PairCertifier certifier = this->certifier();
  const auto is_counted = [&](std::uint32_t a, std::uint32_t b) {
    return others == nullptr || (*others)[bodies().table().comes_before(a, b) ? a : b] == 0;
  };
  std::uint64_t before_all = 0;
  for (const SearchResults& found : found_) before_all += found.near;
  std::vector<std::uint64_t> uncounted(lease_.count());
  lease_.parallel_for(
      last - first, bodies_at_once, [&](std::size_t from, std::size_t to, std::size_t worker) {
        SearchResults& found = found_[worker];
        const auto bound_of = [&](std::uint32_t number) { return inflated_bound(bodies(), number, time_); };
        for (const auto& [a, b] :
             found.search.near_started(windows_, first + from, first + to, time_, bound_of)) {
          const std::uint64_t before = found.near;
          certifier.certify(a, b, found);
          if (found.near != before && !is_counted(a, b)) ++uncounted[worker];
        }
      });
  std::uint64_t near = 0;
  for (const SearchResults& found : found_) near += found.near;
  for (const std::uint64_t some : uncounted) near -= some;
  return near - before_all;
}

void WindowStart::find_links(std::span<const std::uint32_t> numbers) {
  const PairCertifier certifier = this->certifier();
  const auto is_linked = [this](std::uint32_t number) {
    return !state_.contacts.partners_of(number).empty() || !state_.contacts.overlaps_of(number).empty();
  };
  // Only linked bodies are marked and certified, so that the records of most bodies are not accessed.
  std::vector<std::uint32_t> linked;
  std::copy_if(numbers.begin(), numbers.end(), std::back_inserter(linked), is_linked);
  for (const std::uint32_t number : linked) bodies()[number].visited = true;
  lease_.parallel_for(linked.size(), bodies_at_once,
                      [&](std::size_t from, std::size_t to, std::size_t worker) {
                        for (std::size_t k = from; k < to; ++k)
                          certifier.certify_linked(linked[k], found_[worker]);
                      });
  for (const std::uint32_t number : linked) bodies()[number].visited = false;
}

void WindowStart::find_walls(std::span<const std::uint32_t> numbers) {
  if (!bodies().walls()) return;
  const PairCertifier certifier = this->certifier();
  lease_.parallel_for(numbers.size(), bodies_at_once,
                      [&](std::size_t from, std::size_t to, std::size_t worker) {
                        for (std::size_t k = from; k < to; ++k)
                          certifier.certify_walls(numbers[k], found_[worker]);
                      });
}

void WindowStart::hand_over() {
  for (SearchResults& found : found_) found.hand_over(main_.queue(), main_.work().counters);
}

}  // namespace kinesphere
