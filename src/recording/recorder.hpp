// Recorder: records the steps of a world as they happen.
#pragma once

#include "recording/expectation.hpp"
#include "recording/step.hpp"

namespace kinesphere {

class Recorder {
 public:
  /// Starts a recording with a snapshot of the world. Precondition: no probe of the world is running.
  Recorder(const World& world, bool has_pair_filter, bool has_rotation_probe);

  /// Records a change of the world, before it is made.
  void note(const World& world, const Step& change);

  /// Returns a probe that asks `probe` and records its answers; an empty one if `probe` is empty. The
  /// recorder must outlive it.
  RotationProbe listen_to(RotationProbe probe);
  /// Returns the probe that listen_to() was given.
  const RotationProbe& rotation_probe() const { return rotation_probe_; }

  /// Returns the complete recording and leaves the recorder empty.
  std::vector<std::byte> finish(const World& world);

  /// Returns the memory in use, in bytes.
  std::size_t memory() const;

  class Listener;

 private:
  ByteWriter content_;
  StepHash hash_;
  Expectation expectation_;
  double until_ = 0.0;   ///< argument of the last advance
  step::Asking asking_;  ///< Member, so that its memory is reused.
  RotationProbe rotation_probe_;
};

/// A probe that forwards each call to another probe and records its answers. The destructor completes the
/// step, also during stack unwinding.
class Recorder::Listener {
 public:
  Listener(Recorder& recorder, const World& world, const Probe& probe, std::optional<double> until = {});
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener();

  void operator()(std::span<const BodyId> ids, double time, std::span<State> states);
  /// Marks the step as successful. Without this call, the step counts as failed: a refused answer or an
  /// exception.
  void succeeded(const std::optional<Event>& event = {});

 private:
  Recorder& recorder_;
  const World& world_;
  const Probe& probe_;
  std::optional<Event> event_;
};

}  // namespace kinesphere
