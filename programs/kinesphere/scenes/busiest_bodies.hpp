// The bodies that cost most probes, with the reasons and advice, for a person.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "kinesphere/inspection.hpp"

namespace kinesphere::program {

/// Number of bodies that `kinesphere run --explain` lists.
inline constexpr std::size_t listed_bodies = 10;

/// Returns a row for each body, then the advice on each of their reasons. `probes` are those of all bodies.
std::string text_of_busiest(std::span<const BusyBody> busiest, std::uint64_t probes);

}  // namespace kinesphere::program
