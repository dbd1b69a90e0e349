// Contacts that a detector overlooks, in scenes without bounces, so that all detectors watch one motion.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>

#include "simulation/detector/detector.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

/// Number of contacts of each pair, or of each body (twice) and wall.
using ContactCounts = std::map<std::tuple<std::uint32_t, std::uint32_t, Wall>, std::uint64_t>;

/// Runs the scene and counts its contacts. Throws ProgramError.
ContactCounts count_contacts(const Scene& scene, const DetectorMaker& make);

/// Returns the contacts of two bodies alone, or of a body and a wall alone.
ContactCounts body_contacts(const ContactCounts& counts);
ContactCounts wall_contacts(const ContactCounts& counts);
std::uint64_t total(const ContactCounts& counts);
/// Returns the number of contacts in `truth` that are not in `seen`.
std::uint64_t missed(const ContactCounts& truth, const ContactCounts& seen);

}  // namespace kinesphere::program
