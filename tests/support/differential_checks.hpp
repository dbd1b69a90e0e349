// What each detector that misses nothing must hold on a differential scene, and the tests' names.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "simulation/detector/detector.hpp"
#include "simulation/scene/scene.hpp"
#include "support/differential_scenes.hpp"

namespace kinesphere::scene_tests {

/// Expects, for bodies that pass through each other, the contacts of the oracle, and audits the detector on
/// the way.
void expect_agreement_with_oracle(const Scene& scene, const DetectorMaker& make);

/// Lets the bodies bounce, and expects that no gap falls below the tolerance on the exact paths that they
/// then take. Bounces magnify the last bit, so two correct detectors drift apart, and each is held against
/// its own run.
void expect_no_overlaps(Scene scene, const DetectorMaker& make);

/// The families whose bodies can bounce.
inline constexpr Family bouncing_families[] = {Family::random_forces, Family::velocity_field,
                                               Family::ballistic, Family::points};

}  // namespace kinesphere::scene_tests
