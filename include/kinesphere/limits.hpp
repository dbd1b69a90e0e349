// The numbers that the library takes: every limit, stated once.
//
// Input beyond a limit is refused with an error that names the argument and the body. Within the limits no
// square or product that decides anything overflows or underflows: what single precision cannot square is
// looked at in double precision, and what double precision would lose to underflow is added to its margins.
// docs/guarantee.md ("Numbers of all sizes") shows why.
#pragma once

namespace kinesphere::limits {

// What a world takes.

/// The contact tolerance (length) lies between these two.
inline constexpr double least_contact_tolerance = 1e-30;
inline constexpr double largest_contact_tolerance = 1e20;

/// In contact tolerances, so 2.2e6 for the default of 1e-6: each coordinate of a position, a box or a shape,
/// radii, position errors, sensor distances and the separation distance are at most this. Then the rounding
/// of a certificate stays well within one tolerance.
inline constexpr double largest_length = 0x1p41;

/// Each component of a velocity, and a velocity error, is at most this (length / time).
inline constexpr double largest_speed = 1e100;

/// Each component of a planned acceleration, and an acceleration limit, is at most this (length / time^2).
inline constexpr double largest_acceleration = 1e100;

/// Times lie within +- this: the start of a world, and all that it advances to.
inline constexpr double largest_time = 1e30;

/// The window and the time resolution of a monitor (time) lie between this and largest_time.
inline constexpr double least_time = 1e-30;

/// Of queries, in contact tolerances: a radius or the length of a way.
inline constexpr double largest_query_length = 4.0 * largest_length;

/// Each component of the direction of a way, which may have any length but zero.
inline constexpr double largest_direction = 1e100;

// What the functions of bound.hpp take. They refuse nothing.

/// Beyond this they are certain of nothing: an earliest time is `from`, and gap limits are infinite. It
/// concerns the sum of the magnitudes of all lengths that go into a question, that of all speeds, and that of
/// all accelerations: positions, radii and the ways from the reports to `from`, say, make up the lengths.
inline constexpr double largest_size = 0x1p480;

/// So much is added to each of these sums, unless it is zero, before margins for rounding are taken from it.
/// Numbers far below it may have any size, zero included, and only make answers earlier: bodies and gaps
/// smaller than about 1e-146 cannot be told from contacts.
inline constexpr double least_size = 0x1p-480;

}  // namespace kinesphere::limits
