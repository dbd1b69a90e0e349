(* What the kernels take: the bound of a body (include/kinesphere/bound.hpp) and a capsule in single precision
   (src/broadphase/swept_sphere.hpp). *)
From Flocq Require Import IEEE754.BinarySingleNaN.
From Kinesphere Require Import floats.

Record bound := {
  time : double;  (* of the report *)
  position_x : double; position_y : double; position_z : double;
  velocity_x : double; velocity_y : double; velocity_z : double;
  plan_x : double; plan_y : double; plan_z : double;
  radius : double;
  growth_speed : double;
  growth_acceleration : double
}.

Record capsule := {
  centre_x : single; centre_y : single; centre_z : single;
  motion_x : single; motion_y : single; motion_z : single;
  ball : single
}.
