#include "rigid_bodies.hpp"

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "errors.hpp"
#include "kinesphere/response.hpp"
#include "moving.hpp"
#include "shapes.hpp"
#include "world.hpp"

namespace kinesphere::python {
namespace {

/// Axes of rotation have three numbers in the plane, too.
constexpr bool in_space = false;

Quaternion quaternion_at(const Numbers& numbers, std::size_t row) {
  return {numbers.at(row, 0), numbers.at(row, 1), numbers.at(row, 2), numbers.at(row, 3)};
}

/// Returns a Ball for a part without length, and a Hull for one of more than two points.
py::object part_object(const RigidPart& part) {
  if (!part.more.empty()) return py::cast(Hull{part});
  return part.a == part.b ? py::cast(Ball{part.a, part.radius}) : py::cast(part);
}

py::object add_rigid_body(WorldHandle& handle, const py::object& parts, const py::object& position,
                          const py::object& velocity, double acceleration_limit,
                          const py::object& orientation, const py::object& angular_velocity,
                          double angular_acceleration_limit, double largest_angular_speed,
                          const py::object& inertia, const py::object& planned_acceleration,
                          double position_error, double velocity_error, std::uint64_t category,
                          std::uint64_t mask, const py::object& group, bool solid, std::uint64_t sensor_class,
                          std::uint64_t user_data, double mass) {
  const std::string_view call = "add_rigid_body";
  const auto turn = handle.take(call);
  const auto vector = [&](const py::object& given, const char* name) {
    return given.is_none() ? Vec3{} : vector_of(given, {call, name}, handle.is_plane());
  };
  const RigidArguments rigid{
      parts, orientation, angular_velocity, angular_acceleration_limit, largest_angular_speed, inertia};
  const RigidBody body =
      rigid.read({.acceleration_limit = acceleration_limit,
                  .planned_acceleration = vector(planned_acceleration, "planned_acceleration"),
                  .position_error = position_error,
                  .velocity_error = velocity_error,
                  .position = vector(position, "position"),
                  .velocity = vector(velocity, "velocity"),
                  .filter = {category, mask, group_of(group, {call, "group"})},
                  .solid = solid,
                  .sensor_class = sensor_class_of(sensor_class, {call, "sensor_class"}),
                  .user_data = user_data,
                  .mass = mass});
  const BodyId id = handle.change([&](auto& to) { return to.add_rigid_body(body); }).value();
  end_call(handle);
  return object_of(id);
}

/// Returns orientations of shape (n, 4) and angular velocities of shape (n, 3), without n for a single id.
RigidBody rigid_of(const World& world, BodyId body, std::string_view call) {
  const BodyView view = world.body(body).value();
  if (view.rigid) return *view.rigid;
  throw BadResult({ErrorCode::unsupported, "body", body,
                   std::string(call) + ": body must be rigid, but body " + to_string(body) + " is not"});
}

py::tuple rotations(WorldHandle& handle, const py::object& bodies) {
  const auto turn = handle.take("rotations");
  const Ids named = ids_of(bodies, {"rotations", "bodies"});
  const std::size_t count = named.ids.size();
  NewArray orientations = named.is_single ? new_doubles({4}) : new_doubles({count, 4});
  NewArray spins = named.is_single ? new_doubles({3}) : new_doubles({count, 3});
  double* orientation = orientations.data<double>();
  double* spin = spins.data<double>();
  for (const BodyId id : named.ids) {
    const auto [q, w] = rigid_of(handle.world, id, "rotations").rotation;
    for (const double number : {q.w, q.x, q.y, q.z}) *orientation++ = number;
    for (const double number : {w.x, w.y, w.z}) *spin++ = number;
  }
  return py::make_tuple(orientations.take(), spins.take());
}

py::list parts_of(WorldHandle& handle, const py::object& body) {
  const auto turn = handle.take("parts_of");
  py::list parts;
  for (const RigidPart& part : rigid_of(handle.world, id_of(body, {"parts_of", "body"}), "parts_of").parts)
    parts.append(part_object(part));
  return parts;
}

void set_angular_velocity(WorldHandle& handle, const py::object& bodies, const py::object& given) {
  const Argument argument{"set_angular_velocity", "angular_velocities"};
  const auto turn = handle.take(argument.call);
  const Ids named = ids_of(bodies, {argument.call, "bodies"});
  const std::vector<Vec3> each = named.is_single ? std::vector{vector_of(given, argument, in_space)}
                                                 : vectors_of(given, argument, in_space, named.ids.size());
  for (std::size_t k = 0; k < each.size(); ++k)
    require(handle.world.change(named.ids[k], {.angular_velocity = each[k]}));
  end_call(handle);
}

void set_rotation(WorldHandle& handle, const py::object& body, const py::object& orientation,
                  const py::object& angular_velocity) {
  const std::string_view call = "set_rotation";
  const auto turn = handle.take(call);
  const Rotation rotation{quaternion_of(orientation, {call, "orientation"}),
                          vector_of(angular_velocity, {call, "angular_velocity"}, in_space)};
  require(handle.world.change(id_of(body, {call, "body"}), {.rotation = rotation}));
  end_call(handle);
}

/// Reads the answer of a rotation probe: arrays of shape (n, 4) and (n, 3).
void read_rotations(const py::object& answer, std::span<Rotation> rotations) {
  const std::string_view call = "rotation probe";
  if (PyTuple_Check(answer.ptr()) == 0 || py::len(answer) != 2)
    refuse({call, "function"}, "must return (orientations, angular velocities)",
           "returned " + py::repr(answer).cast<std::string>());
  const py::object given[] = {answer[py::int_(0)], answer[py::int_(1)]};
  const Argument argument{call, "orientations"};
  const Numbers orientations(given[0], argument);
  if (orientations.dimensions() != 2 || orientations.length(0) != rotations.size() ||
      orientations.length(1) != 4)
    refuse(argument, "must have shape (n, 4) with n = " + std::to_string(rotations.size()),
           "has shape " + orientations.shape());
  const std::vector<Vec3> spins =
      vectors_of(given[1], {call, "angular_velocities"}, in_space, rotations.size());
  for (std::size_t k = 0; k < rotations.size(); ++k)
    rotations[k] = {quaternion_at(orientations, k), spins[k]};
}

void set_rotation_probe(WorldHandle& handle, const py::object& function) {
  const auto turn = handle.take("set_rotation_probe");
  require_function(function, {"set_rotation_probe", "function"}, "must be a function of (ids, t)");
  RotationProbe probe;
  if (!function.is_none()) {
    // A world with a rotation probe works with one thread, so nothing but the probe can throw meanwhile.
    probe = [kept = kept_by_engine(function)](std::span<const BodyId> ids, double time,
                                              std::span<Rotation> rotations) {
      const py::gil_scoped_acquire gil;
      read_rotations((*kept)(array_of(ids), time), rotations);
    };
  }
  require(handle.world.set_rotation_probe(std::move(probe)));
  handle.has_rotation_probe = !function.is_none();
  end_call(handle);
}

py::tuple bounce_rigid(const Event& contact, const py::object& restitution) {
  Response after;
  if (py::isinstance<Roughness>(restitution)) {
    after = answer_of_rough(contact, restitution.cast<const Roughness&>());
  } else {
    const auto normal = restitution.cast<double>();
    require_bounce("bounce_rigid", normal);
    after = response_of(contact, bounce(contact, normal));
  }
  const auto vector = [](const std::optional<Vec3>& given) {
    return given ? array_of(*given) : py::object(py::none());
  };
  return py::make_tuple(py::make_tuple(vector(after.first_velocity), vector(after.first_angular_velocity)),
                        py::make_tuple(vector(after.second_velocity), vector(after.second_angular_velocity)));
}

}  // namespace

Quaternion quaternion_of(const py::object& given, const Argument& argument) {
  const Numbers numbers(given, argument);
  if (numbers.dimensions() != 1 || numbers.length(0) != 4)
    refuse(argument, "must be a quaternion (w, x, y, z), of shape (4,)", "has shape " + numbers.shape());
  return {numbers.at(0), numbers.at(1), numbers.at(2), numbers.at(3)};
}

std::vector<Quaternion> quaternions_of(const py::object& given, const Argument& argument) {
  const Numbers numbers(given, argument);
  if (numbers.dimensions() != 2 || numbers.length(1) != 4)
    refuse(argument, "must be quaternions (w, x, y, z), of shape (n, 4)", "has shape " + numbers.shape());
  std::vector<Quaternion> rotations;
  for (std::size_t k = 0; k < numbers.length(0); ++k) rotations.push_back(quaternion_at(numbers, k));
  return rotations;
}

py::object array_of(std::span<const Quaternion> rotations) {
  NewArray orientations = new_doubles({rotations.size(), 4});
  if (rotations.empty()) return orientations.take();
  double* orientation = orientations.data<double>();
  for (const Quaternion& q : rotations)
    for (const double number : {q.w, q.x, q.y, q.z}) *orientation++ = number;
  return orientations.take();
}

py::tuple arrays_of(std::span<const Rotation> rotations) {
  std::vector<Quaternion> orientations;
  std::vector<Vec3> spins;
  for (const auto& [orientation, spin] : rotations) {
    orientations.push_back(orientation);
    spins.push_back(spin);
  }
  return py::make_tuple(array_of(orientations), array_of(spins));
}

RigidBody RigidArguments::read(const BodyDefinition& body) const {
  const std::string_view call = "add_rigid_body";
  RigidBody rigid{.body = body,
                  .rotation = {.orientation = quaternion_of(orientation, {call, "orientation"})},
                  .angular_acceleration_limit = angular_acceleration_limit,
                  .largest_angular_speed = largest_angular_speed,
                  .inertia = vector_of(inertia, {call, "inertia"}, in_space)};
  if (!angular_velocity.is_none())
    rigid.rotation.angular_velocity = vector_of(angular_velocity, {call, "angular_velocity"}, in_space);
  for (const py::handle part : py::iterable(parts)) {
    if (py::isinstance<RigidPart>(part)) {
      rigid.parts.push_back(part.cast<RigidPart>());
    } else if (py::isinstance<Ball>(part)) {
      const auto ball = part.cast<Ball>();
      rigid.parts.push_back({ball.centre, ball.centre, ball.radius});
    } else if (py::isinstance<Hull>(part)) {
      rigid.parts.push_back(part.cast<Hull>().part);
    } else {
      throw py::type_error("add_rigid_body: parts must be Balls, Capsules and Hulls, but one is " +
                           py::repr(part).cast<std::string>());
    }
  }
  return rigid;
}

void bind_rigid_bodies(py::module_& module, WorldClass& world) {
  world
      .def("add_rigid_body", add_rigid_body, py::arg("parts"), py::arg("position"),
           py::arg("velocity") = py::none(), py::arg("acceleration_limit") = 0.0, py::kw_only(),
           py::arg("orientation") = py::make_tuple(1.0, 0.0, 0.0, 0.0),
           py::arg("angular_velocity") = py::none(), py::arg("angular_acceleration_limit") = 0.0,
           py::arg("largest_angular_speed") = std::numeric_limits<double>::infinity(),
           py::arg("inertia") = py::make_tuple(0.0, 0.0, 0.0), py::arg("planned_acceleration") = py::none(),
           py::arg("position_error") = 0.0, py::arg("velocity_error") = 0.0, py::arg("category") = 1,
           py::arg("mask") = std::numeric_limits<std::uint64_t>::max(), py::arg("group") = 0,
           py::arg("solid") = true, py::arg("sensor_class") = 0, py::arg("user_data") = 0,
           py::arg("mass") = 1.0,
           R"(Adds a rigid body: Balls, Capsules and Hulls that move and turn together. Returns its BodyId.

parts: at least one, relative to the position, about which the body turns, and before it is turned.
orientation: a quaternion (w, x, y, z) of length 1, which turns a vector of the body into one of the world.
angular_velocity (radians / time): shape (3,), in the world's axes, also in two dimensions; zero without.
angular_acceleration_limit (radians / time^2, >= 0): at 0 the body keeps its angular velocity between changes, and
the world knows its rotation; any other body needs set_rotation_probe().
largest_angular_speed (radians / time, >= 0): must be finite if the limit above is not 0.
inertia (mass length^2, each >= 0): moments about the axes of the body, which must be its principal axes. Contacts
do not turn it about an axis with moment 0 or inf.

The others are those of add(); position_error and velocity_error hold for every point of the body. It is one body,
with one state in a probe. Events name its parts. Raises InvalidValue that names the argument.)")
      .def(
          "rotations", rotations, py::arg("bodies"),
          R"(Rotations of rigid bodies at their last reports: orientations and angular velocities (radians / time).

Shapes (n, 4) and (n, 3), or (4,) and (3,) for a single id. Raises StateError for a body that is not rigid.)")
      .def("parts_of", parts_of, py::arg("body"),
           "The Balls, Capsules and Hulls of a rigid body, as it was added. Raises StateError for any other.")
      .def(
          "set_angular_velocity", set_angular_velocity, py::arg("bodies"), py::arg("angular_velocities"),
          R"(Tells the world that rigid bodies turn with these angular velocities (radians / time) from now on.

One id and shape (3,), or n ids and shape (n, 3). A rotation probe has to answer accordingly. Raises InvalidValue
for more than the largest_angular_speed of the body; those before it have been changed.)")
      .def("set_rotation", set_rotation, py::arg("body"), py::arg("orientation"), py::arg("angular_velocity"),
           "Turns a rigid body at once, as teleport() moves it. Shapes (4,) and (3,); see add_rigid_body().")
      .def("set_rotation_probe", set_rotation_probe, py::arg("function"),
           R"(A function f(ids, t) -> (orientations, angular velocities) of rigid bodies, or None.

ids is an array of int64, shape (n,); the answers have shape (n, 4) and (n, 3), as in add_rigid_body(). It is asked
directly after the probe, for the same time. What it raises comes out of the call of the world, which can be
repeated. Without one, only bodies that keep their angular velocity can be probed. Clones have it, too; save() does
not contain it, and the world cannot be pickled. During it the world cannot be changed.)");
  module.def(
      "bounce_rigid", bounce_rigid, py::arg("contact"), py::arg("restitution") = 1.0,
      R"(What bounce() makes of rigid bodies: ((velocity, angular velocity) of the first, those of the second).

Each is an array of shape (3,), or None for what the contact leaves as it is: walls, static bodies, spins of bodies
that are no rigid ones or without inertia. A function for World.run() may return it. Momentum and angular momentum
are conserved, and with restitution 1 energy is. Masses are those of the event. In place of the restitution a
Roughness stands for rough balls.)");
}

}  // namespace kinesphere::python
