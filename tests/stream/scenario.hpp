// What a random world has. Each feature can be left out, so that a failing stream shrinks to what it needs.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "kinesphere/world_definition.hpp"

namespace kinesphere::stream {

struct Scenario {
  std::uint64_t seed = 0;
  int bodies = 10;    ///< balls and rigid bodies at the start
  double edge = 5.0;  ///< of the box, or of the region around which bodies stay (units of length)
  double relative_tolerance = 1e-6;
  ContactEvents contacts = ContactEvents::all;
  double length_scale = 1.0;
  double time_scale = 1.0;
  double restitution = 1.0;
  Vec3 remoteness{};  ///< in farthest places
  double lateness = 1.0;
  double error_scale = 1.0;  ///< in tolerances
  Axes repeats{};

  // Features.
  bool box = false;
  bool periodic = false;  ///< needs a box
  bool flat = false;      ///< two dimensions
  bool line = false;      ///< bodies move along x alone
  bool far = false;       ///< away from the origin
  bool late = false;      ///< times are so large that they are coarse
  bool scaled = false;    ///< lengths and times are very large or small
  bool errors = false;    ///< reports are not exact
  bool zeno = false;      ///< there is a Zeno interval
  bool spread = false;    ///< spread_window_starts
  bool wall_filter = false;
  bool filters = false;
  bool mixed_contacts = false;  ///< bodies ask for events of their own
  bool sizes = false;           ///< radii differ by factors of 10^5
  bool fast = false;            ///< some bodies are a hundred times as fast
  bool steered = false;         ///< bodies have acceleration limits
  bool gravity = false;
  bool bounces = false;
  bool settles = false;  ///< bouncing bodies come to rest
  bool losses = false;   ///< bouncing bodies lose energy
  bool radii = false;    ///< radii change with time
  bool rigid = false;
  bool hulls = false;
  bool spins = false;  ///< angular velocities change, and a rotation probe tells of them
  bool carried = false;
  bool statics = false;
  bool zones = false;
  bool sensors = false;
  bool actions = false;  ///< events remove, disable and put bodies to sleep
  bool resting = false;
  bool recorded = false;
  bool copies = false;  ///< the world is saved and restored, or cloned
  bool answers = false;
  bool overlaps = false;     ///< bodies may come into being where others are
  bool grid = false;         ///< places and velocities are on a grid, so that times and distances are equal
  bool pair_filter = false;  ///< haunted bodies touch only each other
  bool runs = false;         ///< World::run() is compared with a loop
  bool crowd = false;        ///< hundreds of small bodies, among which a run finds clusters

  double unit_length() const { return scaled ? length_scale : 1.0; }
  double unit_time() const { return scaled ? time_scale : 1.0; }
  double tolerance() const { return relative_tolerance * unit_length(); }
  double position_error() const { return errors ? error_scale * tolerance() : 0.0; }
  bool is_periodic() const { return box && periodic; }
  /// A corner of the box.
  Vec3 origin() const;
  WorldDefinition definition() const;
  std::string text() const;
  /// Leaves out features that others exclude, or that mean nothing without them.
  void clear_contradictions();
  void make_crowd();
};

struct Feature {
  std::string_view name;
  bool Scenario::*is_on;
};
std::span<const Feature> features();

Scenario draw_scenario(std::uint64_t seed);

}  // namespace kinesphere::stream
