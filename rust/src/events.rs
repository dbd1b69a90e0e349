//! Events and responses.
use crate::error::{check, literal, Result};
use crate::geometry::{BodyId, State, Vec3};
use crate::sys;
use std::fmt;
use std::mem::size_of;

/// Kinds of events, in the order of their delivery within one instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EventKind {
    /// A state contradicts the motion limits of its body.
    BoundViolation,
    ContactBegin,
    ContactEnd,
    WallBegin,
    WallEnd,
    ZenoGuard,
    SensorEnter,
    SensorLeave,
    Woke,
}

impl EventKind {
    const ALL: [EventKind; 9] = [
        EventKind::BoundViolation,
        EventKind::ContactBegin,
        EventKind::ContactEnd,
        EventKind::WallBegin,
        EventKind::WallEnd,
        EventKind::ZenoGuard,
        EventKind::SensorEnter,
        EventKind::SensorLeave,
        EventKind::Woke,
    ];
    /// Returns nothing for `KS_EVENT_NONE`.
    fn of(number: i32) -> Option<EventKind> {
        EventKind::ALL.get((number as usize).wrapping_sub(1)).copied()
    }
    /// Returns a name such as "contact_begin".
    pub fn name(self) -> &'static str {
        literal(unsafe { sys::ks_event_kind_name(self as i32 + 1) })
    }
}

impl fmt::Display for EventKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The walls of the box of a world.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Wall {
    XLower,
    XUpper,
    YLower,
    YUpper,
    ZLower,
    ZUpper,
}

impl Wall {
    /// Returns nothing for `KS_WALL_NONE`.
    pub(crate) fn of(number: i32) -> Option<Wall> {
        use Wall::*;
        [XLower, XUpper, YLower, YUpper, ZLower, ZUpper].get((number as usize).wrapping_sub(1)).copied()
    }
}

/// What happens, with the states of the bodies at that time (`Event` in C++).
#[derive(Clone, Copy, Debug)]
pub struct Event {
    pub kind: EventKind,
    pub time: f64,
    pub first: BodyId,
    /// Nothing for events of one body and for walls.
    pub second: Option<BodyId>,
    pub wall: Option<Wall>,
    pub repeated: bool,
    pub jammed: bool,
    pub already_touching: bool,
    pub first_senses: bool,
    pub second_senses: bool,
    pub first_state: State,
    pub second_state: State,
    pub point: Vec3,
    /// Unit vector from `first` to `second` or the wall.
    pub normal: Vec3,
    pub gap: f64,
    pub approach_speed: f64,
    /// Of a sensor (length).
    pub distance: f64,
    pub first_user_data: u64,
    pub second_user_data: u64,
    /// Of rigid bodies: the part at the contact, as an index of [`crate::RigidDefinition::parts`]; of a mesh: the
    /// triangle.
    pub first_part: u32,
    pub second_part: u32,
    /// Of rigid bodies (radians / time).
    pub first_angular_velocity: Vec3,
    pub second_angular_velocity: Vec3,
    /// Of a bound violation: the acceleration limit that the body has from now on (length / time^2).
    pub acceleration_limit: f64,
    raw: sys::ks_event,
}

impl Event {
    pub(crate) fn of(raw: sys::ks_event) -> Option<Event> {
        Some(Event {
            kind: EventKind::of(raw.kind)?,
            time: raw.time,
            first: raw.first,
            second: raw.second.some(),
            wall: Wall::of(raw.wall),
            repeated: raw.repeated != 0,
            jammed: raw.jammed != 0,
            already_touching: raw.already_touching != 0,
            first_senses: raw.senses & 1 != 0,
            second_senses: raw.senses & 2 != 0,
            first_state: raw.first_state,
            second_state: raw.second_state,
            point: raw.point,
            normal: raw.normal,
            gap: raw.gap,
            approach_speed: raw.approach_speed,
            distance: raw.distance,
            first_user_data: raw.first_user_data,
            second_user_data: raw.second_user_data,
            first_part: raw.first_part,
            second_part: raw.second_part,
            first_angular_velocity: raw.first_angular_velocity,
            second_angular_velocity: raw.second_angular_velocity,
            acceleration_limit: raw.acceleration_limit,
            raw,
        })
    }

    /// The record of C, with all that C knows of the event.
    pub fn raw(&self) -> &sys::ks_event {
        &self.raw
    }

    /// The velocities after a frictionless bounce with restitution in [0, 1]. Events other than begins of contacts
    /// turn nobody.
    pub fn bounce(&self, restitution: f64) -> Result<Response> {
        self.settle(restitution, 0.0)
    }
    /// Like `bounce`, for bodies that settle in a heap: none separates more slowly than `resting_speed`.
    pub fn settle(&self, restitution: f64, resting_speed: f64) -> Result<Response> {
        let mut raw = Response::default().raw();
        check(unsafe { sys::ks_bounce(&self.raw, restitution, resting_speed, &mut raw) })?;
        Ok(Response {
            first: if raw.turns_first != 0 { Some(raw.first_velocity) } else { None },
            second: if raw.turns_second != 0 { Some(raw.second_velocity) } else { None },
            first_angular_velocity: (raw.spins_first != 0).then_some(raw.first_angular_velocity),
            second_angular_velocity: (raw.spins_second != 0).then_some(raw.second_angular_velocity),
            ..Default::default()
        })
    }
}

/// What a response does to a body, after the body has got its velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum BodyAction {
    #[default]
    None,
    Remove,
    Disable,
    /// With velocity 0.
    Sleep,
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
        unsafe { sys::ks_event_hash_add(&mut self.raw, &event.raw) };
    }
    pub fn value(&self) -> u64 {
        let mut value = 0;
        unsafe { sys::ks_event_hash_value(&self.raw, &mut value) };
        value
    }
}
