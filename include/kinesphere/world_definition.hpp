// Definition of a world: its walls and its contact criteria. limits.hpp gives the ranges of the numbers.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "kinesphere/contact_events.hpp"
#include "kinesphere/filter.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// A subset of the three axes.
struct Axes {
  bool x = false;
  bool y = false;
  bool z = false;

  /// Return whether axis 0, 1 or 2 belongs to it, and whether any does.
  constexpr bool operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr bool any() const { return x || y || z; }
  friend constexpr bool operator==(const Axes&, const Axes&) = default;
};

/// Space, tolerance and events of a world: World::create().
struct WorldDefinition {
  /// Box whose faces are the walls. Without a box the world is unbounded.
  std::optional<Box> box{};
  /// Axes on which space is periodic with the size of the box, without walls: a body that leaves on one
  /// side re-enters on the other. States from the caller may be in any image. States that the world returns
  /// lie in the box (lower <= position < upper), except the second state of an event, which is in the image
  /// nearest to the first. Each body must fit: on each periodic axis 2 radius + 6 position_error +
  /// separation_distance + contact_tolerance may be at most 3/8 of the box; a diameter of a third of the
  /// box satisfies this. Cost: a body is probed at least once while it crosses half of the box.
  Axes periodic{};
  /// Shear rate (1 / time) of Lees-Edwards boundaries, of either sign: the images of all bodies across y
  /// slide along x. The image n periods up y is displaced by n shear_rate L_y (t - start_time) along x,
  /// besides its n L_y, and n shear_rate L_y faster, where L_y is the period of y. So a flow x' = shear_rate
  /// y goes on through the borders. x and y have to be periodic; z may have any borders. All bodies are
  /// balls, and none sleeps. A state from the caller may be in any image: its velocity is that of the image
  /// in which its position lies (docs/fluids.md). Not for a GameWorld or a DistributedWorld. The world
  /// advances to times of at most 1.4e13 times that in which the next image slides by the box. Cost: a ball
  /// near a border across y is searched for whenever images have slid by about its size.
  double shear_rate = 0.0;
  /// The filter of all walls: they meet a body as another body with this filter would. By default they meet
  /// every body, whatever its filter. Bodies that the walls do not meet may be anywhere. For walls that
  /// differ from each other, add static half-spaces (World::add_static) instead of a box.
  std::optional<Filter> wall_filter{};
  /// 2 or 3. With 2, bodies are discs in the plane z = 0: the z of every position, velocity and planned
  /// acceleration must be 0, and the z range of the box is ignored.
  int dimensions = 3;
  /// eps > 0 (length): a contact begins at a time when the true gap is at most eps, and no gap falls below
  /// -eps without a report.
  double contact_tolerance = 1e-6;
  /// > contact_tolerance (length): a contact ends at a time when the gap is between this and this plus eps.
  /// Default (NaN): 4 eps. With position errors e0, choose it larger than the sum of 2 e0 of the two
  /// bodies; otherwise noise ends and begins contacts.
  double separation_distance = std::numeric_limits<double>::quiet_NaN();
  /// Which contact events bodies ask for that do not say it themselves (BodyDefinition::contacts).
  ContactEvents contacts = ContactEvents::all;
  /// If false, add() refuses a body that certainly overlaps another body or a wall.
  bool allow_overlap = true;
  /// >= 0 (time): a contact is marked Event::repeated if it follows the previous contact of the same body
  /// within less than this time, however fast it is. Slow contacts of bodies that are pressed upon each other
  /// are marked without it: those within 4 sqrt(eps / (A + |g|)), the longest time of a hop within the
  /// tolerance (docs/grains.md).
  double zeno_interval = 0.0;
  /// The time at which the world begins. Doubles tell late times apart less finely: at 1.7e9, now in Unix
  /// seconds, to 2.4e-7, in which a body at speed 300 goes 7e-5. Contacts are not exact to less than that, so
  /// begin at 0 and add an offset where times are shown, unless such ways are far below the contact
  /// tolerance.
  double start_time = 0.0;
  /// Has no effect: work is spread over time anyway. A DistributedWorld refuses it.
  bool spread_window_starts = false;
  /// If a report breaks the promise of its body, the world takes the acceleration that explains the report
  /// for the body's acceleration limit from then on, unless the limit is larger already: so a body whose
  /// gravity was forgotten still meets what it falls on. Event::acceleration_limit says the limit. False: the
  /// promised limit stays, and each report that breaks it is a bound_violation (docs/guarantee.md).
  bool adopt_observed_limits = true;

  /// Two default separation distances (NaN) are equal.
  friend bool operator==(const WorldDefinition& a, const WorldDefinition& b) {
    const auto others = [](const WorldDefinition& world) {
      return std::tie(world.box, world.periodic, world.shear_rate, world.wall_filter, world.dimensions,
                      world.contact_tolerance, world.contacts, world.allow_overlap, world.zeno_interval,
                      world.start_time, world.spread_window_starts, world.adopt_observed_limits);
    };
    return others(a) == others(b) &&
           (a.separation_distance == b.separation_distance ||
            (std::isnan(a.separation_distance) && std::isnan(b.separation_distance)));
  }
};

}  // namespace kinesphere
