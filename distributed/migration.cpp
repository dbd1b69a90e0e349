#include "distributed/migration.hpp"

#include <algorithm>
#include <utility>

#include "distributed/guarded.hpp"
#include "number/scope_guard.hpp"

namespace kinesphere {
BodyMessage Migration::pack(std::uint32_t number) const {
  const Bodies& bodies = rank_.bodies();
  const BodyDirectory::Entry& entry = rank_.directory[number];
  BodyMessage message;
  message.name = rank_.name_of(number);
  message.owner = entry.owner;
  const auto [body, image] = bodies.checkpoint(number);
  message.body = body;
  message.image = image;
  message.filter = bodies.filters.of(number);
  message.mass = bodies.masses.of(number);
  message.radius = bodies.radii.of(number);
  if (body.has_shape()) message.shape = bodies.shapes.of(body);
  if (const RigidRecord* const turning = bodies.rigid.find(body)) message.rigid = *turning;
  message.contacts = ContactCheckpoint::of(rank_.state.contacts, number);
  const BroadPhase& windows = rank_.state.broad_phase;
  message.is_registered = windows.contains(number);
  if (message.is_registered) {
    message.rung = windows.window_of(number).rung;
    message.end = windows.end_of(number);
  }
  motion_.write_body(entry.in_motion, message.motion).value();
  // Replace numbers by names.
  PartnerList partners;
  std::vector<OverlapRecord>& overlaps = message.contacts.overlaps;
  for (const auto& [partner, state] : std::as_const(message).contacts.partners.all())
    partners.set({rank_.name_of(partner), state});
  for (OverlapRecord& overlap : overlaps) overlap.partner = rank_.name_of(overlap.partner);
  if (const PendingLinks::Links* links = pending_links_.of(message.name)) {
    for (const ContactRecord& partner : links->partners) partners.set(partner);
    overlaps.insert(overlaps.end(), links->overlaps.begin(), links->overlaps.end());
  }
  message.contacts.partners = std::move(partners);
  return message;
}

BodyMessage Migration::pack_checkpoint(std::uint32_t number, SpeculativeRunner& runner) {
  const Cluster* cluster = runner.cluster_of(number);
  const BodyCheckpoint* checkpoint =
      cluster != nullptr && cluster->executed ? runner.checkpoint_of(number) : nullptr;
  BodyMessage message;
  if (checkpoint == nullptr) {
    message = pack(number);
  } else {
    std::optional<MotionOrigin> before;
    for (const auto& [body, origin] : runner.undo_log_of(*cluster))
      if (!before && body.index == rank_.name_of(number)) before = origin;
    const std::uint32_t in_motion = rank_.directory[number].in_motion;
    std::optional<MotionOrigin> present;
    if (before) {
      present = motion_.origin(in_motion);
      motion_.set_origin(in_motion, *before).value();
    }
    const ScopeGuard reset([&] {
      if (present) (void)motion_.set_origin(in_motion, *present);
    });
    const Bodies::Checkpoint now = rank_.bodies().checkpoint(number);
    const ContactCheckpoint contacts = ContactCheckpoint::of(rank_.state.contacts, number);
    rank_.bodies().restore(number, checkpoint->body);
    checkpoint->contacts.restore(rank_.state.contacts, number);
    message = pack(number);
    if (message.rigid) message.rigid->go_back();
    rank_.bodies().restore(number, now);
    contacts.restore(rank_.state.contacts, number);
  }
  if (cluster != nullptr) {
    for (const Event& event : cluster->pending)
      if (event.first.index == message.name) message.pending.push_back(event);
  }
  return message;
}

BodyMessage::Due Migration::due_of(const PairCertificate& pair, std::uint32_t number) const {
  if (!pair.has_second()) return {pair.failure_time, pair.second};
  return {pair.failure_time, rank_.name_of(pair.first == number ? pair.second : pair.first)};
}

/// Returns the body's revision at the start of the batch, if a batch is running and has changed the body;
/// otherwise its current revision.
std::uint32_t Migration::revision_of(std::uint32_t number, const SpeculativeRunner* runner) const {
  const BodyCheckpoint* checkpoint = runner != nullptr ? runner->checkpoint_of(number) : nullptr;
  return checkpoint != nullptr ? checkpoint->body.body.revision : rank_.bodies()[number].revision;
}

PairCertificate Migration::certificate(const BodyMessage::Due& due, std::uint32_t number, std::uint32_t other,
                                       const SpeculativeRunner* runner) const {
  PairCertificate pair = rank_.main.certifier().certificate(due.time, number, other);
  pair.first_revision = revision_of(pair.first, runner);
  if (pair.has_second()) pair.second_revision = revision_of(pair.second, runner);
  return pair;
}

void Migration::add_due(std::vector<BodyMessage>& messages, std::span<const std::uint32_t> numbers,
                        SpeculativeRunner* runner) {
  if (numbers.empty()) return;
  positions_.resize(rank_.bodies().numbers());
  for (std::size_t k = 0; k < numbers.size(); ++k) positions_[numbers[k]] = static_cast<std::uint32_t>(k) + 1;
  const auto note = [&](const PairCertificate& pair) {
    const std::uint32_t first = positions_[pair.first];
    const std::uint32_t second = pair.has_second() ? positions_[pair.second] : 0;
    if (first == 0 && second == 0) return;
    if (revision_of(pair.first, runner) != pair.first_revision) return;
    if (pair.has_second() && revision_of(pair.second, runner) != pair.second_revision) return;
    if (first != 0) messages[first - 1].due.push_back(due_of(pair, pair.first));
    if (second != 0) messages[second - 1].due.push_back(due_of(pair, pair.second));
  };
  rank_.main.queue().for_each(note);
  if (runner != nullptr) {
    for (const Cluster& cluster : runner->clusters()) {
      if (cluster.is_merged()) continue;
      for (const PairCertificate& pair : runner->due_of(cluster)) note(pair);
    }
  }
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    positions_[numbers[k]] = 0;
    if (!loose_) continue;
    if (const auto loose = loose_->find(numbers[k]); loose != loose_->end())
      messages[k].due.insert(messages[k].due.end(), loose->second.begin(), loose->second.end());
  }
}

void Migration::add_late_pairs(BodyMessage& message, std::uint32_t number, const Cluster& cluster,
                               SpeculativeRunner& runner) const {
  for (const PairCertificate& pair : runner.late_pairs_of(cluster)) {
    if (pair.first != number && !(pair.has_second() && pair.second == number)) continue;
    BodyMessage::Due& due = message.due.emplace_back(due_of(pair, number));
    due.is_of_batch_start =
        pair.has_second() && runner.cluster_of(pair.first == number ? pair.second : pair.first) != &cluster;
  }
}

/// Drops the certificates that a cluster has made with another body that has changed since in a cluster of
/// its own. That cluster was executed here, or elsewhere; then one of the messages brings the body.
void Migration::drop_stale_due(std::vector<BodyMessage>& messages, const SpeculativeRunner* runner) const {
  std::vector<std::uint32_t> changed;
  for (const BodyMessage& message : messages)
    if (message.is_stale) changed.push_back(message.name);
  std::sort(changed.begin(), changed.end());
  const auto is_stale = [&](const BodyMessage::Due& due) {
    if (!due.is_of_batch_start) return false;
    if (std::binary_search(changed.begin(), changed.end(), due.other)) return true;
    const auto other = rank_.directory.find(due.other);
    return other && revision_of(*other, runner) != rank_.bodies()[*other].revision;
  };
  for (BodyMessage& message : messages) std::erase_if(message.due, is_stale);
}

Result<InitialWork> Migration::install(std::vector<BodyMessage>& messages, const SpeculativeRunner* runner) {
  InitialWork beginning;
  std::vector<std::uint32_t> numbers;
  drop_stale_due(messages, runner);
  for (BodyMessage& message : messages) {
    const auto number = install(message);
    if (!number) return number.error();
    numbers.push_back(*number);
    if (message.body.dirty) beginning.dirty.push_back(*number);
  }
  for (const BodyMessage& message : messages) link(message);
  for (std::size_t k = 0; k < messages.size(); ++k) {
    BodyMessage& message = messages[k];
    const std::uint32_t number = numbers[k];
    if (message.enters && message.is_registered)
      rank_.state.broad_phase.enter(number, inflated_bound(rank_.bodies(), number, rank_.time()),
                                    rank_.time(), message.window());
    for (const BodyMessage::Due& due : message.due) {
      if (due.other >= PairCertificate::window_end) {
        beginning.due.push_back(certificate(due, number, due.other, runner));
      } else if (const auto other = rank_.directory.find(due.other)) {
        beginning.due.push_back(certificate(due, number, *other, runner));
      } else if (loose_) {
        (*loose_)[number].push_back(due);
      }
    }
    for (Event& event : message.pending) {
      event.first = rank_.bodies().id_of(number);
      beginning.pending.push_back(event);
    }
  }
  // If two bodies have arrived together, each has brought the certificate of their pair: remove duplicates.
  std::sort(beginning.due.begin(), beginning.due.end());
  const auto same = [](const PairCertificate& a, const PairCertificate& b) { return !(a < b) && !(b < a); };
  beginning.due.erase(std::unique(beginning.due.begin(), beginning.due.end(), same), beginning.due.end());
  rank_.state.broad_phase.tidy();
  return beginning;
}

/// Installs the body's own state. Contacts and the broad phase follow in link() and in install() of the list.
Result<std::uint32_t> Migration::install(BodyMessage& message) {
  Bodies& bodies = rank_.bodies();
  BodyDirectory& directory = rank_.directory;
  std::span<const std::byte> bytes(message.motion);
  const auto known = directory.find(message.name);
  if (known) {
    if (auto removed = motion_.remove(directory[*known].in_motion); !removed) return removed.error();
  }
  const auto in_motion = motion_.read_body(bytes);
  if (!in_motion) return in_motion.error();
  const std::uint32_t number =
      known ? *known : bodies.add_named(BodyDefinition{}, rank_.time(), message.name);
  Body& body = bodies[number];
  const std::uint32_t generation = body.generation;
  const std::uint32_t new_revision = message.is_stale || !known ? body.revision + 1 : body.revision;
  bodies.shapes.remove(body);
  bodies.rigid.remove(body);
  body = message.body;
  body.generation = generation;
  body.revision = new_revision;
  body.shape_number = body.change_number = body.sleep_number = Body::none;
  body.is_rigid = body.carries_shape = false;
  if (message.shape) bodies.give_shape(number, *message.shape, true);
  if (message.rigid) bodies.make_rigid(number, std::move(*message.rigid));
  bodies.filters.keep(number, message.filter);
  bodies.masses.keep(number, message.mass);
  bodies.radii.keep(number, message.radius);
  bodies.set_solid(number, body.solid);
  if (bodies.space().repeats()) bodies.images[number] = message.image;
  if (!known) {
    rank_.state.contacts.add(number, 0.0);
    directory.add(message.name, number, message.owner);
  }
  directory[number].owner = message.owner;
  directory[number].in_motion = *in_motion;
  message.contacts.restore_alone(rank_.state.contacts, number);
  if (body.dirty) {
    body.dirty = false;
    rank_.main.dirty().add(rank_.bodies(), number);
  }
  return number;
}

/// Sets the body's links in the contact graph, and moves pending links between it and bodies held here there.
void Migration::link(const BodyMessage& message) {
  std::vector<ContactRecord> partners;
  std::vector<OverlapRecord> overlaps;
  PendingLinks::Links missing;
  for (const auto& [name, state] : message.contacts.partners.all()) {
    if (const auto partner = rank_.directory.find(name)) {
      partners.push_back({*partner, state});
      pending_links_.remove(name, message.name);
    } else {
      missing.partners.push_back({name, state});
    }
  }
  for (const OverlapRecord& overlap : message.contacts.overlaps) {
    if (const auto partner = rank_.directory.find(overlap.partner)) {
      overlaps.push_back({*partner, overlap.distance, overlap.senses});
      pending_links_.remove(overlap.partner, message.name);
    } else {
      missing.overlaps.push_back(overlap);
    }
  }
  rank_.state.contacts.set_links(*rank_.directory.find(message.name), partners, std::move(overlaps));
  pending_links_.set(message.name, std::move(missing));
}

Result<std::vector<BodyMessage>> Migration::exchange(Communicator& communicator, ErrorConsensus& consensus,
                                                     SendBuffers& buffers, const SpeculativeRunner* runner) {
  std::vector<BodyMessage> messages;
  for (const Communicator::Bytes& bytes : buffers.exchange(communicator)) {
    ByteReader reader(bytes);
    while (reader.remaining() > 0 && !reader.failed()) reader(messages.emplace_back());
  }
  consensus.note(guarded([&]() -> Result<void> {
    auto beginning = install(messages, runner);
    if (!beginning) return beginning.error();
    rank_.main.queue().add_all(beginning->due);
    return {};
  }));
  if (auto agreed = consensus.agree_on_noted(); !agreed) return agreed.error();
  return messages;
}

void Migration::drop(std::uint32_t number) {
  const std::uint32_t name = rank_.name_of(number);
  for (const auto& [partner, state] : rank_.state.contacts.partners_of(number))
    pending_links_.add_partner(rank_.name_of(partner), {name, state});
  for (const OverlapRecord& overlap : rank_.state.contacts.overlaps_of(number))
    pending_links_.add_overlap(rank_.name_of(overlap.partner), {name, overlap.distance, overlap.senses});
  rank_.state.contacts.set_links(number, {}, {});
  pending_links_.remove(name);
  if (rank_.state.broad_phase.contains(number)) rank_.state.broad_phase.leave(number);
  (void)motion_.remove(rank_.directory[number].in_motion);
  rank_.directory.remove(name, number);
  rank_.bodies().remove(number);
}

}  // namespace kinesphere
