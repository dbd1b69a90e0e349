//! Kinesphere in Rust: every collision among moving spheres whose trajectories nobody knows in advance, and what is
//! certain about tracks that report when they like.
//!
//! ```
//! use kinesphere::{BodyDefinition, BodyId, EventKind, State, Vec3, World, WorldDefinition};
//!
//! # fn main() -> kinesphere::Result<()> {
//! let mut world = World::new(&WorldDefinition::default())?;
//! let velocities = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(-1.0, 0.0, 0.0)];
//! let starts = [Vec3::new(0.0, 0.0, 0.0), Vec3::new(10.0, 0.0, 0.0)];
//! for (&position, &velocity) in starts.iter().zip(&velocities) {
//!     world.add(&BodyDefinition { position, velocity, ..Default::default() })?;
//! }
//! let probe = |ids: &[BodyId], time: f64, states: &mut [State]| {
//!     for (id, state) in ids.iter().zip(states) {
//!         let velocity = velocities[id.index()];
//!         *state = State { position: starts[id.index()] + velocity * time, velocity };
//!     }
//! };
//! let event = world.advance(60.0, probe)?.expect("the two meet");
//! assert_eq!(event.kind, EventKind::ContactBegin);
//! assert!((event.time - 4.0).abs() < 1e-5);
//! # Ok(())
//! # }
//! ```
//!
//! The crate is a safe interface to the C library `kinesphere-c`; `kinesphere.h` and the C++ headers explain units,
//! ranges, guarantees and costs. Wrong input is an [`Error`]. A panic in a closure passes through the call that
//! called it; the world can then go on, as after an error.
#[rustfmt::skip]
pub mod sys;

mod answers;
mod bodies;
mod error;
mod events;
mod game;
mod geometry;
mod monitor;
mod recording;
#[rustfmt::skip]
mod records;
mod world;

pub use answers::{Answers, Choice};
pub use bodies::{RigidDefinition, StaticDefinition};
pub use error::{Error, Result};
pub use events::{EventHash, Response, StepPotential, StepPotentialDefinition};
pub use game::{GameResponse, GameWorld};
pub use geometry::{
    BodyId, Box3, Mesh, Quaternion, Ray, RigidHull, RigidPart, Rotation, Shape, Sphere, State, Vec3,
};
pub use monitor::{ErrorBound, Monitor, Separation, SeparationRule};
pub use recording::Replay;
pub use records::*;
pub use world::{Motion, Run, World};

/// Returns the version of the library, such as "0.3.0".
pub fn version() -> &'static str {
    error::literal(unsafe { sys::ks_version() })
}
