// A detector that checks the arguments of each call before it passes them on to a detector that does not
// check.
#pragma once

#include <memory>

#include "bodies/validation.hpp"
#include "simulation/detector/detector.hpp"

namespace kinesphere {

/// NewBodies says which detector checks the definitions of new bodies: the wrapper (unchecked), or the
/// wrapped one.
enum class NewBodies { unchecked, checked_by_itself };

/// Wraps `detector` so that wrong arguments are answered with an Error and never reach it. `bodies` is the
/// number of bodies in the motion; numbers from `bodies` on are unknown_body.
std::unique_ptr<Detector> with_checked_input(std::unique_ptr<Detector> detector,
                                             const WorldDefinition& definition, std::size_t bodies,
                                             NewBodies new_bodies = NewBodies::unchecked);

/// Returns unsupported for periodic space and for the plane, which only the world supports.
Result<void> check_whole_space(const WorldDefinition& definition);

/// Checks the world definition, constructs a Made and wraps it by with_checked_input(). Errors: those of
/// check_world() and check_whole_space().
template <class Made, class... Options>
Result<std::unique_ptr<Detector>> make_checked(const WorldDefinition& definition, const Motion& motion,
                                               Options&&... options) {
  if (auto valid = first_error(check_world(definition), check_whole_space(definition)); !valid)
    return valid.error();
  return with_checked_input(std::make_unique<Made>(definition, motion, std::forward<Options>(options)...),
                            definition, motion.size());
}

}  // namespace kinesphere
