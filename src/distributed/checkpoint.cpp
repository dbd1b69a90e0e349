// The whole of a distributed world as bytes: a part for each rank, which any number of ranks can go on from.
//
// Of windows, no more is kept than in which one each body is: a capsule that is made anew holds what the body
// may do from now on, and decides nothing (docs/distributed.md).
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "archive/archive.hpp"
#include "archive/envelope.hpp"
#include "archive/fields.hpp"
#include "distributed/domain.hpp"
#include "distributed/guarded.hpp"
#include "engine/validation.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

constexpr Envelope envelope{{'K', 'i', 'n', 'e', 'd', 'w', '\r', '\n'},
                            2,
                            "part of a distributed world",
                            "restore",
                            "parts",
                            ErrorCode::bad_snapshot};

Error refusal(const std::string& what) { return envelope.refusal(what); }

}  // namespace

/// A part of one.
class DistributedWorld::Domain::Checkpoint {
 public:
  /// The same in all parts of one checkpoint.
  struct Stamp {
    std::uint64_t parts = 0;
    double time = 0.0;
    std::array<std::uint64_t, 2> hash{};

    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [count, when, events] = self;
      archive(count, when, events);
    }
    friend bool operator==(const Stamp&, const Stamp&) = default;
  };

  Stamp stamp{};
  std::uint64_t part = 0;
  WorldDefinition definition{};
  // Of all ranks.
  std::vector<std::byte> tempo{};
  SensorTable sensors{};
  double phase_end = infinity;
  // Of one.
  Kicks kicks{};
  Counters counters{};
  std::array<std::uint64_t, 2> hash{};
  std::vector<Parcel> parcels{};

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    archive(self.stamp, self.part, self.definition, self.tempo, self.sensors, self.phase_end, self.kicks,
            self.counters, self.hash, self.parcels);
  }

  static Result<Checkpoint> read(std::span<const std::byte> bytes) {
    auto content = envelope.open(bytes);
    if (!content) return content.error();
    ByteReader reader(*content);
    Checkpoint checkpoint;
    reader(checkpoint);
    if (reader.failed() || reader.remaining() != 0)
      return refusal("must hold parts of a world, but the content of one does not have the form of it");
    if (!check_world(checkpoint.definition) || checkpoint.part >= checkpoint.stamp.parts ||
        !std::isfinite(checkpoint.stamp.time) || std::isnan(checkpoint.phase_end))
      return refusal("must hold parts of a world that can be, but one contradicts itself");
    return checkpoint;
  }
};

Result<std::vector<std::byte>> DistributedWorld::Domain::save() {
  if (failed_)
    return Error{ErrorCode::rank_failed, "world", no_body, "save: the world cannot go on after an error"};
  Checkpoint checkpoint;
  auto all_events = hash_.parts();
  communicator_.sum(all_events);
  checkpoint.stamp = {ranks(), time(), all_events};
  checkpoint.part = static_cast<std::uint64_t>(rank());
  checkpoint.definition = bodies().definition();
  ByteWriter tempo;
  tempo(tables_.tempo);
  checkpoint.tempo = tempo.take();
  checkpoint.sensors = bodies().sensors;
  checkpoint.phase_end = everybody_.phase_end();
  checkpoint.kicks = everybody_.work().settled;
  checkpoint.counters = everybody_.work().counters;
  checkpoint.hash = hash_.parts();
  std::vector<std::uint32_t> numbers;
  const auto written = guarded([&]() -> Result<void> {
    for (std::uint32_t number = 0; number < bodies().numbers(); ++number) {
      if (!bodies()[number].alive || !is_own(number)) continue;
      numbers.push_back(number);
      checkpoint.parcels.push_back(pack(number));
    }
    return {};
  });
  if (auto agreed = agree(written); !agreed) return agreed.error();
  add_due(checkpoint.parcels, numbers);
  ByteWriter content;
  content(checkpoint);
  return envelope.seal(content.bytes());
}

Result<std::unique_ptr<DistributedWorld::Domain>> DistributedWorld::Domain::restore(
    std::span<const std::vector<std::byte>> parts, Motion& motion) {
  std::vector<Checkpoint> here;
  Result<void> valid;
  for (const std::vector<std::byte>& bytes : parts) {
    auto read = Checkpoint::read(bytes);
    if (!read) {
      valid = read.error();
      break;
    }
    here.push_back(std::move(*read));
  }
  // What is the same everywhere, from a rank that has a part.
  ByteWriter writer;
  if (valid && !here.empty()) {
    writer(here.size());
    for (const Checkpoint& checkpoint : here) writer(checkpoint.stamp, checkpoint.part);
    writer(here[0].definition, here[0].tempo, here[0].sensors, here[0].phase_end);
  }
  Checkpoint common;
  std::vector<std::uint64_t> found;
  bool of_one_world = true;
  Communicator all;
  for (const Bytes& bytes : all.gather(writer.bytes())) {
    if (bytes.empty()) continue;
    ByteReader reader(bytes);
    std::size_t count = 0;
    reader(count);
    for (; count > 0; --count) {
      Checkpoint::Stamp stamp;
      reader(stamp, found.emplace_back());
      of_one_world = of_one_world && (found.size() == 1 || stamp == common.stamp);
      common.stamp = stamp;
    }
    reader(common.definition, common.tempo, common.sensors, common.phase_end);
  }
  std::sort(found.begin(), found.end());
  const bool once = std::adjacent_find(found.begin(), found.end()) == found.end();
  if (valid && (!of_one_world || !once || found.empty()))
    valid = refusal("must be all of one world, each of them once, but are not");
  for (std::uint64_t part = 0; part < common.stamp.parts && valid; ++part) {
    if (part < found.size() && found[part] == part) continue;
    valid = refusal("must be all of one world, but of " + std::to_string(common.stamp.parts) + " part " +
                    std::to_string(part) + " is missing");
  }
  auto domain = std::make_unique<Domain>(common.definition, motion);
  if (auto agreed = domain->agree(valid); !agreed) return agreed.error();
  if (auto resumed = domain->resume(common, here); !resumed) return resumed.error();
  return domain;
}

/// With the parts that were handed in here.
Result<void> DistributedWorld::Domain::resume(const Checkpoint& common, std::vector<Checkpoint>& parts) {
  everybody_.move_on_to(common.stamp.time);
  everybody_.begin_phase(common.phase_end);
  ByteReader tempo(common.tempo);
  tempo(tables_.tempo);
  const bool is_sound = !tempo.failed() && tables_.tempo.is_sound();
  auto valid =
      is_sound ? Result<void>() : refusal("must hold parts of a world that can be, but have no tempo");
  bodies().sensors = common.sensors;
  std::vector<Parcel> parcels;
  for (Checkpoint& part : parts) {
    everybody_.work().settled += part.kicks;
    everybody_.work().counters += part.counters;
    hash_ += EventHash::of(part.hash);
    std::move(part.parcels.begin(), part.parcels.end(), std::back_inserter(parcels));
  }
  std::vector<Vec3> positions;
  positions.reserve(parcels.size());
  for (const Parcel& parcel : parcels)
    positions.push_back(bodies().space().wrapped(parcel.body.bound.centre_at(time())).position);
  partition_ = Partition::choose(communicator_, positions, std::vector<double>(positions.size(), 1.0));
  ++partitions_;
  std::vector<ByteWriter> writers(ranks());
  for (std::size_t k = 0; k < parcels.size(); ++k) {
    parcels[k].owner = partition_.owner_of(positions[k]);
    parcels[k].enters = true;
    writers[static_cast<std::size_t>(parcels[k].owner)](parcels[k]);
  }
  parcels.clear();
  std::vector<Windows::Starter> none;
  resuming_ = true;
  const auto installed = receive(writers, none);
  resuming_ = false;
  if (valid) valid = installed;
  if (auto agreed = agree(valid); !agreed) return agreed;
  for (const auto& [name, number] : roster_) new_names_.push_back(name);
  auto spread_out = spread(none, true);
  loose_.clear();
  return spread_out;
}

}  // namespace kinesphere
