// Passes every change from the public calls through the recorder to the engine.
#pragma once

#include "engine/engine.hpp"
#include "recording/recorder.hpp"

namespace kinesphere {

template <class Change>
World::WorldEditor World::changing(const Change& change) {
  if (recorder_) recorder_->note(*this, change);
  return changeable().changes();
}

}  // namespace kinesphere
