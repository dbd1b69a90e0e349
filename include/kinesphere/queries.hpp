// Results of the spatial queries at a world's current time: World::overlapping, nearest, ray_cast,
// sphere_cast.
//
//   for (const OverlapHit& hit : world.overlapping({1, 2, 3}, 5.0).value())
//     if (hit.certainty == Certainty::certainly) ...
//
// Between probes the world knows a body only as a sphere that contains it. Results are therefore
// three-valued: bodies that are left out certainly do not match; the returned bodies match possibly or
// certainly. The overloads that take a Probe probe the undecided bodies. Then `possibly` remains only where
// position errors or rounding (relative 2^-45) decide. The world handles these reports like all others
// (answers.hpp).
//
// A static body counts with its whole shape. A ray through an edge of a triangle is as undecided as one
// that grazes a sphere. On periodic axes, regions, distances and rays extend across the border, and a body
// counts once, in its nearest image or in the first image that is hit.
#pragma once

#include "kinesphere/body.hpp"

namespace kinesphere {

/// How sure a result is.
enum class Certainty { possibly, certainly };

/// A body that overlaps a region; touching the region counts as overlap.
struct OverlapHit {
  BodyId body;
  Certainty certainty;
};

/// A body that is among the k nearest. Its surface is between `lower` and `upper` (length) from the point;
/// negative distances are depths inside the body.
struct NearestHit {
  BodyId body;
  Certainty certainty;
  double lower;
  double upper;
};

/// A body that a ray or a moving sphere hits first, after a distance between `lower` and `upper` (length):
/// 0 if the ray starts inside the body; `upper` is infinite if the ray may miss the body.
struct CastHit {
  BodyId body;
  Certainty certainty;
  double lower;
  double upper;
};

}  // namespace kinesphere
