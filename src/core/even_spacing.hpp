// How far things are apart that are spread evenly.
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>

#include "number/roots.hpp"

namespace kinesphere::core {

/// Returns how far so many points are apart that are spread evenly over a box with these edges, or over fewer
/// dimensions if it is flat. Sorts the edges.
inline double even_spacing(double (&edges)[3], double count) {
  std::sort(std::begin(edges), std::end(edges));
  const double volume = edges[0] * edges[1] * edges[2];
  double distance = volume > 0.0 ? cube_root(volume / count) : 0.0;
  if (!(edges[0] > distance)) distance = std::sqrt(edges[1] * edges[2] / count);
  if (!(edges[1] > distance)) distance = edges[2] / count;
  return distance;
}

}  // namespace kinesphere::core
