// RankEngine::save() and RankEngine::restore().
#include <iterator>
#include <utility>

#include "distributed/checkpoint.hpp"
#include "distributed/guarded.hpp"
#include "distributed/rank_engine.hpp"

namespace kinesphere {

Result<std::vector<std::byte>> DistributedWorld::RankEngine::save() {
  if (auto valid = agreement_.check("save"); !valid) return valid.error();
  Checkpoint checkpoint;
  auto all_events = hash_.parts();
  communicator_.sum(all_events);
  checkpoint.stamp = {static_cast<std::uint64_t>(communicator_.ranks()), time(), all_events};
  checkpoint.part = static_cast<std::uint64_t>(communicator_.rank());
  checkpoint.definition = definition();
  ByteWriter window_policy;
  window_policy(local_.state.window_policy);
  checkpoint.window_policy = window_policy.take();
  checkpoint.sensors = local_.bodies().sensors;
  checkpoint.epoch_end = local_.main.epoch_end();
  checkpoint.kicks = local_.main.work().recertified;
  checkpoint.counters = counters();
  checkpoint.hash = hash_.parts();
  std::vector<std::uint32_t> numbers;
  const auto packed = guarded([&] {
    for (std::uint32_t number = 0; number < local_.bodies().numbers(); ++number) {
      if (!local_.bodies()[number].alive || !local_.directory.is_own(number)) continue;
      numbers.push_back(number);
      checkpoint.bodies.push_back(transit_.pack(number));
    }
  });
  if (auto agreed = agree(packed); !agreed) return agreed.error();
  transit_.add_due(checkpoint.bodies, numbers, nullptr);
  return checkpoint.write();
}

Result<std::unique_ptr<DistributedWorld::RankEngine>> DistributedWorld::RankEngine::restore(
    std::span<const std::vector<std::byte>> parts, Motion& motion) {
  auto read = Checkpoint::read_all(parts);
  std::vector<Checkpoint> here;
  if (read) here = std::move(*read);
  Communicator all;
  Checkpoint common;
  Result<void> valid = gather_common(all, here, common);
  if (!read) valid = read.error();
  auto domain = std::make_unique<RankEngine>(common.definition, motion);
  if (auto agreed = domain->agree(valid); !agreed) return agreed.error();
  if (auto resumed = domain->resume(common, here); !resumed) return resumed.error();
  return domain;
}

/// Continues from the parts that were passed on this rank.
Result<void> DistributedWorld::RankEngine::resume(const Checkpoint& common, std::vector<Checkpoint>& parts) {
  local_.main.advance_clock(common.stamp.time);
  local_.main.begin_epoch(common.epoch_end);
  auto valid = read_window_policy(common.window_policy, local_.state.window_policy);
  local_.bodies().sensors = common.sensors;
  std::vector<BodyMessage> messages;
  for (Checkpoint& part : parts) {
    local_.main.work().recertified += part.kicks;
    local_.main.work().counters += part.counters;
    hash_ += EventHash::of(part.hash);
    std::move(part.bodies.begin(), part.bodies.end(), std::back_inserter(messages));
  }
  transit_.keep_loose_pairs();
  const auto dealt_out = distribution_.distribute(std::move(messages));
  if (valid) valid = dealt_out;
  if (auto agreed = agree(valid); !agreed) return agreed;
  for (std::uint32_t number = 0; number < local_.bodies().numbers(); ++number)
    if (local_.bodies()[number].alive) names_.add(local_.name_of(number));
  std::vector<BroadPhase::Starter> none;
  auto spread_out = distribution_.spread(none, true);
  transit_.forget_loose_pairs();
  return spread_out;
}

}  // namespace kinesphere
