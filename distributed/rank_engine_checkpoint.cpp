// RankEngine::save() and RankEngine::restore().
#include <iterator>
#include <utility>

#include "distributed/checkpoint.hpp"
#include "distributed/guarded.hpp"
#include "distributed/rank_engine.hpp"

namespace kinesphere {

Result<std::vector<std::byte>> DistributedWorld::RankEngine::save() {
  if (auto valid = consensus_.check("save"); !valid) return valid.error();
  take_arrivals();
  Checkpoint checkpoint;
  auto all_events = hash_.parts();
  communicator_.sum(all_events);
  checkpoint.identity = {static_cast<std::uint64_t>(communicator_.ranks()), time(), all_events};
  checkpoint.part = static_cast<std::uint64_t>(communicator_.rank());
  checkpoint.definition = definition();
  checkpoint.sensors = sensors_;
  checkpoint.facts = facts_;
  checkpoint.counters = counters();
  checkpoint.hash = hash_.parts();
  checkpoint.bodies = own_;
  const auto written = guarded([&] {
    for (BodyRecord& body : checkpoint.bodies) motion_.write_body(body.in_motion, body.motion).value();
  });
  if (auto agreed = agree(written); !agreed) return agreed.error();
  return checkpoint.write();
}

Result<std::unique_ptr<DistributedWorld::RankEngine>> DistributedWorld::RankEngine::restore(
    std::span<const std::vector<std::byte>> parts, Motion& motion, std::optional<int> communicator) {
  auto read = Checkpoint::read_all(parts);
  std::vector<Checkpoint> here;
  if (read) here = std::move(*read);
  Communicator all(communicator);
  Checkpoint common;
  Result<void> valid = gather_common(all, here, common);
  if (!read) valid = read.error();
  auto domain = std::make_unique<RankEngine>(common.definition, motion, communicator);
  if (auto agreed = domain->agree(valid); !agreed) return agreed.error();
  if (auto resumed = domain->resume(common, here); !resumed) return resumed.error();
  return domain;
}

/// Continues from the parts that were passed on this rank.
Result<void> DistributedWorld::RankEngine::resume(const Checkpoint& common, std::vector<Checkpoint>& parts) {
  time_ = common.identity.time;
  sensors_ = common.sensors;
  facts_ = common.facts;
  for (Checkpoint& part : parts) {
    counters_ += part.counters;
    hash_ += EventHash::of(part.hash);
    std::move(part.bodies.begin(), part.bodies.end(), std::back_inserter(own_));
  }
  if (auto assigned = distribution_.assign(own_, time_); !assigned) return assigned;
  for (const BodyRecord& body : own_) names_.add(body.name);
  return agree(names_.check(communicator_));
}

}  // namespace kinesphere
