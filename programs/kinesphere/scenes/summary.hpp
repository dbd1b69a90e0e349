// Figures for a person: aligned rows, thousands separators, units.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulation/run/run_scene.hpp"
#include "simulation/scene/make_scene.hpp"

namespace kinesphere::program {

class Summary {
 public:
  void row(std::string label, std::string value, std::string note = "");
  /// Adds an empty line.
  void space() { rows_.emplace_back(); }
  /// Returns the rows: labels on the left; counts and values right-aligned in one column if a note follows
  /// them.
  std::string text() const;

 private:
  struct Row {
    std::string label, value, note;
  };
  std::vector<Row> rows_;
};

/// Returns 1234567 as "1,234,567".
std::string grouped(std::uint64_t count);
/// Returns "12.3 %"; "-" if `whole` is 0.
std::string percent(double part, double whole);
/// Returns four significant digits; large numbers as integers, with thousands separators; "-" for a number
/// that is not finite, such as a rate over no time.
std::string number(double value);

/// Adds the scene: name, motion, bodies, seed, response.
void add_scene(Summary& summary, const SceneParameters& parameters);
/// Rows that a summary has even with a count of 0.
struct EventRows {
  bool ends = false;        ///< row for ends of contacts
  bool zeno_guard = false;  ///< row for the number of its actions
};
/// Adds contacts, walls and errors.
void add_events(Summary& summary, const SceneResult& result, const EventRows& rows);
/// Adds real time, in all and for each simulated second, and the real-time factor: simulated over real time.
void add_speed(Summary& summary, double simulated_seconds, double real_seconds);

}  // namespace kinesphere::program
