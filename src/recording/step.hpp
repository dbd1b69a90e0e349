// Steps of a recording: one class for each call that changes a world, with its arguments, and one for all
// calls that probe.
//
// A change lists its fields for archives and repeats itself through the public call, which checks its
// arguments.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "archive/archive.hpp"
#include "archive/checksum.hpp"
#include "archive/fields.hpp"
#include "kinesphere/recording.hpp"

namespace kinesphere {

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

/// A probed state, as one of several that a single probe call returned.
struct Answer {
  ProbedState report{};
  bool last = false;  ///< Last answer of its probe call.
};

/// A rotation that the rotation probe returned.
struct RotationAnswer {
  double time = 0.0;
  BodyId body{};
  Rotation rotation{};
};

/// A call that probed: advance(), or any other call with a probe.
struct Asking {
  std::optional<double> until{};  ///< The argument of advance(); empty for other calls.
  std::vector<Answer> answers{};
  std::vector<RotationAnswer> rotations{};
  bool failed = true;  ///< The last answer was refused, or the probe threw.
  std::optional<Event> event{};
  std::uint64_t hash = 0;  ///< StepHash of all outcomes so far.
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
                 step::Schedule, step::Unschedule, step::SetPairState, step::TurnBack>;

/// Running hash over the outcomes of all steps so far: events to the last bit, and all work counters.
class StepHash {
 public:
  void add(const World& world, const step::Asking& asking);
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
  std::vector<Step> steps{};
};

Result<RecordingContent> read_content(std::span<const std::byte> recording);

}  // namespace kinesphere
