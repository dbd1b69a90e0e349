// Compares the terms of the theorems in proof/ with the library: records them from its own sources and
// compares them with proof/kernels.v. If they differ, the library has changed: write the file anew
// (KINESPHERE_WRITE_KERNELS=1 and this test) and run scripts/prove.sh, which shows which theorems still hold.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "proof/traced_kernels.hpp"

namespace traced_kinesphere {
/// The growth of a bound does not depend on how its body is turned.
Vec3 rotated(const Quaternion&, const Vec3& vector) { return vector; }
}  // namespace traced_kinesphere

namespace {

namespace kernels = traced_kinesphere;
using traced::call;
using traced::definition;
using traced::Double;
using traced::variable;

Double field(const std::string& of, const std::string& name) { return variable(of + ".(" + name + ")"); }

kernels::Vec3 vector(const std::string& of, const std::string& name) {
  return {field(of, name + "_x"), field(of, name + "_y"), field(of, name + "_z")};
}

kernels::Bound bound(const std::string& name) {
  return {.time = field(name, "time"),
          .position = vector(name, "position"),
          .velocity = vector(name, "velocity"),
          .planned_acceleration = vector(name, "plan"),
          .radius = field(name, "radius"),
          .growth_speed = field(name, "growth_speed"),
          .acceleration_limit = field(name, "acceleration_limit")};
}

/// Returns the term that builds a bound.
Double term_of_bound(const kernels::Bound& bound) {
  const kernels::Vec3 &x = bound.position, &v = bound.velocity, &g = bound.planned_acceleration;
  return call("Build_bound", bound.time, x.x, x.y, x.z, v.x, v.y, v.z, g.x, g.y, g.z, bound.radius,
              bound.growth_speed, bound.acceleration_limit);
}

/// Returns the bound of a report.
Double bound_of_report() {
  const auto three = [](const std::string& name) {
    return kernels::Vec3{variable(name + "x"), variable(name + "y"), variable(name + "z")};
  };
  const kernels::Bound bound =
      kernels::bound_of({.radius = variable("r"),
                         .acceleration_limit = variable("limit"),
                         .planned_acceleration = three("g"),
                         .position_error = variable("e0"),
                         .velocity_error = variable("e1"),
                         .radius_rate = variable("k")},
                        {.position = three(""), .velocity = three("v")}, variable("t"));
  return term_of_bound(bound);
}

/// Returns the growth of the bound of a point that is fixed in a turning body.
Double growth_of_point() {
  const kernels::RigidExtent body{.bound = {.acceleration_limit = variable("limit")},
                                  .parts = {},
                                  .spin = variable("spin"),
                                  .spin_growth = variable("spin_growth")};
  return body.of_point({variable("x"), variable("y"), variable("z")}, variable("r")).acceleration_limit;
}

std::string kernels_file() {
  const Double a = variable("a"), b = variable("b"), c = variable("c"), size = variable("size");
  const Double from = variable("from"), until = variable("until"), distance = variable("distance");
  std::string text =
      "(* What the library computes, operation by operation. Written by tests/proof/kernel_terms_test.cpp "
      "from\n"
      "   the sources of the library; not to be edited. *)\n"
      "From Coq Require Import ZArith.\n"
      "From Flocq Require Import IEEE754.BinarySingleNaN.\n"
      "From Kinesphere Require Import floats inputs.\n"
      "Local Open Scope float_scope.\n";
  const auto add = [&](const std::string& where, const std::string& head,
                       const std::function<Double()>& kernel) {
    text += "\n(* " + where + " *)\n" + definition(head, kernel);
  };
  const std::string rounding = "src/bound/rounding.hpp";
  add(rounding, "widened (size : double) : double", [&] { return kernels::rounding::widened(size); });
  add(rounding, "capped (size : double) : double", [&] { return kernels::rounding::capped(size); });
  add(rounding, "sum_down (a b : double) : double", [&] { return kernels::rounding::sum_down(a, b); });
  add(rounding, "sum_up (a b : double) : double", [&] { return kernels::rounding::sum_up(a, b); });
  add(rounding, "first_crossing (c b a : double) : double",
      [&] { return kernels::rounding::first_crossing(c, b, a); });
  add("src/bound/safe_steps.hpp",
      "advance_by_safe_steps (step : double -> double) (from until : double) : double",
      [&] { return kernels::advance_by_safe_steps(from, until, [](Double d) { return call("step", d); }); });
  const auto earliest_meeting = [&] {
    return kernels::earliest_meeting(bound("a"), bound("b"), from, until, distance);
  };
  add("src/bound/bound.cpp", "bound_of (r limit gx gy gz e0 e1 k x y z vx vy vz t : double) : bound",
      bound_of_report);
  add("src/bound/certificates.cpp: the step of earliest_meeting, d after from",
      "meeting_step (a b : bound) (from distance d : double) : double", earliest_meeting);
  kernels::name_of_step = "meeting_step a b from distance";
  add("src/bound/certificates.cpp", "earliest_meeting (a b : bound) (from until distance : double) : double",
      earliest_meeting);
  kernels::name_of_step.clear();
  add("src/bound/certificates.cpp: earliest_meeting of a bound and a half-space",
      "wall_meeting (a : bound) (x y z offset from until distance : double) : double", [&] {
        const kernels::HalfSpace wall{{variable("x"), variable("y"), variable("z")}, variable("offset")};
        return kernels::earliest_meeting(bound("a"), wall, from, until, distance);
      });
  const std::string beside = "src/bound/relative_motion.hpp: BoundBesideBound";
  add(beside, "beside (a b : bound) (from : double) : bound",
      [&] { return term_of_bound(kernels::BoundBesideBound(bound("a"), bound("b"), from).bound); });
  add(beside, "slack_beside (a b : bound) (from : double) : double",
      [&] { return kernels::BoundBesideBound(bound("a"), bound("b"), from).slack; });
  add("src/bound/rigid_extent.hpp: the growth of RigidExtent::of_point",
      "growth_of_point (limit spin_growth spin x y z : double) : double", growth_of_point);
  return text;
}

TEST(KernelTerms, AreThoseThatHaveBeenProved) {
  const std::string written = kernels_file();
  const std::string path = KINESPHERE_KERNEL_TERMS;
  if (std::getenv("KINESPHERE_WRITE_KERNELS") != nullptr) std::ofstream(path) << written;
  std::ifstream file(path);
  const std::string proved{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(written, proved) << "the library computes something else than what proof/ is about";
}

}  // namespace
