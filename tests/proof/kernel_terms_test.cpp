// The terms about which proof/ has theorems are those that the library computes: they are written down here
// from its own sources and compared with proof/kernels.v. Where they differ, the library has changed: write
// the file anew (KINESPHERE_WRITE_KERNELS=1 and this test) and run scripts/prove.sh, which says what still
// holds.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "proof/traced_kernels.hpp"

namespace {

namespace kernels = traced_kinesphere;
using traced::call;
using traced::definition;
using traced::Double;
using traced::Single;
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
          .growth_acceleration = field(name, "growth_acceleration")};
}

kernels::Capsule capsule(const std::string& name) {
  const auto part = [&](const std::string& of) { return variable<Single>(name + ".(" + of + ")"); };
  return {.centre = {part("centre_x"), part("centre_y"), part("centre_z")},
          .velocity = {part("motion_x"), part("motion_y"), part("motion_z")},
          .radius = part("ball")};
}

/// Whether the search leaves the one capsule of a table out.
bool left_out() {
  const kernels::Capsule other = capsule("other");
  const kernels::CapsuleColumns table{
      other.centre.data(),   other.centre.data() + 1,   other.centre.data() + 2,
      other.velocity.data(), other.velocity.data() + 1, other.velocity.data() + 2,
      &other.radius};
  const std::array queries{kernels::CapsuleQuery{
      .capsule = capsule("one"), .from = variable<Single>("from"), .to = variable<Single>("to")}};
  const std::array runs{kernels::Run{.begin = 0, .end = 1}};
  std::array<std::uint32_t, 1> found{};
  std::array<std::uint32_t, 1> ends{};
  kernels::near_capsules_plain(table, queries, runs, found.data(), ends.data());
  return ends[0] == 0;
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
                       const std::function<traced::Answer()>& kernel) {
    text += "\n(* " + where + " *)\n" + definition(head, kernel);
  };
  const std::string rounding = "src/bound/rounding.hpp";
  add(rounding, "widened (size : double) : double", [&] { return kernels::rounding::widened(size); });
  add(rounding, "capped (size : double) : double", [&] { return kernels::rounding::capped(size); });
  add(rounding, "sum_down (a b : double) : double", [&] { return kernels::rounding::sum_down(a, b); });
  add(rounding, "first_crossing (c b a : double) : double",
      [&] { return kernels::rounding::first_crossing(c, b, a); });
  add("src/bound/safe_steps.hpp",
      "advance_by_safe_steps (step : double -> double) (from until : double) : double",
      [&] { return kernels::advance_by_safe_steps(from, until, [](Double d) { return call("step", d); }); });
  add("src/bound/certificates.cpp: the step of earliest_meeting, d after from",
      "meeting_step (a b : bound) (from distance d : double) : double",
      [&] { return kernels::earliest_meeting(bound("a"), bound("b"), from, until, distance); });
  add("src/window/capsule_search_plain.cpp: one capsule of a table",
      "left_out (other one : capsule) (from to : single) : bool", left_out);
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
