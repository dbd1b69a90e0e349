// Plays a scenario: random changes, time, and comparisons of all events and answers with the truth.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinesphere/certificates.hpp"
#include "kinesphere/queries.hpp"
#include "kinesphere/response.hpp"
#include "kinesphere/world.hpp"
#include "mixed_worlds/draws.hpp"
#include "mixed_worlds/truth.hpp"

namespace kinesphere::mixed {

/// What has been compared so far.
struct Tally {
  std::size_t events = 0;
  std::size_t begins = 0;
  std::size_t answers = 0;
  bool cut_short = false;  ///< the scenario was crowded
};

class Player {
 public:
  explicit Player(const Scenario& scenario);
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  /// Throws Disagreement.
  void play();
  const Tally& tally() const { return tally_; }
  /// The latest changes and events, one a line.
  std::string story() const;

 private:
  const Scenario& scenario() const { return truth_.scenario(); }
  double now() const { return truth_.now; }
  double lengths(double count) const { return count * scenario().unit_length(); }
  double times(double count) const { return count * scenario().unit_time(); }
  double speeds(double count) const { return lengths(count) / scenario().unit_time(); }

  // player.cpp
  void begin_change(const char* name);
  void tell(const std::string& line);
  Probe probe();
  State report(BodyId id, double time);
  void give_rotation_probe();
  void step(double until);
  void move_on();
  void shrink(BodyId grown);
  template <class Call>
  void while_there_is_room(Call call);
  void send_back();
  void replay();
  void steer();
  void turn_back(Thing& thing);
  void turn(BodyId id, const Vec3& velocity);
  void spin(BodyId id, const Vec3& angular_velocity);
  void rest(Thing& thing);
  bool can_rest(const Thing& thing) const;
  void restarted(BodyId id);

  // changes.cpp
  using Change = void (Player::*)(Thing&);
  static const std::array<Change, 23> changes;
  void change_any();
  void come();
  void come_rigid();
  void build(bool is_zone);
  void carry();
  void change_sensor();
  void come(Thing&) { come(); }
  void replace(Thing& thing);
  void set_velocity(Thing& thing);
  void teleport(Thing& thing);
  void switch_on_or_off(Thing& thing);
  void set_radius(Thing& thing);
  void set_radius_rate(Thing& thing);
  void set_limits(Thing& thing);
  void set_filter(Thing& thing);
  void set_solid(Thing& thing);
  void set_sensor_class(Thing& thing);
  void set_spin(Thing& thing);
  void set_rotation(Thing& thing);
  void sleep_or_wake(Thing& thing);
  void set_shape(Thing& thing);
  void set_sensor(Thing& thing);
  void build(Thing& thing);
  Spin any_spin(const Thing& thing);

  // events.cpp
  struct ContactState {
    bool touching = false;  ///< a begin was told and, if there are ends, no end
    bool clear = false;     ///< with impacts: the two have parted since the last begin
    bool held = false;      ///< a response has parted the two, so that they may not sink deeper
  };
  void hear(const Event& event);
  void hear_begin(const Event& event, const Contact& contact);
  void hear_end(const Event& event, const Contact& contact);
  void check_gap_before_change(const Event& event, const Contact& contact);
  void check_approach(const Event& event, const Contact& contact) const;
  void respond(const Event& event, const Contact& contact);
  void act(BodyId id);
  /// Checks that what no event has told between two times has not happened.
  void check_silence(double from, double until);

  // answers.cpp
  void check_answers();
  /// Checks that the world counts the contacts and overlaps of a body that its events have told.
  void check_account(BodyId id) const;
  void check_safe_time(const World::Certificates& certificates);
  void check_pair(const World::Certificates& certificates, BodyId a, BodyId b);
  void check_approach(const World::Certificates& certificates, BodyId id);

  // queries.cpp
  struct Near {
    Real distance;  ///< from the point of a query, or along a ray
    BodyId body;
  };
  void check_queries(bool asks);
  bool is_sought(BodyId id, const QueryOptions& options) const;
  QueryOptions any_options();
  void check_overlaps(const World::Queries& queries, const Vec3& point, bool asks);
  void check_box(const World::Queries& queries, const Vec3& corner);
  void check_nearest(const World::Queries& queries, const Vec3& point);
  void check_cast(const World::Queries& queries, const Vec3& point);
  Real way_to_hit(const Thing& thing, const Vector& from, const Vector& along, double radius, double most);
  double query_slack() const;

  Truth truth_;
  World world_;
  Draws draw_;
  Tally tally_;
  std::map<Contact, ContactState> states_;
  std::vector<std::vector<Thing>> befores_;  ///< the truth before each change at the present time
  std::uint64_t reports_ = 0;
  std::deque<std::string> story_;
};

}  // namespace kinesphere::mixed
