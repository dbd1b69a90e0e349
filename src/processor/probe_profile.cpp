#include "processor/probe_profile.hpp"

#include <algorithm>
#include <numeric>

#include "archive/heap_counter.hpp"

namespace kinesphere {
namespace {

/// Least ratio of the declared to the shown acceleration at which a limit is loose. A limit that is 4 times
/// too wide costs about twice the probes (docs/acceleration-limits.md).
constexpr double loose_ratio = 4.0;

/// Minimum probes for which the shown accelerations are compared with the limit.
constexpr std::uint64_t enough_reports = 8;

/// Largest number of probes that an approach that ends in a contact usually takes; with more, the contacts do
/// not explain the probes.
constexpr std::uint64_t probes_of_a_contact = 8;

bool is_loose(const BusyBody& busy) {
  return busy.probes >= enough_reports && busy.acceleration_limit > loose_ratio * busy.largest_acceleration;
}

ProbeReason reason_of(const BusyBody& busy) {
  const std::uint64_t most = std::max({busy.touching, busy.near, busy.windows, busy.changes, busy.queries});
  if (most == busy.queries) return ProbeReason::queries;
  if (most == busy.changes) return ProbeReason::changes;
  const bool collides = busy.contacts > 0 && busy.touching + busy.near <= probes_of_a_contact * busy.contacts;
  if (most == busy.touching && !collides) return ProbeReason::touching;
  if (is_loose(busy)) return ProbeReason::loose_limit;
  if (most == busy.windows) return ProbeReason::travel;
  return collides ? ProbeReason::contacts : ProbeReason::narrow_misses;
}

}  // namespace

ProbeProfile::Record& ProbeProfile::record_of(const BodyTable& bodies, std::uint32_t number) {
  if (number >= records_.size()) records_.resize(bodies.numbers());
  Record& record = records_[number];
  const std::uint32_t generation = bodies[number].generation;
  if (record.generation != generation) record = {.generation = generation};
  return record;
}

void ProbeProfile::note_probes(const BodyTable& bodies, std::span<const std::uint32_t> numbers,
                               ProbeCause cause) {
  for (const std::uint32_t number : numbers)
    ++record_of(bodies, number).probes[static_cast<std::size_t>(cause)];
}

void ProbeProfile::note_event(const BodyTable& bodies, const Event& event) {
  if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) return;
  for (const BodyId id : {event.first, event.second})
    if (id != no_body) ++record_of(bodies, bodies.number_of(id)).contacts;
}

void ProbeProfile::note_report(std::uint32_t number, const Bound& before, const Bound& after) {
  const double duration = after.time - before.time;
  if (duration <= 0.0) return;
  const Vec3 expected = before.velocity_at(after.time);
  // The slack covers rounding, as in bound_violation().
  const double slack = 0x1p-30 * (norm(after.velocity) + norm(expected));
  const double errors = before.growth_speed + after.growth_speed;
  const double shown = (norm(after.velocity - expected) - errors - slack) / duration;
  double& largest = records_[number].largest_acceleration;
  largest = std::max(largest, shown);
}

BusyBody ProbeProfile::busy_body(const Bodies& bodies, std::uint32_t number, const Record& record) {
  BusyBody busy{.body = bodies.id_of(number),
                .probes = std::accumulate(record.probes.begin(), record.probes.end(), std::uint64_t{0}),
                .touching = record.of(ProbeCause::touching),
                .near = record.of(ProbeCause::near),
                .windows = record.of(ProbeCause::region),
                .changes = record.of(ProbeCause::change),
                .queries = record.of(ProbeCause::query),
                .contacts = record.contacts,
                .acceleration_limit = bodies.definition_of(number).acceleration_limit,
                .largest_acceleration = record.largest_acceleration};
  busy.reason = reason_of(busy);
  return busy;
}

std::vector<BusyBody> ProbeProfile::busiest(const Bodies& bodies, std::size_t count) const {
  std::vector<BusyBody> all;
  for (std::uint32_t number = 0; number < records_.size(); ++number) {
    const Body& body = bodies[number];
    if (!body.alive || body.generation != records_[number].generation) continue;
    const BusyBody busy = busy_body(bodies, number, records_[number]);
    if (busy.probes > 0) all.push_back(busy);
  }
  const std::size_t kept = std::min(count, all.size());
  std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(kept), all.end(),
                    [](const BusyBody& a, const BusyBody& b) {
                      return a.probes != b.probes ? a.probes > b.probes : a.body.index < b.body.index;
                    });
  all.resize(kept);
  return all;
}

std::size_t ProbeProfile::bytes() const { return sizeof *this + heap_bytes(records_); }

}  // namespace kinesphere
