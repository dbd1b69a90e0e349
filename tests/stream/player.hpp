// Plays a stream of operations on a world, and compares all results with the truth.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "kinesphere/workers.hpp"
#include "simulation/scene/scene.hpp"
#include "stream/operation.hpp"
#include "stream/reported_contacts.hpp"

namespace kinesphere::stream {

/// An argument that every call must refuse.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class Player {
 public:
  explicit Player(const WorldKind& kind);
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  /// Throws Disagreement.
  void perform(const Operation& operation);
  static const char* name_of(const Operation& operation);

  const World& world() const { return world_; }
  std::size_t events() const { return events_; }

 private:
  struct Kind {
    const char* name;
    int weight;
    void (Player::*perform)(const Operation&);
  };
  static const std::array<Kind, 29> kinds;
  static const Kind& kind_of(std::uint8_t code);

  // The operations. Operations that need a body do nothing if there is none.
  void advance(const Operation& operation);
  void run(const Operation& operation);
  void advance_to_next(const Operation& operation);
  void advance_with_bad_probe(const Operation& operation);
  void add(const Operation& operation);
  void add_all(const Operation& operation);
  void remove(const Operation& operation);
  void remove_all(const Operation& operation);
  void set_velocity(const Operation& operation);
  void steer(const Operation& operation);
  void teleport(const Operation& operation);
  void nudge(const Operation& operation);
  void set_radius(const Operation& operation);
  void set_motion_limits(const Operation& operation);
  void set_filter(const Operation& operation);
  void set_pair_filter(const Operation& operation);
  void haunt(const Operation& operation);
  void set_solid(const Operation& operation);
  void set_sensor(const Operation& operation);
  void set_sensor_class(const Operation& operation);
  void add_static(const Operation& operation);
  void set_user_data(const Operation& operation);
  void turn_off(const Operation& operation);
  void turn_on(const Operation& operation);
  void restore(const Operation& operation);
  void ask(const Operation& operation);
  void call_wrongly(const Operation& operation);
  void rest(const Operation& operation);
  void wake(const Operation& operation);

  // player.cpp
  template <class Call>
  auto on_world(Call call);
  using Answers = std::function<void(std::span<const BodyId>, double, std::span<State>)>;
  Answers probe();
  std::optional<Event> next_event(double until);
  void answer(const Event& event, const Operation& operation);
  void move_on();
  void hear(const Event& event);
  void check_order(const Event& event);
  void check_all() const;
  void check_body(BodyId id) const;
  std::optional<BodyId> any(const Operation& operation) const;
  std::optional<BodyId> any_moving(const Operation& operation) const;
  Operation about(BodyId id, Operation operation) const;

  // rest.cpp
  struct EventProcessor {
    std::vector<BodyId> has_to_wake, may_wake;
    void join(const EventProcessor& other);
  };
  bool in_touch(BodyId id, BodyId resting, bool certainly) const;
  std::vector<BodyId> resting_with(BodyId id, bool certainly) const;
  EventProcessor island_of(BodyId id) const;
  EventProcessor island_if_resting(BodyId id) const;
  void check_woken(const EventProcessor& island);
  void hear_woken(const Event& event);
  void wake_by(const Event& event);
  void rest(BodyId id);
  template <class Call>
  auto waking(const EventProcessor& island, Call call);

  // run.cpp
  Workers& workers(int threads);
  std::vector<Event> loop(double until, const ResponseFn& respond);

  // sprint.cpp
  void sprint(BodyId id, const Operation& operation) const;
  void check_touching(const World& world, BodyId id, const Vec3& place) const;

  // rigid.cpp
  bool is_rigid(BodyId id) const { return truth_.at(id).rigid.has_value(); }
  void give_rotation_probe(World& world);
  RigidBody new_rigid_body(const Operation& operation) const;
  void add_rigid(const Operation& operation);
  void turn(BodyId id, const Vec3& angular_velocity);
  void turn(BodyId id, const Rotation& rotation);
  void turn(BodyId id, const Operation& operation);
  void go_on_turning(BodyId id);
  void check_rigid(const BodyView& view, const TrueBody& body) const;
  void turn_wrongly(BodyId id, const Operation& operation);

  // changes.cpp
  BodyDefinition new_body(const Operation& operation) const;
  double radius(const Operation& operation) const;
  Vec3 acceleration(const Operation& operation, const MotionLimits& promise) const {
    return truth_.in_space(operation.acceleration(promise));
  }
  MotionLimits limits(const Operation& operation) const;
  bool has_room(BodyId id, const CollisionShape& extent, const BodyDefinition& body) const;
  template <class Change>
  void refresh_filter(const std::vector<BodyId>& ids, Change change);
  void join(BodyId id, const BodyDefinition& body, const Operation& operation);
  void leave(BodyId id, const std::vector<Before>& before);
  Vec3 inside(Vec3 position, double radius) const;
  bool room_of_fixed(BodyId id) const;
  State place(const Operation& operation, double radius) const;
  void set_velocity(BodyId id, const Vec3& velocity);
  void teleport(BodyId id, const State& state);
  void send_back();
  void check_snapshot() const;
  PairFilter pair_filter() const;
  void give_pair_filter(World& world) const;
  void give_pair_filters();
  void changed() { rounds_ = 3; }

  WorldKind kind_;
  Truth truth_;
  ReportedContacts told_;
  World world_;
  std::optional<World> twin_;                      ///< must behave like the world
  bool twin_saves_the_same_ = false;               ///< to the last byte
  std::array<std::optional<Workers>, 3> workers_;  ///< indexed by the number of threads, less one
  std::vector<BodyId> removed_;
  std::set<BodyId> woken_;  ///< woken at this instant, without an event so far
  std::size_t events_ = 0;
  std::optional<Event> last_event_;
  int rounds_ = 0;  ///< ordered rounds of events that may begin at this instant
  /// The rotation probe gives this instead of a rotation, once.
  std::optional<Rotation> bad_rotation_;
  bool crossed_ = false;  ///< a crossing came in this round; the pair's next distance has a round of its own
  double asked_at_;       ///< time of the last probe
};

struct Failure {
  std::size_t operation;  ///< its number in the stream
  std::string what;
};
struct Played {
  std::size_t operations = 0;
  std::size_t events = 0;
  std::optional<Failure> failure;
};
Played play(std::span<const std::uint8_t> bytes);

/// Returns a stream with a failure, by as few operations as removing them finds.
Bytes shrunk(Bytes bytes);

/// Returns text about a failing stream: its operations by name, and its bytes.
std::string story_of(std::span<const std::uint8_t> bytes);

}  // namespace kinesphere::stream
