// Contacts that fixed steps see.
#pragma once

#include <cstddef>
#include "research/bench/contact_counts.hpp"
#include "research/bench/speed/step_kernel.hpp"

namespace kinesphere::program {

/// Counts the contacts in a scene in which all bodies pass through each other. A pair that touches in one
/// step and not in the step before is a contact.
ContactCounts contacts_at_steps(const Scene& scene, double step, std::size_t steps, SphereTest test);

}  // namespace kinesphere::program
