// How far two tracks are from each other now: an estimate, and limits of the vertical distance.
#pragma once

#include <optional>

#include "kinesphere/monitor/monitor.hpp"

namespace kinesphere::program {

/// Lengths, >= 0, in the plane or space of the monitor.
struct PairDistance {
  /// Distance if both have gone straight on since their latest reports. An estimate, not a bound. Of a
  /// cylinder and of well clear it is that in the plane; of an ellipsoid heights are stretched to its width.
  double likely = 0.0;
  /// The vertical distance; empty in two dimensions.
  struct Vertical {
    double likely = 0.0;              ///< an estimate, as above
    double lower = 0.0, upper = 0.0;  ///< limits, wherever in their errors the two are
  };
  std::optional<Vertical> vertical{};
};

/// Returns how far two tracks are apart now. Precondition: the monitor has both. Cost: O(1).
PairDistance distance_now(const Monitor& monitor, const Separation& separation, TrackId first,
                          TrackId second);

}  // namespace kinesphere::program
