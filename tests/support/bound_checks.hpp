// Compares a certificate with its slow twin: it must never be late, and not needlessly early.
#pragma once

#include <gtest/gtest.h>

#include "support/bound_cases.hpp"
#include "support/exact_certificates.hpp"

namespace kinesphere {

/// How early a certificate may be: as if the distance were wrong by `length` (relative to the lengths that
/// enter the question), and then by `part` of the time to go, and two units in the last place of the clock.
struct Tightness {
  double length = 0x1p-43;
  double part = 1e-6;
};

/// Checks, without tolerance, that `certificate` lies in [from, horizon] or is +infinity, and is no later
/// than `truth`.
inline testing::AssertionResult never_late(double certificate, exact::Wide truth, double from,
                                           double horizon) {
  if (exact::Wide(certificate) > truth)
    return testing::AssertionFailure()
           << "certificate " << certificate << " is later than " << static_cast<double>(truth) << " by "
           << static_cast<double>(certificate - truth);
  if (certificate != infinity && !(certificate >= from && certificate <= horizon))
    return testing::AssertionFailure()
           << "certificate " << certificate << " outside of [" << from << ", " << horizon << "]";
  return testing::AssertionSuccess();
}

/// `truth` is the time for a distance with the largest allowed error.
inline testing::AssertionResult hardly_early(double certificate, exact::Wide truth, double from,
                                             double horizon, double part) {
  const exact::Wide end = exact::min(truth, horizon);
  const exact::Wide allowed = part * (end - from) + 0x1p-51 * std::abs(certificate);
  if (exact::Wide(certificate) >= end - allowed) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "certificate " << certificate << " is far from "
                                     << static_cast<double>(truth);
}

}  // namespace kinesphere
