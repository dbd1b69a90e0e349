// The bodies of a world: their table, and beside it what some of them have: changes, rests, filters, homes,
// shapes, sensors.
//
// A fixed body has a shape in a table of its own; it is never probed. A body that rests has a bound that
// stands still, and is otherwise like any other; what it promises once it is awake waits in a table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "contact/contact_event.hpp"
#include "contact/sensor_table.hpp"
#include "engine/body_table.hpp"
#include "engine/filters.hpp"
#include "engine/periodic_image.hpp"
#include "engine/shapes.hpp"
#include "engine/side_table.hpp"
#include "kinesphere/world_definition.hpp"
#include "space/space.hpp"

namespace kinesphere {

class Bodies {
 public:
  explicit Bodies(const WorldDefinition& definition);

  const WorldDefinition& definition() const { return definition_; }
  const Space& space() const { return space_; }
  /// As walls_of(definition()).
  const std::optional<Box>& walls() const { return walls_; }

  const BodyTable& table() const { return table_; }
  Body& operator[](std::uint32_t number) { return table_[number]; }
  const Body& operator[](std::uint32_t number) const { return table_[number]; }
  BodyId id_of(std::uint32_t number) const { return table_.id_of(number); }
  std::uint32_t numbers() const { return table_.numbers(); }

  void reserve(std::size_t bodies);
  /// A body with all of its definition but its state and its promise: its number.
  std::uint32_t add(const BodyDefinition& definition);
  /// The same with a name (BodyTable). Its definition may be that of one that has moved here.
  std::uint32_t add(const BodyDefinition& definition, std::uint32_t name);
  /// The body never moves, and has this shape.
  void fix(std::uint32_t number, const Shape& shape);
  void remove(std::uint32_t number);

  /// With the state of the last report, and with all changes since.
  BodyDefinition definition_of(std::uint32_t number) const;
  void set_solid(std::uint32_t number, bool solid);
  /// The change of the body, to be made or added to.
  Change& change_of(std::uint32_t number);
  /// It is in force, or the body has gone.
  void forget_change(std::uint32_t number) { changes.remove(table_, number); }

  /// Whether the filters let two bodies touch or sense each other.
  bool may_meet(std::uint32_t a, std::uint32_t b) const {
    return !filters.any() || (!(table_[a].is_static() && table_[b].is_static()) &&
                              filters.may_meet(id_of(a), filters.of(a), id_of(b), filters.of(b)));
  }
  bool may_touch(std::uint32_t a, std::uint32_t b) const {
    return table_[a].solid && table_[b].solid && may_meet(a, b);
  }

  /// The caller has placed the body anew: its images are counted from here.
  void count_images_anew(std::uint32_t number) {
    if (space_.repeats()) images[number].image = {};
  }
  /// Where space repeats: moves the body to the image in which the middle of its way for this long lies in
  /// the primary box.
  void wrap_to_primary(std::uint32_t number, double now, double length);

  /// A body as it is, to be put back as it was; without changes since its report.
  struct Checkpoint {
    Body body;
    PeriodicImage image;
  };
  Checkpoint checkpoint(std::uint32_t number) const {
    return {table_[number], space_.repeats() ? images[number] : PeriodicImage{}};
  }
  void restore(std::uint32_t number, const Checkpoint& checkpoint) {
    table_[number] = checkpoint.body;
    if (space_.repeats()) images[number] = checkpoint.image;
  }

  /// All but the definition and what follows from it, the tag, and the pair filter. The ids of bodies that
  /// are read are given out anew.
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [changed, resting, filtered, at_home, fixed, sensing, definition, space, enclosure, numbered] =
        self;
    auto& [bodies, live_count, free, tag, names] = numbered;
    auto& [by_number, pair_filter, any] = filtered;
    archive(bodies, live_count, changed, resting, by_number, at_home, free, fixed, sensing, any);
    if constexpr (!std::is_const_v<Self>) tag = 0;
  }
  /// For one that was read, with the time of the world: nullptr, or the part that cannot have come about.
  const char* first_invalid_part(double now, const std::vector<std::uint32_t>& dirty) const;

  // Parts of the bodies. What concerns the table too is done by the functions above.
  WaitingChanges changes;
  SleepRecords sleep_records;
  Filters filters;
  std::vector<PeriodicImage> images;  ///< by number; empty unless space repeats
  Shapes shapes;
  SensorTable sensors;

 private:
  std::uint32_t describe(std::uint32_t number, const BodyDefinition& definition);
  bool bodies_are_valid(double now, const std::vector<std::uint32_t>& dirty) const;
  bool is_valid(std::uint32_t number, double now) const;
  bool is_valid_static(std::uint32_t number, double now) const;
  bool sleep_is_valid(const Body& body) const;
  bool limits_are_valid(const Body& body, BodyDefinition definition) const;

  WorldDefinition definition_;
  Space space_;
  std::optional<Box> walls_;
  BodyTable table_;
};

}  // namespace kinesphere
