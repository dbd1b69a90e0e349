//! Responses to events, and their hash.
use crate::error::{check, Result};
use crate::geometry::Vec3;
use crate::records::{BodyAction, Event};
use crate::sys;
use std::mem::size_of;

impl Event {
    /// The velocities after a frictionless bounce with restitution in [0, 1]. Events other than begins of contacts
    /// turn nobody.
    pub fn bounce(&self, restitution: f64) -> Result<Response> {
        self.settle(restitution, 0.0)
    }
    /// Like `bounce`, for bodies that settle in a heap: none separates more slowly than `resting_speed`.
    pub fn settle(&self, restitution: f64, resting_speed: f64) -> Result<Response> {
        let mut raw = sys::ks_response::new();
        check(unsafe { sys::ks_bounce(self.raw(), restitution, resting_speed, &mut raw) })?;
        Ok(Response {
            first: if raw.turns_first != 0 { Some(raw.first_velocity) } else { None },
            second: if raw.turns_second != 0 { Some(raw.second_velocity) } else { None },
            first_angular_velocity: (raw.spins_first != 0).then_some(raw.first_angular_velocity),
            second_angular_velocity: (raw.spins_second != 0).then_some(raw.second_angular_velocity),
            ..Default::default()
        })
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
    /// In a run: `on_event` may change the world when it receives this event ([`crate::World::run`]).
    pub stop: bool,
}

impl Response {
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
        }
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
