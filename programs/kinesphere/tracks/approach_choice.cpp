// Which approaches of a track set are wanted.
#include "tracks/approach_choice.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <set>
#include <string_view>

#include "base/program_error.hpp"
#include "base/validators.hpp"
#include "formats/fields/time_text.hpp"

namespace kinesphere::program {
namespace {

/// Returns seconds of the track set.
double window_time(const std::string& text, std::string_view option, const TrackSet& track_set) {
  const auto time = time_field(text, track_set.dates);
  const bool counts_frames = track_set.times.kind() == TimeKind::frames;
  const TimeKind kind = counts_frames ? TimeKind::number : track_set.times.kind();
  if (time && time->kind == kind) return track_set.times.seconds(time->time);
  throw ProgramError(fmt::format("{}: expected a time as in the file, {}{}, but got '{}'", option,
                                 name_of(track_set.times.kind()),
                                 kind == TimeKind::utc ? ", such as 2024-05-01T08:00:00Z" : "", text));
}

TimeWindow span_of(const TrackSet& track_set) {
  const RecordedTrack& any = track_set.tracks.front();
  TimeWindow span{any.from(), any.until()};
  for (const RecordedTrack& track : track_set.tracks) {
    span.from = std::min(span.from, track.from());
    span.until = std::max(span.until, track.until());
  }
  return span;
}

TimeWindow asked_window(const ApproachChoice& choice, const TrackSet& track_set) {
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  return {choice.from.empty() ? -unbounded : window_time(choice.from, "--from", track_set),
          choice.until.empty() ? unbounded : window_time(choice.until, "--until", track_set)};
}

TimeWindow chosen_window(const ApproachChoice& choice, const TimeWindow& asked, const TrackSet& track_set) {
  const TimeWindow span = span_of(track_set);
  const TimeWindow window{std::max(span.from, asked.from), std::min(span.until, asked.until)};
  if (window.from >= span.until && !choice.from.empty())
    throw ProgramError(fmt::format("--from: expected a time before the recording's end {}, but got '{}'",
                                   track_set.times.text(span.until), choice.from));
  if (window.until <= span.from && !choice.until.empty())
    throw ProgramError(fmt::format("--until: expected a time after the recording's begin {}, but got '{}'",
                                   track_set.times.text(span.from), choice.until));
  if (window.from >= window.until && !choice.from.empty())
    throw ProgramError(
        fmt::format("--until: expected a time after --from {}, but got '{}'", choice.from, choice.until));
  return window;
}

/// Returns the ids of `text`, which is one id or several joined by commas.
std::vector<std::string> listed_ids(const std::string& text, const std::set<std::string_view>& known) {
  if (known.contains(text)) return {text};
  std::vector<std::string> ids;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    ids.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return ids;
}

std::vector<bool> chosen_tracks(const ApproachChoice& choice, const TrackSet& track_set) {
  if (choice.only.empty()) return {};
  std::set<std::string_view> known;
  for (const RecordedTrack& track : track_set.tracks) known.insert(track.id);
  std::set<std::string> chosen;
  for (const std::string& text : choice.only) {
    for (const std::string& id : listed_ids(text, known)) {
      if (!known.contains(id))
        throw ProgramError(fmt::format("--only: expected an id that has a track, such as '{}', but got '{}'",
                                       *known.begin(), id));
      chosen.insert(id);
    }
  }
  std::vector<bool> tracks;
  for (const RecordedTrack& track : track_set.tracks) tracks.push_back(chosen.contains(track.id));
  return tracks;
}

double least_duration(const ApproachChoice& choice) {
  const double duration = choice.min_duration.value_or(0.0);
  if (duration >= 0.0) return duration;
  throw ProgramError(fmt::format("--min-duration: expected a number >= 0, but got {}", duration));
}

}  // namespace

void add_choice_options(CLI::App& command, ApproachChoice& choice) {
  constexpr const char* group = "Which approaches";
  command.add_option("--from", choice.from, "From this time on: a number or a date, as in the file")
      ->type_name("TIME")
      ->group(group);
  command.add_option("--until", choice.until, "Until this time: a number or a date, as in the file")
      ->type_name("TIME")
      ->group(group);
  command
      .add_option("--only", choice.only, "Only approaches of these ids, with each other and with all others")
      ->type_name("ID[,ID...]")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group(group);
  command
      .add_option("--min-duration", choice.min_duration,
                  "Only approaches that last as long (seconds) or longer")
      ->check(finite_number())
      ->group(group);
}

ApproachFilter::ApproachFilter(const ApproachChoice& choice, const TrackSet& track_set)
    : asked_(asked_window(choice, track_set)),
      window_(chosen_window(choice, asked_, track_set)),
      only_(chosen_tracks(choice, track_set)),
      min_duration_(least_duration(choice)) {}

LeftOut ApproachFilter::apply(std::vector<Approach>& approaches) const {
  LeftOut left_out;
  if (!only_.empty())
    left_out.by_ids = std::erase_if(approaches, [this](const Approach& approach) {
      return !only_[approach.first] && !only_[approach.second];
    });
  left_out.by_duration = std::erase_if(
      approaches, [this](const Approach& approach) { return approach.end - approach.begin < min_duration_; });
  return left_out;
}

}  // namespace kinesphere::program
