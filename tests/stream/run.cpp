// World::run: a copy of the world runs by itself and must agree to the last bit with a loop over advance()
// that has equal responses. The events of the loop are compared with the truth, so the truth holds for the
// run as well.
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <limits>
#include <utility>

#include "kinesphere/inspection.hpp"
#include "kinesphere/response.hpp"
#include "stream/player.hpp"

namespace kinesphere::stream {
namespace {

/// Maximum events of a loop; it stops at the end of the instant that reaches it.
constexpr std::size_t most_events = 300;

bool is_begin(const Event& event) {
  return event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
}

/// Places in which a run can fail, at one event.
enum class Fault { nowhere, sink, respond, refused_answer, departure, states, refused_states };

/// Thrown by a callback that fails.
struct Failed {};

/// Responds to an event by the event alone: two bodies that meet bounce, lose speed, settle, or pass.
class Answering {
 public:
  Answering(const Truth& truth, std::uint64_t seed, bool passes)
      : truth_(truth), seed_(seed), passes_(passes) {}

  Response operator()(const Event& event) const {
    if (passes_) return {};
    // The body starts from there, with the acceleration of its awake state.
    if (event.kind == EventKind::woke && moves(event.first))
      return {.first_velocity = event.first_state.velocity};
    if (!is_begin(event) || event.approach_speed <= 0.0) return {};
    Random random(seed_ ^ std::bit_cast<std::uint64_t>(event.time) ^ event.first.pack());
    const double unit = truth_.scenario().unit_length() / truth_.scenario().unit_time();
    Response answer;
    switch (random.bits() % 8) {
      case 0:
      case 1:
        return {};
      case 2:
        answer = response_of(event, bounce(event, 0.3));
        break;
      case 3:
        answer = response_of(event, settle(event, 0.3, 0.1 * unit));
        break;
      default:
        answer = response_of(event, bounce(event, 1.0));
    }
    if (!turns(event.first, answer.first_angular_velocity)) answer.first_angular_velocity.reset();
    if (!turns(event.second, answer.second_angular_velocity)) answer.second_angular_velocity.reset();
    return answer;
  }
  bool moves(BodyId id) const {
    const Thing& thing = truth_.at(id);
    return thing.id == id && thing.present() && thing.moves();
  }

 private:
  /// Contacts turn bodies in worlds without a rotation probe, where the new spin is within the limit.
  bool turns(BodyId id, const std::optional<Vec3>& angular_velocity) const {
    return angular_velocity && !truth_.scenario().spins &&
           norm(*angular_velocity) < 0.8 * truth_.at(id).largest_spin;
  }

  const Truth& truth_;
  std::uint64_t seed_;
  bool passes_;
};

/// Moves bodies from their true states at the begin of the run.
class Moving final : public MotionSource {
 public:
  explicit Moving(const Truth& truth) : truth_(truth), things_(truth.things) {}
  void fail_at(const Event& event, const Response& answer, Fault fault) {
    event_ = event;
    answer_ = answer;
    fault_ = fault;
  }
  void fail_no_more() { fault_ = Fault::nowhere; }
  /// Checks the calls. An exception inside a cluster would only make the run fall back.
  void check_use() const {
    if (const char* misuse = misuse_) throw Disagreement(misuse);
  }

  void states(std::span<const BodyId> ids, double time, std::span<State> states) override {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const Thing& thing = things_[ids[k].index];
      if (!thing.present() || thing.id != ids[k] || !thing.moves())
        misuse_ = "a run asks for a body that does not move";
      if (time < thing.path.since) misuse_ = "a run asks for a time before the body set out";
      states[k] = truth_.report(thing, time);
      if (time != event_.time || (ids[k] != event_.first && ids[k] != event_.second)) continue;
      if (fault_ == Fault::states) throw Failed();
      if (fault_ == Fault::refused_states) states[k].position.y = nan;
    }
  }
  MotionOrigin origin(BodyId id) const override {
    const Path& path = things_[id.index].path;
    return {path.since, {rounded(path.position), rounded(path.velocity)}};
  }
  /// A body that slept is awake from then on.
  void set_origin(BodyId id, const MotionOrigin& origin) override {
    const auto& velocity = id == event_.first ? answer_.first_velocity : answer_.second_velocity;
    if (fault_ == Fault::departure && origin.time == event_.time &&
        (id == event_.first || id == event_.second) && origin.state.velocity == velocity)
      throw Failed();
    Thing& thing = things_[id.index];
    if (std::exchange(thing.sleeping, false))
      thing.path.acceleration = vector(thing.definition.planned_acceleration);
    thing.path.since = origin.time;
    thing.path.position = vector(origin.state.position);
    thing.path.velocity = vector(origin.state.velocity);
  }

 private:
  const Truth& truth_;
  std::vector<Thing> things_;
  std::atomic<const char*> misuse_ = nullptr;
  Fault fault_ = Fault::nowhere;
  Event event_;
  Response answer_;
};

/// A world that runs, with its expected events.
class Run {
 public:
  Run(World& world, Moving& source, const Answering& answer, const std::vector<Event>& expected)
      : world_(world), mover_(source), answer_(answer), expected_(expected) {}

  /// Fails at the first event that equals this one of the expected events.
  void fail_at(std::size_t place, Fault fault) {
    const Event& event = expected_[place];
    // An answer has no effect on a body that has gone, whatever it says.
    if (fault == Fault::refused_answer && !answer_.moves(event.first)) fault = Fault::respond;
    const auto same = [&](const Event& other) { return other == event; };
    place_ =
        static_cast<std::size_t>(std::find_if(expected_.begin(), expected_.end(), same) - expected_.begin());
    fault_ = fault;
    mover_.fail_at(event, answer_(event), fault);
  }

  /// Returns false if it failed as requested; it does not fail again.
  bool go(double until, bool answers, Workers& workers) {
    const auto states = [this](std::span<const BodyId> ids, double time, std::span<State> answer) {
      mover_.states(ids, time, answer);
    };
    const auto respond = [this](const Event& event) { return respond_to(event); };
    const auto sink = [this](const Event& event) { tell(event); };
    try {
      const auto done = answers ? world_.run(until, mover_, respond, sink, &workers)
                                : world_.run(until, states, sink, &workers);
      if (done) {
        require(told_ == expected_.size(), "a run leaves out events");
        require(fault_ != Fault::sink && fault_ != Fault::respond && fault_ != Fault::refused_answer,
                "a run does not say that a callback has failed");
        return true;
      }
      require(fault_ == Fault::refused_answer || fault_ == Fault::refused_states,
              "a run is refused without a reason");
      require(done.error().code == ErrorCode::not_finite, "a run is refused for a wrong reason");
    } catch (const Failed&) {
      require(fault_ != Fault::nowhere, "a failure is reported twice");
    }
    check_failure();
    fault_ = Fault::nowhere;
    mover_.fail_no_more();
    return false;
  }

  /// Completes the run by a loop.
  void go_by_loop(double until, bool answers) {
    const auto probe = [this](std::span<const BodyId> ids, double time, std::span<State> states) {
      mover_.states(ids, time, states);
    };
    for (;;) {
      const auto event = world_.advance(until, probe);
      if (!event) throw Disagreement("advance after a run: " + event.error().message);
      if (!*event) break;
      tell(**event);
      const Response answer = answers ? answer_(**event) : Response{};
      turn((*event)->first, answer.first_velocity);
      turn((*event)->second, answer.second_velocity);
      spin((*event)->first, answer.first_angular_velocity);
      spin((*event)->second, answer.second_angular_velocity);
    }
    require(told_ == expected_.size(), "a loop after a run leaves out events");
  }

 private:
  Response respond_to(const Event& event) const {
    Response answer = answer_(event);
    if (place_ >= expected_.size() || event != expected_[place_]) return answer;
    if (fault_ == Fault::respond) throw Failed();
    if (fault_ == Fault::refused_answer) answer.first_velocity = Vec3{nan, 0, 0};
    return answer;
  }
  void tell(const Event& event) {
    require(event.time <= world_.time(), "an event is reported before its time");
    require(told_ < expected_.size(), "a run tells more than a loop");
    require(event == expected_[told_], "a run tells something else than a loop");
    ++told_;
    if (fault_ == Fault::sink && told_ > place_) throw Failed();
  }
  void turn(BodyId id, const std::optional<Vec3>& velocity) {
    if (!velocity) return;
    State state;
    mover_.states(std::span(&id, 1), world_.time(), std::span(&state, 1));
    mover_.set_origin(id, {world_.time(), {state.position, *velocity}});
    if (const auto done = world_.set_velocity(id, *velocity); !done)
      throw Disagreement("set_velocity after a run: " + done.error().message);
  }
  void spin(BodyId id, const std::optional<Vec3>& angular_velocity) {
    if (angular_velocity) world_.change(id, {.angular_velocity = *angular_velocity}).value();
  }
  /// Checks that the world is at the expected time, and clean.
  void check_failure() const {
    const bool at_event = fault_ == Fault::respond || fault_ == Fault::refused_answer;
    require(fault_ != Fault::sink || told_ == place_ + 1, "a run goes on when the sink has failed");
    require(!at_event || told_ == place_, "a run fails at another event than the callback");
    require(told_ == 0 || expected_[told_ - 1].time <= expected_[place_].time,
            "events are reported that come after a failure");
    if (const auto finding = world_.inspection().audit())
      throw Disagreement("audit of a run that failed: " + finding->where + ": " + finding->what);
  }

  World& world_;
  Moving& mover_;
  const Answering& answer_;
  const std::vector<Event>& expected_;
  std::size_t told_ = 0;
  Fault fault_ = Fault::nowhere;
  std::size_t place_ = 0;
};

}  // namespace

Workers& Player::workers(int threads) {
  auto& place = workers_[static_cast<std::size_t>(threads - 1)];
  if (!place) place = Workers::create(threads).value();
  return *place;
}

/// Goes on to `until`, or to an event with many before it.
std::vector<Event> Player::loop(double until, const ResponseFn& respond) {
  std::vector<Event> events;
  while (const auto event = next_event(until)) {
    events.push_back(*event);
    const Response answer = respond(*event);
    if (answer.first_velocity) turn(event->first, *answer.first_velocity);
    if (answer.second_velocity) turn(event->second, *answer.second_velocity);
    if (answer.first_angular_velocity) spin(event->first, *answer.first_angular_velocity);
    if (answer.second_angular_velocity) spin(event->second, *answer.second_angular_velocity);
    if (events.size() >= most_events) until = world_.time();
  }
  return events;
}

/// Compares a run of a copy of the world with a loop. Goes on with the copy, unless the world is recorded.
void Player::run() {
  // Bodies that grow too large end a run.
  if (!scenario().runs || (scenario().radii && scenario().is_periodic())) return;
  const bool sleep = !woken_.empty() || std::ranges::any_of(truth_.things, [](const Thing& thing) {
    return thing.present() && thing.sleeping;
  });
  // Reports with errors have no origin.
  const bool answers = !scenario().errors && (sleep || !draw_.one_in(8));
  if (sleep && !answers) return;
  begin_change("run");
  steer();
  const double length = draw_.uniform();
  const Answering answer(truth_, draw_.below(~std::size_t{0}), !answers);
  World world = world_.clone().value();
  if (truth_.has_pair_filter) world.set_pair_filter(pair_filter()).value();
  if (truth_.has_pair_filter) world_.set_pair_filter(pair_filter()).value();
  give_rotation_probe(world);
  for (Thing& thing : truth_.things) {
    const State state = state_of(thing, now());
    if (thing.moves())
      thing.path = {now(), vector(state.position), vector(state.velocity), thing.path.acceleration};
  }
  Moving source(truth_);
  const double start = now();
  const std::uint64_t probes = world_.counters().probes - world.counters().probes;
  const std::vector<Event> events =
      loop(start + times((scenario().crowd ? 0.3 : 0.2) * length * length), answer);

  Run run(world, source, answer, events);
  Fault fault = Fault::nowhere;
  if (!events.empty() && draw_.one_in(2)) {
    static constexpr std::array faults{Fault::sink,    Fault::states,    Fault::refused_states,
                                       Fault::respond, Fault::departure, Fault::refused_answer};
    fault = faults[draw_.below(answers ? 6 : 3)];
    // A motion source cannot set a body back to sleep, so this fault would wake it.
    if (fault == Fault::departure && sleep) fault = Fault::respond;
    const std::size_t place = draw_.below(events.size());
    // The world does not probe again after a report of this instant.
    if (fault == Fault::refused_states && (events[place].time == start || !is_begin(events[place])))
      fault = Fault::states;
    run.fail_at(place, fault);
  }
  const int threads = 1 + static_cast<int>(draw_.below(3));
  if (!run.go(world_.time(), answers, workers(threads))) {
    // Events that the sink has not received already have responses, which a loop would not know.
    if (fault != Fault::sink && draw_.one_in(2))
      run.go_by_loop(world_.time(), answers);
    else
      require(run.go(world_.time(), answers, workers(1 + static_cast<int>(draw_.below(3)))),
              "a run fails again");
  }
  source.check_use();
  require(world.time() == world_.time(), "a run ends at another time than a loop");
  if (fault == Fault::nowhere)
    require(world.counters().probes + probes == world_.counters().probes,
            "a run probes otherwise than a loop");
  for (const Thing& thing : truth_.things) {
    if (!thing.present() || !thing.moves()) continue;
    const MotionOrigin origin = source.origin(thing.id);
    require(origin.time == thing.path.since &&
                origin.state == State{rounded(thing.path.position), rounded(thing.path.velocity)},
            "a run leaves a body on another way than a loop");
  }
  if (!scenario().recorded) world_ = std::move(world);
}

}  // namespace kinesphere::stream
