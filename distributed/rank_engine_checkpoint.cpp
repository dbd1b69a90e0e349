// RankEngine::save() and RankEngine::restore().
#include <iterator>
#include <utility>

#include "distributed/checkpoint.hpp"
#include "distributed/guarded.hpp"
#include "distributed/rank_engine.hpp"

namespace kinesphere {

Result<std::vector<std::byte>> DistributedWorld::RankEngine::save() {
  if (auto valid = consensus_.check("save"); !valid) return valid.error();
  Checkpoint checkpoint;
  auto all_events = hash_.parts();
  communicator_.sum(all_events);
  checkpoint.identity = {static_cast<std::uint64_t>(communicator_.ranks()), time(), all_events};
  checkpoint.part = static_cast<std::uint64_t>(communicator_.rank());
  checkpoint.definition = definition();
  ByteWriter window_policy;
  window_policy(rank_.state.window_policy);
  checkpoint.window_policy = window_policy.take();
  checkpoint.sensors = rank_.bodies().sensors;
  checkpoint.epoch_end = rank_.main.epoch_end();
  checkpoint.spot_checks = rank_.state.spot_checks;
  checkpoint.recertified = rank_.main.work().recertified;
  checkpoint.counters = counters();
  checkpoint.hash = hash_.parts();
  std::vector<std::uint32_t> numbers;
  const auto packed = guarded([&] {
    for (std::uint32_t number = 0; number < rank_.bodies().numbers(); ++number) {
      if (!rank_.bodies()[number].alive || !rank_.directory.is_own(number)) continue;
      numbers.push_back(number);
      checkpoint.bodies.push_back(migration_.pack(number));
    }
  });
  if (auto agreed = agree(packed); !agreed) return agreed.error();
  migration_.add_due(checkpoint.bodies, numbers, nullptr);
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
  rank_.main.advance_clock(common.identity.time);
  rank_.main.begin_epoch(common.epoch_end);
  rank_.state.spot_checks = common.spot_checks;
  auto valid = read_window_policy(common.window_policy, rank_.state.window_policy);
  rank_.bodies().sensors = common.sensors;
  std::vector<BodyMessage> messages;
  for (Checkpoint& part : parts) {
    rank_.main.work().recertified += part.recertified;
    rank_.main.work().counters += part.counters;
    hash_ += EventHash::of(part.hash);
    std::move(part.bodies.begin(), part.bodies.end(), std::back_inserter(messages));
  }
  migration_.keep_loose_pairs();
  const auto dealt_out = distribution_.distribute(std::move(messages));
  if (valid) valid = dealt_out;
  if (auto agreed = agree(valid); !agreed) return agreed;
  for (std::uint32_t number = 0; number < rank_.bodies().numbers(); ++number)
    if (rank_.bodies()[number].alive) names_.add(rank_.name_of(number));
  std::vector<BroadPhase::Starter> none;
  auto updated = distribution_.update_ghosts(none, true);
  migration_.forget_loose_pairs();
  return updated;
}

}  // namespace kinesphere
