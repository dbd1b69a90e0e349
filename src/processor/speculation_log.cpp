#include "processor/speculation_log.hpp"

#include "number/infinity.hpp"
#include "processor/event_processor.hpp"

namespace kinesphere {

void EventProcessor::begin(SpeculationLog& log, std::span<const PairCertificate> due,
                           std::span<const std::uint32_t> dirty, std::span<const Event> pending) {
  log_ = &log;
  time_ = log.batch->begin;
  epoch_end_ = log.batch->epoch_end;
  next_slice_ = log.batch->next_slice;
  queue_.clear();
  for (const PairCertificate& pair : due) queue_.add(pair);
  events_.clear();
  for (const Event& event : pending) events_.queue(event);
  dirty_.assign(dirty);
  gathering_ = true;
  work_ = {};
}

/// Adds bodies that the body touches or senses to the conflicts if they are outside the cluster.
void EventProcessor::note_linked_conflicts(std::uint32_t number) {
  const auto set = [this](std::uint32_t other) {
    if (!log_->is_own(other) && !bodies()[other].is_static()) log_->conflicts.add(other);
  };
  for (const ContactRecord& contact : contacts().partners_of(number)) set(contact.partner);
  for (const OverlapRecord& overlap : contacts().overlaps_of(number)) set(overlap.partner);
}

/// Certifies the body with one outside the cluster. Adds that one to the conflicts if the pair is due in this
/// batch, otherwise to the read set.
void EventProcessor::certify_speculatively(std::uint32_t number, std::uint32_t other) {
  assert(log_->is_own(number) && !log_->is_own(other));
  const PairCertifier certifier = this->certifier();
  if (log_->checkpoint_of(other) != nullptr && certifier.needs_thresholds(number, other))
    return log_->conflicts.add(other);
  const double until = certifier.certify(number, other, found_);
  if (bodies()[other].is_static()) return;
  // Balls that stay apart do so after a later report, too. The times of shapes are not as orderly.
  if (until == infinity && !certifier.needs_thresholds(number, other)) return;
  if (log_->batch->is_in_batch(until)) {
    log_->conflicts.add(other);
  } else {
    log_->read_set.add({other, time_, until < infinity});
  }
}

}  // namespace kinesphere
