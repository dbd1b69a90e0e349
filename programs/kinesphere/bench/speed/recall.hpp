// How many contacts fixed steps overlook.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "bench/contact_counts.hpp"
#include "bench/speed/step_kernel.hpp"

namespace kinesphere::program {

/// Of the contacts in `truth`, which are those of this scene, in which all pass through each other. A pair
/// that touches in one step and not in the one before is a contact.
std::uint64_t missed_by_steps(const Scene& scene, const ContactCounts& truth, double step, std::size_t steps,
                              SphereTest test);

}  // namespace kinesphere::program
