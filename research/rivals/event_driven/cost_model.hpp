// How large cells should be: the events that the detector of the paper has to expect, and what they cost, as
// functions of the edge of its finest grid. After the cost model of Kim, Guibas and Shin (1998) for ballistic
// spheres (the paper's [1], section 4.2), with growing bounds and resets added.
//
//   const CostModel model(spheres, box, true);
//   double edge = model.choose_cell_edge();
//   ExpectedRates rates = model.expected_rates(edge);
//
// Small cells mean many crossings and resets, large ones many pairs. The model takes the spheres for a gas:
// spread evenly, moving in all directions alike, whatever their size.
#pragma once

#include <vector>

#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// What single operations cost, in nanoseconds, though only their ratios matter. Measured once, on one
/// machine: being fixed they make the choice of cells, and with it the whole run, the same everywhere.
struct UnitCosts {
  static constexpr double pair_test = 60.0;       ///< whether two bounds can meet before their next reset
  static constexpr double visit = 8.0;            ///< of a body that stands in a neighbouring cell
  static constexpr double tree_operation = 90.0;  ///< an insertion into the event tree, or a removal
  static constexpr double cell_operation =
      120.0;                              ///< to find a cell in the subspace tree, enter it or leave it
  static constexpr double probe = 250.0;  ///< a report, and the new bound's crossings, reset and walls
};

/// What the model needs to know of a body.
struct MovingSphere {
  double radius = 0.0;        ///< with its position error
  double speed = 0.0;         ///< now
  double growth_speed = 0.0;  ///< e1
  double limit = 0.0;         ///< A
};

/// Of all bodies together, per unit of time. An event is counted once; a bound that is reset at a colliding
/// event counts there only.
struct ExpectedRates {
  double entering = 0.0;
  double leaving = 0.0;
  double resetting = 0.0;
  double colliding = 0.0;  ///< of two bounds, or of one with a wall
  double pair_tests = 0.0;
  double visits = 0.0;  ///< of bodies in cells, to find these pairs
  double cost = 0.0;    ///< nanoseconds of work
};

class CostModel {
 public:
  /// The spheres move in `extent`, whose faces are walls or not. Cost: O(n log n).
  CostModel(const std::vector<MovingSphere>& spheres, const Box& extent, bool has_walls);

  /// Needs finest_edge > 0. Cost: about 0.3 ms.
  ExpectedRates expected_rates(double finest_edge) const;

  /// The edge of least expected cost, to within a few per cent: always the same for the same spheres, on
  /// every machine. > 0. Cost: about 7 ms.
  double choose_cell_edge() const;

 private:
  struct Level;
  struct Cycle;
  struct Neighbours;

  std::vector<Level> levels_of(double finest_edge) const;
  Level aged(const Level& level, const std::vector<Level>& levels) const;
  Cycle cycle_of(const MovingSphere& sphere, const Level& own, const std::vector<Level>& levels) const;
  double meeting_rate(double radius, double growth_speed, double speed,
                      const std::vector<Level>& levels) const;
  double wall_rate(double growth_speed, double speed) const;
  Neighbours neighbours_of(double width, const Level& own, const std::vector<Level>& levels) const;
  void add_rates(ExpectedRates& rates, const MovingSphere& sphere, const Level& own,
                 const std::vector<Level>& levels, const std::vector<Level>& fresh) const;
  double planes_per_length(double edge) const;
  double volume_within(double length) const;

  std::vector<MovingSphere> samples_;
  double weight_ = 0.0;           ///< bodies that a sample stands for
  double others_ = 0.0;           ///< part of the bodies that are not the one looked at
  double contact_density_ = 1.0;  ///< near another sphere, relative to everywhere
  Box extent_;
  Vec3 sides_;
  bool walls_;
};

}  // namespace kinesphere
