#include "distributed/checkpoint.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "archive/envelope.hpp"
#include "bodies/validation.hpp"

namespace kinesphere {
namespace {

constexpr Envelope envelope{{'K', 'i', 'n', 'e', 'd', 'w', '\r', '\n'},
                            12,
                            "part of a distributed world",
                            "restore",
                            "parts",
                            ErrorCode::bad_snapshot};

Error refusal(const std::string& what) { return envelope.refusal(what); }

}  // namespace

std::vector<std::byte> Checkpoint::write() const {
  ByteWriter content;
  content(*this);
  return envelope.seal(content.bytes());
}

Result<Checkpoint> Checkpoint::read(std::span<const std::byte> bytes) {
  auto content = envelope.open(bytes);
  if (!content) return content.error();
  ByteReader reader(*content);
  Checkpoint checkpoint;
  reader(checkpoint);
  if (reader.failed() || reader.remaining() != 0)
    return refusal("must be parts of a world, but one has the wrong format");
  if (!check_world(checkpoint.definition) || checkpoint.definition.shear_rate != 0.0 ||
      checkpoint.part >= checkpoint.identity.parts || !std::isfinite(checkpoint.identity.time) ||
      !checkpoint.facts.spot_checks.is_valid(checkpoint.identity.time) ||
      !(checkpoint.facts.first_radius >= 0.0) || !(checkpoint.facts.common_reach >= 0.0))
    return refusal("must be consistent, but one contradicts itself");
  return checkpoint;
}

Result<std::vector<Checkpoint>> Checkpoint::read_all(std::span<const std::vector<std::byte>> parts) {
  std::vector<Checkpoint> all;
  for (const std::vector<std::byte>& bytes : parts) {
    auto checkpoint = read(bytes);
    if (!checkpoint) return checkpoint.error();
    all.push_back(std::move(*checkpoint));
  }
  return all;
}

Result<void> gather_common(Communicator& communicator, std::span<const Checkpoint> here, Checkpoint& common) {
  ByteWriter writer;
  if (!here.empty()) {
    writer(here.size());
    for (const Checkpoint& checkpoint : here) writer(checkpoint.identity, checkpoint.part);
    writer(here[0].definition, here[0].sensors, here[0].facts);
  }
  std::vector<std::uint64_t> found;
  bool of_one_world = true;
  for (const Communicator::Bytes& bytes : communicator.gather(writer.bytes())) {
    if (bytes.empty()) continue;
    ByteReader reader(bytes);
    std::size_t count = 0;
    reader(count);
    for (; count > 0; --count) {
      Checkpoint::Identity identity;
      reader(identity, found.emplace_back());
      of_one_world = of_one_world && (found.size() == 1 || identity == common.identity);
      common.identity = identity;
    }
    reader(common.definition, common.sensors, common.facts);
  }
  std::sort(found.begin(), found.end());
  const bool once = std::adjacent_find(found.begin(), found.end()) == found.end();
  if (!of_one_world || !once || found.empty())
    return refusal("must be all of one world, each of them once, but are not");
  for (std::uint64_t part = 0; part < common.identity.parts; ++part) {
    if (part < found.size() && found[part] == part) continue;
    return refusal("must be all of one world, but of " + std::to_string(common.identity.parts) + " part " +
                   std::to_string(part) + " is missing");
  }
  return {};
}

}  // namespace kinesphere
