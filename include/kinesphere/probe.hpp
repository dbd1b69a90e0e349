// Probe: the callback that gives the library the position and velocity of bodies at a time.
#pragma once

#include <span>

#include "kinesphere/body.hpp"
#include "kinesphere/callback.hpp"

namespace kinesphere {

/// Any callable `void(std::span<const BodyId> ids, double time, std::span<State> states)`. It must set
/// states[k] to the state of ids[k] at `time`; times never decrease from one call to the next. It must not
/// change the world that calls it, nor make a call of that world that could probe: such calls fail with
/// probe_in_progress. It may throw; the interrupted call of the world can then be repeated.
///
/// Given a named callable (an lvalue), a Probe refers to it, and the callable must outlive the Probe. Given
/// a temporary, such as a lambda written in place, a Probe owns it, and copies of the Probe share it. These
/// two are therefore safe:
///   world.advance(60, [&](std::span<const BodyId> ids, double time, std::span<State> states) { ... });
///   Probe probe = motion.probe();  // the motion must outlive it
/// A null function pointer or an empty std::function gives an empty Probe, which every call of a world
/// refuses with null_probe.
using Probe = Callback<void(std::span<const BodyId> ids, double time, std::span<State> states)>;

}  // namespace kinesphere
