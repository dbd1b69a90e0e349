// The envelope of a recording.
#pragma once

#include "archive/envelope.hpp"

namespace kinesphere {

/// Raise the version when the steps change. What they do to a world is the snapshot's version to tell.
inline constexpr Envelope recording_envelope{{'K', 'i', 'n', 'e', 'r', 'c', '\r', '\n'},
                                             6,
                                             "recording",
                                             "Replay::open",
                                             "recording",
                                             ErrorCode::bad_recording};

}  // namespace kinesphere
