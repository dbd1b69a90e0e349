(* Input of the kernels: the bound of a body (include/kinesphere/bound.hpp). *)
From Flocq Require Import IEEE754.BinarySingleNaN.
From Kinesphere Require Import floats.

Record bound := {
  time : double;  (* of the report *)
  position_x : double; position_y : double; position_z : double;
  velocity_x : double; velocity_y : double; velocity_z : double;
  plan_x : double; plan_y : double; plan_z : double;
  radius : double;
  growth_speed : double;
  acceleration_limit : double
}.
