// The latest places of tracks, by cells of the plane: which tracks may be near a place.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/monitor/monitor_event.hpp"

namespace kinesphere::program {

/// Cells are squares of the plane and have any height.
class LatestPlaces {
 public:
  struct Entry {
    TrackId track = 0;
    State state{};  ///< as reported last, on the monitor's map
    double stamp = 0.0;
    // Where the entry is in cells_.
    std::uint64_t cell = 0;
    std::uint32_t slot = 0;
  };

  /// `edge` of cells: length, > 0.
  explicit LatestPlaces(double edge) : edge_(edge) {}

  double edge() const { return edge_; }
  /// Enlarges the cells. Cost: O(tracks).
  void widen(double edge);
  /// Returns the number of the new entry, by which the other functions know it until it is removed. Numbers
  /// of removed entries are given again. Cost of each function: O(1).
  std::uint32_t add(TrackId track, const State& state, double stamp);
  void set(std::uint32_t number, const State& state, double stamp);
  void remove(std::uint32_t number);

  /// Calls `visit(const Entry&)` for all entries no farther than an edge from the place in the plane, and for
  /// others. Cost: O(1 + entries of nine cells).
  template <class Visit>
  void near(const Vec3& place, const Visit& visit) const {
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        if (const auto cell = cells_.find(cell_of({place.x + x * edge_, place.y + y * edge_, 0.0}));
            cell != cells_.end())
          for (const std::uint32_t number : cell->second) visit(entries_[number]);
  }

 private:
  /// Returns a number for a cell. Two cells may have one number, which makes them one.
  std::uint64_t cell_of(const Vec3& place) const {
    const auto index = [this](double coordinate) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(coordinate / edge_)));
    };
    return index(place.x) * 0x9e3779b97f4a7c15u + index(place.y);
  }
  void enter(std::uint32_t number);
  void leave(std::uint32_t number);

  double edge_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> free_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace kinesphere::program
