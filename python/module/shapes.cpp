#include "shapes.hpp"

#include <algorithm>
#include <string>

namespace kinesphere::python {
namespace {

/// Shapes have no dimension: those of two numbers are for the plane z = 0.
Vec3 point_of(const py::object& given, const char* call, const char* name) {
  return vector_of(given, {call, name}, true);
}
/// The corners of a triangle, which the plane does not have.
Vec3 corner_of(const py::object& given, const char* call, const char* name) {
  return vector_of(given, {call, name}, false);
}

/// Returns the box of two corners. Without z it reaches as far above and below z = 0 as half of its longer
/// side.
Box box_between(Vec3 lower, Vec3 upper, bool has_z) {
  const double height = 0.5 * std::max(upper.x - lower.x, upper.y - lower.y);
  if (!has_z) {
    lower.z = -height;
    upper.z = height;
  }
  return {lower, upper};
}

Box box_of_corners(const py::object& lower, const py::object& upper) {
  const Vec3 corners[] = {point_of(lower, "Box", "lower"), point_of(upper, "Box", "upper")};
  const bool has_z = py::len(lower) == 3;
  if ((py::len(upper) == 3) != has_z)
    refuse({"Box", "upper"}, "must have the shape of lower", has_z ? "has shape (2,)" : "has shape (3,)");
  return box_between(corners[0], corners[1], has_z);
}

Hull hull_of(const py::object& points, double radius) {
  const Argument argument{"Hull", "points"};
  const std::vector<Vec3> found = vectors_of(points, argument, true);
  if (found.empty()) refuse(argument, "must have at least one row", "has none");
  return {hull_part(found, radius)};
}

/// Returns an array of shape (n, 3).
py::object points_of(const Hull& hull) {
  const auto& [a, b, radius, more] = hull.part;
  std::vector<Vec3> points{a};
  if (a != b || !more.empty()) points.push_back(b);
  points.insert(points.end(), more.begin(), more.end());
  return array_of(points);
}

/// Returns an array of shape (m, 3).
py::object corners_of(const Mesh& mesh) {
  NewArray array = new_whole_numbers(3 * mesh.size());
  auto* number = array.data<std::int64_t>();
  for (const auto& triple : mesh.corners())
    for (const std::uint32_t corner : triple) *number++ = corner;
  return array.take().attr("reshape")(mesh.size(), 3);
}

/// Binds what shapes have in common. Their classes make them of parts of these names.
template <class Class, class... Names>
void bind_parts(Class& shape, Names... names) {
  using Kind = typename Class::type;
  shape.def("__eq__", [](const Kind& a, const py::object& b) {
    return py::isinstance<Kind>(b) && a == b.cast<const Kind&>();
  });
  shape.def("__reduce__", made_of_parts(names...));
  shape.def("__repr__", [=](const py::object& self) {
    std::string text = self.get_type().attr("__name__").cast<std::string>() + "(";
    for (const char* const part : {names...}) {
      const py::object of = self.attr(part);
      if (text.back() != '(') text += ", ";
      text += py::repr(py::hasattr(of, "tolist") ? py::tuple(of.attr("tolist")()) : of).cast<std::string>();
    }
    return text + ")";
  });
}

}  // namespace

Mesh mesh_of(const py::object& vertices, const py::object& corners, const char* call) {
  const std::vector<Vec3> places = vectors_of(vertices, {call, "vertices"}, false);
  const Argument argument{call, "corners"};
  std::vector<std::array<std::uint32_t, 3>> triples;
  for (const py::handle item : py::reinterpret_borrow<py::iterable>(corners)) {
    const std::vector<std::uint64_t> numbers = each_whole_of(item, argument, 3);
    auto& triple = triples.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      triple[k] = static_cast<std::uint32_t>(std::min<std::uint64_t>(numbers[k], 0xffffffffu));
  }
  return Mesh::create(places, triples).value();
}

std::optional<Box> box_of(const py::object& given, const Argument& argument, bool plane) {
  if (given.is_none()) return {};
  if (py::isinstance<Box>(given)) return given.cast<Box>();
  const Numbers numbers(given, argument);
  const bool fits = numbers.dimensions() == 2 && numbers.length(0) == 2 &&
                    (numbers.length(1) == 3 || (plane && numbers.length(1) == 2));
  if (!fits)
    refuse(argument,
           std::string("must be a Box, or its lower and upper corner, of shape (2, 3)") +
               (plane ? " or (2, 2)" : "; (2, 2) is for dimensions=2"),
           "has shape " + numbers.shape());
  const bool has_z = numbers.length(1) == 3;
  const auto corner = [&](std::size_t k) {
    return Vec3{numbers.at(k, 0), numbers.at(k, 1), has_z ? numbers.at(k, 2) : 0.0};
  };
  return box_between(corner(0), corner(1), has_z);
}

Shape shape_of(const py::object& given, const Argument& argument) {
  if (py::isinstance<Ball>(given)) return given.cast<Ball>();
  if (py::isinstance<HalfSpace>(given)) return given.cast<HalfSpace>();
  if (py::isinstance<Box>(given)) return given.cast<Box>();
  if (py::isinstance<Triangle>(given)) return given.cast<Triangle>();
  if (py::isinstance<Mesh>(given)) return given.cast<Mesh>();
  refuse_type(argument, "must be a Ball, Box, HalfSpace, Triangle or Mesh", given);
}

py::object object_of(const Shape& shape) {
  return std::visit([](const auto& of) { return py::cast(of); }, shape);
}

void bind_shapes(py::module_& module) {
  py::class_<Box> box(
      module, "Box",
      "An axis-aligned box between two corners, lower <= upper on each axis; solid. In the plane corners, "
      "centres and normals may have two numbers.");
  box.def(py::init(
              [](const py::object& lower, const py::object& upper) { return box_of_corners(lower, upper); }),
          py::arg("lower"), py::arg("upper"))
      .def_property_readonly("lower", [](const Box& of) { return array_of(of.lower); })
      .def_property_readonly("upper", [](const Box& of) { return array_of(of.upper); });
  bind_parts(box, "lower", "upper");

  py::class_<Ball> ball(module, "Ball", "A ball that never moves; radius >= 0 (length).");
  ball.def(py::init([](const py::object& centre, double radius) {
             return Ball{point_of(centre, "Ball", "centre"), radius};
           }),
           py::arg("centre"), py::arg("radius"))
      .def_property_readonly("centre", [](const Ball& of) { return array_of(of.centre); })
      .def_readonly("radius", &Ball::radius);
  bind_parts(ball, "centre", "radius");

  py::class_<HalfSpace> half_space(
      module, "HalfSpace", "Bodies may be where dot(normal, p) >= offset; the rest of space is solid.");
  half_space
      .def(py::init([](const py::object& normal, double offset) {
             return HalfSpace{point_of(normal, "HalfSpace", "normal"), offset};
           }),
           py::arg("normal"), py::arg("offset"))
      .def_property_readonly("normal", [](const HalfSpace& of) { return array_of(of.normal); })
      .def_readonly("offset", &HalfSpace::offset);
  bind_parts(half_space, "normal", "offset");

  py::class_<Triangle> triangle(module, "Triangle", "Two-sided and without thickness.");
  triangle
      .def(py::init([](const py::object& a, const py::object& b, const py::object& c) {
             return Triangle{corner_of(a, "Triangle", "a"), corner_of(b, "Triangle", "b"),
                             corner_of(c, "Triangle", "c")};
           }),
           py::arg("a"), py::arg("b"), py::arg("c"))
      .def_property_readonly("a", [](const Triangle& of) { return array_of(of.a); })
      .def_property_readonly("b", [](const Triangle& of) { return array_of(of.b); })
      .def_property_readonly("c", [](const Triangle& of) { return array_of(of.c); });
  bind_parts(triangle, "a", "b", "c");

  py::class_<Mesh> mesh(
      module, "Mesh",
      "A surface of triangles as one shape: vertices of shape (n, 3), and for each triangle a row of "
      "corners, "
      "which are numbers of vertices, shape (m, 3). Two-sided and without thickness. Immutable; bodies share "
      "it. What slides over its edges meets one surface, and events name the triangle (first_part, "
      "second_part).");
  mesh.def(py::init([](const py::object& vertices, const py::object& corners) {
             return mesh_of(vertices, corners, "Mesh");
           }),
           py::arg("vertices"), py::arg("corners"))
      .def_static(
          "chain",
          [](const py::object& points) {
            return Mesh::chain(vectors_of(points, {"Mesh.chain", "points"}, true)).value();
          },
          py::arg("points"),
          "A surface of segments from each point to the next, shape (n, 2), for worlds of two dimensions: "
          "the "
          "only meshes that they take. Repeat the first point at the end to close it. Events name the "
          "triangle, "
          "half of which is the segment.")
      .def_property_readonly("vertices", [](const Mesh& of) { return array_of(of.vertices()); })
      .def_property_readonly("corners", corners_of)
      .def("__len__", [](const Mesh& of) { return of.size(); })
      .def("__eq__",
           [](const Mesh& a, const py::object& b) {
             return py::isinstance<Mesh>(b) && a == b.cast<const Mesh&>();
           })
      .def("__repr__",
           [](const Mesh& of) {
             return "Mesh(" + std::to_string(of.vertices().size()) + " vertices, " +
                    std::to_string(of.size()) + " triangles)";
           })
      .def("__reduce__", [](const py::object& self) {
        return py::make_tuple(self.attr("__class__"),
                              py::make_tuple(self.attr("vertices"), self.attr("corners")));
      });

  py::class_<RigidPart> capsule(
      module, "Capsule",
      "All points within `radius` (length, >= 0) of the segment from a to b: a part of a rigid body.");
  capsule
      .def(py::init([](const py::object& a, const py::object& b, double radius) {
             return RigidPart{point_of(a, "Capsule", "a"), point_of(b, "Capsule", "b"), radius};
           }),
           py::arg("a"), py::arg("b"), py::arg("radius"))
      .def_property_readonly("a", [](const RigidPart& of) { return array_of(of.a); })
      .def_property_readonly("b", [](const RigidPart& of) { return array_of(of.b); })
      .def_readonly("radius", &RigidPart::radius);
  bind_parts(capsule, "a", "b", "radius");

  py::class_<Hull> hull(
      module, "Hull",
      "All points within `radius` (length, >= 0) of the convex hull of 1 to 64 points, of "
      "shape (n, 3) or (n, 2): a part of a rigid body. One that bounces should have a radius "
      "of more than two contact tolerances.");
  hull.def(py::init([](const py::object& points, double radius) { return hull_of(points, radius); }),
           py::arg("points"), py::arg("radius") = 0.0)
      .def_static(
          "box",
          [](const py::object& lower, const py::object& upper, double radius) {
            return Hull{box_part({point_of(lower, "Hull.box", "lower"), point_of(upper, "Hull.box", "upper")},
                                 radius)};
          },
          py::arg("lower"), py::arg("upper"), py::arg("radius") = 0.0,
          "A box between two corners; a rectangle if they have two numbers.")
      .def_property_readonly("points", [](const Hull& of) { return points_of(of); })
      .def_property_readonly("radius", [](const Hull& of) { return of.part.radius; });
  bind_parts(hull, "points", "radius");
}

}  // namespace kinesphere::python
