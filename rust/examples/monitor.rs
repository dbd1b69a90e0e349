//! A control tower: 30 drones report every second, each at its own time and with errors of up to a metre. The monitor
//! says when two are certainly within 50 m of each other, and never wrongly. examples/c and csharp/examples have the
//! same tower.
use kinesphere::{
    ErrorBound, Monitor, MonitorDefinition, MonitorEventKind, Result, Separation, SeparationRule, State,
    TrackClass, TrackReport, Vec3, Verdict,
};

/// Numbers from 0 to 1, the same in each run.
fn numbers(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state = state * 16807 % 2147483647;
        state as f64 / 2147483647.0
    }
}

fn main() -> Result<()> {
    let (noise, warning, drones, seconds) = (1.0, 50.0, 30, 60);
    let tolerance = 4.0 * noise;
    let mut tower = Monitor::new(&MonitorDefinition {
        classes: vec![TrackClass { acceleration_limit: ErrorBound::Ball(4.0), ..Default::default() }],
        separations: vec![SeparationRule { classes: (0, 0), levels: vec![Separation::sphere(warning)] }],
        tolerance,
        ..Default::default()
    })?;

    // Hidden from the tower: the drones fly straight.
    let mut random = numbers(5);
    let start: Vec<State> = (0..drones)
        .map(|_| State {
            position: Vec3::new(1000.0 * random(), 1000.0 * random(), 100.0),
            velocity: Vec3::new(30.0 * (random() - 0.5), 30.0 * (random() - 0.5), 0.0),
        })
        .collect();

    let (mut within, mut wrong) = (0, 0);
    for k in 0..drones * seconds {
        let who = k % drones;
        let time = k as f64 / drones as f64;
        // Everything that becomes certain before the next report comes in.
        while let Some(event) = tower.advance(time)? {
            if event.kind != MonitorEventKind::Verdict || event.verdict != Verdict::Within {
                continue;
            }
            within += 1;
            let (a, b) = (start[event.first as usize], start[event.second as usize]);
            let apart = b.position - a.position + (b.velocity - a.velocity) * event.time;
            if apart.dot(apart).sqrt() > warning + tolerance {
                wrong += 1;
            }
            println!(
                "{:8.3} s  drones {} and {} are within {} m",
                event.time, event.first, event.second, warning
            );
        }
        let mut state = start[who];
        state.position.x += state.velocity.x * time + noise * (random() - 0.5);
        state.position.y += state.velocity.y * time + noise * (random() - 0.5);
        let position_error = ErrorBound::Ball(noise);
        tower.report(
            who as u64,
            &TrackReport { timestamp: time, state, position_error, ..Default::default() },
        )?;
    }
    println!("{} warnings in a minute, {} of them wrong", within, wrong);
    assert!(wrong == 0 && within > 0);
    Ok(())
}
