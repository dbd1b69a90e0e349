// A distributed world becomes a checkpoint, and goes on from one.
#include <iterator>
#include <utility>

#include "distributed/checkpoint.hpp"
#include "distributed/domain.hpp"
#include "distributed/guarded.hpp"

namespace kinesphere {

Result<std::vector<std::byte>> DistributedWorld::Domain::save() {
  if (auto valid = agreement_.check("save"); !valid) return valid.error();
  Checkpoint checkpoint;
  auto all_events = hash_.parts();
  communicator_.sum(all_events);
  checkpoint.stamp = {static_cast<std::uint64_t>(communicator_.ranks()), time(), all_events};
  checkpoint.part = static_cast<std::uint64_t>(communicator_.rank());
  checkpoint.definition = definition();
  ByteWriter tempo;
  tempo(local_.tables.tempo);
  checkpoint.tempo = tempo.take();
  checkpoint.sensors = local_.bodies().sensors;
  checkpoint.phase_end = local_.everybody.phase_end();
  checkpoint.kicks = local_.everybody.work().settled;
  checkpoint.counters = counters();
  checkpoint.hash = hash_.parts();
  std::vector<std::uint32_t> numbers;
  const auto packed = guarded([&] {
    for (std::uint32_t number = 0; number < local_.bodies().numbers(); ++number) {
      if (!local_.bodies()[number].alive || !local_.roster.is_own(number)) continue;
      numbers.push_back(number);
      checkpoint.parcels.push_back(transit_.pack(number));
    }
  });
  if (auto agreed = agree(packed); !agreed) return agreed.error();
  transit_.add_due(checkpoint.parcels, numbers, nullptr);
  return checkpoint.write();
}

Result<std::unique_ptr<DistributedWorld::Domain>> DistributedWorld::Domain::restore(
    std::span<const std::vector<std::byte>> parts, Motion& motion) {
  auto read = Checkpoint::read_all(parts);
  std::vector<Checkpoint> here;
  if (read) here = std::move(*read);
  Communicator all;
  Checkpoint common;
  Result<void> valid = gather_common(all, here, common);
  if (!read) valid = read.error();
  auto domain = std::make_unique<Domain>(common.definition, motion);
  if (auto agreed = domain->agree(valid); !agreed) return agreed.error();
  if (auto resumed = domain->resume(common, here); !resumed) return resumed.error();
  return domain;
}

/// With the parts that were handed in here.
Result<void> DistributedWorld::Domain::resume(const Checkpoint& common, std::vector<Checkpoint>& parts) {
  local_.everybody.move_on_to(common.stamp.time);
  local_.everybody.begin_phase(common.phase_end);
  auto valid = read_tempo(common.tempo, local_.tables.tempo);
  local_.bodies().sensors = common.sensors;
  std::vector<Parcel> parcels;
  for (Checkpoint& part : parts) {
    local_.everybody.work().settled += part.kicks;
    local_.everybody.work().counters += part.counters;
    hash_ += EventHash::of(part.hash);
    std::move(part.parcels.begin(), part.parcels.end(), std::back_inserter(parcels));
  }
  transit_.keep_loose_pairs();
  const auto dealt_out = distribution_.deal_out(std::move(parcels));
  if (valid) valid = dealt_out;
  if (auto agreed = agree(valid); !agreed) return agreed;
  for (std::uint32_t number = 0; number < local_.bodies().numbers(); ++number)
    if (local_.bodies()[number].alive) names_.add(local_.name_of(number));
  std::vector<Windows::Starter> none;
  auto spread_out = distribution_.spread(none, true);
  transit_.forget_loose_pairs();
  return spread_out;
}

}  // namespace kinesphere
