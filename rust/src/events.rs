//! Responses to events: bounces and potentials; and their hash.
use crate::error::{check, Result};
use crate::geometry::Vec3;
use crate::records::{BodyAction, Event, Roughness};
use crate::sys;
use crate::world::World;
use std::mem::size_of;

impl Event {
    /// The velocities after a frictionless bounce with restitution in [0, 1]. Events other than begins of contacts
    /// turn nobody.
    pub fn bounce(&self, restitution: f64) -> Result<Response> {
        self.settle(restitution, 0.0)
    }
    /// Like `bounce`, for bodies that settle in a heap: none separates more slowly than `resting_speed`.
    pub fn settle(&self, restitution: f64, resting_speed: f64) -> Result<Response> {
        Response::of(|raw| unsafe { sys::ks_bounce(self.raw(), restitution, resting_speed, raw) })
    }
    /// The velocities after a bounce of rough balls that turn: rigid bodies of one part, a ball around the position.
    pub fn bounce_rough(&self, rough: &Roughness) -> Result<Response> {
        Response::of(|raw| unsafe { sys::ks_bounce_rough(self.raw(), &rough.raw(), raw) })
    }
}

/// What an event does to its bodies: velocities from then on, and what else is done to them. A body without both
/// continues as before. A response has no effect on a body that an earlier one at the same time has removed, and none
/// but `Remove` on one that it has disabled.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Response {
    pub first: Option<Vec3>,
    pub second: Option<Vec3>,
    /// Of rigid bodies (radians / time).
    pub first_angular_velocity: Option<Vec3>,
    pub second_angular_velocity: Option<Vec3>,
    pub first_action: BodyAction,
    pub second_action: BodyAction,
    /// Of sensors: the two have been turned back at the sensor distance ([`crate::World::turn_back`]).
    pub turned_back: bool,
    /// The two get this state ([`crate::World::set_pair_state`]).
    pub pair_state: Option<i32>,
    /// In a run: `on_event` may change the world when it receives this event ([`crate::World::run`]).
    pub stop: bool,
}

impl Response {
    /// The response that this call writes.
    fn of(write: impl FnOnce(&mut sys::ks_response) -> sys::ks_status) -> Result<Response> {
        let mut raw = sys::ks_response::new();
        check(write(&mut raw))?;
        Ok(Response {
            first: (raw.turns_first != 0).then_some(raw.first_velocity),
            second: (raw.turns_second != 0).then_some(raw.second_velocity),
            first_angular_velocity: (raw.spins_first != 0).then_some(raw.first_angular_velocity),
            second_angular_velocity: (raw.spins_second != 0).then_some(raw.second_angular_velocity),
            turned_back: raw.turned_back != 0,
            pair_state: (raw.sets_pair_state != 0).then_some(raw.pair_state),
            ..Default::default()
        })
    }
    pub(crate) fn raw(&self) -> sys::ks_response {
        sys::ks_response {
            struct_size: size_of::<sys::ks_response>() as u32,
            stop: self.stop as i32,
            first_action: self.first_action as i32,
            second_action: self.second_action as i32,
            turns_first: self.first.is_some() as i32,
            turns_second: self.second.is_some() as i32,
            first_velocity: self.first.unwrap_or_default(),
            second_velocity: self.second.unwrap_or_default(),
            spins_first: self.first_angular_velocity.is_some() as i32,
            spins_second: self.second_angular_velocity.is_some() as i32,
            first_angular_velocity: self.first_angular_velocity.unwrap_or_default(),
            second_angular_velocity: self.second_angular_velocity.unwrap_or_default(),
            turned_back: self.turned_back as i32,
            sets_pair_state: self.pair_state.is_some() as i32,
            pair_state: self.pair_state.unwrap_or_default(),
            reserved: 0,
        }
    }
}

/// What a [`StepPotential`] is made of: the energy of a pair, as a function of the gap between its surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepPotentialDefinition<'a> {
    /// Gaps at which the energy changes (length, > 0), ascending.
    pub distances: &'a [f64],
    /// Of pairs that are nearer than each distance, but not than the one before.
    pub energies: &'a [f64],
    /// Energy beyond the last distance; infinity for a bond.
    pub outside: f64,
    /// Of contacts, in [0, 1].
    pub restitution: f64,
}

impl Default for StepPotentialDefinition<'_> {
    fn default() -> Self {
        StepPotentialDefinition { distances: &[], energies: &[], outside: 0.0, restitution: 1.0 }
    }
}

/// A potential of steps between pairs of bodies, as a response to events: square wells, Lennard-Jones potentials in
/// steps, bonds.
#[derive(Debug)]
pub struct StepPotential {
    handle: sys::ks_step_potential,
}

impl Drop for StepPotential {
    fn drop(&mut self) {
        unsafe { sys::ks_step_potential_destroy(self.handle) };
    }
}

impl StepPotential {
    /// A potential for worlds with the definition of this one, whose bodies need a sensor with its distances
    /// ([`World::set_sensor`]).
    ///
    /// # Panics
    /// If there are not as many energies as distances.
    pub fn new(world: &World, definition: &StepPotentialDefinition) -> Result<StepPotential> {
        let StepPotentialDefinition { distances, energies, outside, restitution } = *definition;
        assert_eq!(distances.len(), energies.len(), "one energy for each distance");
        let raw = sys::ks_step_potential_definition {
            struct_size: size_of::<sys::ks_step_potential_definition>() as u32,
            reserved: 0,
            count: distances.len(),
            distances: distances.as_ptr(),
            energies: energies.as_ptr(),
            outside,
            restitution,
        };
        let mut handle = sys::ks_step_potential { value: 0 };
        check(unsafe { sys::ks_step_potential_create(world.handle(), &raw, &mut handle) })?;
        Ok(StepPotential { handle })
    }
    /// At a step of the potential the two gain or lose what their energy changes by, or are turned back; at a contact
    /// they bounce.
    pub fn respond(&self, event: &Event) -> Result<Response> {
        Response::of(|raw| unsafe { sys::ks_step_potential_respond(self.handle, event.raw(), raw) })
    }
    /// The potential energy of a pair with this gap (length).
    pub fn energy(&self, gap: f64) -> f64 {
        let mut energy = 0.0;
        unsafe { sys::ks_step_potential_energy(self.handle, gap, &mut energy) };
        energy
    }
}

/// One number for all events of a run: two runs with equal numbers had bit-identical events.
#[derive(Clone, Copy, Default)]
pub struct EventHash {
    raw: sys::ks_event_hash,
}

impl EventHash {
    pub fn add(&mut self, event: &Event) {
        // It cannot fail: the event is one of the library.
        unsafe { sys::ks_event_hash_add(&mut self.raw, event.raw()) };
    }
    pub fn value(&self) -> u64 {
        let mut value = 0;
        unsafe { sys::ks_event_hash_value(&self.raw, &mut value) };
        value
    }
}
