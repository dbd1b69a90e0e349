// Windows end on all ranks, and new ones start: bodies go to the ranks in whose space they are, and copies of
// them to all that have to know of them.
#include <algorithm>
#include <cmath>
#include <string>

#include "archive/archive.hpp"
#include "distributed/domain.hpp"
#include "distributed/guarded.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// Known space reaches so many times the mean width of capsules beyond what is a rank's.
constexpr double margin_in_widths = 2.0;
/// Space is divided anew where a rank has so many times the work that it should have.
constexpr double most_imbalance = 1.2;

std::vector<std::vector<std::byte>> taken(std::vector<ByteWriter>& writers) {
  std::vector<std::vector<std::byte>> bytes(writers.size());
  std::transform(writers.begin(), writers.end(), bytes.begin(),
                 [](ByteWriter& writer) { return writer.take(); });
  return bytes;
}

Box grown(Box box, double by) {
  const Vec3 room{by, by, by};
  return {box.lower - room, box.upper + room};
}

double width_of(const Box& box) {
  const Vec3 size = box.upper - box.lower;
  return std::max({size.x, size.y, size.z});
}

}  // namespace

/// No two bodies have the same name: the names that have been added since are sent to where names like them
/// are compared.
Result<void> DistributedWorld::Domain::check_names() {
  std::vector<ByteWriter> writers(ranks());
  for (const std::uint32_t name : new_names_) writers[name % ranks()](name);
  new_names_.clear();
  std::vector<std::pair<std::uint32_t, std::size_t>> names;
  const std::vector<Bytes> incoming = communicator_.exchange(taken(writers));
  for (std::size_t from = 0; from < incoming.size(); ++from) {
    ByteReader reader(incoming[from]);
    while (reader.remaining() > 0) {
      std::uint32_t name = 0;
      reader(name);
      if (!compared_names_.insert(name).second) names.emplace_back(name, from);
    }
  }
  if (names.empty()) return agree({});
  const auto [name, from] = *std::min_element(names.begin(), names.end());
  return agree(Error{ErrorCode::out_of_range,
                     "index",
                     {name, 0, 0},
                     "add: index must be that of no other body, but rank " + std::to_string(from) +
                         " has added a body " + std::to_string(name) + " that is there already"});
}

std::size_t DistributedWorld::Domain::registered_copies() const {
  return static_cast<std::size_t>(std::count_if(copies_.begin(), copies_.end(), [this](std::uint32_t number) {
    return tables_.windows.contains(number);
  }));
}

std::size_t DistributedWorld::Domain::moving_copies() const {
  return static_cast<std::size_t>(std::count_if(copies_.begin(), copies_.end(), [this](std::uint32_t number) {
    return tables_.windows.contains(number) && tables_.windows.end_of(number) < infinity;
  }));
}

/// As World::Engine::start_with_arrivals() and what follows it.
Result<void> DistributedWorld::Domain::settle_arrivals(Shift& shift) {
  std::vector<std::uint32_t> arrived = everybody_.unsettled().arrivals(bodies());
  const Windows& windows = tables_.windows;
  std::uint64_t sums[] = {arrived.size(), windows.size() - registered_copies(),
                          windows.moving() - moving_copies()};
  communicator_.sum(sums);
  if (sums[0] == 0) return {};
  if (auto valid = check_names(); !valid) return valid;
  std::vector<std::uint32_t> joining = arrived;
  const bool anew = are_many(sums[0], sums[1]);
  if (anew) std::erase_if(joining, [this](std::uint32_t number) { return bodies()[number].stands_still(); });
  const std::uint64_t all_joining = communicator_.sum(joining.size());
  const bool was_for_few = anew && 2 * all_joining >= sums[2];
  if (all_joining > 0 && (was_for_few || !tables_.tempo.is_chosen())) {
    Starting starting(tables_, everybody_, shift, found_);
    Survey survey = starting.survey(joining);
    survey.reduce([this](std::span<std::uint64_t> numbers) { communicator_.sum(numbers); },
                  [this](std::span<double> numbers) { communicator_.least(numbers); });
    starting.choose_tempo(survey);
  }
  if (anew && all_joining > 0) {
    const auto probed = guarded([&]() -> Result<void> {
      auto stale = everybody_.probe_stale(joining, shift);
      return stale ? Result<void>() : stale.error();
    });
    if (auto agreed = agree(probed); !agreed) return agreed;
    if (auto started = start_windows(shift, true, joining); !started) return started;
  }
  // Those that stand still, and few that have come, get capsules one by one, without time moving on.
  if (auto settled = run_part(time(), time()); !settled) return settled.error();
  double end = everybody_.phase_end();
  for (std::uint32_t number = 0; number < bodies().numbers(); ++number)
    if (windows.contains(number) && is_own(number) && windows.end_of(number) > time())
      end = std::min(end, windows.end_of(number));
  everybody_.begin_phase(communicator_.least(end));
  return {};
}

std::vector<int> DistributedWorld::Domain::union_of(const std::vector<int>& held) {
  ByteWriter writer;
  writer(held);
  std::vector<int> all;
  for (const Bytes& bytes : communicator_.gather(writer.bytes())) {
    std::vector<int> some;
    ByteReader reader(bytes);
    reader(some);
    all.insert(all.end(), some.begin(), some.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// As World::Engine::start_windows(). Copies whose windows end are dropped, and come anew.
Result<void> DistributedWorld::Domain::start_windows(Shift& shift, bool all,
                                                     std::span<const std::uint32_t> joining) {
  Windows& windows = tables_.windows;
  Tempo& tempo = tables_.tempo;
  const double now = time();
  Starting starting(tables_, everybody_, shift, found_);
  std::vector<std::uint32_t> numbers = windows.ended(now, all);
  std::uint64_t sums[] = {0, joining.size(), windows.moving() - moving_copies()};
  for (const std::uint32_t number : numbers) {
    if (is_own(number)) {
      entries_[number].holders.clear();
    } else {
      drop(number);
    }
  }
  std::erase_if(numbers, [&](std::uint32_t number) { return !windows.contains(number); });
  std::erase_if(copies_, [this](std::uint32_t number) { return is_own(number); });
  sums[0] = numbers.size();
  communicator_.sum(sums);
  const bool most = 2 * (sums[0] + sums[1]) > sums[2];
  if (auto probed = agree(guarded([&] { return starting.refresh(numbers); })); !probed) return probed;
  if (most) {
    const Kicks here = std::exchange(everybody_.work().settled, {});
    std::uint64_t kicks[] = {here.bodies, here.near};
    communicator_.sum(kicks);
    tempo.start_main(now, {kicks[0], kicks[1]});
  }
  windows.end_windows(now, all);
  std::erase_if(numbers, [this](std::uint32_t number) { return bodies()[number].dirty; });
  if (rank() == 0) ++everybody_.work().counters.window_ends;
  everybody_.work().counters.starts += numbers.size();
  everybody_.work().counters.restarts += joining.size();
  for (const std::uint32_t number : joining) {
    if (windows.contains(number)) windows.leave(number);
    numbers.push_back(number);
  }
  Tempo::Round round(tempo, most);
  std::vector<Windows::Starter> starters =
      starting.choose_windows(numbers, union_of(windows.held_tiers()), round);
  round.reduce([this](std::span<std::uint64_t> sum) { communicator_.sum(sum); });
  for (const Windows::Starter& starter : starters) {
    bodies()[starter.number].settled_now();
    entries_[starter.number].cost += 1.0f;
  }
  if (most) divide_space(starters);
  if (auto moved = migrate(starters); !moved) return moved;
  if (auto known = spread(starters, most); !known) return known;
  std::uint64_t found[] = {starting.start(starters, &is_copy_), 0};
  found[1] = windows.size() - registered_copies();
  communicator_.sum(found);
  tempo.finish_start(round, found[0], found[1]);
  everybody_.begin_phase(communicator_.least(windows.next_end()));
  return {};
}

/// By the work that bodies have made since the last time, if that was not shared well.
void DistributedWorld::Domain::divide_space(std::span<const Windows::Starter> starters) {
  if (ranks() == 1) return;
  double work = 0.0;
  for (const Windows::Starter& starter : starters) work += static_cast<double>(entries_[starter.number].cost);
  double most_of_all = -communicator_.least(-work);
  double sum[] = {work};
  communicator_.sum(sum);
  const double mean = sum[0] / static_cast<double>(ranks());
  if (partitions_ > 0 && most_of_all <= most_imbalance * mean) return;
  std::vector<Vec3> positions;
  std::vector<double> costs;
  for (const Windows::Starter& starter : starters) {
    positions.push_back(bodies().space().wrapped(bodies()[starter.number].bound.centre_at(time())).position);
    costs.push_back(static_cast<double>(entries_[starter.number].cost));
  }
  partition_ = Partition::choose(communicator_, positions, costs);
  ++partitions_;
  for (const Windows::Starter& starter : starters) entries_[starter.number].cost = 0.0f;
}

/// The body with the window that starts for it now.
Parcel DistributedWorld::Domain::pack_to_start(const Windows::Starter& starter) const {
  Parcel parcel = pack(starter.number);
  parcel.starts = true;
  parcel.tier = starter.window.tier;
  parcel.end = starter.window.end;
  return parcel;
}

/// Bodies go to the ranks in whose space they are.
Result<void> DistributedWorld::Domain::migrate(std::vector<Windows::Starter>& starters) {
  if (ranks() == 1) return {};
  std::vector<ByteWriter> writers(ranks());
  std::erase_if(starters, [&](const Windows::Starter& starter) {
    const std::uint32_t number = starter.number;
    const Vec3 centre = bodies().space().wrapped(bodies()[number].bound.centre_at(time())).position;
    const int owner = partition_.owner_of(centre);
    if (owner == rank()) return false;
    Parcel parcel = pack_to_start(starter);
    parcel.owner = owner;
    writers[static_cast<std::size_t>(owner)](parcel);
    drop(number);
    return true;
  });
  return receive(writers, starters);
}

/// Sends these, and takes in what comes from others. Bodies that start with all others are added to
/// `starters`.
Result<void> DistributedWorld::Domain::receive(std::vector<ByteWriter>& writers,
                                               std::vector<Windows::Starter>& starters) {
  std::vector<Parcel> parcels;
  for (const Bytes& bytes : communicator_.exchange(taken(writers))) {
    ByteReader reader(bytes);
    while (reader.remaining() > 0 && !reader.failed()) reader(parcels.emplace_back());
  }
  auto beginning = install(parcels);
  if (!beginning) return beginning.error();
  everybody_.agenda().add_all(beginning->due);
  for (const Parcel& parcel : parcels) {
    if (!parcel.starts) continue;
    const std::uint32_t number = *find(parcel.name);
    const RoomyBound bound = roomy_bound(bodies(), number, time());
    starters.push_back({number, SizeLevels::level_of(bound, parcel.window()), parcel.window()});
  }
  return {};
}

/// Ranks tell each other what space they know, and copies of bodies go where they may be met.
Result<void> DistributedWorld::Domain::spread(std::vector<Windows::Starter>& starters, bool anew) {
  if (ranks() == 1) return {};
  const Space& space = bodies().space();
  const auto here = static_cast<std::size_t>(rank());
  std::vector<Box> ways;
  for (const Windows::Starter& starter : starters) {
    const RoomyBound bound =
        room_for(bodies(), starter.number, MovedBound(bodies()[starter.number].bound, time()));
    ways.push_back(space.within(bound.box_of_way(starter.window.end - time())));
  }
  std::vector<std::uint32_t> others;  // own bodies whose windows go on
  if (anew) {
    for (std::uint32_t number = 0; number < bodies().numbers(); ++number)
      if (tables_.windows.contains(number) && is_own(number)) others.push_back(number);
    double widths[] = {0.0, static_cast<double>(ways.size() + others.size())};
    for (const Box& way : ways) widths[0] += width_of(way);
    for (const std::uint32_t number : others) widths[0] += width_of(box_of(number));
    communicator_.sum(widths);
    Box core = partition_.region_of(rank());
    for (int axis = 0; axis < 3; ++axis) {
      if (!space.repeats(axis) || core.upper[axis] < core.lower[axis]) continue;
      core.lower[axis] = std::max(core.lower[axis], bodies().definition().box->lower[axis]);
      core.upper[axis] = std::min(core.upper[axis], bodies().definition().box->upper[axis]);
    }
    if (widths[1] > 0.0) core = grown(core, margin_in_widths * widths[0] / widths[1]);
    known_[here].begin(core);
  }
  const std::size_t before = anew ? 0 : known_[here].boxes().size();
  const auto cover = [&](const Box& way) {
    if (!covers(way)) known_[here].add(way);
  };
  for (const std::uint32_t number : others) cover(box_of(number));
  for (const Box& way : ways) cover(way);
  ByteWriter known;
  known(std::vector<Box>(known_[here].boxes().begin() + static_cast<std::ptrdiff_t>(before),
                         known_[here].boxes().end()));
  const std::vector<Bytes> all = communicator_.gather(known.bytes());
  std::vector<ByteWriter> writers(ranks());
  for (std::size_t to = 0; to < ranks(); ++to) {
    if (to == here) continue;
    std::vector<Box> boxes;
    ByteReader reader(all[to]);
    reader(boxes);
    if (anew) known_[to] = {};
    for (const Box& box : boxes) known_[to].add(box);
    if (!anew) others = own_bodies_in(boxes);
    std::vector<std::uint32_t> sent;
    std::vector<Parcel> parcels;
    for (const std::uint32_t number : others) {
      if (is_held(number, static_cast<int>(to)) || !known_[to].meets(box_of(number), space)) continue;
      sent.push_back(number);
      parcels.push_back(pack(number));
      parcels.back().enters = true;
      entries_[number].holders.push_back(static_cast<int>(to));
    }
    add_due(parcels, sent);
    for (const Parcel& parcel : parcels) writers[to](parcel);
  }
  for (std::size_t k = 0; k < starters.size(); ++k) {
    std::optional<Parcel> parcel;
    const std::uint32_t number = starters[k].number;
    for (std::size_t to = 0; to < ranks(); ++to) {
      if (to == here || !known_[to].meets(ways[k], space)) continue;
      if (!parcel) parcel = pack_to_start(starters[k]);
      writers[to](*parcel);
      entries_[number].holders.push_back(static_cast<int>(to));
    }
  }
  return receive(writers, starters);
}

bool DistributedWorld::Domain::is_held(std::uint32_t number, int by) const {
  const std::vector<int>& holders = entries_[number].holders;
  return std::find(holders.begin(), holders.end(), by) != holders.end();
}

/// Those that are registered and may come into one of the boxes before their windows end.
std::vector<std::uint32_t> DistributedWorld::Domain::own_bodies_in(std::span<const Box> boxes) const {
  std::vector<std::uint32_t> found;
  NeighbourSearch search;
  for (const Box& box : boxes) {
    Bound ball{.time = time(), .position = 0.5 * (box.lower + box.upper)};
    ball.radius = 0.5 * norm(box.upper - box.lower);
    const RoomyBound bound{MovedBound(ball, time()), 0.0};
    for (const std::uint32_t number : search.near(tables_.windows, no_body.index, bound, time(), infinity))
      if (is_own(number) && meet(box, box_of(number), bodies().space())) found.push_back(number);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace kinesphere
