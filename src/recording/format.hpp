// Envelope of a recording: magic bytes, version and error.
#pragma once

#include "archive/envelope.hpp"

namespace kinesphere {

/// Raise the version when the serialized steps change. The snapshot's version covers changes of their effect
/// on a world.
inline constexpr Envelope recording_envelope{{'K', 'i', 'n', 'e', 'r', 'c', '\r', '\n'},
                                             13,
                                             "recording",
                                             "Replay::open",
                                             "recording",
                                             ErrorCode::bad_recording};

}  // namespace kinesphere
