// A picture of a run: where contacts were, how many there were at each time, and how fast.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kinesphere/event.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

/// Takes memory for 400,000 contacts at most; of more it keeps every second, fourth and so on.
class RunPlot {
 public:
  RunPlot(std::string name, const Scene& scene);
  /// Counts beginnings of contacts; passes over all other events.
  void add(const Event& event);
  /// Returns an SVG picture of 1000 by 520 pixels.
  std::string svg() const;

 private:
  struct Contact {
    Vec3 point;
    double speed;
    bool is_of_wall;
  };
  static constexpr std::size_t bins = 60;  ///< of the time of the run
  using Counts = std::array<std::uint64_t, bins>;

  std::string map() const;
  std::string rates() const;
  std::string speeds() const;

  std::string name_;
  double start_, end_;
  std::vector<Contact> kept_;
  std::uint64_t stride_ = 1, seen_ = 0;
  Counts of_bodies_{}, of_walls_{};
};

}  // namespace kinesphere::program
