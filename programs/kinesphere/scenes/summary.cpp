// Figures for a person: aligned rows, thousands separators, units.
#include "scenes/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scenes/scene_file.hpp"

namespace kinesphere::program {
namespace {

std::string_view sequence_of(Tone tone) {
  switch (tone) {
    case Tone::strong:
      return "\x1b[1m";
    case Tone::good:
      return "\x1b[32m";
    case Tone::bad:
      return "\x1b[1;31m";
    default:
      return {};
  }
}

/// Returns the numbers of the two bodies of an event, or of the one at a wall.
std::string bodies_text(const Event& event) {
  if (event.second == no_body) return fmt::format("{} at a wall", event.first.index);
  return fmt::format("{} and {}", event.first.index, event.second.index);
}

}  // namespace

void Summary::row(std::string label, std::string value, std::string note, Tone tone) {
  rows_.push_back({std::move(label), std::move(value), std::move(note), tone});
}

std::string Summary::text(bool colour) const {
  std::size_t label_width = 0;
  std::size_t value_width = 0;
  for (const Row& row : rows_) {
    label_width = std::max(label_width, row.label.size());
    if (!row.note.empty()) value_width = std::max(value_width, row.value.size());
  }
  std::string text;
  for (const Row& row : rows_) {
    std::string line =
        fmt::format("{:<{}}  {:<{}}  {}", row.label, label_width, row.value, value_width, row.note);
    line.erase(line.find_last_not_of(' ') + 1);
    if (const std::string_view sequence = sequence_of(row.tone); colour && !sequence.empty()) {
      constexpr std::string_view plain = "\x1b[0m";
      line.insert(label_width + 2 + row.value.size(), plain);
      line.insert(label_width + 2, sequence);
    }
    text += line + '\n';
  }
  return text;
}

std::string percent(double part, double whole) {
  return whole > 0 ? fmt::format("{:.3g} %", 100 * part / whole) : "-";
}

std::string number(double value) {
  if (!std::isfinite(value)) return "-";
  if (value >= 1e4 && value < 1e15) return grouped(static_cast<std::uint64_t>(std::llround(value)));
  return fmt::format("{:.4g}", value);
}

void add_scene(Summary& summary, const SceneParameters& parameters) {
  std::string response(name_of(parameters.response));
  if (parameters.response == SceneResponse::bounce) {
    response += fmt::format(", restitution {}", number(parameters.restitution));
  }
  summary.row("scene", parameters.name);
  summary.row("bodies", grouped(parameters.bodies),
              fmt::format("{}, {}", name_of(parameters.motion), response));
  summary.row("seed", std::to_string(parameters.seed));
}

void add_events(Summary& summary, const SceneResult& result, const EventRows& rows) {
  const Counters& counters = result.counters;
  const auto row = [&](std::string label, EventKind begin, EventKind end) {
    const std::uint64_t begun = counters.count(begin);
    std::string note =
        fmt::format("{} per body-second", number(static_cast<double>(begun) / result.body_time));
    if (rows.ends) note += fmt::format(", {} ended", grouped(counters.count(end)));
    summary.row(std::move(label), grouped(begun), std::move(note), Tone::strong);
  };
  row("contacts", EventKind::contact_begin, EventKind::contact_end);
  row("wall contacts", EventKind::wall_begin, EventKind::wall_end);
  if (rows.internals && counters.repeated_contacts > 0) {
    summary.row("repeated", grouped(counters.repeated_contacts), "contacts within the Zeno interval");
  }
  if (counters.jammed_contacts > 0) {
    summary.row("jammed", grouped(counters.jammed_contacts),
                "contacts without room, which lose energy: choose a smaller tolerance", Tone::bad);
  }
  const std::uint64_t guards = counters.count(EventKind::zeno_guard);
  if (guards > 0 || rows.internals) {
    summary.row("zeno guard", grouped(guards),
                fmt::format("contacts left to overlap; {} looks put off within the tolerance",
                            grouped(counters.zeno_steps)));
  }
  if (const auto count = counters.count(EventKind::bound_violation); count > 0) {
    summary.row("bound violations", grouped(count),
                "states that broke a body's promise: contacts may have been missed", Tone::bad);
  }
}

void add_hardest(Summary& summary, const Event& event) {
  summary.row("hardest", number(event.approach_speed),
              fmt::format("approach speed of {}, at {} s", bodies_text(event), number(event.time)),
              Tone::strong);
}

void add_speed(Summary& summary, double simulated_seconds, double real_seconds) {
  summary.row("real time", fmt::format("{} s", number(real_seconds)),
              fmt::format("{} ms per simulated second", number(1e3 * real_seconds / simulated_seconds)));
  summary.row("real-time factor", number(simulated_seconds / real_seconds));
}

}  // namespace kinesphere::program
