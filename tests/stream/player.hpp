// Plays a stream of operations on the world of a scenario, and compares all events and answers with the
// truth.
#pragma once

#include <array>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "kinesphere/certificates.hpp"
#include "kinesphere/queries.hpp"
#include "kinesphere/response.hpp"
#include "kinesphere/workers.hpp"
#include "kinesphere/world.hpp"
#include "stream/draws.hpp"
#include "stream/operation.hpp"
#include "stream/truth.hpp"

namespace kinesphere::stream {

/// An argument that every call must refuse.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// What has been compared so far.
struct Tally {
  std::size_t events = 0;
  std::size_t begins = 0;
  std::size_t answers = 0;
};

class Player {
 public:
  explicit Player(const Scenario& scenario);
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  /// Throws Disagreement, or CutShort.
  void perform(const Operation& operation);
  /// Ends the recording, if there is one, and compares its replay.
  void finish();
  const World& world() const { return world_; }
  const Tally& tally() const { return tally_; }
  /// The latest changes and events, one a line.
  std::string story() const;

  /// The code of an operation that runs the world.
  static constexpr std::uint8_t run_code = 0;

 private:
  const Scenario& scenario() const { return truth_.scenario(); }
  double now() const { return truth_.now; }
  double lengths(double count) const { return count * scenario().unit_length(); }
  double times(double count) const { return count * scenario().unit_time(); }
  double speeds(double count) const { return lengths(count) / scenario().unit_time(); }

  struct Kind {
    const char* name;
    int weight;
    void (Player::*perform)();
  };
  static const std::array<Kind, 32> kinds;
  static const Kind& kind_of(std::uint8_t code);
  /// Performs another change at an event, of any kind that does not move time on.
  void perform_any_change();

  // player.cpp
  void begin_change(const char* name);
  void tell(const std::string& line);
  Thing* thing();
  Thing* moving_thing();
  Probe probe();
  void give_rotation_probe(World& world);
  std::optional<Event> next_event(double until);
  void move_on();
  void advance();
  void advance_to_next();
  void advance_with_bad_probe();
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
  void check_world();
  void check_body(const Thing& thing) const;

  // sleeping.cpp
  void check_awake(const std::optional<std::vector<BodyId>>& touched = std::nullopt);
  bool in_touch(const Thing& a, const Thing& b, bool certainly) const;

  // changes.cpp
  void come();
  void come_rigid();
  void come_together();
  void build(bool is_zone);
  void build();
  void carry();
  void leave(Thing& thing);
  void remove();
  void remove_some();
  void set_velocity();
  void teleport();
  void teleport(Thing& thing, const State& to);
  void nudge();
  void switch_on_or_off();
  void set_radius();
  void set_radius_rate();
  void set_limits();
  void set_filter();
  void set_pair_filter();
  void haunt();
  void set_solid();
  void set_sensor_class();
  void set_user_data();
  void set_spin();
  void set_rotation();
  void sleep_or_wake();
  void set_shape();
  void set_sensor();
  Spin any_spin(const Thing& thing);
  PairFilter pair_filter() const;
  void check_refusal(const Error& error, const Thing& thing) const;

  // run.cpp
  void run();
  Workers& workers(int threads);
  std::vector<Event> loop(double until, const ResponseFn& respond);

  // sprint.cpp
  void sprint();
  void check_touching(const World& world, BodyId id, const Vec3& place) const;

  // wrong_calls.cpp
  void call_wrongly();

  // events.cpp
  struct ContactState {
    bool touching = false;  ///< a begin was told and, if there are ends, no end
    bool clear = false;     ///< with impacts: the two have parted since the last begin
    bool held = false;      ///< a response has parted the two, so that they may not sink deeper
  };
  void hear(const Event& event);
  void check_order(const Event& event);
  bool is_repeated(const Event& begin, const Contact& contact, bool certainly) const;
  Range pressure_of(const Contact& contact) const;
  std::vector<BodyId> counting(const Contact& contact) const;
  struct Followed {
    double passed;
    Range pressure;
  };
  Followed followed_by(const Contact& contact, bool certainly) const;
  void note_begin(const Contact& contact);
  void hear_begin(const Event& event, const Contact& contact);
  void hear_end(const Event& event, const Contact& contact);
  void check_gap_before_change(const Event& event, const Contact& contact);
  void check_approach(const Event& event, const Contact& contact) const;
  void respond(const Event& event);
  void act(BodyId id);
  /// Checks that what no event has told between two times has not happened.
  void check_silence(double from, double until);

  // answers.cpp
  void ask();
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
  std::size_t probes_ = 0;
  std::uint8_t chosen_ = 0;  ///< body of the present operation
  std::map<Contact, ContactState> states_;
  std::vector<std::vector<Thing>> befores_;          ///< the truth before each change at the present time
  std::vector<BodyId> removed_;                      ///< the latest
  std::set<BodyId> woken_;                           ///< woken at this instant, without an event so far
  std::array<std::optional<Workers>, 3> workers_{};  ///< by the number of threads, less one
  std::optional<Event> last_event_;
  int rounds_ = 0;        ///< ordered rounds of events that may begin at this instant
  bool crossed_ = false;  ///< a crossing came in this round; the pair's next distance has a round of its own
  /// The rotation probe gives this instead of a rotation, once.
  std::optional<Rotation> bad_rotation_;
  std::deque<std::string> story_;
};

struct Played {
  std::size_t operations = 0;  ///< up to the one that fails
  Tally tally;
  bool cut_short = false;  ///< the scenario was crowded
  std::optional<std::string> failure;
  std::string story;  ///< the latest changes and events
};
Played play(std::span<const std::uint8_t> bytes);

/// Returns the snapshot of the world of a stream at its end, or where it is cut short.
std::vector<std::byte> snapshot_after(std::span<const std::uint8_t> bytes);

/// Returns a stream with a failure, by as few features, bodies and operations as leaving them out finds.
Bytes shrunk(Bytes bytes);

/// Returns text about a failing stream: its scenario, its latest changes and events, and its bytes.
std::string story_of(std::span<const std::uint8_t> bytes);

}  // namespace kinesphere::stream
