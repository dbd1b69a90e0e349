// Reading of recordings: validation of the bytes, and the hash of what steps ask and come to.
#include "recording/step.hpp"

namespace kinesphere {
namespace {

bool is_valid(const Step& step) {
  const auto* asking = std::get_if<step::Asking>(&step);
  return !asking || !asking->has_event || (asking->advances && !asking->failed);
}

bool has_pair_filter(const Step& step) {
  const auto* set = std::get_if<step::SetPairFilter>(&step);
  return set && set->given;
}

/// Counts the steps. Returns false if they do not have the form of steps.
bool count(RecordingContent& content) {
  ByteReader reader(content.steps);
  Step step;
  while (reader.remaining() > 0) {
    if (std::holds_alternative<step::End>(step)) return false;
    reader(step);
    if (reader.failed() || !is_valid(step)) return false;
    content.needs_pair_filter = content.needs_pair_filter || has_pair_filter(step);
    ++content.step_count;
  }
  return std::holds_alternative<step::End>(step);
}

}  // namespace

Result<RecordingContent> read_content(std::span<const std::byte> recording) {
  const auto bytes = recording_envelope.open(recording);
  if (!bytes) return bytes.error();
  RecordingContent content;
  ByteReader reader(*bytes);
  reader(content.snapshot, content.has_pair_filter, content.has_rotation_probe);
  const auto steps = bytes->last(reader.remaining());
  content.steps.assign(steps.begin(), steps.end());
  content.needs_pair_filter = content.has_pair_filter;
  if (reader.failed() || !count(content))
    return recording_envelope.refusal("must hold a recording, but its content does not have the form of one");
  return content;
}

void StepHash::ask(std::span<const BodyId> bodies, double time) {
  outcome_(time, bodies.size());
  for (const BodyId body : bodies) outcome_(body);
}

void StepHash::add(const World& world, bool failed, const std::optional<Event>& event) {
  outcome_(world.time(), failed, event, world.counters());
  sum_ = checksum(outcome_.bytes(), sum_);
  outcome_.clear();
}

}  // namespace kinesphere
