#include "tracks/midnights.hpp"

#include <algorithm>
#include <cstddef>

namespace kinesphere::program {
namespace {

struct ClockRow {
  Place place;
  std::size_t track;
  FileTime* time;
  std::int64_t midnights = 0;  ///< before it
};

/// Counts midnights: a clock that falls by half a day or more has passed one.
class MidnightCounter {
 public:
  /// Returns the midnights before the next time, one less for a row that is a little late, from before the
  /// last midnight. Nothing for a time that falls by less than half a day, but for late rows.
  std::optional<std::int64_t> add(const FileTime& time) {
    constexpr double latest = 600.0, half_a_day = 43'200.0, whole_day = 86'400.0;
    const double ahead = last_ ? seconds_between(*last_, time) : 0.0;
    if (ahead < -latest && ahead > -half_a_day) return std::nullopt;
    if (ahead >= whole_day - latest && time.whole < 86'400) return passed_ - 1;
    if (ahead <= -half_a_day) ++passed_;
    last_ = time;
    return passed_;
  }

 private:
  std::optional<FileTime> last_;
  std::int64_t passed_ = 0;
};

std::vector<ClockRow> clocks_of(std::vector<RawTrack>& tracks, std::uint32_t file) {
  std::vector<ClockRow> clocks;
  for (std::size_t track = 0; track < tracks.size(); ++track) {
    for (RawSample& sample : tracks[track].samples)
      if (sample.place.file == file) clocks.push_back({sample.place, track, &sample.time});
    for (RawTrack::Placeless& at : tracks[track].timed_placeless)
      if (at.place.file == file) clocks.push_back({at.place, track, &at.time});
  }
  std::stable_sort(clocks.begin(), clocks.end(),
                   [](const ClockRow& a, const ClockRow& b) { return a.place.line < b.place.line; });
  return clocks;
}

/// True if the rows of each track follow each other.
bool are_together(const std::vector<ClockRow>& clocks, std::size_t tracks) {
  std::vector<bool> seen(tracks);
  for (std::size_t k = 0; k < clocks.size(); ++k) {
    if (k > 0 && clocks[k - 1].track == clocks[k].track) continue;
    if (seen[clocks[k].track]) return false;
    seen[clocks[k].track] = true;
  }
  return true;
}

/// Returns the first row of a track that passes no midnight.
std::optional<Place> track_of_one_day(const std::vector<ClockRow>& clocks) {
  for (std::size_t begin = 0, end = 0; begin < clocks.size(); begin = end) {
    bool has_passed = false;
    for (; end < clocks.size() && clocks[end].track == clocks[begin].track; ++end)
      has_passed = has_passed || clocks[end].midnights > 0;
    if (!has_passed) return clocks[begin].place;
  }
  return std::nullopt;
}

/// Returns the first row behind a midnight that no track passes: another scene may begin there.
std::optional<Place> midnight_of_no_track(const std::vector<ClockRow>& clocks, std::size_t tracks) {
  std::vector<const ClockRow*> before(tracks);
  std::vector<const ClockRow*> first;  // of each day but that of the first row
  std::vector<bool> is_passed;
  for (const ClockRow& clock : clocks) {
    const auto day = static_cast<std::size_t>(clock.midnights);
    if (day > first.size()) {
      first.push_back(&clock);
      is_passed.push_back(false);
    }
    const ClockRow* const earlier = before[clock.track];
    if (day > 0 && earlier != nullptr && earlier->midnights == clock.midnights - 1) is_passed[day - 1] = true;
    before[clock.track] = &clock;
  }
  const auto unclear = std::find(is_passed.begin(), is_passed.end(), false);
  if (unclear == is_passed.end()) return std::nullopt;
  return first[static_cast<std::size_t>(unclear - is_passed.begin())]->place;
}

}  // namespace

Midnights pass_midnights(std::vector<RawTrack>& tracks, std::uint32_t file) {
  std::vector<ClockRow> clocks = clocks_of(tracks, file);
  const bool together = are_together(clocks, tracks.size());
  std::vector<MidnightCounter> counters(together ? tracks.size() : 1);
  Midnights result;
  for (ClockRow& clock : clocks) {
    const auto midnights = counters[together ? clock.track : 0].add(*clock.time);
    if (!midnights) return {};
    clock.midnights = *midnights;
    // It is late, from before the first row, or the clock stood still for a day.
    if (*midnights < 0) return {.has_passed = true, .unclear = clock.place};
    result.has_passed = result.has_passed || *midnights > 0;
  }
  if (!result.has_passed) return result;
  result.unclear = together ? track_of_one_day(clocks) : midnight_of_no_track(clocks, tracks.size());
  if (result.unclear) return result;
  constexpr std::int64_t day = 86'400;
  for (const ClockRow& clock : clocks) clock.time->whole += day * clock.midnights;
  return result;
}

}  // namespace kinesphere::program
