// The recorder: writes down the steps of a world while they are made.
#pragma once

#include <utility>

#include "recording/step.hpp"

namespace kinesphere {

class Recorder {
 public:
  /// The world must not be in a probe.
  Recorder(const World& world, bool has_pair_filter);

  /// A change that is made.
  void note(const Step& change) { content_(change); }

  /// The whole recording. The recorder is empty then.
  std::vector<std::byte> finish(const World& world);

  /// Bytes that it holds.
  std::size_t memory() const;

  class Listener;

 private:
  ByteWriter content_;
  StepHash hash_;
  step::Asking asking_;  ///< kept for its memory
};

/// A probe that passes questions on to another and writes down what that answers. When it goes, also while an
/// exception passes, the step is complete.
class Recorder::Listener {
 public:
  Listener(Recorder& recorder, const World& world, const Probe& probe, std::optional<double> until = {});
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener();

  void operator()(std::span<const BodyId> ids, double time, std::span<State> states);
  /// The call has come to its end. An error in it is a refused answer.
  void succeeded(const std::optional<Event>& event = {});

 private:
  Recorder& recorder_;
  const World& world_;
  const Probe& probe_;
};

}  // namespace kinesphere
