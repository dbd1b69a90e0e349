// A detector that checks what it is handed, in front of one that does not.
#pragma once

#include <memory>

#include "engine/validation.hpp"
#include "simulation/detector/detector.hpp"

namespace kinesphere {

/// How the detector takes the definitions of new bodies.
enum class NewBodies { unchecked, checked_by_itself };

/// `bodies` is how many the motion has.
std::unique_ptr<Detector> with_checked_input(std::unique_ptr<Detector> detector,
                                             const WorldDefinition& definition, std::size_t bodies,
                                             NewBodies new_bodies = NewBodies::unchecked);

/// Only the world knows of space that repeats and of the plane.
Result<void> check_whole_space(const WorldDefinition& definition);

/// A detector made by its constructor, once the world has been found to be fit, and with checked input.
template <class Made, class... Options>
Result<std::unique_ptr<Detector>> make_checked(const WorldDefinition& definition, const Motion& motion,
                                               Options&&... options) {
  if (auto valid = first_error(check_world(definition), check_whole_space(definition)); !valid)
    return valid.error();
  return with_checked_input(std::make_unique<Made>(definition, motion, std::forward<Options>(options)...),
                            definition, motion.size());
}

}  // namespace kinesphere
