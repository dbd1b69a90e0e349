//! The scene of tests/same_hash/shared_scene.cpp, run in three ways. Each prints its hash.
use kinesphere::{
    BodyDefinition, Box3, EventHash, Motion, Result, Run, Shape, State, Vec3, World, WorldDefinition,
};

fn new_world(start: &[State], radii: &[f64]) -> Result<World> {
    let bounds = Some(Box3 { lower: Vec3::default(), upper: Vec3::new(20.0, 20.0, 20.0) });
    let mut world = World::new(&WorldDefinition { bounds, ..Default::default() })?;
    world.set_sensor(0, &[0.5], u64::MAX)?;
    let limits = vec![5.0; start.len()];
    let forces = Motion::RandomForces { acceleration_limits: &limits, interval: 0.2, seed: 7 };
    world.add_motion(forces, start, radii, radii, &BodyDefinition::default())?;
    let zone = Box3 { lower: Vec3::new(5.0, 5.0, 5.0), upper: Vec3::new(15.0, 15.0, 15.0) };
    world.add_zone(&Shape::Box(zone), 0)?;
    Ok(world)
}

fn step_by_step(mut world: World) -> Result<u64> {
    let mut hash = EventHash::default();
    while let Some(event) = world.advance_motions(5.0)? {
        hash.add(&event);
        world.apply(&event, event.bounce(0.9)?)?;
    }
    Ok(hash.value())
}

fn at_once(mut world: World, how: Run, threads: i32) -> Result<u64> {
    let mut hash = EventHash::default();
    world.run(5.0, how, threads, |_, event| hash.add(event))?;
    Ok(hash.value())
}

fn main() -> Result<()> {
    let mut state: u64 = 1;
    let mut random = || {
        state = state * 16807 % 2147483647;
        state as f64 / 2147483647.0
    };
    let (mut start, mut radii) = (Vec::new(), Vec::new());
    for k in 0..64 {
        radii.push(0.5 + random());
        let cell = [(k % 4) as f64, (k / 4 % 4) as f64, (k / 16) as f64].map(|at| 2.5 + at * 5.0);
        let velocity = [(); 3].map(|_| 20.0 * (random() - 0.5));
        start.push(State {
            position: Vec3::new(cell[0], cell[1], cell[2]),
            velocity: Vec3::new(velocity[0], velocity[1], velocity[2]),
        });
    }
    println!("{:016x}", step_by_step(new_world(&start, &radii)?)?);
    println!("{:016x}", at_once(new_world(&start, &radii)?, Run::Bounce { restitution: 0.9 }, 1)?);
    let respond = |event: &kinesphere::Event| event.bounce(0.9).expect("an event of the library");
    println!("{:016x}", at_once(new_world(&start, &radii)?, Run::Respond(&respond), 2)?);
    Ok(())
}
