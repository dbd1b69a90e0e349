// Which contacts a detector overlooks, where nobody bounces and so all detectors watch the same motion.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>

#include "simulation/detector/detector.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

/// How often each pair, or body (twice) and wall, came into contact.
using ContactCounts = std::map<std::tuple<std::uint32_t, std::uint32_t, Wall>, std::uint64_t>;

/// Throws ProgramError.
ContactCounts count_contacts(const Scene& scene, const DetectorMaker& make);

/// The contacts of two bodies alone, or of a body and a wall alone.
ContactCounts body_contacts(const ContactCounts& counts);
ContactCounts wall_contacts(const ContactCounts& counts);
std::uint64_t total(const ContactCounts& counts);
/// How many of the contacts in `truth` are not in `seen`.
std::uint64_t missed(const ContactCounts& truth, const ContactCounts& seen);

}  // namespace kinesphere::program
