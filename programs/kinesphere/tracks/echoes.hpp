// Samples that a second receiver has passed on later.
#pragma once

#include "tracks/cleaning.hpp"

namespace kinesphere::program {

/// Leaves out the echoes of a moving body: samples with exactly the place of one of the few samples before,
/// where two receivers hear one sender and one of them is late. Counts them. There are echoes if
/// - at least 5 samples, and a tenth of all, have a place that is at most 4 samples old;
/// - they come after another time than samples usually do: in a recording of coarse places or of bodies that
/// stop,
///   places are repeated in the rhythm of the samples;
/// - without them the fastest steps are slower by a sixth or more.
/// Places that are repeated four times and more are a rest and stay. Precondition: sorted by time.
void leave_out_echoes(Piece& samples, const RawTrackSet& raw, Tally& echoes);

}  // namespace kinesphere::program
