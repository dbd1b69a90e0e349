// Checks for each complete detector on differential scenes, and the tests' names.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "simulation/detector/detector.hpp"
#include "simulation/scene/scene.hpp"
#include "support/differential_scenes.hpp"

namespace kinesphere::scene_tests {

/// Expects the contacts of the oracle, for bodies that pass through each other, and audits the detector.
void expect_agreement_with_oracle(const Scene& scene, const DetectorMaker& make);

/// Lets the bodies bounce, and expects that no gap falls below the tolerance on their exact paths. Bounces
/// magnify the last bit, so two correct detectors drift apart; each is checked against its own run.
void expect_no_overlaps(Scene scene, const DetectorMaker& make);

/// The families of scenes in which bodies can bounce.
inline constexpr Family bouncing_families[] = {Family::random_forces, Family::velocity_field,
                                               Family::ballistic, Family::points};

}  // namespace kinesphere::scene_tests
