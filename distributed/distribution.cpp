#include "distributed/distribution.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "archive/archive.hpp"
#include "distributed/guarded.hpp"

namespace kinesphere {
namespace {

/// Margin of the halo region around a rank's region of space, in mean widths of swept-sphere boxes. A larger
/// margin means more ghosts; a smaller one means more requests for boxes within batches.
constexpr double margin_in_widths = 2.0;
/// Limit of the imbalance, greatest work of a rank over mean work, beyond which space is repartitioned.
constexpr double most_imbalance = 1.2;

Box grown(Box box, double by) {
  const Vec3 margin{by, by, by};
  return {box.lower - margin, box.upper + margin};
}

double width_of(const Box& box) {
  const Vec3 size = box.upper - box.lower;
  return std::max({size.x, size.y, size.z});
}

}  // namespace

Distribution::Distribution(Communicator& communicator, ErrorConsensus& consensus, RankState& rank_state,
                           Migration& migration, HaloRegions& known)
    : communicator_(communicator),
      consensus_(consensus),
      rank_(rank_state),
      migration_(migration),
      known_(known),
      partition_(communicator.ranks()) {
  for (int rank = 0; rank < communicator.ranks(); ++rank)
    known_[rank].assign(std::span(&partition_.region_of(rank), 1));
}

void Distribution::drop_ghosts(std::vector<std::uint32_t>& ending) {
  std::erase_if(ending, [this](std::uint32_t number) {
    const bool is_copy = !rank_.directory.is_own(number);
    if (is_copy) {
      migration_.drop(number);
    } else {
      rank_.directory[number].holders.clear();
    }
    return is_copy;
  });
}

void Distribution::divide_space(std::span<const BroadPhase::Starter> starters) {
  if (communicator_.ranks() == 1) return;
  double work = 0.0;
  for (const BroadPhase::Starter& starter : starters)
    work += static_cast<double>(rank_.directory[starter.number].cost);
  const double most_of_all = -communicator_.least(-work);
  double sum[] = {work};
  communicator_.sum(sum);
  const double mean = sum[0] / communicator_.ranks();
  if (partitions_ > 0 && most_of_all <= most_imbalance * mean) return;
  std::vector<Vec3> positions;
  std::vector<double> costs;
  for (const BroadPhase::Starter& starter : starters) {
    positions.push_back(rank_.centre_of(rank_.bodies()[starter.number]));
    costs.push_back(static_cast<double>(std::exchange(rank_.directory[starter.number].cost, 0.0f)));
  }
  partition_ = Partition::choose(communicator_, positions, costs);
  ++partitions_;
}

/// Packs the body with the window that starts for it now.
BodyMessage Distribution::pack_to_start(const BroadPhase::Starter& starter) const {
  BodyMessage message = migration_.pack(starter.number);
  message.starts = true;
  message.rung = starter.window.rung;
  message.end = starter.window.end;
  return message;
}

Result<void> Distribution::migrate(std::vector<BroadPhase::Starter>& starters) {
  if (communicator_.ranks() == 1) return {};
  SendBuffers buffers(communicator_.ranks());
  consensus_.note(guarded([&] {
    std::erase_if(starters, [&](const BroadPhase::Starter& starter) {
      const int owner = partition_.owner_of(rank_.centre_of(rank_.bodies()[starter.number]));
      if (owner == communicator_.rank()) return false;
      BodyMessage message = pack_to_start(starter);
      message.owner = owner;
      buffers.add(owner, message);
      migration_.drop(starter.number);
      return true;
    });
  }));
  return exchange(buffers, starters);
}

/// Sends the outbox and installs arriving bodies. Appends those that take part in the bulk start to
/// `starters`.
Result<void> Distribution::exchange(SendBuffers& buffers, std::vector<BroadPhase::Starter>& starters) {
  const auto messages = migration_.exchange(communicator_, consensus_, buffers);
  if (!messages) return messages.error();
  for (const BodyMessage& message : *messages) {
    if (!message.starts) continue;
    const std::uint32_t number = *rank_.directory.find(message.name);
    const InflatedBound bound = inflated_bound(rank_.bodies(), number, rank_.time());
    starters.push_back({number, SizeClasses::size_class_of(bound, message.window()), message.window()});
  }
  return {};
}

Result<void> Distribution::update_ghosts(std::vector<BroadPhase::Starter>& starters, bool anew) {
  if (communicator_.ranks() == 1) return {};
  const int here = communicator_.rank();
  std::vector<Box> ways;
  ways.reserve(starters.size());
  for (const BroadPhase::Starter& starter : starters) ways.push_back(way_of(starter));
  std::vector<std::uint32_t> others;  // own bodies whose windows continue
  if (anew) {
    for (std::uint32_t number = 0; number < rank_.bodies().numbers(); ++number)
      if (rank_.state.broad_phase.contains(number) && rank_.directory.is_own(number))
        others.push_back(number);
    known_[here].assign({});
  }
  const std::size_t announced = known_.here().boxes().size();
  if (anew) known_[here].add(core_of(ways, others));
  for (const std::uint32_t number : others) known_.cover(rank_.box_of(number));
  for (const Box& way : ways) known_.cover(way);
  const std::vector<std::vector<Box>> added =
      gather_boxes(std::span(known_.here().boxes()).subspan(announced));
  SendBuffers buffers(communicator_.ranks());
  consensus_.note(guarded([&] {
    for (int to = 0; to < communicator_.ranks(); ++to) {
      if (to == here) continue;
      const std::vector<Box>& boxes = added[static_cast<std::size_t>(to)];
      if (anew) known_[to].assign({});
      for (const Box& box : boxes) known_[to].add(box);
      send_ghosts(to, anew ? others : rank_.own_bodies_in(boxes), buffers);
    }
    send_starters(starters, ways, buffers);
  }));
  return exchange(buffers, starters);
}

/// Returns the box around the body's swept sphere until its window ends.
Box Distribution::way_of(const BroadPhase::Starter& starter) const {
  const Bodies& bodies = rank_.bodies();
  const double now = rank_.time();
  const InflatedBound bound = margin_for(bodies, starter.number, BoundAt(bodies[starter.number].bound, now));
  return bodies.space().within(bound.box_of_way(starter.window.end - now));
}

/// Returns this rank's region of space, grown by the halo margin.
Box Distribution::core_of(std::span<const Box> ways, std::span<const std::uint32_t> others) {
  double widths[] = {0.0, static_cast<double>(ways.size() + others.size())};
  for (const Box& way : ways) widths[0] += width_of(way);
  for (const std::uint32_t number : others) widths[0] += width_of(rank_.box_of(number));
  communicator_.sum(widths);
  Box core = partition_.region_of(communicator_.rank());
  const Bodies& bodies = rank_.bodies();
  for (int axis = 0; axis < 3; ++axis) {
    if (!bodies.space().repeats(axis) || core.upper[axis] < core.lower[axis]) continue;
    core.lower[axis] = std::max(core.lower[axis], bodies.definition().box->lower[axis]);
    core.upper[axis] = std::min(core.upper[axis], bodies.definition().box->upper[axis]);
  }
  return widths[1] > 0.0 ? grown(core, margin_in_widths * widths[0] / widths[1]) : core;
}

/// Returns the boxes of all ranks, indexed by rank.
std::vector<std::vector<Box>> Distribution::gather_boxes(std::span<const Box> boxes) {
  ByteWriter writer;
  writer(std::vector<Box>(boxes.begin(), boxes.end()));
  std::vector<std::vector<Box>> all;
  for (const Communicator::Bytes& bytes : communicator_.gather(writer.bytes())) {
    ByteReader reader(bytes);
    reader(all.emplace_back());
  }
  return all;
}

/// Sends ghosts of those registered bodies that meet the halo region of rank `to` and that it does not hold
/// yet.
void Distribution::send_ghosts(int to, std::span<const std::uint32_t> numbers, SendBuffers& buffers) {
  std::vector<std::uint32_t> sent;
  std::vector<BodyMessage> messages;
  for (const std::uint32_t number : numbers) {
    if (rank_.directory.is_held(number, to) ||
        !known_[to].meets(rank_.box_of(number), rank_.bodies().space()))
      continue;
    rank_.directory.add_holder(number, to);
    sent.push_back(number);
    messages.push_back(migration_.pack(number));
    messages.back().enters = true;
  }
  migration_.add_due(messages, sent, nullptr);
  for (const BodyMessage& message : messages) buffers.add(to, message);
}

/// Sends ghosts of the starters to all ranks whose halo region their swept box meets; ways[k] is the box of
/// starters[k].
void Distribution::send_starters(std::span<const BroadPhase::Starter> starters, std::span<const Box> ways,
                                 SendBuffers& buffers) {
  for (std::size_t k = 0; k < starters.size(); ++k) {
    std::optional<BodyMessage> message;
    for (const int to : known_.ranks_that_meet(ways[k])) {
      if (!message) message = pack_to_start(starters[k]);
      buffers.add(to, *message);
      rank_.directory.add_holder(starters[k].number, to);
    }
  }
}

Result<void> Distribution::distribute(std::vector<BodyMessage> messages) {
  std::vector<Vec3> positions;
  positions.reserve(messages.size());
  for (const BodyMessage& message : messages) positions.push_back(rank_.centre_of(message.body));
  partition_ = Partition::choose(communicator_, positions, std::vector<double>(positions.size(), 1.0));
  ++partitions_;
  SendBuffers buffers(communicator_.ranks());
  for (std::size_t k = 0; k < messages.size(); ++k) {
    messages[k].owner = partition_.owner_of(positions[k]);
    messages[k].enters = true;
    buffers.add(messages[k].owner, messages[k]);
  }
  messages.clear();
  const auto installed = migration_.exchange(communicator_, consensus_, buffers);
  return installed ? Result<void>() : installed.error();
}

}  // namespace kinesphere
