#include "recording/recorder.hpp"

#include <limits>

#include "archive/heap_counter.hpp"
#include "number/scope_guard.hpp"

namespace kinesphere {

Recorder::Recorder(const World& world, bool has_pair_filter, bool has_rotation_probe) {
  content_(world.save().value(), has_pair_filter, has_rotation_probe);
}

void Recorder::note(const World& world, const Step& change) {
  if (const auto rebound = expectation_.rebound_of(world, change))
    content_(Step(*rebound));
  else
    content_(change);
  expectation_.note(world, change);
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
  content_(Step(step::End{world.time(), checksum(world.save().value())}));
  return recording_envelope.seal(std::exchange(content_, {}).bytes());
}

std::size_t Recorder::memory() const {
  return sizeof *this + content_.capacity() + expectation_.memory() +
         heap_bytes(asking_.bodies, asking_.answers, asking_.rotations);
}

Recorder::Listener::Listener(Recorder& recorder, const World& world, const Probe& probe,
                             std::optional<double> until)
    : recorder_(recorder), world_(world), probe_(probe) {
  step::Asking& asking = recorder_.asking_;
  asking.advances = until.has_value();
  if (until) asking.until.set(0, *until, std::exchange(recorder_.until_, *until));
  asking.bodies.clear();
  asking.answers.clear();
  asking.rotations.clear();
  asking.failed = true;
}

Recorder::Listener::~Listener() {
  step::Asking& asking = recorder_.asking_;
  if (!asking.advances && asking.answers.empty()) return;
  recorder_.hash_.add(world_, asking.failed, event_);
  asking.has_event = event_.has_value();
  asking.hash = static_cast<std::uint16_t>(recorder_.hash_.value());
  if (asking.advances) recorder_.expectation_.note(event_);
  // Written in the format of a Step, without copying the answers into one.
  recorder_.content_(static_cast<std::uint8_t>(Step(step::Asking()).index()), asking);
}

void Recorder::Listener::operator()(std::span<const BodyId> ids, double time, std::span<State> states) {
  recorder_.hash_.ask(ids, time);
  const auto note = [&](std::size_t k, const State& state) {
    if (!recorder_.asking_.advances) recorder_.asking_.bodies.push_back(ids[k]);
    recorder_.asking_.answers.push_back(recorder_.expectation_.told(world_, ids[k], time, state));
  };
  // If the probe throws, the replay gets states that are refused.
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  ScopeGuard thrown([&] {
    for (std::size_t k = 0; k < ids.size(); ++k) note(k, {{nothing, nothing, nothing}, {}});
  });
  probe_(ids, time, states);
  thrown.dismiss();
  for (std::size_t k = 0; k < ids.size(); ++k) note(k, states[k]);
}

void Recorder::Listener::succeeded(const std::optional<Event>& event) {
  recorder_.asking_.failed = false;
  event_ = event;
}

}  // namespace kinesphere
