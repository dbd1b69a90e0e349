// Reading of recordings: validation of the bytes, and the events and states for a viewer.
#include <algorithm>

#include "recording/format.hpp"
#include "recording/step.hpp"

namespace kinesphere {
namespace {

bool is_valid(const Event& event) {
  return static_cast<int>(event.kind) < event_kind_count && static_cast<int>(event.wall) <= wall_count &&
         event.senses <= Senses::both;
}

/// Returns true if the last answer completes a probe call, and the outcome is possible.
bool is_valid(const step::Asking& asking) {
  if (!asking.answers.empty() && !asking.answers.back().last) return false;
  if (asking.event && (asking.failed || !asking.until || !is_valid(*asking.event))) return false;
  return true;
}

bool is_valid(const std::vector<Step>& steps) {
  if (steps.empty()) return false;
  for (const Step& step : steps) {
    if (std::holds_alternative<step::End>(step) != (&step == &steps.back())) return false;
    const auto* asking = std::get_if<step::Asking>(&step);
    if (asking && !is_valid(*asking)) return false;
  }
  return true;
}

/// Returns the number of accepted answers. If the step failed, the answers of the last probe call, at the end
/// of the list, do not count.
std::size_t accepted(const step::Asking& asking) {
  const auto& answers = asking.answers;
  if (!asking.failed || answers.empty()) return answers.size();
  const auto last_call = std::find_if(answers.rbegin() + 1, answers.rend(),
                                      [](const step::Answer& answer) { return answer.last; });
  return static_cast<std::size_t>(answers.rend() - last_call);
}

}  // namespace

Result<RecordingContent> read_content(std::span<const std::byte> recording) {
  const auto bytes = recording_envelope.open(recording);
  if (!bytes) return bytes.error();
  RecordingContent content;
  ByteReader reader(*bytes);
  reader(content.snapshot, content.has_pair_filter, content.has_rotation_probe);
  while (!reader.failed() && reader.remaining() > 0) reader(content.steps.emplace_back());
  if (reader.failed() || !is_valid(content.steps))
    return recording_envelope.refusal("must hold a recording, but its content does not have the form of one");
  return content;
}

Result<RecordedRun> read_recording(std::span<const std::byte> recording) {
  const auto content = read_content(recording);
  if (!content) return content.error();
  const auto world = World::restore(content->snapshot, [](BodyId, BodyId) { return true; });
  if (!world) return world.error();
  RecordedRun run;
  run.start_time = world->time();
  for (const Step& step : content->steps) {
    if (const auto* end = std::get_if<step::End>(&step)) run.end_time = end->time;
    const auto* asking = std::get_if<step::Asking>(&step);
    if (!asking) continue;
    for (std::size_t k = 0; k < accepted(*asking); ++k)
      run.probed_states.push_back(asking->answers[k].report);
    if (asking->event) run.events.push_back(*asking->event);
  }
  return run;
}

void StepHash::add(const World& world, const step::Asking& asking) {
  outcome_.clear();
  outcome_(world.time(), asking.failed, asking.event, world.counters());
  sum_ = checksum(outcome_.bytes(), sum_);
}

}  // namespace kinesphere
