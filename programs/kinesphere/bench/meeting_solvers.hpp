// Three ways to the time of a colliding event, compared: how fast each is, and how wrong.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace kinesphere::program {

/// One solver on one family of pairs of bounds. An answer is late when it comes after the true meeting (of
/// the same doubles, in the precision of long double); such an answer is one of a meeting overlooked when it
/// comes by more than a thousandth of the time to go after it.
struct MeetingSolverRow {
  std::string_view pairs;    ///< the family
  std::string_view solver;   ///< certified, numeric, closed form
  double nanoseconds;        ///< for an answer
  double late_share;         ///< of the pairs that meet
  double largest_lateness;   ///< time, of answers that are late but no miss
  double deepest_overlap;    ///< length, of the bounds at the time of such an answer
  double missed_share;       ///< of the pairs that meet
  double largest_earliness;  ///< time by which an answer came too soon, for pairs that meet
};

/// Asks all solvers about `pairs` pairs of each family: bounds like those of the paper's first experiment,
/// and some that are harder. About 2 microseconds a pair. Deterministic but for the nanoseconds.
std::vector<MeetingSolverRow> compare_meeting_solvers(std::uint64_t pairs, std::uint64_t seed = 1);

}  // namespace kinesphere::program
