(* What the library computes, operation by operation. Written by tests/proof/kernel_terms_test.cpp from
   the sources of the library; not to be edited. *)
From Coq Require Import ZArith.
From Flocq Require Import IEEE754.BinarySingleNaN.
From Kinesphere Require Import floats inputs.
Local Open Scope float_scope.

(* src/bound/rounding.hpp *)
Definition widened (size : double) : double :=
  if (literal 0 0) <? size then
    size + (literal 1 (-480))
  else
  size + (literal 0 0).

(* src/bound/rounding.hpp *)
Definition capped (size : double) : double :=
  if size <=? (literal 1 480) then
    size
  else
  infinity.

(* src/bound/rounding.hpp *)
Definition sum_down (a b : double) : double :=
  if infinite a then
    a + b
  else
  if infinite b then
    a + b
  else
  let t1 := a + b in
  t1 - ((magnitude t1) * (literal 1 (-52))).

(* src/bound/rounding.hpp *)
Definition sum_up (a b : double) : double :=
  let t1 := - a in
  if infinite t1 then
    let t2 := - b in
    let t3 := t1 + t2 in
    - t3
  else
  let t2 := - b in
  if infinite t2 then
    let t3 := t1 + t2 in
    - t3
  else
  let t3 := t1 + t2 in
  - (t3 - ((magnitude t3) * (literal 1 (-52)))).

(* src/bound/rounding.hpp *)
Definition first_crossing (c b a : double) : double :=
  if (literal 1 (-975)) <? c then
    if (literal 0 0) <=? b then
      if (literal 0 0) <=? a then
        if (b + a) <? infinity then
          infinity
        else
        literal 0 0
      else
      let t1 := b * b in
      let t2 := ((literal 2 0) * a) * c in
      let t3 := t1 - t2 in
      let t4 := t3 - (literal 1 (-1022)) in
      if (literal 0 0) <? t4 then
        let t5 := - a in
        let t6 := (b + (root t4)) / t5 in
        let t7 := t6 - (t6 * (literal 1 (-47))) in
        if (literal 1 (-975)) <? t7 then
          t7
        else
        literal 0 0
      else
      let t5 := - a in
      let t6 := (b + (root (literal 0 0))) / t5 in
      let t7 := t6 - (t6 * (literal 1 (-47))) in
      if (literal 1 (-975)) <? t7 then
        t7
      else
      literal 0 0
    else
    let t1 := b * b in
    let t2 := ((literal 2 0) * a) * c in
    let t3 := t1 - t2 in
    let t4 := t3 + (((literal 1 (-47)) * (t1 + (magnitude t2))) + (literal 1 (-1022))) in
    if t4 <? (literal 0 0) then
      infinity
    else
    let t5 := ((literal 2 0) * c) / ((root t4) - b) in
    let t6 := t5 - (t5 * (literal 1 (-47))) in
    if (literal 1 (-975)) <? t6 then
      t6
    else
    literal 0 0
  else
  literal 0 0.

(* src/bound/safe_steps.hpp *)
Definition advance_by_safe_steps (step : double -> double) (from until : double) : double :=
  let t1 := step (literal 0 0) in
  let t2 := sum_down (literal 0 0) t1 in
  let t3 := sum_down from t2 in
  if until <? t3 then
    infinity
  else
  if (t2 * (literal 1 (-24))) <? t1 then
    let t4 := step t2 in
    let t5 := sum_down t2 t4 in
    let t6 := sum_down from t5 in
    if until <? t6 then
      infinity
    else
    if (t5 * (literal 1 (-24))) <? t4 then
      let t7 := step t5 in
      let t8 := sum_down t5 t7 in
      let t9 := sum_down from t8 in
      if until <? t9 then
        infinity
      else
      if (t8 * (literal 1 (-24))) <? t7 then
        let t10 := step t8 in
        let t11 := sum_down t8 t10 in
        let t12 := sum_down from t11 in
        if until <? t12 then
          infinity
        else
        if (t11 * (literal 1 (-24))) <? t10 then
          let t13 := step t11 in
          let t14 := sum_down t11 t13 in
          let t15 := sum_down from t14 in
          if until <? t15 then
            infinity
          else
          if (t14 * (literal 1 (-24))) <? t13 then
            let t16 := step t14 in
            let t17 := sum_down t14 t16 in
            let t18 := sum_down from t17 in
            if until <? t18 then
              infinity
            else
            if (t17 * (literal 1 (-24))) <? t16 then
              let t19 := step t17 in
              let t20 := sum_down t17 t19 in
              let t21 := sum_down from t20 in
              if until <? t21 then
                infinity
              else
              if (t20 * (literal 1 (-24))) <? t19 then
                let t22 := step t20 in
                let t23 := sum_down t20 t22 in
                let t24 := sum_down from t23 in
                if until <? t24 then
                  infinity
                else
                if (t23 * (literal 1 (-24))) <? t22 then
                  let t25 := step t23 in
                  let t26 := sum_down t23 t25 in
                  let t27 := sum_down from t26 in
                  if until <? t27 then
                    infinity
                  else
                  if (t26 * (literal 1 (-24))) <? t25 then
                    let t28 := step t26 in
                    let t29 := sum_down t26 t28 in
                    let t30 := sum_down from t29 in
                    if until <? t30 then
                      infinity
                    else
                    if (t29 * (literal 1 (-24))) <? t28 then
                      let t31 := step t29 in
                      let t32 := sum_down t29 t31 in
                      let t33 := sum_down from t32 in
                      if until <? t33 then
                        infinity
                      else
                      if (t32 * (literal 1 (-24))) <? t31 then
                        let t34 := step t32 in
                        let t35 := sum_down t32 t34 in
                        let t36 := sum_down from t35 in
                        if until <? t36 then
                          infinity
                        else
                        if (t35 * (literal 1 (-24))) <? t34 then
                          let t37 := step t35 in
                          let t38 := sum_down t35 t37 in
                          let t39 := sum_down from t38 in
                          if until <? t39 then
                            infinity
                          else
                          if (t38 * (literal 1 (-24))) <? t37 then
                            let t40 := step t38 in
                            let t41 := sum_down t38 t40 in
                            let t42 := sum_down from t41 in
                            if until <? t42 then
                              infinity
                            else
                            if (t41 * (literal 1 (-24))) <? t40 then
                              let t43 := step t41 in
                              let t44 := sum_down t41 t43 in
                              let t45 := sum_down from t44 in
                              if until <? t45 then
                                infinity
                              else
                              if (t44 * (literal 1 (-24))) <? t43 then
                                let t46 := step t44 in
                                let t47 := sum_down t44 t46 in
                                let t48 := sum_down from t47 in
                                if until <? t48 then
                                  infinity
                                else
                                if (t47 * (literal 1 (-24))) <? t46 then
                                  if from <? t48 then
                                    t48
                                  else
                                  from
                                else
                                if from <? t48 then
                                  t48
                                else
                                from
                              else
                              if from <? t45 then
                                t45
                              else
                              from
                            else
                            if from <? t42 then
                              t42
                            else
                            from
                          else
                          if from <? t39 then
                            t39
                          else
                          from
                        else
                        if from <? t36 then
                          t36
                        else
                        from
                      else
                      if from <? t33 then
                        t33
                      else
                      from
                    else
                    if from <? t30 then
                      t30
                    else
                    from
                  else
                  if from <? t27 then
                    t27
                  else
                  from
                else
                if from <? t24 then
                  t24
                else
                from
              else
              if from <? t21 then
                t21
              else
              from
            else
            if from <? t18 then
              t18
            else
            from
          else
          if from <? t15 then
            t15
          else
          from
        else
        if from <? t12 then
          t12
        else
        from
      else
      if from <? t9 then
        t9
      else
      from
    else
    if from <? t6 then
      t6
    else
    from
  else
  if from <? t3 then
    t3
  else
  from.

(* src/bound/bound.cpp *)
Definition bound_of (r limit gx gy gz e0 e1 k x y z vx vy vz t : double) : bound :=
  if k =? (literal 0 0) then
    let t1 := r + e0 in
    Build_bound t x y z vx vy vz gx gy gz t1 e1 limit
  else
  let t1 := r + e0 in
  Build_bound t x y z vx vy vz gx gy gz t1 (sum_up e1 (magnitude k)) limit.

(* src/bound/certificates.cpp: the step of earliest_meeting, d after from *)
Definition meeting_step (a b : bound) (from distance d : double) : double :=
  let t1 := from - a.(time) in
  let t2 := (literal 1 (-1)) * t1 in
  let t3 := from - b.(time) in
  let t4 := (literal 1 (-1)) * t3 in
  let t5 := (a.(position_x) + ((a.(velocity_x) + (a.(plan_x) * t2)) * t1)) - (b.(position_x) + ((b.(velocity_x) + (b.(plan_x) * t4)) * t3)) in
  let t6 := (a.(velocity_x) + (a.(plan_x) * t1)) - (b.(velocity_x) + (b.(plan_x) * t3)) in
  let t7 := a.(plan_x) - b.(plan_x) in
  let t8 := (literal 1 (-1)) * d in
  let t9 := t6 + (t7 * t8) in
  let t10 := t5 + (t9 * d) in
  let t11 := (a.(position_y) + ((a.(velocity_y) + (a.(plan_y) * t2)) * t1)) - (b.(position_y) + ((b.(velocity_y) + (b.(plan_y) * t4)) * t3)) in
  let t12 := (a.(velocity_y) + (a.(plan_y) * t1)) - (b.(velocity_y) + (b.(plan_y) * t3)) in
  let t13 := a.(plan_y) - b.(plan_y) in
  let t14 := t12 + (t13 * t8) in
  let t15 := t11 + (t14 * d) in
  let t16 := (a.(position_z) + ((a.(velocity_z) + (a.(plan_z) * t2)) * t1)) - (b.(position_z) + ((b.(velocity_z) + (b.(plan_z) * t4)) * t3)) in
  let t17 := (a.(velocity_z) + (a.(plan_z) * t1)) - (b.(velocity_z) + (b.(plan_z) * t3)) in
  let t18 := a.(plan_z) - b.(plan_z) in
  let t19 := t17 + (t18 * t8) in
  let t20 := t16 + (t19 * d) in
  let t21 := ((t10 * t10) + (t15 * t15)) + (t20 * t20) in
  let t22 := root t21 in
  if (literal 1 (-500)) <? t22 then
    if (literal 0 0) <? t22 then
      let t23 := (a.(radius) + b.(radius)) + distance in
      let t24 := ((a.(growth_speed) + (((literal 1 (-1)) * a.(acceleration_limit)) * t1)) * t1) + ((b.(growth_speed) + (((literal 1 (-1)) * b.(acceleration_limit)) * t3)) * t3) in
      let t25 := (a.(growth_speed) + (a.(acceleration_limit) * t1)) + (b.(growth_speed) + (b.(acceleration_limit) * t3)) in
      let t26 := a.(acceleration_limit) + b.(acceleration_limit) in
      let t27 := t25 + (((literal 1 (-1)) * t26) * d) in
      let t28 := t24 + (t27 * d) in
      let t29 := widened ((((magnitude a.(plan_x)) + (magnitude a.(plan_y))) + (magnitude a.(plan_z))) + a.(acceleration_limit)) in
      let t30 := (widened ((((magnitude a.(velocity_x)) + (magnitude a.(velocity_y))) + (magnitude a.(velocity_z))) + a.(growth_speed))) + (t29 * t1) in
      let t31 := (widened ((((magnitude a.(position_x)) + (magnitude a.(position_y))) + (magnitude a.(position_z))) + a.(radius))) + (t30 * t1) in
      let t32 := widened ((((magnitude b.(plan_x)) + (magnitude b.(plan_y))) + (magnitude b.(plan_z))) + b.(acceleration_limit)) in
      let t33 := (widened ((((magnitude b.(velocity_x)) + (magnitude b.(velocity_y))) + (magnitude b.(velocity_z))) + b.(growth_speed))) + (t32 * t3) in
      let t34 := (widened ((((magnitude b.(position_x)) + (magnitude b.(position_y))) + (magnitude b.(position_z))) + b.(radius))) + (t33 * t3) in
      let t35 := capped (t30 + t33) in
      let t36 := capped (t29 + t32) in
      let t37 := (capped (t31 + t34)) + ((t35 + (((literal 1 (-1)) * t36) * d)) * d) in
      let t38 := (literal 1 (-47)) * (t37 + (magnitude distance)) in
      let t39 := ((t22 - t23) - t28) - t38 in
      let t40 := t10 / t22 in
      let t41 := t6 + (t7 * d) in
      let t42 := t15 / t22 in
      let t43 := t12 + (t13 * d) in
      let t44 := t20 / t22 in
      let t45 := t17 + (t18 * d) in
      let t46 := ((t40 * t41) + (t42 * t43)) + (t44 * t45) in
      let t47 := t25 + (t26 * d) in
      let t48 := (literal 1 (-47)) * (t35 + (t36 * d)) in
      let t49 := (literal 1 (-47)) * t36 in
      first_crossing t39 ((t46 - t47) - t48) (((((t40 * t7) + (t42 * t13)) + (t44 * t18)) - t26) - t49)
    else
    let t23 := (a.(radius) + b.(radius)) + distance in
    let t24 := ((a.(growth_speed) + (((literal 1 (-1)) * a.(acceleration_limit)) * t1)) * t1) + ((b.(growth_speed) + (((literal 1 (-1)) * b.(acceleration_limit)) * t3)) * t3) in
    let t25 := (a.(growth_speed) + (a.(acceleration_limit) * t1)) + (b.(growth_speed) + (b.(acceleration_limit) * t3)) in
    let t26 := a.(acceleration_limit) + b.(acceleration_limit) in
    let t27 := t25 + (((literal 1 (-1)) * t26) * d) in
    let t28 := t24 + (t27 * d) in
    let t29 := widened ((((magnitude a.(plan_x)) + (magnitude a.(plan_y))) + (magnitude a.(plan_z))) + a.(acceleration_limit)) in
    let t30 := (widened ((((magnitude a.(velocity_x)) + (magnitude a.(velocity_y))) + (magnitude a.(velocity_z))) + a.(growth_speed))) + (t29 * t1) in
    let t31 := (widened ((((magnitude a.(position_x)) + (magnitude a.(position_y))) + (magnitude a.(position_z))) + a.(radius))) + (t30 * t1) in
    let t32 := widened ((((magnitude b.(plan_x)) + (magnitude b.(plan_y))) + (magnitude b.(plan_z))) + b.(acceleration_limit)) in
    let t33 := (widened ((((magnitude b.(velocity_x)) + (magnitude b.(velocity_y))) + (magnitude b.(velocity_z))) + b.(growth_speed))) + (t32 * t3) in
    let t34 := (widened ((((magnitude b.(position_x)) + (magnitude b.(position_y))) + (magnitude b.(position_z))) + b.(radius))) + (t33 * t3) in
    let t35 := capped (t30 + t33) in
    let t36 := capped (t29 + t32) in
    let t37 := (capped (t31 + t34)) + ((t35 + (((literal 1 (-1)) * t36) * d)) * d) in
    let t38 := (literal 1 (-47)) * (t37 + (magnitude distance)) in
    let t39 := ((t22 - t23) - t28) - t38 in
    let t40 := t6 + (t7 * d) in
    let t41 := t12 + (t13 * d) in
    let t42 := t17 + (t18 * d) in
    let t43 := t25 + (t26 * d) in
    let t44 := (literal 1 (-47)) * (t35 + (t36 * d)) in
    let t45 := (((((literal 0 0) * t40) + ((literal 0 0) * t41)) + ((literal 0 0) * t42)) - t43) - t44 in
    let t46 := (literal 1 (-47)) * t36 in
    let t47 := (((((literal 0 0) * t7) + ((literal 0 0) * t13)) + ((literal 0 0) * t18)) - t26) - t46 in
    first_crossing t39 t45 t47
  else
  let t23 := (a.(radius) + b.(radius)) + distance in
  let t24 := ((a.(growth_speed) + (((literal 1 (-1)) * a.(acceleration_limit)) * t1)) * t1) + ((b.(growth_speed) + (((literal 1 (-1)) * b.(acceleration_limit)) * t3)) * t3) in
  let t25 := (a.(growth_speed) + (a.(acceleration_limit) * t1)) + (b.(growth_speed) + (b.(acceleration_limit) * t3)) in
  let t26 := a.(acceleration_limit) + b.(acceleration_limit) in
  let t27 := t25 + (((literal 1 (-1)) * t26) * d) in
  let t28 := t24 + (t27 * d) in
  let t29 := widened ((((magnitude a.(plan_x)) + (magnitude a.(plan_y))) + (magnitude a.(plan_z))) + a.(acceleration_limit)) in
  let t30 := (widened ((((magnitude a.(velocity_x)) + (magnitude a.(velocity_y))) + (magnitude a.(velocity_z))) + a.(growth_speed))) + (t29 * t1) in
  let t31 := (widened ((((magnitude a.(position_x)) + (magnitude a.(position_y))) + (magnitude a.(position_z))) + a.(radius))) + (t30 * t1) in
  let t32 := widened ((((magnitude b.(plan_x)) + (magnitude b.(plan_y))) + (magnitude b.(plan_z))) + b.(acceleration_limit)) in
  let t33 := (widened ((((magnitude b.(velocity_x)) + (magnitude b.(velocity_y))) + (magnitude b.(velocity_z))) + b.(growth_speed))) + (t32 * t3) in
  let t34 := (widened ((((magnitude b.(position_x)) + (magnitude b.(position_y))) + (magnitude b.(position_z))) + b.(radius))) + (t33 * t3) in
  let t35 := capped (t30 + t33) in
  let t36 := capped (t29 + t32) in
  let t37 := (capped (t31 + t34)) + ((t35 + (((literal 1 (-1)) * t36) * d)) * d) in
  let t38 := (literal 1 (-47)) * (t37 + (magnitude distance)) in
  let t39 := t6 + (t7 * d) in
  let t40 := t12 + (t13 * d) in
  let t41 := t17 + (t18 * d) in
  let t42 := t25 + (t26 * d) in
  let t43 := (literal 1 (-47)) * (t35 + (t36 * d)) in
  let t44 := (((((literal 0 0) * t39) + ((literal 0 0) * t40)) + ((literal 0 0) * t41)) - t42) - t43 in
  let t45 := (literal 1 (-47)) * t36 in
  let t46 := (((((literal 0 0) * t7) + ((literal 0 0) * t13)) + ((literal 0 0) * t18)) - t26) - t45 in
  first_crossing ((((literal 0 0) - t23) - t28) - t38) t44 t46.

(* src/bound/certificates.cpp *)
Definition earliest_meeting (a b : bound) (from until distance : double) : double :=
  advance_by_safe_steps (meeting_step a b from distance) from until.

(* src/bound/certificates.cpp: earliest_meeting of a bound and a half-space *)
Definition wall_meeting (a : bound) (x y z offset from until distance : double) : double :=
  let t1 := ((x * a.(velocity_x)) + (y * a.(velocity_y))) + (z * a.(velocity_z)) in
  let t2 := ((x * a.(plan_x)) + (y * a.(plan_y))) + (z * a.(plan_z)) in
  let t3 := (literal 1 (-1)) * t2 in
  let t4 := from - a.(time) in
  let t5 := t1 + (t3 * t4) in
  let t6 := (((x * a.(position_x)) + (y * a.(position_y))) + (z * a.(position_z))) + (t5 * t4) in
  let t7 := (((t6 - offset) - a.(radius)) - ((a.(growth_speed) + (((literal 1 (-1)) * a.(acceleration_limit)) * t4)) * t4)) - distance in
  let t8 := capped (widened ((((magnitude a.(plan_x)) + (magnitude a.(plan_y))) + (magnitude a.(plan_z))) + a.(acceleration_limit))) in
  let t9 := t8 * t4 in
  let t10 := capped ((widened ((((magnitude a.(velocity_x)) + (magnitude a.(velocity_y))) + (magnitude a.(velocity_z))) + a.(growth_speed))) + t9) in
  let t11 := (widened ((((magnitude a.(position_x)) + (magnitude a.(position_y))) + (magnitude a.(position_z))) + a.(radius))) + (t10 * t4) in
  let t12 := first_crossing (t7 - ((literal 1 (-47)) * (((capped t11) + (magnitude offset)) + (magnitude distance)))) (((t1 + (t2 * t4)) - (a.(growth_speed) + (a.(acceleration_limit) * t4))) - ((literal 1 (-47)) * t10)) ((t2 - a.(acceleration_limit)) - ((literal 1 (-47)) * t8)) in
  let t13 := sum_down from t12 in
  if until <? t13 then
    infinity
  else
  if from <? t13 then
    t13
  else
  from.

(* src/bound/relative_motion.hpp: BoundBesideBound *)
Definition beside (a b : bound) (from : double) : bound :=
  let t1 := from - a.(time) in
  let t2 := (literal 1 (-1)) * t1 in
  let t3 := from - b.(time) in
  let t4 := (literal 1 (-1)) * t3 in
  let t5 := (a.(position_x) + ((a.(velocity_x) + (a.(plan_x) * t2)) * t1)) - (b.(position_x) + ((b.(velocity_x) + (b.(plan_x) * t4)) * t3)) in
  let t6 := (a.(position_y) + ((a.(velocity_y) + (a.(plan_y) * t2)) * t1)) - (b.(position_y) + ((b.(velocity_y) + (b.(plan_y) * t4)) * t3)) in
  let t7 := (a.(position_z) + ((a.(velocity_z) + (a.(plan_z) * t2)) * t1)) - (b.(position_z) + ((b.(velocity_z) + (b.(plan_z) * t4)) * t3)) in
  let t8 := widened ((((magnitude a.(plan_x)) + (magnitude a.(plan_y))) + (magnitude a.(plan_z))) + a.(acceleration_limit)) in
  let t9 := (widened ((((magnitude a.(velocity_x)) + (magnitude a.(velocity_y))) + (magnitude a.(velocity_z))) + a.(growth_speed))) + (t8 * t1) in
  let t10 := widened ((((magnitude b.(plan_x)) + (magnitude b.(plan_y))) + (magnitude b.(plan_z))) + b.(acceleration_limit)) in
  let t11 := (widened ((((magnitude b.(velocity_x)) + (magnitude b.(velocity_y))) + (magnitude b.(velocity_z))) + b.(growth_speed))) + (t10 * t3) in
  let t12 := ((a.(growth_speed) + (a.(acceleration_limit) * t1)) + (b.(growth_speed) + (b.(acceleration_limit) * t3))) + ((literal 1 (-47)) * (capped (t9 + t11))) in
  Build_bound from t5 t6 t7 ((a.(velocity_x) + (a.(plan_x) * t1)) - (b.(velocity_x) + (b.(plan_x) * t3))) ((a.(velocity_y) + (a.(plan_y) * t1)) - (b.(velocity_y) + (b.(plan_y) * t3))) ((a.(velocity_z) + (a.(plan_z) * t1)) - (b.(velocity_z) + (b.(plan_z) * t3))) (a.(plan_x) - b.(plan_x)) (a.(plan_y) - b.(plan_y)) (a.(plan_z) - b.(plan_z)) ((a.(radius) + b.(radius)) - (literal 0 0)) t12 ((a.(acceleration_limit) + b.(acceleration_limit)) + ((literal 1 (-47)) * (capped (t8 + t10)))).

(* src/bound/relative_motion.hpp: BoundBesideBound *)
Definition slack_beside (a b : bound) (from : double) : double :=
  let t1 := from - a.(time) in
  let t2 := from - b.(time) in
  let t3 := ((a.(growth_speed) + (((literal 1 (-1)) * a.(acceleration_limit)) * t1)) * t1) + ((b.(growth_speed) + (((literal 1 (-1)) * b.(acceleration_limit)) * t2)) * t2) in
  let t4 := (widened ((((magnitude a.(velocity_x)) + (magnitude a.(velocity_y))) + (magnitude a.(velocity_z))) + a.(growth_speed))) + ((widened ((((magnitude a.(plan_x)) + (magnitude a.(plan_y))) + (magnitude a.(plan_z))) + a.(acceleration_limit))) * t1) in
  let t5 := (widened ((((magnitude a.(position_x)) + (magnitude a.(position_y))) + (magnitude a.(position_z))) + a.(radius))) + (t4 * t1) in
  let t6 := (widened ((((magnitude b.(velocity_x)) + (magnitude b.(velocity_y))) + (magnitude b.(velocity_z))) + b.(growth_speed))) + ((widened ((((magnitude b.(plan_x)) + (magnitude b.(plan_y))) + (magnitude b.(plan_z))) + b.(acceleration_limit))) * t2) in
  let t7 := (widened ((((magnitude b.(position_x)) + (magnitude b.(position_y))) + (magnitude b.(position_z))) + b.(radius))) + (t6 * t2) in
  t3 + ((literal 1 (-47)) * (capped (t5 + t7))).

(* src/bound/rigid_extent.hpp: the growth of RigidExtent::of_point *)
Definition growth_of_point (limit spin_growth spin x y z : double) : double :=
  let t1 := (literal 1 0) + (literal 1 (-47)) in
  let t2 := (root (((x * x) + (y * y)) + (z * z))) * t1 in
  limit + (((spin_growth + (spin * spin)) * t2) * t1).
