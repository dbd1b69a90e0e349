// The one question that the library asks: where are these bodies now, and how fast?
#pragma once

#include <span>

#include "kinesphere/body.hpp"
#include "kinesphere/callback.hpp"

namespace kinesphere {

/// Any callable `void(std::span<const BodyId> ids, double time, std::span<State> states)`. It must set
/// states[k] to the state of ids[k] at `time`; times never decrease from one call to the next. It may not
/// change the world that asks it, nor ask that world anything that could probe: such calls fail with
/// probe_in_progress. It may throw; the call of the world that asked it can then be repeated.
///
/// A Probe refers to a callable that has a name (an lvalue), which must outlive it, and owns one that has
/// none (a temporary, a lambda written in place): copies of the Probe share it. So both of these are safe:
///   world.advance(60, [&](std::span<const BodyId> ids, double time, std::span<State> states) { ... });
///   Probe probe = motion.probe();  // the motion must outlive it
/// A null function pointer or an empty std::function gives an empty Probe, which every call of a world
/// refuses with null_probe.
using Probe = Callback<void(std::span<const BodyId> ids, double time, std::span<State> states)>;

}  // namespace kinesphere
