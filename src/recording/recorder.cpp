#include "recording/recorder.hpp"

#include "archive/heap_counter.hpp"
#include "recording/format.hpp"

namespace kinesphere {

Recorder::Recorder(const World& world, bool has_pair_filter, bool has_rotation_probe) {
  content_(world.save().value(), has_pair_filter, has_rotation_probe);
}

RotationProbe Recorder::listen_to(RotationProbe probe) {
  rotation_probe_ = std::move(probe);
  if (!rotation_probe_) return {};
  return [this](std::span<const BodyId> ids, double time, std::span<Rotation> rotations) {
    // As in Listener: the probe may throw.
    const std::size_t first = asking_.rotations.size();
    for (std::size_t k = 0; k < ids.size(); ++k) asking_.rotations.push_back({time, ids[k], rotations[k]});
    rotation_probe_(ids, time, rotations);
    for (std::size_t k = 0; k < ids.size(); ++k) asking_.rotations[first + k].rotation = rotations[k];
  };
}

std::vector<std::byte> Recorder::finish(const World& world) {
  note(step::End{world.time(), checksum(world.save().value())});
  return recording_envelope.seal(std::exchange(content_, {}).bytes());
}

std::size_t Recorder::memory() const {
  return sizeof *this + content_.capacity() + heap_bytes(asking_.answers, asking_.rotations);
}

Recorder::Listener::Listener(Recorder& recorder, const World& world, const Probe& probe,
                             std::optional<double> until)
    : recorder_(recorder), world_(world), probe_(probe) {
  step::Asking& asking = recorder_.asking_;
  asking.until = until;
  asking.answers.clear();
  asking.rotations.clear();
  asking.failed = true;
  asking.event.reset();
}

Recorder::Listener::~Listener() {
  if (!recorder_.asking_.until && recorder_.asking_.answers.empty()) return;
  recorder_.hash_.add(world_, recorder_.asking_);
  recorder_.asking_.hash = recorder_.hash_.value();
  // Written in the format of a Step, without copying the answers into one.
  recorder_.content_(static_cast<std::uint8_t>(Step(step::Asking()).index()), recorder_.asking_);
}

void Recorder::Listener::operator()(std::span<const BodyId> ids, double time, std::span<State> states) {
  // The states before the call stand in until the probe has returned, since it may throw.
  auto& answers = recorder_.asking_.answers;
  const std::size_t first = answers.size();
  for (std::size_t k = 0; k < ids.size(); ++k)
    answers.push_back({{time, ids[k], states[k]}, k + 1 == ids.size()});
  probe_(ids, time, states);
  for (std::size_t k = 0; k < ids.size(); ++k) answers[first + k].report.state = states[k];
}

void Recorder::Listener::succeeded(const std::optional<Event>& event) {
  recorder_.asking_.failed = false;
  recorder_.asking_.event = event;
}

}  // namespace kinesphere
