// The truth about the bodies of a world, kept apart from the world: present bodies, their limits, and their
// real motion, with a constant acceleration between changes.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <vector>

#include "bodies/collision_shape.hpp"
#include "contact/contact_event.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/motion/trajectory.hpp"
#include "kinesphere/shape.hpp"
#include "kinesphere/world_definition.hpp"
#include "number/infinity.hpp"
#include "simulation/oracle/gap_course.hpp"
#include "stream/operation.hpp"
#include "stream/true_rigid.hpp"

namespace kinesphere::stream {

/// The world contradicts the truth.
struct Disagreement : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline void require(bool holds, const char* what) {
  if (!holds) throw Disagreement(what);
}

/// Two bodies, or a body and a wall; or two bodies and a sensor distance, which is subtracted from their gap.
struct Contact {
  BodyId first;
  BodyId second = no_body;  ///< has a larger index than `first`
  Wall wall = Wall::none;
  std::optional<double> sensed{};

  friend bool operator==(const Contact&, const Contact&) = default;
};
std::string text_of(const Contact& contact);

struct TrueBody {
  BodyId id{};
  BodyDefinition definition{};  ///< the state in it is ignored
  Trajectory path{};            ///< one segment, since the last change
  bool alive = false;
  bool enabled = false;
  bool fixed = false;
  bool resting = false;          ///< asleep: in place, without velocity or acceleration
  double rested_at = 0.0;        ///< time of falling asleep
  Vec3 on_waking{};              ///< acceleration after waking
  std::optional<Shape> shape{};  ///< shape of a static body that is no ball
  std::optional<TrueRigid> rigid{};
  double last_contact = -std::numeric_limits<double>::infinity();  ///< according to events
  Range pressure{0.0, 0.0};  ///< limits of the acceleration that pressed it upon its partner then

  bool present() const { return alive && enabled; }
};

class Truth {
 public:
  explicit Truth(const WorldDefinition& definition);

  double time() const { return time_; }
  void move_on_to(double time) { time_ = time; }
  const WorldDefinition& definition() const { return definition_; }
  /// The present walls.
  const std::vector<Wall>& walls() const { return walls_; }
  /// Returns the vector without z in a world of the plane.
  Vec3 in_space(Vec3 v) const {
    if (definition_.dimensions == 2) v.z = 0.0;
    return v;
  }
  /// Returns whole periods, to be added to `from`.
  Vec3 shift_to_nearest(const Vec3& from, const Vec3& to) const;

  void add(BodyId id, const BodyDefinition& body, const Vec3& acceleration);
  void add_static(BodyId id, const BodyDefinition& body, const Shape& shape);
  /// `radius` is that of the ball around it.
  void add_rigid(BodyId id, const RigidBody& body, double radius, const Vec3& acceleration);
  /// The rigid body turns from now on with a constant angular velocity.
  void turn(BodyId id, const Rotation& rotation) { at(id).rigid->turning = {time_, rotation}; }
  /// The rigid body swings from now on, with this part of its largest angular acceleration.
  void swing(BodyId id, double part, const Vec3& axis);
  /// Notes the limits of accelerations of a rigid body, after each change of the body.
  void note_acceleration(BodyId id);
  /// Returns limits of the largest acceleration of a point of the body, as the world may know it.
  Range largest_accelerations(BodyId id) const;
  void remove(BodyId id);
  void move(BodyId id, const State& state);
  /// Sets the acceleration; a sleeping body gets it when it wakes.
  void steer(BodyId id, const Vec3& acceleration);
  void rest(BodyId id);
  void wake(BodyId id);

  const std::vector<TrueBody>& bodies() const { return bodies_; }
  TrueBody& at(BodyId id) { return bodies_[id.index]; }
  const TrueBody& at(BodyId id) const { return bodies_[id.index]; }
  /// Returns the present bodies, by index.
  std::vector<BodyId> ids() const;
  bool is_alive(BodyId id) const;
  bool is_present(BodyId id) const { return is_alive(id) && at(id).enabled; }
  State state(BodyId id) const { return at(id).path.front().state_at(time_); }
  Rotation rotation(BodyId id, double time) const { return at(id).rigid->turning.at(time); }
  /// Returns true if one of the bodies is rigid. Then approach_speed() is unknown.
  bool turns(const Contact& contact) const {
    return at(contact.first).rigid || (contact.wall == Wall::none && at(contact.second).rigid);
  }
  /// Returns the least gap of parts at these places and the walls that meet such a filter.
  double gap_to_walls(const std::vector<placed_parts::PlacedPart>& parts, const Filter& filter) const;

  /// The caller's own filter: haunted bodies touch only each other.
  bool pair_filter(BodyId a, BodyId b) const { return haunted_.contains(a) == haunted_.contains(b); }
  bool has_pair_filter = false;
  void haunt(BodyId id);
  std::array<Sensor, sensor_classes> sensors{};
  /// Returns true if events may report this contact.
  bool may_be_reported(const Contact& contact) const;
  /// Returns true if a body with this definition touches the other when they meet.
  bool may_touch(BodyId a, const BodyDefinition& definition_of_a, BodyId b) const;

  /// Returns true if gap() does not tell how deep the bodies overlap: axes and hulls in boxes and triangles.
  bool hides_depth(const Contact& contact) const {
    return turns(contact) && shape(contact) != nullptr && !inside(contact);
  }
  /// Returns the gap at the present time; for a sensor, beyond its distance.
  double gap(const Contact& contact) const;
  /// Returns the gap in quadruple precision, by formulas other than the library's.
  double exact_gap(const Contact& contact) const;
  /// Returns the distance of a point from the surface of the body.
  double distance(BodyId id, const Vec3& point) const;
  /// Returns the first time in [from, until] at which the gap is at most, or at least, `level`.
  std::optional<double> first_time(const Contact& contact, LevelCrossing overlap, double level, double from,
                                   double until) const;
  /// Returns the limits of the gap that bounds imply now.
  GapLimits limits(const CollisionShape& a, const CollisionShape& b) const;
  /// Returns the present closing speed of the gap.
  double approach_speed(const Contact& contact) const;
  /// Returns limits of the present closing speed of the gap of a rigid body: of before and of after this
  /// instant, at which the nearest points may change.
  Range closing_speeds(const Contact& contact) const;
  /// Returns false only if the gap certainly stays above (falls_to) or below (rises_to) the level until then.
  bool may_reach(const Contact& contact, LevelCrossing overlap, double level, double until) const;
  /// Returns true if the gap opens at some time between now and `until`.
  bool opens_before(const Contact& contact, double until) const;

 private:
  struct Relative {
    Vec3 position, velocity, acceleration;
  };
  const TrueBody& mover(const Contact& contact) const;
  const Shape* shape(const Contact& contact) const;
  std::optional<HalfSpace> inside(const Contact& contact) const;
  Relative relative(const Contact& contact) const;
  double approach_to_shape(const Contact& contact) const;
  double extent(const Contact& contact) const;
  double turning_speed(const Contact& contact) const;
  double least_radius(const Contact& contact) const;
  std::vector<placed_parts::PlacedPart> placed(const TrueBody& body, double time, const Vec3& shift) const;
  template <class Visit>
  void for_each_image(Visit visit) const;
  double gap_of_parts(const Contact& contact, double time, double enough) const;
  bool meets(const Contact& contact) const;
  bool senses(BodyId a, BodyId b, double distance) const;
  double gap_at(const Contact& contact, double time, double enough = infinity) const;
  std::optional<double> march(const Contact& contact, LevelCrossing overlap, double level, double from,
                              double until) const;
  std::optional<double> first_in_images(const Contact& contact, LevelCrossing overlap, double level,
                                        double from, double until) const;
  void restart(BodyId id);

  WorldDefinition definition_;
  std::vector<Wall> walls_;
  double time_;
  std::vector<TrueBody> bodies_;  ///< indexed by body
  std::set<BodyId> haunted_;
};

}  // namespace kinesphere::stream
