// What the world says about space at its current time: World::overlapping, nearest, ray_cast and sphere_cast.
//
//   for (const Found& found : world.overlapping({1, 2, 3}, 5.0).value())
//     if (found.certainty == Certainty::certainly) ...
//
// Between probes the world knows a body only as a sphere that contains it. So answers have three values: a
// body that is left out is certainly not concerned, the others are so possibly or certainly. The calls that
// take a Probe ask for the states that leave something open. Then `possibly` remains only where position
// errors, or rounding (relative 2^-45), decide. Those states are reports like any other (answers.hpp).
//
// Of a fixed body the whole shape counts. A ray through an edge of a triangle is as undecided as one that
// grazes a sphere.
// Where space repeats, regions, distances and ways reach across the border. A body counts once, in its
// nearest image or in the first that is hit.
#pragma once

#include "kinesphere/body.hpp"

namespace kinesphere {

enum class Certainty { possibly, certainly };

/// A body that overlaps a region; touching it counts.
struct OverlapHit {
  BodyId body;
  Certainty certainty;
};

/// A body that is among the k nearest. Its surface is between `lower` and `upper` (length) away from the
/// point: negative distances are depths inside the body.
struct NearestHit {
  BodyId body;
  Certainty certainty;
  double lower;
  double upper;
};

/// A body that is the first on the way. It is hit after a way between `lower` and `upper` (length): 0 where
/// the way begins inside; `upper` is infinite where the body may be missed.
struct CastHit {
  BodyId body;
  Certainty certainty;
  double lower;
  double upper;
};

}  // namespace kinesphere
