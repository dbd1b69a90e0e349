#include "distributed/window_starts.hpp"

#include <algorithm>
#include <utility>

#include "archive/archive.hpp"
#include "distributed/guarded.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

Arrivals WindowStarts::count_arrivals() {
  std::vector<std::uint32_t> arrived = local_.everybody.unsettled().arrivals(local_.bodies());
  std::uint64_t sums[] = {arrived.size(), local_.own_registered(), local_.own_moving()};
  communicator_.sum(sums);
  return {std::move(arrived), sums[0], sums[1], sums[2]};
}

Result<void> WindowStarts::start_with(const Arrivals& arrivals, Shift& shift) {
  std::vector<std::uint32_t> joining = arrivals.here;
  const bool anew = are_many(arrivals.everywhere, arrivals.registered);
  if (anew)
    std::erase_if(joining, [this](std::uint32_t number) { return local_.bodies()[number].stands_still(); });
  const std::uint64_t all_joining = communicator_.sum(joining.size());
  const bool was_for_few = anew && 2 * all_joining >= arrivals.moving;
  if (all_joining > 0 && (was_for_few || !local_.tables.tempo.is_chosen())) choose_tempo(joining, shift);
  if (!anew || all_joining == 0) return {};
  const auto probed = guarded([&]() -> Result<void> {
    auto stale = local_.everybody.probe_stale(joining, shift);
    return stale ? Result<void>() : stale.error();
  });
  if (auto agreed = agreement_.agree(probed); !agreed) return agreed;
  return start(shift, true, joining);
}

void WindowStarts::choose_tempo(std::span<const std::uint32_t> joining, Shift& shift) {
  Starting starting(local_.tables, local_.everybody, shift, found_);
  Survey survey = starting.survey(joining);
  survey.reduce([this](std::span<std::uint64_t> numbers) { communicator_.sum(numbers); },
                [this](std::span<double> numbers) { communicator_.least(numbers); });
  starting.choose_tempo(survey);
}

void WindowStarts::begin_phase_of_arrivals() {
  const Windows& windows = local_.tables.windows;
  double end = local_.everybody.phase_end();
  for (std::uint32_t number = 0; number < local_.bodies().numbers(); ++number)
    if (windows.contains(number) && local_.roster.is_own(number) && windows.end_of(number) > local_.time())
      end = std::min(end, windows.end_of(number));
  local_.everybody.begin_phase(communicator_.least(end));
}

/// Its length depends on how many bodies of all ranks have been kicked since the last one started.
void WindowStarts::start_main_window() {
  const Kicks here = std::exchange(local_.everybody.work().settled, {});
  std::uint64_t kicks[] = {here.bodies, here.near};
  communicator_.sum(kicks);
  local_.tables.tempo.start_main(local_.time(), {kicks[0], kicks[1]});
}

/// What each rank has in its list, once, in ascending order.
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

Result<void> WindowStarts::start(Shift& shift, bool all, std::span<const std::uint32_t> joining) {
  Windows& windows = local_.tables.windows;
  Tempo& tempo = local_.tables.tempo;
  Island& everybody = local_.everybody;
  const double now = local_.time();
  Starting starting(local_.tables, everybody, shift, found_);
  std::vector<std::uint32_t> numbers = windows.ended(now, all);
  std::uint64_t sums[] = {0, joining.size(), local_.own_moving()};
  distribution_.drop_copies(numbers);
  sums[0] = numbers.size();
  communicator_.sum(sums);
  const bool most = 2 * (sums[0] + sums[1]) > sums[2];
  if (auto probed = agreement_.agree(guarded([&] { return starting.refresh(numbers); })); !probed)
    return probed;
  if (most) start_main_window();
  windows.end_windows(now, all);
  std::erase_if(numbers, [this](std::uint32_t number) { return local_.bodies()[number].dirty; });
  if (communicator_.rank() == 0) ++everybody.work().counters.window_ends;
  everybody.work().counters.starts += numbers.size();
  everybody.work().counters.restarts += joining.size();
  for (const std::uint32_t number : joining) {
    if (windows.contains(number)) windows.leave(number);
    numbers.push_back(number);
  }
  Tempo::Round round(tempo, most);
  std::vector<Windows::Starter> starters =
      starting.choose_windows(numbers, union_of(windows.held_tiers()), round);
  round.reduce([this](std::span<std::uint64_t> sum) { communicator_.sum(sum); });
  for (const Windows::Starter& starter : starters) {
    local_.bodies()[starter.number].settled_now();
    local_.roster[starter.number].cost += 1.0f;
  }
  if (most) distribution_.divide_space(starters);
  if (auto moved = distribution_.migrate(starters); !moved) return moved;
  if (auto known = distribution_.spread(starters, most); !known) return known;
  std::uint64_t found[] = {starting.start(starters, &local_.roster.are_copies()), 0};
  found[1] = local_.own_registered();
  communicator_.sum(found);
  tempo.finish_start(round, found[0], found[1]);
  everybody.begin_phase(communicator_.least(windows.next_end()));
  return {};
}

}  // namespace kinesphere
