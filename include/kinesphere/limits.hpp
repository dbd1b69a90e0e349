// Limits of all numbers that the library accepts, each stated once.
//
// Input beyond a limit is refused with an error that names the argument and the body. Within the limits no
// square or product that affects a decision overflows or underflows: values that single precision cannot
// square are computed in double precision, and values that double precision would lose to underflow are
// added to its margins. docs/guarantee.md ("Numbers of all sizes") gives the reasons.
#pragma once

#include <cstddef>

namespace kinesphere::limits {

// Limits of a world's input.

/// Range of the contact tolerance (length).
inline constexpr double least_contact_tolerance = 1e-30;
inline constexpr double largest_contact_tolerance = 1e20;

/// Largest length, in contact tolerances; 2.2e6 for the default of 1e-6. It limits each coordinate of a
/// position, a box or a shape, radii, position errors, sensor distances and the separation distance. It
/// keeps the rounding of a certificate well within one tolerance.
inline constexpr double largest_length = 0x1p41;

/// Largest coordinate of a reported position on an axis that is periodic, in contact tolerances. The world
/// takes the image in the box of each report, so reports may lie far outside. Beyond this, doubles no longer
/// tell positions apart that differ by a 64th of the tolerance.
inline constexpr double largest_image = 0x1p47;

/// Largest number of points of a part of a rigid body.
inline constexpr std::size_t most_hull_points = 64;

/// A mesh has fewer triangles than this.
inline constexpr std::size_t most_triangles = std::size_t{1} << 31;

/// Largest component of a velocity, and largest velocity error (length / time).
inline constexpr double largest_speed = 1e100;

/// Largest component of a planned acceleration, and largest acceleration limit (length / time^2).
inline constexpr double largest_acceleration = 1e100;

/// Largest absolute value of a time: the start of a world, and all times to which it advances.
inline constexpr double largest_time = 1e30;

/// Least window and least time resolution of a monitor (time); largest_time is their maximum.
inline constexpr double least_time = 1e-30;

/// Largest radius, distance or ray length of a query, in contact tolerances.
inline constexpr double largest_query_length = 4.0 * largest_length;

/// Largest component of a ray's direction, which may have any length except zero.
inline constexpr double largest_direction = 1e100;

// Limits of the functions of bound.hpp, which refuse nothing.

/// Size beyond which these functions give no certain result: an earliest time is `from`, and gap limits are
/// infinite. It applies to the sum of the magnitudes of all lengths that enter a computation, to that of
/// all speeds and to that of all accelerations. Lengths include positions, radii and the distances
/// travelled from the reports to `from`.
inline constexpr double largest_size = 0x1p480;

/// Amount added to each of these sums, unless it is zero, before rounding margins are computed from it.
/// Numbers far below it may have any size, including zero, and only make results earlier: bodies and gaps
/// smaller than about 1e-146 are indistinguishable from contacts.
inline constexpr double least_size = 0x1p-480;

}  // namespace kinesphere::limits
