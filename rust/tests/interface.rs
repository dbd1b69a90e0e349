//! What Rust adds to the C interface: results, panics, lifetimes.
use kinesphere::*;
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::Arc;

/// A world in which two balls fly towards each other, and the probe that moves them.
#[allow(clippy::type_complexity)]
fn two_balls() -> (World, [BodyId; 2], impl Fn(&[BodyId], f64, &mut [State])) {
    let mut world = World::new(&WorldDefinition::default()).unwrap();
    let start = [
        State { position: Vec3::new(0.0, 0.0, 0.0), velocity: Vec3::new(1.0, 0.0, 0.0) },
        State { position: Vec3::new(10.0, 0.0, 0.0), velocity: Vec3::new(-1.0, 0.0, 0.0) },
    ];
    let ids = start.map(|state| world.add(&state.into()).unwrap());
    let probe = move |ids: &[BodyId], time: f64, states: &mut [State]| {
        for (id, state) in ids.iter().zip(states) {
            let from = start[id.index()];
            *state = State { position: from.position + from.velocity * time, ..from };
        }
    };
    (world, ids, probe)
}

#[test]
fn two_balls_meet() {
    let (mut world, [left, right], probe) = two_balls();
    let event = world.advance(20.0, &probe).unwrap().unwrap();
    assert_eq!((event.kind, event.first, event.second), (EventKind::ContactBegin, left, Some(right)));
    assert_eq!(event.kind.to_string(), "contact_begin");
    assert!((event.time - 4.0).abs() < 1e-5 && world.time() == event.time && world.probe_count() > 0);
    assert_eq!(world.touching(left).unwrap(), [right]);
    assert_eq!(world.advance(20.0, &probe).unwrap().unwrap().kind, EventKind::ContactEnd);
    assert!(world.advance(20.0, &probe).unwrap().is_none());
}

#[test]
fn timers_come_and_pairs_are_turned_back() {
    let (mut world, [first, second], probe) = two_balls();
    world.set_pair_state(first, second, -5).unwrap();
    assert_eq!(world.pair_state(second, first).unwrap(), -5);
    world.schedule(0.25, 7, 0.5).unwrap();
    let event = world.advance(20.0, &probe).unwrap().unwrap();
    assert_eq!((event.kind, event.time, event.first_user_data), (EventKind::Timer, 0.25, 7));
    assert_eq!(world.unschedule(7).unwrap(), 1);
    let event = world.advance(20.0, &probe).unwrap().unwrap();
    assert_eq!((event.kind, event.pair_state), (EventKind::ContactBegin, -5));
    assert!(world.turn_back(&event).is_err());
    assert!(world.schedule(0.0, 0, 0.0).is_err());
}

#[test]
fn a_ball_meets_a_moving_shape() {
    // A plate rises at 2 towards a ball that falls at 1, from a gap of 2.5.
    let mut world = World::new(&WorldDefinition::default()).unwrap();
    let start = [
        State { position: Vec3::default(), velocity: Vec3::new(0.0, 0.0, 2.0) },
        State { position: Vec3::new(0.25, 0.5, 4.0), velocity: Vec3::new(0.0, 0.0, -1.0) },
    ];
    let plate = Shape::Box(Box3 { lower: Vec3::new(-1.0, -1.0, 0.0), upper: Vec3::new(1.0, 1.0, 0.5) });
    let heavy = BodyDefinition { mass: f64::INFINITY, ..start[0].into() };
    let lift = world.add_moving_shape(&heavy, &plate).unwrap();
    let ball = world.add(&start[1].into()).unwrap();
    let probe = |ids: &[BodyId], time: f64, states: &mut [State]| {
        for (id, state) in ids.iter().zip(states) {
            let from = start[id.index()];
            *state = State { position: from.position + from.velocity * time, ..from };
        }
    };
    let event = world.advance(5.0, probe).unwrap().unwrap();
    assert_eq!((event.kind, event.first, event.second), (EventKind::ContactBegin, lift, Some(ball)));
    assert!((event.time - 2.5 / 3.0).abs() < 1e-5);
    let sphere = Shape::Ball { centre: Vec3::default(), radius: 1.0 };
    let error = world.add_moving_shape(&heavy, &sphere).unwrap_err();
    assert_eq!((error.name, error.argument.as_str()), ("unsupported", "shape"));
}

#[test]
fn a_ball_lands_on_the_edge_of_a_mesh() {
    let mut world = World::new(&WorldDefinition::default()).unwrap();
    let corner = |x: f64, y: f64| Vec3::new(4.0 * x, 4.0 * y, 0.0);
    let vertices = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let corners = [[0, 1, 2], [0, 2, 3]];
    let floor = world.add_mesh(&vertices, &corners).unwrap();
    let start = State { position: Vec3::new(1.0, 1.0, 3.0), velocity: Vec3::new(0.0, 0.0, -1.0) };
    let ball = world.add(&start.into()).unwrap();
    let probe = |_: &[BodyId], time: f64, states: &mut [State]| {
        states.fill(State { position: start.position + start.velocity * time, ..start });
    };
    let event = world.advance(5.0, probe).unwrap().unwrap();
    assert_eq!((event.kind, event.first, event.second), (EventKind::ContactBegin, floor, Some(ball)));
    assert!((event.time - 2.0).abs() < 1e-5);
    assert_eq!((event.normal, event.first_part), (Vec3::new(0.0, 0.0, 1.0), 0));
    let mesh = Mesh::new(&vertices, &corners[..1]).unwrap();
    let shape = mesh.shape();
    world.set_shape(floor, &shape).unwrap();
    drop(mesh);
    assert_eq!(world.set_shape(floor, &shape).unwrap_err().name, "stale_handle");
    assert_eq!(Mesh::new(&vertices, &[[0, 1, 4]]).unwrap_err().argument, "corners");
    assert!(Mesh::chain(&vertices).is_ok());
    assert_eq!(Mesh::chain(&vertices[..1]).unwrap_err().argument, "points");
}

#[test]
fn a_ball_turns_a_dumbbell() {
    let mut world = World::new(&WorldDefinition::default()).unwrap();
    let start =
        [State::default(), State { position: Vec3::new(1.0, 5.0, 0.0), velocity: Vec3::new(0.0, -1.0, 0.0) }];
    let end = |x| RigidPart { a: Vec3::new(x, 0.0, 0.0), b: Vec3::new(x, 0.0, 0.0), radius: 0.5 };
    let inertia = Vec3::new(0.0, 2.0, 2.0);
    let dumbbell = RigidDefinition { inertia, ..RigidDefinition::new(vec![end(-1.0), end(1.0)]) };
    let heavy = BodyDefinition { mass: 2.0, ..Default::default() };
    let body = world.add_rigid_body(&heavy, &dumbbell).unwrap();
    let ball = world.add(&start[1].into()).unwrap();
    let probe = |ids: &[BodyId], time: f64, states: &mut [State]| {
        for (id, state) in ids.iter().zip(states) {
            let from = start[id.index()];
            *state = State { position: from.position + from.velocity * time, ..from };
        }
    };
    let event = world.advance(10.0, probe).unwrap().unwrap();
    assert_eq!((event.first, event.second, event.first_part), (body, Some(ball), 1));
    let after = event.bounce(1.0).unwrap();
    let (v, w) = (after.first.unwrap().y, after.first_angular_velocity.unwrap().z);
    let u = after.second.unwrap().y;
    assert!((2.0 * v + u + 1.0).abs() < 1e-12 && (2.0 * w + u + 1.0).abs() < 1e-12);
    assert!(
        (2.0 * v * v + 2.0 * w * w + u * u - 1.0).abs() < 1e-12 && after.second_angular_velocity.is_none()
    );
    world.apply(&event, after).unwrap();
    assert_eq!(world.rotation(body).unwrap().angular_velocity.z, w);
    assert_eq!(world.rotation(ball).unwrap_err().name, "unsupported");
    assert_eq!(world.add_rigid_body(&heavy, &RigidDefinition::new(vec![])).unwrap_err().argument, "parts");
}

#[test]
fn a_square_that_turns_meets_a_ball_with_a_side() {
    let plate = |x, y| Vec3::new(x, y, 0.0);
    let square = RigidHull {
        points: vec![plate(-1.0, -1.0), plate(1.0, -1.0), plate(1.0, 1.0), plate(-1.0, 1.0)],
        radius: 0.0,
    };
    let cube = Box3 { lower: Vec3::new(-1.0, -1.0, -1.0), upper: Vec3::new(1.0, 1.0, 1.0) };
    for hull in [square, RigidHull::cuboid(cube, 0.0)] {
        let mut world = World::new(&WorldDefinition::default()).unwrap();
        let mut rigid = RigidDefinition { hulls: vec![hull], ..RigidDefinition::new(vec![]) };
        rigid.rotation.angular_velocity.z = 1.0;
        let body = world.add_rigid_body(&BodyDefinition::default(), &rigid).unwrap();
        let place = State { position: Vec3::new(2.2, 0.0, 0.0), velocity: Vec3::default() };
        world.add(&place.into()).unwrap();
        let probe = move |ids: &[BodyId], _: f64, states: &mut [State]| {
            for (id, state) in ids.iter().zip(states) {
                *state = if id.index() == 0 { State::default() } else { place };
            }
        };
        let event = world.advance(10.0, probe).unwrap().unwrap();
        assert!(event.first == body && (event.time - (2.0_f64 / 2.2).acos()).abs() < 1e-5);
    }
    let nothing = RigidDefinition { hulls: vec![RigidHull::default()], ..RigidDefinition::new(vec![]) };
    let mut world = World::new(&WorldDefinition::default()).unwrap();
    let error = world.add_rigid_body(&BodyDefinition::default(), &nothing).unwrap_err();
    assert_eq!(error.argument, "rigid.hulls.points");
}

#[test]
fn a_function_turns_a_rod() {
    let mut world = World::new(&WorldDefinition::default()).unwrap();
    let rod = RigidPart { a: Vec3::default(), b: Vec3::new(4.0, 0.0, 0.0), radius: 0.1 };
    let mut rigid = RigidDefinition::new(vec![rod]);
    rigid.rotation.angular_velocity.z = 1.0;
    rigid.angular_acceleration_limit = 1.0;
    rigid.largest_angular_speed = 2.0;
    world.add_rigid_body(&BodyDefinition::default(), &rigid).unwrap();
    let place = State { position: Vec3::new(0.0, 2.0, 0.0), velocity: Vec3::default() };
    world.add(&place.into()).unwrap();
    let probe = move |ids: &[BodyId], _: f64, states: &mut [State]| {
        for (id, state) in ids.iter().zip(states) {
            *state = if id.index() == 0 { State::default() } else { place };
        }
    };
    assert_eq!(world.advance(10.0, probe).unwrap_err().name, "null_probe");
    world.set_rotation_probe(|_, _, _| panic!("it does not turn")).unwrap();
    let panicked = catch_unwind(AssertUnwindSafe(|| world.advance(10.0, probe)));
    assert_eq!(panicked.unwrap_err().downcast_ref(), Some(&"it does not turn"));
    world
        .set_rotation_probe(|_, time, rotations| {
            for rotation in rotations {
                let (w, z) = ((time / 2.0).cos(), (time / 2.0).sin());
                rotation.orientation = Quaternion { w, z, ..Default::default() };
                rotation.angular_velocity = Vec3::new(0.0, 0.0, 1.0);
            }
        })
        .unwrap();
    let event = world.try_clone().unwrap().advance(10.0, probe).unwrap().unwrap();
    assert!((event.time - (std::f64::consts::FRAC_PI_2 - (1.1_f64 / 2.0).asin())).abs() < 1e-5);
    assert_eq!(event.first_angular_velocity.z, 1.0);
}

#[test]
fn wrong_use_is_an_error() {
    let (mut world, [left, _], probe) = two_balls();
    let error = world.set_radius(left, -1.0).unwrap_err();
    assert_eq!((error.name, error.argument.as_str(), error.body), ("out_of_range", "radius", Some(left)));
    assert!(error.to_string().contains("must be >= 0"));
    world.remove(left).unwrap();
    assert_eq!(world.set_radius(left, 1.0).unwrap_err().name, "stale_body");
    assert_eq!(world.advance(f64::NAN, probe).unwrap_err().name, "not_finite");
    assert_eq!(World::restore(b"nothing").err().unwrap().name, "bad_snapshot");
    assert!(!world.contains(left) && world.len() == 1);
}

#[test]
fn a_panic_passes_through_the_call() {
    let (mut world, _, probe) = two_balls();
    let (_, _, other) = two_balls();
    let limits = MotionLimits { acceleration_limit: 1.0, ..Default::default() };
    for body in world.bodies().unwrap() {
        world.set_motion_limits(body, &limits).unwrap();
    }
    let panicked = catch_unwind(AssertUnwindSafe(|| world.advance(20.0, |_, _, _| panic!("game over"))));
    assert_eq!(panicked.unwrap_err().downcast_ref(), Some(&"game over"));
    drop(probe);
    let event = world.advance(20.0, other).unwrap().unwrap();
    assert_eq!(event.kind, EventKind::ContactBegin);

    // Also from several threads of a run.
    let mut flying = World::new(&WorldDefinition {
        bounds: Some(Box3 { lower: Vec3::default(), upper: Vec3::new(9.0, 9.0, 9.0) }),
        ..Default::default()
    })
    .unwrap();
    let states: Vec<State> = (0..8)
        .map(|k| State { position: Vec3::new(1.0 + k as f64, 4.5, 4.5), velocity: Vec3::new(0.0, 1.0, 0.0) })
        .collect();
    let ballistic = Motion::Ballistic { gravity: Vec3::default() };
    let like = BodyDefinition { radius: 0.2, ..Default::default() };
    let (number, _) = flying.add_motion(ballistic, &states[1..], &[], &[], &like).unwrap();
    assert_eq!(flying.add_to_motion(number, ballistic, &states[..1], &like).unwrap().0, [7]);
    assert_eq!(flying.len(), 8);
    let respond = |_: &Event| -> Response { panic!("no answer") };
    let panicked = catch_unwind(AssertUnwindSafe(|| flying.run(20.0, Run::Respond(&respond), 2, |_, _| {})));
    assert_eq!(panicked.unwrap_err().downcast_ref(), Some(&"no answer"));
    let mut walls = 0;
    flying
        .run(20.0, Run::Bounce { restitution: 1.0 }, 2, |_, event| walls += event.wall.is_some() as i32)
        .unwrap();
    assert!(walls >= 8);
}

/// A bullet and a rock vanish as they meet, and a fragment appears there, which is disabled at the wall; a tired ball
/// falls asleep at a post.
#[test]
fn responses_remove_disable_put_to_sleep_and_stop() {
    const BULLET: u64 = 1;
    const TIRED: u64 = 3;
    let at = |x, y, speed| State { position: Vec3::new(x, y, y), velocity: Vec3::new(speed, 0.0, 0.0) };
    let is_burst = |event: &Event| event.kind == EventKind::ContactBegin && event.first_user_data == BULLET;
    let respond = |event: &Event| -> Response {
        let sleeps = event.kind == EventKind::ContactBegin && event.first_user_data == TIRED;
        match event.kind {
            _ if is_burst(event) => Response {
                first_action: BodyAction::Remove,
                second_action: BodyAction::Remove,
                stop: true,
                ..Default::default()
            },
            _ if sleeps => Response { first_action: BodyAction::Sleep, ..Default::default() },
            EventKind::WallBegin => Response { first_action: BodyAction::Disable, ..Default::default() },
            _ => Response::default(),
        }
    };
    let ballistic = Motion::Ballistic { gravity: Vec3::default() };
    let like = |user_data| BodyDefinition { radius: 0.5, user_data, ..Default::default() };
    let play = |threads| {
        let bounds = Some(Box3 { lower: Vec3::default(), upper: Vec3::new(20.0, 20.0, 20.0) });
        let mut world = World::new(&WorldDefinition { bounds, ..Default::default() }).unwrap();
        world.use_threads(threads).unwrap();
        assert_eq!(world.use_threads(0).unwrap_err().name, "out_of_range");
        let start = [at(1.0, 5.0, 4.0), at(8.0, 5.0, 0.0), at(1.0, 9.0, 1.0), at(8.0, 9.0, 0.0)];
        let (motion, mut ids) = world.add_motion(ballistic, &start[..1], &[], &[], &like(BULLET)).unwrap();
        for k in 1..4 {
            ids.extend(world.add_to_motion(motion, ballistic, &start[k..=k], &like(k as u64 + 1)).unwrap().1);
        }
        let (mut hash, mut fragments, mut refused) = (EventHash::default(), vec![], 0);
        let on_event = |world: &mut World, event: &Event| {
            hash.add(event);
            let state = [State { position: event.point, velocity: Vec3::new(2.0, 0.0, 0.0) }];
            match world.add_to_motion(motion, ballistic, &state, &like(5)) {
                Ok((numbers, added)) => {
                    assert!(is_burst(event) && numbers[0] < 2 && !world.contains(event.first));
                    fragments = added;
                }
                Err(error) => refused += (error.name == "run_in_progress") as i32,
            }
        };
        world.run(10.0, Run::Respond(&respond), threads, on_event).unwrap();
        assert!(fragments.len() == 1 && refused > 0 && world.len() == 3);
        assert!(!world.contains(ids[0]) && world.states(&ids[..1], 10.0).is_err());
        assert!((world.states(&ids[2..3], 10.0).unwrap()[0].position.x - 7.0).abs() < 1e-4);
        assert_eq!(world.wake(ids[2]), Ok(()));
        hash.value()
    };
    assert_eq!(play(1), play(2));

    // A loop does the same with `apply`; a wall cannot vanish.
    let mut world = World::new(&WorldDefinition {
        bounds: Some(Box3 { lower: Vec3::default(), upper: Vec3::new(20.0, 20.0, 20.0) }),
        ..Default::default()
    })
    .unwrap();
    world.add_motion(ballistic, &[at(5.0, 5.0, 1.0)], &[], &[], &like(0)).unwrap();
    let wrong = |_: &Event| Response { second_action: BodyAction::Remove, ..Default::default() };
    let error = world.run(20.0, Run::Respond(&wrong), 1, |_, _| {}).unwrap_err();
    assert_eq!((error.name, error.argument.as_str()), ("unknown_body", "second_action"));
    let event = world.advance_motions(20.0).unwrap().unwrap();
    world.apply(&event, Response { first_action: BodyAction::Remove, ..Default::default() }).unwrap();
    assert!(world.is_empty());
}

#[test]
fn walls_with_a_filter_let_a_ball_pass() {
    let walls = Filter { category: 2, ..Default::default() };
    let bounds = Some(Box3 { lower: Vec3::default(), upper: Vec3::new(20.0, 20.0, 20.0) });
    let mut world =
        World::new(&WorldDefinition { bounds, wall_filter: Some(walls), ..Default::default() }).unwrap();
    let start = [State { position: Vec3::new(10.0, 10.0, 10.0), velocity: Vec3::new(1.0, 0.0, 0.0) }];
    let like = BodyDefinition { filter: Filter { mask: 1, ..Default::default() }, ..Default::default() };
    let ballistic = Motion::Ballistic { gravity: Vec3::default() };
    let (_, ids) = world.add_motion(ballistic, &start, &[], &[], &like).unwrap();
    assert!(world.advance_motions(15.0).unwrap().is_none());
    world.set_filter(ids[0], Filter::default()).unwrap();
    assert_eq!(world.advance_motions(16.0).unwrap().unwrap().kind, EventKind::WallBegin);
}

#[test]
fn a_pair_filter_lives_as_long_as_the_last_clone() {
    let (mut world, _, probe) = two_balls();
    let calls = Arc::new(AtomicUsize::new(0));
    let counter = calls.clone();
    world
        .set_pair_filter(move |_, _| {
            counter.fetch_add(1, Ordering::Relaxed);
            false
        })
        .unwrap();
    let mut clone = world.try_clone().unwrap();
    drop(world);
    assert!(clone.advance(20.0, probe).unwrap().is_none());
    assert!(calls.load(Ordering::Relaxed) > 0 && Arc::strong_count(&calls) == 2);
    drop(clone);
    assert_eq!(Arc::strong_count(&calls), 1);
}

#[test]
fn a_panic_of_a_pair_filter_passes_through_the_call() {
    let (mut world, _, probe) = two_balls();
    world.set_pair_filter(|_, _| panic!("no answer")).unwrap();
    let panicked = catch_unwind(AssertUnwindSafe(|| world.advance(20.0, &probe)));
    assert_eq!(panicked.unwrap_err().downcast_ref(), Some(&"no answer"));
    // The call went on as if the two might touch, to the begin of their contact.
    assert!((world.time() - 4.0).abs() < 1e-5);
    world.set_pair_filter(|_, _| true).unwrap();
    assert_eq!(world.advance(20.0, &probe).unwrap().unwrap().kind, EventKind::ContactEnd);
}

#[test]
fn ships_are_steered() {
    let mut world = World::new(&WorldDefinition::default()).unwrap();
    let start = [State::default(), State { position: Vec3::new(10.0, 0.0, 0.0), ..Default::default() }];
    let ships = Motion::Steered { acceleration_limits: &[2.0, 2.0] };
    let (_, ids) = world.add_motion(ships, &start, &[], &[], &BodyDefinition::default()).unwrap();
    world.steer(ids[0], Vec3::new(2.0, 0.0, 0.0)).unwrap();
    assert_eq!(world.steer(ids[0], Vec3::new(3.0, 0.0, 0.0)).unwrap_err().argument, "acceleration");
    let event = world.advance_motions(60.0).unwrap().unwrap();
    assert!((event.time - 8.0_f64.sqrt()).abs() < 1e-5);
}

#[test]
fn a_state_that_the_probe_forgets_is_an_error() {
    let (mut world, [left, _], _) = two_balls();
    let limits = MotionLimits { acceleration_limit: 1.0, ..Default::default() };
    world.set_motion_limits(left, &limits).unwrap();
    let error = world.advance(20.0, |_, _, _| {}).unwrap_err();
    assert!(error.name == "not_finite" && error.body.is_some());
}

#[test]
fn what_a_world_knows_of_a_body() {
    let (mut world, [left, right], probe) = two_balls();
    world.reserve(10).unwrap();
    world.set_user_data(left, 7).unwrap();
    world.set_solid(right, false).unwrap();
    world.refresh_filter(left).unwrap();
    assert!(world.advance(2.0, &probe).unwrap().is_none());
    let view = world.body(left).unwrap();
    assert!(view.enabled && !view.is_static && !view.sleeping && view.bounds_end >= 2.0);
    assert_eq!((view.definition.user_data, view.definition.radius, view.image), (7, 1.0, [0; 3]));
    assert!(view.bounds.lower.x < 2.0 && view.bounds.upper.x > 2.0);
    assert!(!world.body(right).unwrap().definition.solid);
    let handle = world.handle();
    let mut size = 0;
    assert_eq!(unsafe { sys::ks_world_size(handle, &mut size) }, sys::KS_OK);
    assert_eq!(size, 2);
    world.remove_all(&[left, right]).unwrap();
    assert!(world.is_empty() && world.remove_all(&[left]).unwrap_err().name == "stale_body");
}

#[test]
fn snapshots_queries_and_predictions() {
    let (world, [left, right], probe) = two_balls();
    let mut restored = World::restore(&world.save().unwrap()).unwrap();
    assert_eq!(restored.bodies().unwrap(), [left, right]);
    let first = restored.advance(20.0, &probe).unwrap().unwrap();
    assert!((first.time - 4.0).abs() < 1e-5);
    let mut filtered = World::restore(&world.save().unwrap()).unwrap();
    filtered.set_pair_filter(|_, _| false).unwrap();
    let snapshot = filtered.save().unwrap();
    assert!(World::restore(&snapshot).err().unwrap().argument == "pair_filter");
    let mut filtered = World::restore_with_pair_filter(&snapshot, |_, _| false).unwrap();
    assert!(filtered.advance(20.0, &probe).unwrap().is_none());
    let contact = world.earliest_contact(left).unwrap();
    assert!(contact.partner == Some(right) && contact.time > 3.9 && contact.time <= 4.0);
    assert!(world.safe_until().unwrap().time <= 4.0);
    let hits = world.cast(Vec3::new(-5.0, 0.0, 0.0), Vec3::new(1.0, 0.0, 0.0), 50.0, 0.0).unwrap();
    assert!(hits.len() == 1 && hits[0].body == left && hits[0].certain);
    assert_eq!(world.nearest(Vec3::new(9.0, 0.0, 0.0), 1).unwrap()[0].body, right);
    assert!(world.overlapping(Vec3::new(5.0, 0.0, 0.0), 1.0).unwrap().is_empty());
    let along = Ray { origin: Vec3::new(-5.0, 0.0, 0.0), direction: Vec3::new(1.0, 0.0, 0.0), length: 50.0, radius: 0.0 };
    let hits = world.cast_all(&[along, along], &Choice { filter: None, except: &[right, left] }).unwrap();
    assert!(hits.len() == 2 && hits[0][0].body == left && hits[1][0].body == right);
    let spheres = [Sphere { centre: Vec3::default(), radius: 50.0 }, Sphere { centre: Vec3::new(5.0, 0.0, 0.0), radius: 1.0 }];
    let found = world.answers_with(&probe).overlapping_all(&spheres, &Choice::default()).unwrap();
    assert!(found[0].len() == 2 && found[1].is_empty());
    let nobody = Filter { category: 0, mask: 0, group: 0 };
    let found = world.nearest_all(&[Vec3::default()], 1, &Choice { filter: Some(nobody), except: &[] }).unwrap();
    assert!(found[0].is_empty());
    let refused = world.cast_all(&[along, Ray::default()], &Choice::default()).unwrap_err();
    assert!(refused.to_string().contains("query 1, direction"), "{refused}");
    let corner = Box3 { lower: Vec3::new(8.0, -1.0, -1.0), upper: Vec3::new(9.5, 1.0, 1.0) };
    assert_eq!(world.overlapping_box(&corner).unwrap()[0].body, right);
    assert!(world.pair_safe_until(left, right, 2.0).unwrap().time <= 3.0);
    let (lower, upper) = world.distance_limits(left, right, 1.0).unwrap();
    assert!(lower <= 6.0 && 6.0 <= upper);
}

#[test]
fn a_probe_makes_answers_better() {
    let (mut world, [left, right], probe) = two_balls();
    let limits = MotionLimits { acceleration_limit: 1.0, ..Default::default() };
    for body in [left, right] {
        world.set_motion_limits(body, &limits).unwrap();
    }
    assert!(world.advance(1.0, &probe).unwrap().is_none());
    let mut answers = world.answers_with(|_, _, _| panic!("lost"));
    let panicked = catch_unwind(AssertUnwindSafe(|| answers.pair_safe_until(left, right, 0.0)));
    assert_eq!(panicked.unwrap_err().downcast_ref(), Some(&"lost"));
    let known = world.distance_limits(left, right, 1.0).unwrap();
    let (lower, upper) = world.answers_with(&probe).distance_limits(left, right, 1.0).unwrap();
    assert!(known.0 <= lower && (upper - lower).abs() < 1e-9 && (lower - 6.0).abs() < 1e-9);
    assert!(world.answers_with(&probe).nearest(Vec3::default(), 1).unwrap()[0].certain);
}

#[test]
fn a_replay_repeats_a_recording() {
    let (mut world, [left, right], probe) = two_balls();
    world.start_recording().unwrap();
    world.set_profiling(true).unwrap();
    let event = world.advance(20.0, &probe).unwrap().unwrap();
    let recording = world.stop_recording().unwrap();
    assert!(world.timings().unwrap().advances == 1);
    let busiest = world.busiest(1).unwrap();
    assert!(busiest.len() == 1 && busiest[0].probes > 0 && busiest[0].reason.advice().len() > 20);
    assert_eq!(busiest[0].reason.to_string(), busiest[0].reason.name());

    let mut replay = Replay::open(&recording).unwrap();
    let again = replay.advance().unwrap().unwrap();
    assert_eq!((again.time, again.first, again.second), (event.time, left, Some(right)));
    assert!(!replay.finished() && replay.advance().unwrap().is_none());
    assert!(replay.finished() && replay.hash() != 0 && replay.steps().0 == replay.steps().1);
    let mut copy = replay.world().unwrap();
    drop(replay);
    assert_eq!(copy.advance(20.0, &probe).unwrap().unwrap().kind, EventKind::ContactEnd);
    assert_eq!(Replay::open(b"nothing").err().unwrap().name, "bad_recording");
}

#[test]
fn a_monitor_predicts() {
    let class = TrackClass { acceleration_limit: ErrorBound::Ball(0.5), ..Default::default() };
    let level = Separation::Ellipsoid { horizontal: 50.0, vertical: 50.0, look_ahead: 60.0 };
    let mut definition = MonitorDefinition {
        classes: vec![class],
        separations: vec![SeparationRule { classes: (0, 0), levels: vec![level] }],
        ..Default::default()
    };
    for shards in 1..3 {
        definition.shard.of = shards; // The pair of 1 and 2 is in the second of two shards.
        let mut monitor = Monitor::new(&definition).unwrap();
        for k in 0..2 {
            let state = State {
                position: Vec3::new(500.0 * k as f64, 0.0, 0.0),
                velocity: Vec3::new(10.0 - 20.0 * k as f64, 0.0, 0.0),
            };
            let report = TrackReport { state, velocity_error: ErrorBound::Ball(0.0), ..Default::default() };
            monitor.report(k + 1, &report).unwrap();
        }
        let event = monitor.advance(1.0).unwrap();
        let pairs = monitor.predicted_pairs().unwrap();
        assert_eq!((event.is_some(), pairs.len()), (shards == 1, (shards == 1) as usize));
        assert!(pairs.iter().all(|pair| (pair.first, pair.second) == (1, 2) && pair.closest_distance < 1e-6));
    }
}

#[test]
fn a_monitor_polls() {
    let class = TrackClass { acceleration_limit: ErrorBound::Ball(3.0), ..Default::default() };
    let rule = SeparationRule { classes: (0, 0), levels: vec![Separation::sphere(50.0)] };
    let mut monitor = Monitor::new(&MonitorDefinition {
        classes: vec![class],
        separations: vec![rule],
        ..Default::default()
    })
    .unwrap();
    let report = |track: u64, timestamp: f64| TrackReport {
        timestamp,
        state: State { position: Vec3::new(1000.0 * track as f64, 0.0, 0.0), ..Default::default() },
        ..Default::default()
    };
    for track in [1, 2] {
        monitor.report(track, &report(track, 0.0)).unwrap();
    }
    let mut silent = Monitor::restore(&monitor.save().unwrap()).unwrap();
    let mut asked = 0;
    let event = monitor.advance_with(60.0, |tracks, time| {
        asked += tracks.len();
        tracks.iter().map(|&track| Some(report(track, time))).collect()
    });
    assert!(event.unwrap().is_none() && asked > 0 && monitor.time() == 60.0);
    assert_eq!(monitor.answer(1, 2, 0).unwrap().verdict, Verdict::Apart);
    let event = silent.advance(60.0).unwrap().unwrap();
    assert_eq!((event.kind, event.verdict), (MonitorEventKind::Verdict, Verdict::Undecided));
    assert_eq!(silent.open_pairs().unwrap().len(), 1);
    assert_eq!(silent.answer(1, 9, 0).unwrap_err().name, "unknown_body");
    let panicked = catch_unwind(AssertUnwindSafe(|| silent.advance_with(61.0, |_, _| panic!("no radar"))));
    assert!(panicked.is_err());
    assert_eq!(silent.tracks().unwrap(), [1, 2]);
    let places = silent.places(1).unwrap();
    assert!(places.len() == 1 && places[0].centre.x == 1000.0);

    // A plan to stay makes the same reports enough.
    let plan = Plan { acceleration: Vec3::default(), limit: ErrorBound::Ball(0.0), valid_until: 60.0 };
    for track in [1, 2] {
        let planned = TrackReport { plan: Some(plan), ..report(track, 60.0) };
        monitor
            .report(track, &TrackReport { plan: Some(Plan { valid_until: 120.0, ..plan }), ..planned })
            .unwrap();
    }
    assert!(monitor.advance(120.0).unwrap().is_none());
}

#[test]
fn the_crate_has_the_version_of_the_library() {
    assert_eq!(version(), env!("CARGO_PKG_VERSION"));
}

fn new_game(response: GameResponse) -> (GameWorld, BodyId) {
    let bounds = Some(Box3 { lower: Vec3::default(), upper: Vec3::new(10.0, 10.0, 10.0) });
    let room = WorldDefinition { bounds, contacts: Contacts::Impacts, ..Default::default() };
    let mut game = GameWorld::new(&room, Vec3::new(0.0, 0.0, -10.0), response).unwrap();
    let position = Vec3::new(5.0, 5.0, 5.0);
    let ball = game.add(&BodyDefinition { radius: 0.5, position, ..Default::default() }).unwrap();
    (game, ball)
}

#[test]
fn a_game_moves_its_bodies() {
    let (mut game, ball) = new_game(GameResponse::Settle { restitution: 0.5, resting_speed: 0.1 });
    assert!(game.step(0.5).unwrap().is_empty());
    assert_eq!((game.ids(), game.velocities()), (&[ball][..], &[Vec3::new(0.0, 0.0, -5.0)][..]));
    assert!((game.positions()[0].z - 3.75).abs() < 1e-12);
    let other = game.add(&BodyDefinition { radius: 0.5, ..Default::default() }).unwrap();
    game.remove(ball).unwrap();
    assert_eq!((game.ids(), game.index_of(other).unwrap(), game.len()), (&[other][..], 0, 1));
    game.set_gravity(Vec3::default()).unwrap();
    game.set_all_velocities(&[Vec3::new(0.0, 1.0, 0.0)]).unwrap();
    game.set_acceleration(other, Vec3::new(0.0, 0.0, 4.0)).unwrap();
    let mut copy = game.try_clone().unwrap();
    copy.set_response(GameResponse::Respond(Box::new(|event| event.bounce(1.0).unwrap()))).unwrap();
    let mut saved = GameWorld::restore(&game.save().unwrap(), GameResponse::PassThrough, None).unwrap();
    for one in [&mut game, &mut copy, &mut saved] {
        one.step(0.5).unwrap();
        assert_eq!(one.velocities(), [Vec3::new(0.0, 1.0, 2.0)]);
        assert_eq!(one.gravity().unwrap(), Vec3::default());
    }
}

#[test]
fn a_response_answers_the_events_of_a_game() {
    let calls = Arc::new(AtomicUsize::new(0));
    let counted = calls.clone();
    let (mut game, ball) = new_game(GameResponse::Respond(Box::new(move |event| {
        let first_action = BodyAction::Remove;
        match counted.fetch_add(1, Ordering::Relaxed) {
            0 => event.bounce(1.0).unwrap(),
            1 => panic!("a slip of the pen"),
            _ => Response { first_action, ..Default::default() },
        }
    })));
    let event = game.advance(2.0).unwrap().unwrap();
    assert_eq!((event.kind, event.first, event.wall), (EventKind::WallBegin, ball, Some(Wall::ZLower)));
    assert_eq!(game.time(), event.time);
    assert!(game.velocities()[0].z > 0.0);
    assert!(game.advance(2.0).unwrap().is_none());
    let panic = catch_unwind(AssertUnwindSafe(|| game.step(2.0).map(<[Event]>::len))).unwrap_err();
    assert_eq!(panic.downcast_ref::<&str>(), Some(&"a slip of the pen"));
    assert_eq!(game.step(2.0).unwrap().len(), 1);
    assert!(game.ids().is_empty() && calls.load(Ordering::Relaxed) >= 3);
}

#[test]
fn wrong_use_of_games_is_told() {
    let (mut game, ball) = new_game(GameResponse::PassThrough);
    let name = |error: Error| (error.name, error.argument);
    let said = |name: &'static str, argument: &str| (name, argument.to_string());
    let nan = Vec3::new(f64::NAN, 0.0, 0.0);
    assert_eq!(name(game.step(f64::NAN).unwrap_err()), said("not_finite", "dt"));
    assert_eq!(name(game.set_all_velocities(&[]).unwrap_err()), said("out_of_range", "velocities"));
    let error = game.set_all_velocities(&[nan]).unwrap_err();
    assert_eq!((error.name, error.body), ("not_finite", Some(ball)));
    assert_eq!(game.set_motion_limits(ball, &MotionLimits::default()).unwrap_err().name, "unsupported");
    let still = |_: &[BodyId], _: f64, _: &mut [State]| {};
    assert_eq!(World::advance(&mut game, 1.0, still).unwrap_err().name, "unsupported");
    game.remove(ball).unwrap();
    assert_eq!(game.index_of(ball).unwrap_err().name, "stale_body");
    assert_eq!(game.set_velocity(ball, nan).unwrap_err().name, "stale_body");
    let bouncing = GameResponse::Bounce { restitution: 2.0 };
    let error = GameWorld::new(&WorldDefinition::default(), Vec3::default(), bouncing).err().unwrap();
    assert_eq!(name(error), said("out_of_range", "restitution"));
    // Another world in the place of the game is noticed, and is no game.
    *game = World::new(&WorldDefinition::default()).unwrap();
    assert_eq!(game.step(1.0).unwrap_err().name, "unsupported");
}

/// A world of two balls of radius 1/2 and mass 1 with this gap, which fly towards each other at this speed.
fn head_on(gap: f64, speed: f64) -> (World, [BodyId; 2]) {
    let mut world =
        World::new(&WorldDefinition { contacts: Contacts::Impacts, ..Default::default() }).unwrap();
    let at = |x: f64, v: f64| State { position: Vec3::new(x, 0.0, 0.0), velocity: Vec3::new(v, 0.0, 0.0) };
    let start = [at(-0.5 - gap / 2.0, speed / 2.0), at(0.5 + gap / 2.0, -speed / 2.0)];
    let gravity = Vec3::default();
    let (radii, like) = ([0.5; 2], BodyDefinition::default());
    let (_, ids) = world.add_motion(Motion::Ballistic { gravity }, &start, &radii, &[], &like).unwrap();
    world.set_sensor(0, &[0.5], u64::MAX).unwrap();
    (world, [ids[0], ids[1]])
}

#[test]
fn a_well_speeds_up_and_holds_back() {
    let (mut world, ids) = head_on(2.0, 1.0);
    let definition = StepPotentialDefinition { distances: &[0.5], energies: &[-1.0], ..Default::default() };
    let well = StepPotential::new(&world, &definition).unwrap();
    assert_eq!((well.energy(0.4), well.energy(0.6)), (-1.0, 0.0));
    let respond = |event: &Event| well.respond(event).unwrap();
    world
        .run(1.6, Run::Respond(&respond), 2, |_, event| assert_eq!(event.kind, EventKind::SensorEnter))
        .unwrap();
    let states = world.states(&ids, 1.6).unwrap();
    let speed = states[0].velocity.x - states[1].velocity.x;
    assert!((speed - 5.0_f64.sqrt()).abs() < 1e-12);

    // Two that begin inside have not enough energy to leave, in a loop, too.
    let (mut world, ids) = head_on(0.2, 1.0);
    let mut turns = 0;
    while let Some(event) = world.advance_motions(40.0).unwrap() {
        let response = well.respond(&event).unwrap();
        turns += response.turned_back as i32;
        world.apply(&event, response).unwrap();
    }
    assert!((39..=41).contains(&turns) && world.sensor_overlaps(ids[0]).unwrap().len() == 1);
    let wrong =
        StepPotentialDefinition { distances: &[0.5, 0.4], energies: &[0.0, 1.0], ..Default::default() };
    assert_eq!(StepPotential::new(&world, &wrong).unwrap_err().name, "out_of_range");
}

#[test]
fn rough_balls_turn_each_other() {
    let mut world = World::new(&WorldDefinition::default()).unwrap();
    let part = RigidPart { a: Vec3::default(), b: Vec3::default(), radius: 0.5 };
    let start = [-1.0, 1.0].map(|side| State {
        position: Vec3::new(2.0 * side, 0.2 * side, 0.0),
        velocity: Vec3::new(-side, 0.0, 0.0),
    });
    for state in start {
        world.add_rigid_body(&state.into(), &RigidDefinition::new(vec![part])).unwrap();
    }
    let flight = |ids: &[BodyId], time: f64, states: &mut [State]| {
        for (id, state) in ids.iter().zip(states) {
            let from = start[id.index()];
            *state = State { position: from.position + from.velocity * time, ..from };
        }
    };
    let event = world.advance(5.0, flight).unwrap().unwrap();
    let after = event.bounce_rough(&Roughness::default()).unwrap();
    let square = |v: Vec3| v.x * v.x + v.y * v.y + v.z * v.z;
    let (turning, flying) = (after.first_angular_velocity.unwrap(), after.first.unwrap());
    assert!(turning.z != 0.0 && (square(flying) + 0.4 * 0.25 * square(turning) - 1.0).abs() < 1e-12);
    let smooth = Roughness { tangential_restitution: -1.0, ..Default::default() };
    assert_eq!(event.bounce_rough(&smooth).unwrap().first, event.bounce(1.0).unwrap().first);
    let error = event.bounce_rough(&Roughness { friction: -1.0, ..Default::default() }).unwrap_err();
    assert_eq!((error.name, error.argument.as_str()), ("out_of_range", "friction"));
}
