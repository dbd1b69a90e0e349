// Turns the command line into the settings of a watch.
#include "watch/watch_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "geography/local_frame.hpp"
#include "watch/format_defaults.hpp"
#include "watch/tracks/class_rules.hpp"

namespace kinesphere::program {
namespace {

constexpr double no_promise = std::numeric_limits<double>::infinity();

/// Parses "3" or "3:1".
void set_errors(const std::string& given, Measure measure, std::string_view option, FallbackError& flat,
                FallbackError& upright) {
  if (given.empty()) return;
  const ErrorBound spread = parse_spread(given, measure, option);
  const bool has_upright = given.find(':') != std::string::npos;
  flat = {spread.horizontal(), fmt::format("{:.4g} ({})", spread.horizontal(), option)};
  if (has_upright)
    upright = {spread.vertical(), fmt::format("{:.4g} ({})", spread.vertical(), option)};
  else if (upright.bound)
    upright = flat;
}

WatchSettings::Clock clock_named(const std::string& name) {
  if (name == "stream") return WatchSettings::Clock::stream;
  if (name == "stamps") return WatchSettings::Clock::stamps;
  if (name == "arrival") return WatchSettings::Clock::machine;
  throw ProgramError(fmt::format("--clock: expected stream, stamps or arrival, but got '{}'", name));
}

/// Returns the parts between commas.
std::vector<std::string> comma_parts(std::string_view text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// Parses LAT,LON.
WatchSettings::Origin parse_origin(const std::string& text) {
  const auto parts = comma_parts(text);
  const auto latitude = parse_number(parts.front()), longitude = parse_number(parts.back());
  if (parts.size() != 2 || !latitude || !longitude || std::abs(*latitude) > 90.0 ||
      std::abs(*longitude) > 360.0)
    throw ProgramError(fmt::format("--origin: expected LATITUDE,LONGITUDE in degrees, but got '{}'", text));
  return {*latitude, *longitude};
}

/// Parses LAT,LON,LENGTH or X,Y,LENGTH.
WatchedArea parse_area(const std::string& text) {
  const auto parts = comma_parts(text);
  const auto first = parse_number(parts.front());
  const auto second = parts.size() == 3 ? parse_number(parts[1]) : std::nullopt;
  if (!first || !second || parts[2].empty())
    throw ProgramError(
        fmt::format("--area: expected LATITUDE,LONGITUDE,RADIUS or X,Y,RADIUS, but got '{}'", text));
  const double radius = parse_measure(parts[2], Measure::length, "--area");
  if (radius > 0.0) return {*first, *second, radius};
  throw ProgramError(fmt::format("--area: expected a radius > 0, but got '{}'", text));
}

/// Parses "2/4" and "1-8/16"; returns all shares for an empty text.
Shard parse_share(const std::string& text) {
  if (text.empty()) return {};
  const auto wrong = [&text] {
    return ProgramError(fmt::format(
        "--share: expected a part of all pairs, as 2/4 or 1-8/16 with numbers from 1, but got '{}'", text));
  };
  constexpr double most = 65536.0;
  const auto whole = [&](std::string_view part) {
    const double number = parse_number(part).value_or(0.0);
    if (!(number >= 1.0 && number <= most && number == std::floor(number))) throw wrong();
    return static_cast<std::uint64_t>(number);
  };
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::string_view parts = std::string_view(text).substr(0, slash);
  const std::size_t dash = std::min(parts.find('-'), parts.size());
  const std::uint64_t of = whole(std::string_view(text).substr(std::min(slash + 1, text.size())));
  const std::uint64_t first = whole(parts.substr(0, dash));
  const std::uint64_t last = dash < parts.size() ? whole(parts.substr(dash + 1)) : first;
  if (last < first || last > of) throw wrong();
  return {.of = of, .first = first - 1, .count = last - first + 1};
}

/// Says which option gives a unit of lengths or speeds, if one does.
void find_measured_option(const WatchOptions& options, WatchSettings& settings) {
  const auto take = [&](std::string_view option, const std::string& text, bool has_unit) {
    if (!has_unit || !settings.measured_option.empty()) return;
    settings.measured_option = option;
    settings.measured_text = text;
  };
  for (const NamedSeparation& named : settings.separations) take("--separation", named.name, named.has_unit);
  for (const auto& [option, text] :
       {std::pair("--acceleration", options.acceleration),
        std::pair("--largest-speed", options.largest_speed),
        std::pair("--position-error", options.position_error),
        std::pair("--velocity-error", options.velocity_error), std::pair("--rest", options.rest)}) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::string_view first = std::string_view(text).substr(0, colon),
                           second = std::string_view(text).substr(std::min(colon + 1, text.size()));
    take(option, text,
         (!first.empty() && has_unit_behind(first)) || (!second.empty() && has_unit_behind(second)));
  }
  for (const std::string& text : options.areas)
    take("--area", text, has_unit_behind(comma_parts(text).back()));
}

double positive_time(const std::string& given, std::string_view option, double otherwise) {
  if (given.empty()) return otherwise;
  const double time = parse_measure(given, Measure::time, option);
  if (time > 0.0) return time;
  throw ProgramError(fmt::format("{}: expected a time > 0, but got '{}'", option, given));
}

double time_or(const std::string& given, std::string_view option, double otherwise) {
  return given.empty() ? otherwise : parse_measure(given, Measure::time, option);
}

/// Sets what is watched for.
void set_separations(const WatchOptions& options, const FormatDefaults& defaults, WatchSettings& settings) {
  const double look_ahead = time_or(options.look_ahead, "--look-ahead", defaults.look_ahead);
  if (look_ahead < 0.0)
    throw ProgramError(fmt::format("--look-ahead: expected a time >= 0, but got '{}'", options.look_ahead));
  for (const std::string& text : options.separations) {
    NamedSeparation& named = settings.separations.emplace_back(parse_separation(text));
    if (!named.has_time) named.separation.look_ahead = look_ahead;
  }
  settings.hold = positive_time(options.hold, "--hold", 60.0);
  settings.confirm = positive_time(options.confirm, "--confirm", 0.0);
}

/// Sets what tracks promise.
void set_promises(const WatchOptions& options, StreamFormat format, const FormatDefaults& defaults,
                  WatchSettings& settings) {
  const auto promised = [&](const std::string& given, Measure measure, std::string_view option,
                            const std::optional<ErrorBound>& otherwise) {
    return given.empty() ? otherwise.value_or(ErrorBound(no_promise)) : parse_spread(given, measure, option);
  };
  const MotionLimits limits{
      promised(options.acceleration, Measure::acceleration, "--acceleration", defaults.acceleration),
      promised(options.largest_speed, Measure::speed, "--largest-speed", defaults.largest_speed)};
  if (!std::isfinite(limits.acceleration.total()) && !std::isfinite(limits.largest_speed.total()))
    throw ProgramError(fmt::format(
        "--acceleration, --largest-speed: expected one of them, because {} does not say how tracks move",
        name_of(format)));
  settings.classes = TrackClasses(limits);
  settings.class_rules = parse_class_rules(options.classes, settings.classes);
  settings.has_automatic_classes = !options.no_classes;
  settings.silence = positive_time(options.silence, "--silence", defaults.silence);
  settings.forget = positive_time(options.forget, "--forget", defaults.forget);
  settings.has_steady_rate = defaults.has_steady_rate;
}

/// Sets how far off reports are where the stream does not say it.
void set_all_errors(const WatchOptions& options, StreamFormat format, const FormatDefaults& defaults,
                    WatchSettings& settings) {
  const auto by_default = [&](const std::optional<double>& bound) {
    return FallbackError{bound, bound ? fmt::format("{:.4g} (default of {})", *bound, name_of(format)) : ""};
  };
  settings.position_error = by_default(defaults.position_error);
  settings.height_error = by_default(defaults.height_error);
  settings.velocity_error = by_default(defaults.velocity_error);
  settings.climb_error = by_default(defaults.climb_error);
  set_errors(options.position_error, Measure::length, "--position-error", settings.position_error,
             settings.height_error);
  set_errors(options.velocity_error, Measure::speed, "--velocity-error", settings.velocity_error,
             settings.climb_error);
  settings.stamp_error = time_or(options.stamp_error, "--stamp-error", defaults.stamp_error);
  settings.velocity_age = defaults.velocity_age;
}

/// Sets which ids are one body, and which alerts are written.
void set_alerts(const WatchOptions& options, const FormatDefaults& defaults, WatchSettings& settings) {
  settings.ids = Identities(options.ids);
  settings.own_as_given = options.own;
  settings.own = settings.ids.name_of(options.own).value_or(options.own);
  settings.has_distinct_ids = options.distinct_ids;
  settings.rest_speed =
      options.rest.empty() ? defaults.rest_speed : parse_measure(options.rest, Measure::speed, "--rest");
  if (settings.rest_speed < 0.0)
    throw ProgramError(fmt::format("--rest: expected a speed >= 0, but got '{}'", options.rest));
  if (!options.only.empty()) {
    const auto names = [&](std::string_view kind) {
      return std::any_of(options.only.begin(), options.only.end(),
                         [kind](const std::string& name) { return name == kind || name == "all"; });
    };
    settings.kinds = {.within = names("within"),
                      .predicted = names("predicted"),
                      .lost = names("lost"),
                      .undecided = names("undecided"),
                      .tracks = names("tracks")};
  }
  settings.text = options.text;
  for (const std::string& text : options.areas) settings.areas.push_back(parse_area(text));
  if (options.most_alerts) settings.most_alerts = *options.most_alerts;
  settings.share = parse_share(options.share);
}

/// Sets the map, the clock and the limits of what is taken.
void set_reading(const WatchOptions& options, const FormatDefaults& defaults, WatchSettings& settings) {
  settings.dimensions = options.dimensions;
  if (!settings.dimensions && defaults.geographic) settings.dimensions = defaults.dimensions;
  settings.window = defaults.window;
  // A track that is not yet stale may be the only one that reports.
  settings.leap = positive_time(options.leap, "--leap", std::max(settings.leap, settings.silence));
  settings.clock = clock_named(options.clock);
  if (!options.origin.empty()) settings.origin = parse_origin(options.origin);
  if (!options.radius.empty()) settings.radius = parse_measure(options.radius, Measure::length, "--radius");
  if (!(settings.radius > 0.0 && settings.radius <= LocalFrame::largest_radius))
    throw ProgramError(fmt::format("--radius: expected a radius > 0, at most {:.0f} km, but got '{}'",
                                   LocalFrame::largest_radius / 1e3, options.radius));
  if (options.most_malformed) settings.most_malformed = *options.most_malformed;
  if (options.most_tracks) settings.most_tracks = *options.most_tracks;
  if (options.most_pairs) settings.most_pairs = *options.most_pairs;
}

}  // namespace

WatchSettings settings_of(const WatchOptions& options, StreamFormat format, const std::string& source) {
  const FormatDefaults defaults = defaults_of(format);
  WatchSettings settings;
  settings.source = source;
  settings.format = name_of(format);
  set_separations(options, defaults, settings);
  set_promises(options, format, defaults, settings);
  set_all_errors(options, format, defaults, settings);
  set_alerts(options, defaults, settings);
  set_reading(options, defaults, settings);
  find_measured_option(options, settings);
  return settings;
}

GivenOptions given_options(const WatchOptions& options) {
  // The name of a format alone changes nothing: the snapshot has it.
  const std::string& said = options.choices.hints.format;
  const auto format = format_named(said);
  const bool is_preset = format && is_table(*format) && name_of(*format) != said;
  constexpr std::string_view others[] = {"--help",    "--most-malformed", "--snapshot",
                                         "--summary", "--plot",           "--snapshot-every",
                                         "--alerts",  "--serve",          "--quiet"};
  GivenOptions given;
  for (const CLI::Option* const option : options.command->get_options()) {
    const std::string name = option->get_name();
    const bool counts = name.starts_with("--") && std::ranges::find(others, name) == std::end(others) &&
                        (name != "--format" || is_preset);
    if (counts) given.emplace_back(name, fmt::format("{}", fmt::join(option->results(), " ")));
  }
  return given;
}

double snapshot_interval(const WatchOptions& options) {
  return positive_time(options.snapshot_every, "--snapshot-every", 10.0);
}

}  // namespace kinesphere::program
