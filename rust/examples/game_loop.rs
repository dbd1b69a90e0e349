//! A game at 60 frames a second. It moves its balls as games do, v += g dt, x += v dt, and hands each frame over.
//! Contacts come with their exact times between the last two frames and are answered there: fast balls never pass
//! through each other or the walls. examples/c and csharp/examples have the same game.
use kinesphere::{
    BodyDefinition, Box3, Contacts, EventKind, Motion, Result, State, Vec3, World, WorldDefinition,
};

/// Numbers from 0 to 1, the same in each run.
fn numbers(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state = state * 16807 % 2147483647;
        state as f64 / 2147483647.0
    }
}

fn main() -> Result<()> {
    let (dt, radius, edge, frames) = (1.0 / 60.0, 0.2, 10.0, 600);

    // The game's own bodies.
    let mut random = numbers(7);
    let mut game: Vec<State> = (0..216)
        .map(|k| State {
            position: Vec3::new(
                0.5 + 1.8 * (k % 6) as f64,
                0.5 + 1.8 * (k / 6 % 6) as f64,
                1.0 + 1.5 * (k / 36) as f64,
            ),
            velocity: Vec3::new(60.0 * (random() - 0.5), 60.0 * (random() - 0.5), 60.0 * (random() - 0.5)),
        })
        .collect();

    let mut world = World::new(&WorldDefinition {
        bounds: Some(Box3 { lower: Vec3::default(), upper: Vec3::new(edge, edge, edge) }),
        contact_tolerance: 1e-3,
        contacts: Contacts::Impacts,
        ..Default::default()
    })?;
    let like = BodyDefinition { radius, ..Default::default() };
    let motion = Motion::Frames { interval: dt, position_error: 0.0, acceleration_limits: &[] };
    let (motion, _) = world.add_motion(motion, &game, &[], &[], &like)?;

    let (mut between_balls, mut off_walls, mut deepest) = (0, 0, 0.0);
    for _ in 0..frames {
        for ball in &mut game {
            ball.velocity.z += -9.81 * dt;
            ball.position += ball.velocity * dt;
        }
        let positions: Vec<Vec3> = game.iter().map(|ball| ball.position).collect();
        let now = world.push_frame(motion, &positions)?;
        while let Some(event) = world.advance_motions(now)? {
            match event.kind {
                EventKind::ContactBegin => between_balls += 1,
                EventKind::WallBegin => off_walls += 1,
                _ => {}
            }
            let after = event.bounce(0.8)?;
            for (body, velocity) in [(Some(event.first), after.first), (event.second, after.second)] {
                if let (Some(body), Some(velocity)) = (body, velocity) {
                    game[body.index()].velocity = velocity;
                    world.set_velocity(body, velocity)?;
                }
            }
        }
        for (ball, p) in game.iter_mut().zip(world.latest_frame(motion)?) {
            ball.position = p; // here the game draws them
            for margin in [p.x, p.y, p.z, edge - p.x, edge - p.y, edge - p.z] {
                deepest = f64::max(deepest, radius - margin);
            }
        }
    }
    println!("{} bounces between balls, {} off walls, in {} frames", between_balls, off_walls, frames);
    println!("no ball was ever deeper in a wall than {:.4}", deepest);
    assert!(deepest <= 1e-3);
    Ok(())
}
