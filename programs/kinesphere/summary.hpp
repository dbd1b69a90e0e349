// Figures for a person: aligned rows, thousands separators, units.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulation/run/simulate.hpp"
#include "simulation/scene/make_scene.hpp"

namespace kinesphere::program {

class Summary {
 public:
  void row(std::string label, std::string value, std::string note = "");
  /// An empty line.
  void space() { rows_.emplace_back(); }
  /// Labels on the left; plain counts and values right-aligned in one column when a note follows them.
  std::string text() const;

 private:
  struct Row {
    std::string label, value, note;
  };
  std::vector<Row> rows_;
};

/// 1234567 -> "1,234,567".
std::string grouped(std::uint64_t count);
/// "12.3 %"; "-" when there is nothing to take a part of.
std::string percent(double part, double whole);
/// Four significant digits; large ones whole, with thousands separators; "-" for what is no finite number,
/// such as a rate over no time at all.
std::string number(double value);

/// What the scene is: name, motion, bodies, seed, response.
void add_scene(Summary& summary, const SceneParameters& parameters);
/// Which rows a summary has even where there was nothing to count.
struct EventRows {
  bool ends = false;        ///< of contacts
  bool zeno_guard = false;  ///< how often it acted
};
/// Contacts, walls and what went wrong.
void add_events(Summary& summary, const SimulationResult& result, const EventRows& rows);
/// Real time spent, per simulated second too, and the real-time factor: simulated over real time.
void add_speed(Summary& summary, double simulated_seconds, double real_seconds);

}  // namespace kinesphere::program
