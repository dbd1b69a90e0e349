(* Inputs of the kernels: the bound of a body (include/kinesphere/bound.hpp) and a swept sphere in single precision
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
  acceleration_limit : double
}.

Record swept_sphere := {
  centre_x : single; centre_y : single; centre_z : single;
  motion_x : single; motion_y : single; motion_z : single;
  ball : single
}.

(* The name in kernels.v, which a test writes. *)
Notation capsule := swept_sphere (only parsing).
