// What is true of the bodies of a world, kept apart from the world: who is there, what each promises, and how
// it really moves, which is with a constant acceleration between changes.
#pragma once

#include <limits>
#include <set>
#include <stdexcept>
#include <vector>

#include "contact/contact_event.hpp"
#include "detector/gap_course.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/motion/trajectory.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere::stream {

/// The world does not say what it should.
struct Disagreement : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline void require(bool holds, const char* what) {
  if (!holds) throw Disagreement(what);
}

/// Two bodies, or a body and a wall.
struct Contact {
  BodyId first;
  BodyId second = no_body;  ///< of larger index than `first`
  Wall wall = Wall::none;

  friend bool operator==(const Contact&, const Contact&) = default;
};
std::string text_of(const Contact& contact);

struct TrueBody {
  BodyId id{};
  BodyDefinition definition{};  ///< but for the state
  Trajectory path{};            ///< one segment, since the last change
  bool alive = false;
  bool enabled = false;
  double last_contact = -std::numeric_limits<double>::infinity();  ///< as events told

  bool present() const { return alive && enabled; }
};

class Truth {
 public:
  explicit Truth(const WorldDefinition& definition) : definition_(definition), time_(definition.start_time) {}

  double time() const { return time_; }
  void move_on_to(double time) { time_ = time; }
  const WorldDefinition& definition() const { return definition_; }

  void add(BodyId id, const BodyDefinition& body, const Vec3& acceleration);
  void remove(BodyId id);
  void move(BodyId id, const State& state);
  void steer(BodyId id, const Vec3& acceleration);

  const std::vector<TrueBody>& bodies() const { return bodies_; }
  TrueBody& at(BodyId id) { return bodies_[id.index]; }
  const TrueBody& at(BodyId id) const { return bodies_[id.index]; }
  /// Of the living, by index.
  std::vector<BodyId> ids() const;
  bool is_alive(BodyId id) const;
  bool is_present(BodyId id) const { return is_alive(id) && at(id).enabled; }
  State state(BodyId id) const { return at(id).path.front().state_at(time_); }

  /// The predicate of the caller's own: haunted bodies touch only each other.
  bool pair_filter(BodyId a, BodyId b) const { return haunted_.contains(a) == haunted_.contains(b); }
  bool has_pair_filter = false;
  void haunt(BodyId id);
  /// Whether events may tell of this contact.
  bool may_touch(const Contact& contact) const;
  bool passes_filters(BodyId a, const Filter& filter_of_a, BodyId b) const;

  GapCourse course(const Contact& contact) const;
  double gap(const Contact& contact) const { return course(contact).gap_at(time_); }
  /// How fast the gap closes now.
  double approach_speed(const Contact& contact) const;
  /// False only if the gap certainly stays above (falls_to) or below (rises_to) the level until then.
  bool may_reach(const Contact& contact, Crossing crossing, double level, double until) const;
  /// Whether the gap opens at some time between now and `until`.
  bool opens_before(const Contact& contact, double until) const;

 private:
  struct Relative {
    Vec3 position, velocity, acceleration;
  };
  Relative relative(const Contact& contact) const;
  double radii(const Contact& contact) const;
  void restart(BodyId id);

  WorldDefinition definition_;
  double time_;
  std::vector<TrueBody> bodies_;  ///< by index
  std::set<BodyId> haunted_;
};

}  // namespace kinesphere::stream
