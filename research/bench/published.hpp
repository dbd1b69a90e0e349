// Results that the paper reports: seconds on its machine, a MIPS R10000 at 195 MHz, per simulated second.
#pragma once

#include <cstdint>
#include <optional>

namespace kinesphere::program {

struct PublishedTimes {
  std::uint32_t bodies;
  double proposed;  ///< seconds
  double hubbard;   ///< seconds
  double ratio;     ///< as printed in the paper
};

/// Table 1 of the paper.
constexpr PublishedTimes published_table1[] = {
    {30, 0.00576, 0.94064, 163.3056},
    {100, 0.02776, 13.36050, 481.2860},
    {300, 0.15844, 150.28884, 948.5537},
    {1000, 1.37200, 2767.82990, 2017.3687},
};

/// Section 4.3 of the paper: 1000 circulating particles (seconds).
constexpr double published_circulation = 2.846;

inline std::optional<PublishedTimes> published_times(std::uint32_t bodies) {
  for (const PublishedTimes& row : published_table1)
    if (row.bodies == bodies) return row;
  return std::nullopt;
}

}  // namespace kinesphere::program
