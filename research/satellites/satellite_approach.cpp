#include "research/satellites/satellite_approach.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>

namespace kinesphere {
namespace {

std::tuple<std::uint32_t, std::uint32_t> pair_of(const SatelliteApproach& approach) {
  return {approach.first, approach.second};
}

/// Calls visit(approach, first, last) for each approach, with the range of `others` of that pair.
template <class Visit>
void for_each_with_others(const std::vector<SatelliteApproach>& approaches,
                          const std::vector<SatelliteApproach>& others, Visit visit) {
  std::size_t from = 0, to = 0;
  for (const SatelliteApproach& approach : approaches) {
    while (from < others.size() && pair_of(others[from]) < pair_of(approach)) ++from;
    to = std::max(to, from);
    while (to < others.size() && pair_of(others[to]) == pair_of(approach)) ++to;
    visit(approach, from, to);
  }
}

}  // namespace

void sort_by_pair(std::vector<SatelliteApproach>& approaches) {
  std::sort(approaches.begin(), approaches.end(), [](const SatelliteApproach& a, const SatelliteApproach& b) {
    return std::tie(a.first, a.second, a.begin, a.end) < std::tie(b.first, b.second, b.begin, b.end);
  });
}

std::vector<SatelliteApproach> not_inside(const std::vector<SatelliteApproach>& approaches,
                                          const std::vector<SatelliteApproach>& others, double step) {
  /// Returns the first multiple of the step after `time`.
  const auto next = [step](double time) {
    return step > 0.0 ? (std::floor(time / step) + 1.0) * step : time;
  };
  std::vector<SatelliteApproach> outside;
  for_each_with_others(approaches, others,
                       [&](const SatelliteApproach& approach, std::size_t from, std::size_t to) {
                         bool has_begun = false;
                         double covered = approach.begin;
                         for (std::size_t k = from; k < to; ++k) {
                           const auto& [first, second, begin, end] = others[k];
                           if (begin <= approach.begin && approach.begin <= end) has_begun = true;
                           if (has_begun && begin <= next(covered)) covered = std::max(covered, end);
                         }
                         if (!has_begun || covered < approach.end) outside.push_back(approach);
                       });
  return outside;
}

std::vector<SatelliteApproach> not_met(const std::vector<SatelliteApproach>& approaches,
                                       const std::vector<SatelliteApproach>& others) {
  std::vector<SatelliteApproach> alone;
  for_each_with_others(approaches, others,
                       [&](const SatelliteApproach& approach, std::size_t from, std::size_t to) {
                         for (std::size_t k = from; k < to; ++k)
                           if (others[k].begin <= approach.end && approach.begin <= others[k].end) return;
                         alone.push_back(approach);
                       });
  return alone;
}

}  // namespace kinesphere
