// Steps of a recording: one class for each call that changes a world, with its arguments, and one for all
// calls that probe.
//
// A change lists its fields for archives and repeats itself through the public call, which checks its
// arguments.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include "archive/archive.hpp"
#include "archive/checksum.hpp"
#include "archive/envelope.hpp"
#include "archive/fields.hpp"
#include "kinesphere/recording.hpp"
#include "recording/differences.hpp"

namespace kinesphere {

/// Raise the version when the serialized steps change. The snapshot's version covers changes of their effect
/// on a world.
inline constexpr Envelope recording_envelope{{'K', 'i', 'n', 'e', 'r', 'c', '\r', '\n'},
                                             15,
                                             "recording",
                                             "Replay::open",
                                             "recording",
                                             ErrorCode::bad_recording};

namespace step {

/// Addition of a body through the World member `call`.
template <class Definition, Result<BodyId> (World::*call)(const Definition&)>
struct New {
  Definition body{};

  Result<void> repeat(World& world) const {
    const auto added = (world.*call)(body);
    return added ? Result<void>() : Result<void>(added.error());
  }
};
using Add = New<BodyDefinition, &World::add>;
using AddStatic = New<StaticDefinition, &World::add_static>;
using AddMovingShape = New<MovingShape, &World::add_moving_shape>;
using AddRigidBody = New<RigidBody, &World::add_rigid_body>;

/// Change of one body without an argument, through the World member `call`.
template <auto call>
struct Plain {
  BodyId body{};

  Result<void> repeat(World& world) const { return (world.*call)(body); }
};
using Remove = Plain<&World::remove>;
using Disable = Plain<&World::disable>;
using RefreshFilter = Plain<&World::refresh_filter>;
using SleepBody = Plain<&World::sleep>;
using Wake = Plain<&World::wake>;

/// Change of one body, or of a sensor class, with one argument, through the World member `call`. `Parameter`
/// is the parameter type of that member.
template <class Subject, class Argument, class Parameter, Result<void> (World::*call)(Subject, Parameter)>
struct With {
  Subject subject{};
  Argument argument{};

  Result<void> repeat(World& world) const { return (world.*call)(subject, argument); }
};
using SetVelocity = With<BodyId, Vec3, const Vec3&, &World::set_velocity>;
using Teleport = With<BodyId, State, const State&, &World::teleport>;
using Enable = With<BodyId, State, const State&, &World::enable>;
using SetSensor = With<SensorClass, Sensor, const Sensor&, &World::set_sensor>;
using SetShape = With<BodyId, Shape, const Shape&, &World::set_shape>;

/// Change of one property of a body, a member of BodyChange.
template <class Argument, std::optional<Argument> BodyChange::*property>
struct Set {
  BodyId body{};
  Argument argument{};

  Result<void> repeat(World& world) const {
    BodyChange change;
    change.*property = argument;
    return world.change(body, change);
  }
};
using SetRadius = Set<double, &BodyChange::radius>;
using SetMotionLimits = Set<MotionLimits, &BodyChange::motion_limits>;
using SetFilter = Set<Filter, &BodyChange::filter>;
using SetSolid = Set<bool, &BodyChange::solid>;
using SetSensorClass = Set<SensorClass, &BodyChange::sensor_class>;
using SetMass = Set<double, &BodyChange::mass>;
using SetUserData = Set<std::uint64_t, &BodyChange::user_data>;
using SetAngularVelocity = Set<Vec3, &BodyChange::angular_velocity>;
using SetRadiusRate = Set<double, &BodyChange::radius_rate>;
using SetRotation = Set<Rotation, &BodyChange::rotation>;

struct SetPairState {
  BodyId first{};
  BodyId second{};
  std::int32_t state = 0;

  Result<void> repeat(World& world) const { return world.set_pair_state(first, second, state); }
};

/// Two bodies were turned back at a sensor distance. It holds what of the event matters.
struct TurnBack {
  EventKind kind{};
  BodyId first{};
  BodyId second{};
  Senses senses{};
  double distance = 0.0;

  static TurnBack of(const Event& crossing) {
    return {crossing.kind, crossing.first, crossing.second, crossing.senses, crossing.distance};
  }
  Result<void> repeat(World& world) const {
    return world.turn_back({.kind = kind,
                            .time = world.time(),
                            .first = first,
                            .second = second,
                            .senses = senses,
                            .distance = distance});
  }
};

/// A timer that was scheduled.
struct Schedule {
  Timer timer{};

  Result<void> repeat(World& world) const { return world.schedule(timer); }
};
/// All timers with these data were removed.
struct Unschedule {
  std::uint64_t user_data = 0;

  Result<void> repeat(World& world) const {
    const auto removed = world.unschedule(user_data);
    return removed ? Result<void>() : Result<void>(removed.error());
  }
};

/// Change of the pair filter. A predicate is code and cannot be recorded, so this holds only whether there is
/// one.
struct SetPairFilter {
  bool given = false;
};

/// Change of the rotation probe; it holds only whether there is one.
struct SetRotationProbe {
  bool given = false;
};

/// Change of the velocity, or of the angular velocity, of a body of the last event (Expectation).
struct Rebound {
  /// Values of `choice`: below told_speed, the number of a rebound that is expected.
  static constexpr std::uint8_t told_speed = 24, as_before = 25;

  bool second = false;              ///< of the second body of the event
  bool spin = false;                ///< of the angular velocity
  std::uint8_t choice = as_before;  ///< which rebound it is
  double speed = 0.0;               ///< change of the approach speed; only for told_speed
  Differences<3> velocity{};

  static void serialize(auto& self, auto& archive) {
    auto& [second, spin, choice, speed, velocity] = self;
    auto head = static_cast<std::uint8_t>((second ? 1 : 0) | (spin ? 2 : 0) | choice << 2);
    archive(head);
    if constexpr (!std::is_const_v<std::remove_reference_t<decltype(self)>>) {
      second = (head & 1) != 0;
      spin = (head & 2) != 0;
      choice = head >> 2;
      if (choice > as_before) archive.refuse();
    }
    if (choice == told_speed) archive(speed);
    archive(velocity);
  }
};

/// A state that a probe returned: position and velocity.
using Answer = Differences<6>;

/// A rotation that the rotation probe returned.
struct RotationAnswer {
  double time = 0.0;
  BodyId body{};
  Rotation rotation{};
};

/// A call that probed: advance(), or any other call with a probe.
struct Asking {
  bool failed = true;            ///< The last answer was refused, or the probe threw.
  bool has_event = false;        ///< advance() returned an event.
  bool advances = false;         ///< The call was advance().
  Differences<1> until{};        ///< The argument of advance(), from that of the last one.
  std::vector<BodyId> bodies{};  ///< Those that a call other than advance() asked for.
  std::vector<Answer> answers{};
  std::vector<RotationAnswer> rotations{};
  std::uint16_t hash = 0;  ///< Lowest bits of the StepHash of all outcomes so far.

  static void serialize(auto& self, auto& archive) {
    auto& [failed, has_event, advances, until, bodies, answers, rotations, hash] = self;
    constexpr std::size_t many = 15;  // further answers are counted behind the head
    auto head = static_cast<std::uint8_t>((failed ? 1 : 0) | (has_event ? 2 : 0) | (advances ? 4 : 0) |
                                          (rotations.empty() ? 0 : 8) | std::min(answers.size(), many) << 4);
    archive(head);
    Varint more{answers.size() - std::min(answers.size(), many)};
    if (head >> 4 == many) archive(more);
    if constexpr (!std::is_const_v<std::remove_reference_t<decltype(self)>>) {
      failed = (head & 1) != 0;
      has_event = (head & 2) != 0;
      advances = (head & 4) != 0;
      answers.clear();
      const std::uint64_t count = (head >> 4) + (head >> 4 == many ? more.value : 0);
      for (std::uint64_t k = 0; k < count && !archive.failed(); ++k) archive(answers.emplace_back());
    } else {
      for (const Answer& answer : answers) archive(answer);
    }
    if (advances)
      archive(until);
    else
      archive(bodies);
    if (head & 8) archive(rotations);
    archive(hash);
  }
};

/// The last step of a recording.
struct End {
  double time = 0.0;
  std::uint64_t checksum = 0;  ///< Checksum of the world's snapshot.
};

}  // namespace step

/// Any step of a recording. The order of the alternatives is part of the format.
using Step =
    std::variant<step::Asking, step::Add, step::AddStatic, step::Remove, step::SetVelocity, step::Teleport,
                 step::SetRadius, step::SetMotionLimits, step::Disable, step::Enable, step::SetFilter,
                 step::SetPairFilter, step::RefreshFilter, step::SetSolid, step::SetSensor,
                 step::SetSensorClass, step::SetUserData, step::End, step::SleepBody, step::Wake,
                 step::SetShape, step::SetMass, step::AddMovingShape, step::AddRigidBody,
                 step::SetAngularVelocity, step::SetRotation, step::SetRadiusRate, step::SetRotationProbe,
                 step::Schedule, step::Unschedule, step::SetPairState, step::TurnBack, step::Rebound>;

/// Running hash over the questions and outcomes of all steps so far: bodies and times, events to the last
/// bit, and all work counters.
class StepHash {
 public:
  /// Takes note of a call of the probe.
  void ask(std::span<const BodyId> bodies, double time);
  /// Takes note of the outcome of a step, after all of its questions.
  void add(const World& world, bool failed, const std::optional<Event>& event);
  std::uint64_t value() const { return sum_; }

 private:
  std::uint64_t sum_ = 0;
  ByteWriter outcome_;  ///< Member, so that its memory is reused.
};

/// Content of a recording whose form has been validated.
struct RecordingContent {
  std::vector<std::byte> snapshot{};
  bool has_pair_filter = false;
  bool has_rotation_probe = false;
  std::vector<std::byte> steps{};  ///< one Step after the other
  std::size_t step_count = 0;
  bool needs_pair_filter = false;  ///< at the start or later
};

Result<RecordingContent> read_content(std::span<const std::byte> recording);

}  // namespace kinesphere
