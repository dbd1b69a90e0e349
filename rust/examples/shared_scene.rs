//! The scene of tests/same_hash/shared_scene.cpp, run in three ways, and the game. Each prints its hash.
use kinesphere::{
    BodyDefinition, Box3, EventHash, GameResponse, GameWorld, Motion, Result, Run, Shape, State,
    StaticDefinition, Vec3, World, WorldDefinition,
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

fn play(mut random: impl FnMut() -> f64) -> Result<u64> {
    let bounds = Some(Box3 { lower: Vec3::default(), upper: Vec3::new(10.0, 10.0, 10.0) });
    let bouncing = GameResponse::Bounce { restitution: 0.9 };
    let room = WorldDefinition { bounds, ..Default::default() };
    let mut game = GameWorld::new(&room, Vec3::new(0.0, 0.0, -9.81), bouncing)?;
    let block = Box3 { lower: Vec3::new(4.0, 4.0, 0.0), upper: Vec3::new(6.0, 6.0, 1.0) };
    game.add_static(&StaticDefinition::new(Shape::Box(block)))?;
    for k in 0..27 {
        let radius = 0.3 + 0.5 * random();
        let cell = [(k % 3) as f64, (k / 3 % 3) as f64, (k / 9) as f64].map(|at| 2.0 + at * 3.0);
        let velocity = [(); 3].map(|_| 10.0 * (random() - 0.5));
        game.add(&BodyDefinition {
            radius,
            mass: radius,
            position: Vec3::new(cell[0], cell[1], cell[2]),
            velocity: Vec3::new(velocity[0], velocity[1], velocity[2]),
            ..Default::default()
        })?;
    }
    let mut hash = EventHash::default();
    for frame in 0..128 {
        if frame % 16 == 0 {
            let turned: Vec<_> = game.velocities().iter().map(|v| Vec3::new(v.y, v.z, v.x)).collect();
            game.set_all_velocities(&turned)?;
        }
        if frame == 32 {
            let fourth = game.ids()[3];
            game.remove(fourth)?;
        }
        if frame == 64 {
            let position = Vec3::new(5.0, 5.0, 9.5);
            game.add(&BodyDefinition { radius: 0.25, position, ..Default::default() })?;
        }
        if frame == 96 {
            let first = game.ids()[0];
            game.set_acceleration(first, Vec3::new(0.0, 0.0, 20.0))?;
        }
        for event in game.step(0.015625)? {
            hash.add(event);
        }
    }
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
    println!("{:016x}", play(random)?);
    Ok(())
}
