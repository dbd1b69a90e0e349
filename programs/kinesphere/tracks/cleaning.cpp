// Turns the samples of one id into pieces of motion: handles duplicates, impossible jumps and gaps.
#include "tracks/cleaning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

/// Samples that follow each other at a possible speed.
struct Chain {
  std::vector<std::size_t> samples;  ///< numbers
};

bool can_reach(const TrackSample& from, const TrackSample& to, double max_speed) {
  return norm(to.position - from.position) <= max_speed * (to.time - from.time);
}

std::vector<Chain> chains_of(const Piece& samples, double max_speed) {
  constexpr std::size_t looked_at = 8;
  std::vector<Chain> chains;
  std::vector<std::size_t> recent;  // chains, the most recently extended first
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const auto chain = std::find_if(recent.begin(), recent.end(), [&](std::size_t number) {
      return can_reach(samples[chains[number].samples.back()].sample, samples[k].sample, max_speed);
    });
    if (chain == recent.end()) {
      recent.insert(recent.begin(), chains.size());
      if (recent.size() > looked_at) recent.pop_back();
      chains.push_back({{k}});
    } else {
      chains[*chain].samples.push_back(k);
      std::rotate(recent.begin(), chain, chain + 1);
    }
  }
  return chains;
}

}  // namespace

void leave_one_at_each_time(Piece& samples, const std::string& id, DuplicatePolicy policy,
                            const RawTrackSet& raw, Tally& duplicates) {
  std::stable_sort(samples.begin(), samples.end(), [](const PlacedSample& a, const PlacedSample& b) {
    return a.sample.time < b.sample.time;
  });
  std::size_t kept = 0;
  for (std::size_t begin = 0; begin < samples.size();) {
    const PlacedSample first = samples[begin];
    Vec3 sum = first.sample.position;
    std::size_t end = begin + 1;
    for (; end < samples.size() && samples[end].sample.time == first.sample.time; ++end) {
      if (policy == DuplicatePolicy::fail) {
        throw ProgramError(fmt::format(
            "{}: expected one sample of id '{}' at each time, but {} has the same time (see --duplicates)",
            raw.name(samples[end].place), id, raw.name(first.place)));
      }
      raw.count(duplicates, samples[end].place);
      sum += samples[end].sample.position;
    }
    samples[kept] = first;
    if (policy == DuplicatePolicy::mean && end - begin > 1)
      samples[kept].sample.position = sum / static_cast<double>(end - begin);
    ++kept;
    begin = end;
  }
  samples.erase(samples.begin() + static_cast<std::ptrdiff_t>(kept), samples.end());
}

std::vector<Piece> split_by_speed(const Piece& samples, double max_speed, const RawTrackSet& raw,
                                  Tally& too_fast) {
  std::vector<Chain> chains = chains_of(samples, max_speed);
  std::vector<std::size_t> by_size(chains.size());
  std::iota(by_size.begin(), by_size.end(), std::size_t{0});
  std::stable_sort(by_size.begin(), by_size.end(), [&](std::size_t a, std::size_t b) {
    return chains[a].samples.size() > chains[b].samples.size();
  });
  // Kept chains by their first sample; none overlaps another.
  std::map<std::size_t, std::size_t> kept;
  for (std::size_t number : by_size) {
    const auto& chain = chains[number].samples;
    const auto after = kept.lower_bound(chain.front());
    const bool overlaps_next = after != kept.end() && after->first < chain.back();
    const bool overlaps_last =
        after != kept.begin() && chains[std::prev(after)->second].samples.back() > chain.front();
    const bool alone = chain.size() == 1 && chains.size() > 1;
    if (!overlaps_next && !overlaps_last && !alone) kept.emplace(chain.front(), number);
  }
  std::vector<bool> stays(samples.size(), false);
  std::vector<Piece> pieces;
  for (const auto& [first, number] : kept) {
    Piece& piece = pieces.emplace_back();
    for (std::size_t k : chains[number].samples) {
      stays[k] = true;
      piece.push_back(samples[k]);
    }
  }
  for (std::size_t k = 0; k < samples.size(); ++k)
    if (!stays[k]) raw.count(too_fast, samples[k].place);
  return pieces;
}

double median_interval(std::vector<double> intervals) {
  if (intervals.empty()) return 0.0;
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>((intervals.size() - 1) / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

void add_intervals(const Piece& piece, std::vector<double>& intervals) {
  for (std::size_t k = 1; k < piece.size(); ++k)
    intervals.push_back(piece[k].sample.time - piece[k - 1].sample.time);
}

std::vector<Piece> split_at_gaps(const Piece& piece, double max_gap, std::span<const double> breaks) {
  std::vector<Piece> pieces;
  for (const PlacedSample& sample : piece) {
    const double time = sample.sample.time;
    bool goes_on = !pieces.empty();
    if (goes_on) {
      const double before = pieces.back().back().sample.time;
      const auto next_break = std::lower_bound(breaks.begin(), breaks.end(), before);
      goes_on = time - before <= max_gap && (next_break == breaks.end() || *next_break > time);
    }
    if (!goes_on) pieces.emplace_back();
    pieces.back().push_back(sample);
  }
  return pieces;
}

}  // namespace kinesphere::program
