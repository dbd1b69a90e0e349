// Collision rate and pressure of a gas of equal hard spheres: as measured in a run, and as in theory.
//
// All values are in units of the diameter, the mass of a sphere and the thermal speed sqrt(kT / m).
#pragma once

#include <cstdint>

#include "simulation/detector/detector.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// Returns the compressibility factor Z = p V / (N kT) of the hard-sphere fluid that fills the part `packing`
/// of space, from 0 to freezing at 0.494: the polynomial of Kolafa, Labik and Malijevsky (Phys. Chem. Chem.
/// Phys. 6, 2335, 2004) in x = packing / (1 - packing).
double hard_sphere_compressibility(double packing);
/// Returns the collisions of one sphere per unit of time, 6 (Z - 1) / sqrt(pi). Each collision counts for
/// both partners.
double hard_sphere_collision_rate(double packing);

/// A measured mean with its standard error.
struct Estimate {
  double value = 0.0;
  double standard_error = 0.0;  ///< from the scatter between blocks, taken as independent
};

/// Properties of a gas, measured in a run.
struct GasProperties {
  double packing = 0.0;
  Estimate collision_rate;     ///< as hard_sphere_collision_rate()
  Estimate compressibility;    ///< as hard_sphere_compressibility(), from the virial of collisions
  std::uint64_t contacts = 0;  ///< number of contacts measured
  double energy_change = 0.0;  ///< largest change since the start, as a part of the energy
  /// Largest change of the total momentum since the start, in units of N m sqrt(kT / m).
  double momentum_change = 0.0;
  SceneResult result;  ///< result of the whole run
};

/// Division of the time of a scene into blocks of one length.
struct GasBlocks {
  int equilibration = 10;  ///< blocks at the start that are not measured
  int measured = 20;
};

/// Runs a scene and measures its gas; errors are those of run_scene(). The result differs from an infinite
/// system by about 1 / N. Precondition: at least two equal spheres are there from the start to the end, fly
/// freely and bounce without loss, in space that is periodic on all axes; two or more blocks are measured.
Result<GasProperties> measure_gas(const Scene& scene, const DetectorMaker& make,
                                  const GasBlocks& blocks = {});

}  // namespace kinesphere
