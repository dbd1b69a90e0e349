// Figures for a person: aligned rows, thousands separators, units.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/number_text.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/scene/make_scene.hpp"

namespace kinesphere::program {

/// How a value stands out on a terminal with colours.
enum class Tone { plain, strong, good, bad };

class Summary {
 public:
  void row(std::string label, std::string value, std::string note = "", Tone tone = Tone::plain);
  /// Adds an empty line.
  void space() { rows_.emplace_back(); }
  /// Returns the rows: labels on the left; counts and values right-aligned in one column if a note follows
  /// them. With `colour` values have the escape sequences of terminals (ECMA-48) for their tones.
  std::string text(bool colour = false) const;

 private:
  struct Row {
    std::string label, value, note;
    Tone tone = Tone::plain;
  };
  std::vector<Row> rows_;
};

/// Returns "12.3 %"; "-" if `whole` is 0.
std::string percent(double part, double whole);
/// Returns four significant digits; large numbers as integers, with thousands separators; "-" for a number
/// that is not finite, such as a rate over no time.
std::string number(double value);

/// Adds the scene: name, motion, bodies, seed, response.
void add_scene(Summary& summary, const SceneParameters& parameters);
/// Rows that a summary has even with a count of 0.
struct EventRows {
  bool ends = false;       ///< row for ends of contacts
  bool internals = false;  ///< rows for contacts that follow each other within the Zeno interval
};
/// Adds contacts, walls and errors.
void add_events(Summary& summary, const SceneResult& result, const EventRows& rows);
/// Adds the contact with the largest approach speed.
void add_hardest(Summary& summary, const Event& event);
/// Adds real time, in all and for each simulated second, and the real-time factor: simulated over real time.
void add_speed(Summary& summary, double simulated_seconds, double real_seconds);

}  // namespace kinesphere::program
