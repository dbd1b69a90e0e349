// Rooms for games.
#pragma once

#include <cstdint>

namespace kinesphere {

/// Returns the edge of a cubic room of which balls of this radius fill the part `packing`, to within 2^-20 of
/// it.
double edge_of_room(std::uint32_t balls, double radius, double packing);

}  // namespace kinesphere
