// Approaches of bodies on known paths: all times at which two of them are near each other, and all local
// minima of their distance.
//
//   PolynomialPaths paths;                       // two bodies, one arc each, x(t) = c0 + c1 t
//   const std::uint32_t bodies[] = {0, 1};
//   const double begins[] = {0, 0}, ends[] = {10, 10};
//   const double coefficients[] = {0, 1, 0, 0, 0, 0,  9, -1, 0, 0, 2, 0};
//   paths.basis = PolynomialPaths::Basis::monomial;
//   paths.terms = 2;
//   paths.bodies = bodies, paths.begins = begins, paths.ends = ends, paths.coefficients = coefficients;
//   const Approaches near = Approaches::of(paths, 3.0).value();
//   // near.minima[0]: distance 2 at time 4.5
//
// Where paths are not known in advance, a World or a Monitor finds what happens.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <ranges>
#include <span>
#include <type_traits>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/callback.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/workers.hpp"

namespace kinesphere {

/// Paths as polynomials of time, arc after arc: for each arc its body, its times, and for each axis (x, y, z)
/// `terms` coefficients. It refers to arrays of the caller, which must stay as they are during a call; a
/// temporary array does not compile.
///
/// The arcs of a body are in the order of time and do not overlap. A body exists during its arcs: one may
/// begin later than others, end earlier, or be absent in between. Where one arc ends and the next begins at
/// the same time the path may jump; it is then taken to go straight from one place to the other at that time.
struct PolynomialPaths {
  /// What the coefficients multiply.
  enum class Basis {
    chebyshev,  ///< sum of c_k T_k(u), with u = (2 t - begin - end) / (end - begin) in [-1, 1]
    monomial    ///< sum of c_k (t - begin)^k
  };
  /// Largest number of coefficients of an axis.
  static constexpr std::size_t most_terms = 24;
  /// An array of the caller, by reference: whatever std::span takes, but for temporaries that own their
  /// numbers.
  template <class T>
  class Array : public std::span<const T> {
   public:
    Array() = default;
    /// Refers to `numbers`, which must live until the call is over.
    template <class Numbers>
    requires std::is_constructible_v<std::span<const T>, Numbers> && std::ranges::borrowed_range<Numbers>
    Array(Numbers&& numbers) : std::span<const T>(numbers) {}
    /// A temporary would be gone before the call.
    template <class Numbers>
    requires std::is_constructible_v<std::span<const T>, Numbers> &&
        (!std::ranges::borrowed_range<Numbers>)Array(Numbers&&) = delete;
  };

  Basis basis = Basis::chebyshev;
  std::size_t terms = 0;          ///< coefficients for each axis, from 1 to most_terms
  Array<std::uint32_t> bodies{};  ///< number of each arc's body; must not decrease
  Array<double> begins{};         ///< begin of each arc (time)
  Array<double> ends{};           ///< end of each arc (time), after its begin
  Array<double> coefficients{};   ///< 3 * terms of each arc: those of x, of y, of z
  /// For each body how far it may be from its polynomials (length, >= 0). Empty: nothing for all.
  Array<double> errors{};

  /// Number of bodies: those of `errors`, or one more than the largest number in `bodies`.
  std::size_t body_count() const;
};

/// Any callable `void(double done)`: the part of the work that is done, rising to 1. It is called in the
/// thread that called, a few hundred times at most. It may throw, which ends the call.
using ProgressFn = Callback<void(double done)>;

/// All approaches of pairs, certified: outside of them the two are farther apart than the distance.
class Approaches {
 public:
  /// Least distance of two bodies for some time around it.
  struct Minimum {
    std::size_t approach = 0;  ///< index of its approach
    double time = 0.0;
    double distance = 0.0;    ///< of the polynomials
    State first{}, second{};  ///< of the polynomials
    bool is_cut_off = false;  ///< the distance still falls toward the begin or end of a path or of the search

    /// Return the position and the velocity of the second body relative to the first.
    Vec3 relative_position() const { return second.position - first.position; }
    Vec3 relative_velocity() const { return second.velocity - first.velocity; }

    friend constexpr bool operator==(const Minimum&, const Minimum&) = default;
  };

  /// A span of time during which two bodies may be within the distance of each other: the distance of their
  /// polynomials is at most the distance asked for plus their errors, and larger before and after.
  struct Approach {
    std::uint32_t first = 0, second = 0;  ///< numbers of the bodies, first < second
    double begin = 0.0, end = 0.0;
    bool begins_with_path = false;  ///< a path, or the search, begins at `begin`
    bool ends_with_path = false;    ///< a path, or the search, ends at `end`
    bool is_certain = false;        ///< the two are within the distance, whatever the errors are
    std::size_t closest = 0;        ///< index of its least minimum

    friend constexpr bool operator==(const Approach&, const Approach&) = default;
  };

  /// What a search leaves out, and the threads that it may use.
  struct Options {
    /// Approaches of this body alone, instead of all pairs.
    std::optional<std::uint32_t> body{};
    /// The search leaves out what is before `begin` and after `end` (time).
    std::optional<double> begin{}, end{};
    /// Threads; none: the caller's alone. Results are the same for any number.
    Workers* workers = nullptr;
    std::optional<ProgressFn> progress{};
  };

  /// Finds all approaches to within `distance` (length, > 0).
  ///
  /// What is certain: at a time outside of all approaches of a pair, the two are farther apart than
  /// `distance` if each is within its error of its polynomial. Each local minimum of the polynomials'
  /// distance during an approach is in `minima`, but for those with a rise of at most twice the sum of the
  /// two errors next to them, which may be none of the true paths; an approach has at least one. Distances
  /// and times are right to within rounding: about 2^-44 of the largest coordinate.
  ///
  /// Cost: half a microsecond to one for each body and step of time; steps are chosen by trial to suit
  /// speeds, density and curvature. Some microseconds for each pair and step that pass near each other.
  /// Memory: 1.3 kB for each body in each thread, 8 bytes for each arc, and the results.
  ///
  /// Errors: out_of_range or not_finite, naming argument and body, for arrays that do not fit each other,
  /// times out of order, and numbers beyond limits.hpp; unknown_body; workers_busy; null_callback.
  [[nodiscard]] static Result<Approaches> of(const PolynomialPaths& paths, double distance,
                                             const Options& options);
  [[nodiscard]] static Result<Approaches> of(const PolynomialPaths& paths, double distance) {
    return of(paths, distance, Options{});
  }

  std::vector<Approach> approaches{};  ///< by begin, then by the numbers of the bodies
  std::vector<Minimum> minima{};       ///< by approach, and in each by time
  double step = 0.0;                   ///< length of the steps that the search took (time)
};

/// Returns the parts of a vector in the frame of a body's orbit about the origin: radial (away from the
/// origin), in-track (at right angles to it, on the side of the velocity) and cross-track (along position x
/// velocity), as CCSDS's RTN. NaN where that has no direction: the last two parts on a way straight from or
/// to the origin.
Vec3 in_orbital_frame(const State& body, const Vec3& vector);

}  // namespace kinesphere
