// The cost model for cell sizes: the events that the detector of the paper has to expect, and their cost, as
// functions of the edge of its finest grid. It follows the cost model of Kim, Guibas and Shin (1998) for
// ballistic spheres (the paper's [1], section 4.2), with growing bounds and resets added.
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

/// Cost of single operations in nanoseconds; only the ratios matter. They were measured once, on one machine.
/// Fixed values trade the best choice on each machine for one choice of cells, and so one run, on all
/// machines.
struct UnitCosts {
  static constexpr double pair_test = 60.0;       ///< test if two bounds can meet before their next reset
  static constexpr double visit = 8.0;            ///< visit of a body in a neighbouring cell
  static constexpr double tree_operation = 90.0;  ///< an insertion into the event tree, or a removal
  static constexpr double cell_operation =
      120.0;                              ///< finding a cell in the subspace tree, entering it or leaving it
  static constexpr double probe = 250.0;  ///< a report, and the new bound's crossings, reset and walls
};

/// The properties of a body that the model needs.
struct MovingSphere {
  double radius = 0.0;        ///< includes the position error
  double speed = 0.0;         ///< present speed
  double growth_speed = 0.0;  ///< e1 of the paper
  double limit = 0.0;         ///< acceleration limit, A of the paper
};

/// Rates of all bodies together, per unit of time. An event is counted once; a bound that is reset at a
/// colliding event counts there only.
struct ExpectedRates {
  double entering = 0.0;
  double leaving = 0.0;
  double resetting = 0.0;
  double colliding = 0.0;  ///< meetings of two bounds, or of a bound and a wall
  double pair_tests = 0.0;
  double visits = 0.0;  ///< visits of bodies in cells, to find these pairs
  double cost = 0.0;    ///< nanoseconds of work
};

class CostModel {
 public:
  /// The spheres move in `extent`; `has_walls` says if its faces are walls. Cost: O(n log n).
  CostModel(const std::vector<MovingSphere>& spheres, const Box& extent, bool has_walls);

  /// Returns the rates for a finest edge > 0 (length). Cost: about 0.3 ms.
  ExpectedRates expected_rates(double finest_edge) const;

  /// Returns the edge > 0 (length) of least expected cost, to within a few per cent. It depends on the
  /// spheres alone and is the same on every machine. Cost: about 7 ms.
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
  double others_ = 0.0;           ///< part of the bodies other than the present one
  double contact_density_ = 1.0;  ///< density next to another sphere, relative to the mean
  Box extent_;
  Vec3 sides_;
  bool walls_;
};

}  // namespace kinesphere
