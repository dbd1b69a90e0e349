// Places of spheres: kinesphere.place_spheres() and radial_distribution().
#include "kinesphere/placement.hpp"

#include <cstring>

#include "errors.hpp"
#include "exchange.hpp"
#include "kinesphere/radial_distribution.hpp"
#include "shapes.hpp"
#include "world.hpp"

namespace kinesphere::python {
namespace {

py::object placed(const py::object& given, const py::object& given_box, const py::object& periodic,
                  double packing, double gap, std::uint64_t seed, int dimensions) {
  const bool plane = dimensions == 2;
  const Numbers numbers(given, {"place_spheres", "radii"});
  if (numbers.dimensions() > 1)
    refuse({"place_spheres", "radii"}, "must have the shape (n,)", "has " + numbers.shape());
  const std::size_t count = numbers.dimensions() == 0 ? 1 : numbers.length(0);
  const std::vector<double> radii = each_of(given, {"place_spheres", "radii"}, count);
  const auto box = box_of(given_box, {"place_spheres", "box"}, plane);
  if (!box) refuse({"place_spheres", "box"}, "must be a Box or two corners", "is None");
  const PlacementOptions options{.periodic = axes_of(periodic, {"place_spheres", "periodic"}, plane),
                                 .dimensions = dimensions,
                                 .packing = packing,
                                 .gap = gap,
                                 .seed = seed};
  const std::vector<Vec3> centres =
      [&] {
        const py::gil_scoped_release released;
        return place_spheres(radii, *box, options);
      }()
          .value();
  const std::size_t axes = plane ? 2 : 3;
  NewArray array = new_doubles({centres.size(), axes});
  for (std::size_t k = 0; k < centres.size(); ++k)
    std::memcpy(array.data<double>() + axes * k, &centres[k], axes * sizeof(double));
  return array.take();
}

py::object distribution(const py::object& given, const py::object& given_box, double range, std::size_t bins,
                        int dimensions) {
  const bool plane = dimensions == 2;
  const std::vector<Vec3> centres = vectors_of(given, {"radial_distribution", "centres"}, plane);
  const auto box = box_of(given_box, {"radial_distribution", "box"}, plane);
  if (!box) refuse({"radial_distribution", "box"}, "must be a Box or two corners", "is None");
  const std::vector<double> found =
      [&] {
        const py::gil_scoped_release released;
        return radial_distribution(centres, *box, range, bins, dimensions);
      }()
          .value();
  return array_of(found);
}

}  // namespace

void bind_placement(py::module_& module) {
  module.def(
      "place_spheres", placed, py::arg("radii"), py::arg("box"), py::kw_only(), py::arg("periodic") = false,
      py::arg("packing") = 0.0, py::arg("gap") = 0.0, py::arg("seed") = 1, py::arg("dimensions") = 3,
      R"(Centres of spheres at random places in a box, none of which overlap: shape (n, 3), (n, 2) in the plane.

radii: of each (length), or one number for one sphere. periodic: as in World(); centres are then as dense at
the faces as anywhere. packing: the part of the box to fill; the radii are then used in turn, for as many
spheres as fill no more than that: place_spheres(0.5, box, packing=0.49). gap: the least distance (length)
between two spheres, and between a sphere and a wall. dimensions: 2 for discs in the plane.

Reaches 0.6 with spheres of one size, 0.8 with discs and more with mixtures. The places are random, but not
in equilibrium. A seed gives the same bits on every machine. Raises InvalidValue if no arrangement without
overlap was found. Takes a microsecond for each sphere below 0.28, 10 at 0.49, 50 at 0.6.)");
  module.def("radial_distribution", distribution, py::arg("centres"), py::arg("box"), py::arg("range"),
             py::arg("bins"), py::kw_only(), py::arg("dimensions") = 3,
             R"(The radial distribution function g of points in a box that repeats on all axes: shape (bins,).

The number of pairs at a distance over that of as many points at random places, in bins of equal width from 0
to range (length), which is at most half of a side of the box. centres: shape (n, 3), or (n, 2) in the plane,
in any image of the box. dimensions: 2 for points in the plane.)");
}

}  // namespace kinesphere::python
