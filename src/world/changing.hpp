// The way of every change from the public calls into the engine: past the recorder.
#pragma once

#include "engine/engine.hpp"
#include "recording/recorder.hpp"

namespace kinesphere {

template <class Change>
World::WorldEditor World::changing(const Change& change) {
  if (recorder_) recorder_->note(change);
  return changeable().changes();
}

}  // namespace kinesphere
