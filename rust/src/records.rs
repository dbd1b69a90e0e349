// Generated from include/kinesphere.h by interface/generate.py: change the header, and run that.
//! Records and enumerations, as `kinesphere.h` has them; what else they can do is in the other modules.
use crate::error::literal;
use crate::geometry::{BodyId, Box3, State, Vec3};
use crate::monitor::{ErrorBound, SeparationRule};
use crate::sys;
use std::fmt;

/// Which contact events bodies ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Contacts {
    /// A begin whenever two touch and approach, or are put into each other, and no ends.
    Impacts = 1,
    /// One begin and one end for each contact.
    BeginAndEnd = 2,
    /// Begins, ends, and each further approach in between.
    All = 3,
}

impl Contacts {
    /// Returns nothing for `KS_CONTACTS_OF_WORLD`.
    pub(crate) fn of(number: i32) -> Option<Contacts> {
        Some(match number {
            1 => Contacts::Impacts,
            2 => Contacts::BeginAndEnd,
            3 => Contacts::All,
            _ => return None,
        })
    }
}

/// Main reason for the probes of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ProbeReason {
    Touching = 0,
    NarrowMisses = 1,
    LooseLimit = 2,
    Contacts = 3,
    Travel = 4,
    Changes = 5,
    Queries = 6,
}

impl ProbeReason {
    pub(crate) fn of(number: i32) -> ProbeReason {
        match number {
            0 => ProbeReason::Touching,
            1 => ProbeReason::NarrowMisses,
            2 => ProbeReason::LooseLimit,
            3 => ProbeReason::Contacts,
            4 => ProbeReason::Travel,
            5 => ProbeReason::Changes,
            6 => ProbeReason::Queries,
            _ => unreachable!("a number that the library gave"),
        }
    }
    /// Returns a name such as "narrow_misses".
    pub fn name(self) -> &'static str {
        literal(unsafe { sys::ks_probe_reason_name(self as i32) })
    }
    /// Returns two sentences: what it means, and what makes such a body cheaper.
    pub fn advice(self) -> &'static str {
        literal(unsafe { sys::ks_probe_reason_advice(self as i32) })
    }
}

impl fmt::Display for ProbeReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Kinds of events, in the order of their delivery within one instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EventKind {
    /// A reported state contradicts the motion limits of its body.
    BoundViolation = 1,
    /// Two bodies touch: their gap has come down to at most the contact tolerance.
    ContactBegin = 2,
    /// Two bodies that touched are apart: their gap has grown to the separation distance.
    ContactEnd = 3,
    /// A body touches a wall of the box.
    WallBegin = 4,
    /// A body that touched a wall is clear of it.
    WallEnd = 5,
    /// Time would have stopped at a contact deep within its tolerance; it goes on by its least step. The two may come
    /// to overlap by more than the tolerance. If it comes often, a response does not part its bodies, or a body
    /// reaches through a wall.
    ZenoGuard = 6,
    /// The gap of two bodies has come down to a sensor distance.
    SensorEnter = 7,
    /// The gap of two bodies that were within a sensor distance has grown beyond it.
    SensorLeave = 8,
    /// A body that slept is awake again.
    Woke = 9,
    /// A timer of the caller's own, after all other events of its time. It names no body, and its first_user_data is
    /// that of the timer.
    Timer = 10,
}

impl EventKind {
    /// Returns nothing for `KS_EVENT_NONE`.
    pub(crate) fn of(number: i32) -> Option<EventKind> {
        Some(match number {
            1 => EventKind::BoundViolation,
            2 => EventKind::ContactBegin,
            3 => EventKind::ContactEnd,
            4 => EventKind::WallBegin,
            5 => EventKind::WallEnd,
            6 => EventKind::ZenoGuard,
            7 => EventKind::SensorEnter,
            8 => EventKind::SensorLeave,
            9 => EventKind::Woke,
            10 => EventKind::Timer,
            _ => return None,
        })
    }
    /// Returns a name such as "contact_begin".
    pub fn name(self) -> &'static str {
        literal(unsafe { sys::ks_event_kind_name(self as i32) })
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
    XLower = 1,
    XUpper = 2,
    YLower = 3,
    YUpper = 4,
    ZLower = 5,
    ZUpper = 6,
}

impl Wall {
    /// Returns nothing for `KS_WALL_NONE`.
    pub(crate) fn of(number: i32) -> Option<Wall> {
        Some(match number {
            1 => Wall::XLower,
            2 => Wall::XUpper,
            3 => Wall::YLower,
            4 => Wall::YUpper,
            5 => Wall::ZLower,
            6 => Wall::ZUpper,
            _ => return None,
        })
    }
}

/// What a response does to a body, after the body has got its velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum BodyAction {
    #[default]
    None = 0,
    Remove = 1,
    Disable = 2,
    /// With velocity 0.
    Sleep = 3,
}

impl BodyAction {
}

/// What the reports prove about two tracks and a separation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Verdict {
    /// The two certainly are not within the separation.
    Apart = 0,
    /// The reports prove neither of the other two.
    Undecided = 1,
    /// They certainly are within it, or outside of it by at most the tolerance.
    Within = 2,
}

impl Verdict {
    pub(crate) fn of(number: i32) -> Verdict {
        match number {
            0 => Verdict::Apart,
            1 => Verdict::Undecided,
            2 => Verdict::Within,
            _ => unreachable!("a number that the library gave"),
        }
    }
    /// Returns a name such as "undecided".
    pub fn name(self) -> &'static str {
        literal(unsafe { sys::ks_verdict_name(self as i32) })
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Kinds of events of a monitor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MonitorEventKind {
    /// The verdict about two tracks and a separation changes.
    Verdict = 1,
    /// If both go straight on, two tracks come within a separation, in its look-ahead time: no guarantee.
    Predicted = 2,
    /// They have passed each other, or a report shows that they will not come near.
    PredictionEnded = 3,
    /// A report contradicts the earlier ones of its track.
    Contradiction = 4,
    /// A contradiction has ended: later reports show which one was wrong.
    Resolved = 5,
    /// The latest report of a track has reached the age stale_after.
    Stale = 6,
    /// A stale track has reported again.
    Resumed = 7,
    /// A track was removed, or its latest report has reached the age drop_after.
    Dropped = 8,
    /// A report has given the track another class; it starts anew. Comes before all others of its time.
    Reclassified = 9,
}

impl MonitorEventKind {
    /// Returns nothing for `KS_MONITOR_NONE`.
    pub(crate) fn of(number: i32) -> Option<MonitorEventKind> {
        Some(match number {
            1 => MonitorEventKind::Verdict,
            2 => MonitorEventKind::Predicted,
            3 => MonitorEventKind::PredictionEnded,
            4 => MonitorEventKind::Contradiction,
            5 => MonitorEventKind::Resolved,
            6 => MonitorEventKind::Stale,
            7 => MonitorEventKind::Resumed,
            8 => MonitorEventKind::Dropped,
            9 => MonitorEventKind::Reclassified,
            _ => return None,
        })
    }
    /// Returns a name such as "predicted".
    pub fn name(self) -> &'static str {
        literal(unsafe { sys::ks_monitor_event_kind_name(self as i32) })
    }
}

impl fmt::Display for MonitorEventKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Selects the bodies that a body may touch: the category of each must have a bit in the mask of the other, unless
/// both are in one group, which decides by its sign. A body without a filter of its own, as a floor, has the category
/// 1: a mask without that bit lets its body fall through the floor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Filter {
    /// Default 1.
    pub category: u64,
    /// Default all bits.
    pub mask: u64,
    pub group: i32,
}

impl Filter {
    pub(crate) fn of(raw: &sys::ks_filter) -> Filter {
        Filter {
            category: raw.category,
            mask: raw.mask,
            group: raw.group,
        }
    }
    /// The record of C.
    pub(crate) fn raw(&self) -> sys::ks_filter {
        sys::ks_filter {
            category: self.category,
            mask: self.mask,
            group: self.group,
        }
    }
}

impl Default for Filter {
    fn default() -> Filter {
        Filter { category: 1, mask: u64::MAX, group: 0 }
    }
}

/// As `WorldDefinition` in C++.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldDefinition {
    /// 2 or 3, default 3. With 2, bodies are discs in the plane z = 0.
    pub dimensions: i32,
    /// These axes repeat, and have no walls.
    pub periodic: [bool; 3],
    /// The sides are walls, or repeat. Without a box the world is unbounded.
    pub bounds: Option<Box3>,
    /// > 0 (length), default 1e-6: the largest gap of a contact.
    pub contact_tolerance: f64,
    /// > contact_tolerance (length), default NaN, which is four tolerances: the gap at which a contact ends.
    pub separation_distance: f64,
    /// >= 0 (time): contacts of a body that follow each other sooner are `repeated`.
    pub zeno_interval: f64,
    /// The time at which the world begins.
    pub start_time: f64,
    /// Default `all`: what bodies ask for that do not say it themselves.
    pub contacts: Contacts,
    /// Default true. If false, bodies that certainly overlap are refused.
    pub allow_overlap: bool,
    /// Has no effect.
    pub spread_window_starts: bool,
    /// The filter of all walls; without one they meet every body.
    pub wall_filter: Option<Filter>,
    /// Default true: a report that breaks the promise of its body raises the body's acceleration limit to what
    /// explains the report.
    pub adopt_observed_limits: bool,
    /// (1 / time): the images of bodies across y slide along x, so that a flow goes on through the borders. x and y
    /// repeat then, and all bodies are balls.
    pub shear_rate: f64,
}

impl WorldDefinition {
    pub(crate) fn of(raw: &sys::ks_world_definition) -> WorldDefinition {
        WorldDefinition {
            dimensions: raw.dimensions,
            periodic: std::array::from_fn(|axis| raw.periodic >> axis & 1 != 0),
            bounds: (raw.has_box != 0).then(|| raw.box_),
            contact_tolerance: raw.contact_tolerance,
            separation_distance: raw.separation_distance,
            zeno_interval: raw.zeno_interval,
            start_time: raw.start_time,
            contacts: Contacts::of(raw.contacts).unwrap_or(Contacts::All),
            allow_overlap: raw.allow_overlap != 0,
            spread_window_starts: raw.spread_window_starts != 0,
            wall_filter: (raw.has_wall_filter != 0).then(|| Filter::of(&raw.wall_filter)),
            adopt_observed_limits: raw.adopt_observed_limits != 0,
            shear_rate: raw.shear_rate,
        }
    }
    /// The record of C.
    pub(crate) fn raw(&self) -> sys::ks_world_definition {
        sys::ks_world_definition {
            struct_size: std::mem::size_of::<sys::ks_world_definition>() as u32,
            dimensions: self.dimensions,
            has_box: self.bounds.is_some() as i32,
            periodic: (0..3).map(|axis| (self.periodic[axis] as u32) << axis).sum(),
            box_: self.bounds.unwrap_or_default(),
            contact_tolerance: self.contact_tolerance,
            separation_distance: self.separation_distance,
            zeno_interval: self.zeno_interval,
            start_time: self.start_time,
            contacts: self.contacts as i32,
            allow_overlap: self.allow_overlap as i32,
            spread_window_starts: self.spread_window_starts as i32,
            has_wall_filter: self.wall_filter.is_some() as i32,
            wall_filter: self.wall_filter.map(|one| one.raw()).unwrap_or_default(),
            adopt_observed_limits: self.adopt_observed_limits as i32,
            reserved: Default::default(),
            shear_rate: self.shear_rate,
        }
    }
}

/// The defaults of the library.
impl Default for WorldDefinition {
    fn default() -> WorldDefinition {
        WorldDefinition::of(&sys::ks_world_definition::new())
    }
}

/// As `BodyDefinition` in C++.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyDefinition {
    /// Default true. If false, the body only senses and is sensed.
    pub solid: bool,
    /// Which contact events it asks for; by default those of the world.
    pub contacts: Option<Contacts>,
    /// From 0 to 255; 255 is that of zones.
    pub sensor_class: u8,
    /// >= 0 (length), default 1.
    pub radius: f64,
    /// >= 0 (length / time^2): the largest deviation from the planned acceleration.
    pub acceleration_limit: f64,
    /// >= 0 (length): every reported position is within this of the true one.
    pub position_error: f64,
    /// >= 0 (length / time): every reported velocity is within this of the true one.
    pub velocity_error: f64,
    /// >= 0, or infinity, default 1: every event of the body has it, and bounces use it.
    pub mass: f64,
    /// Known acceleration, such as gravity (length / time^2).
    pub planned_acceleration: Vec3,
    pub position: Vec3,
    pub velocity: Vec3,
    /// Selects the bodies that it may touch.
    pub filter: Filter,
    /// Stored for the caller.
    pub user_data: u64,
}

impl BodyDefinition {
    pub(crate) fn of(raw: &sys::ks_body_definition) -> BodyDefinition {
        BodyDefinition {
            solid: raw.solid != 0,
            contacts: Contacts::of(raw.contacts),
            sensor_class: raw.sensor_class as u8,
            radius: raw.radius,
            acceleration_limit: raw.acceleration_limit,
            position_error: raw.position_error,
            velocity_error: raw.velocity_error,
            mass: raw.mass,
            planned_acceleration: raw.planned_acceleration,
            position: raw.position,
            velocity: raw.velocity,
            filter: Filter::of(&raw.filter),
            user_data: raw.user_data,
        }
    }
    /// The record of C.
    pub(crate) fn raw(&self) -> sys::ks_body_definition {
        sys::ks_body_definition {
            struct_size: std::mem::size_of::<sys::ks_body_definition>() as u32,
            solid: self.solid as i32,
            contacts: self.contacts.map_or(0, |one| one as i32),
            sensor_class: self.sensor_class as i32,
            radius: self.radius,
            acceleration_limit: self.acceleration_limit,
            position_error: self.position_error,
            velocity_error: self.velocity_error,
            mass: self.mass,
            planned_acceleration: self.planned_acceleration,
            position: self.position,
            velocity: self.velocity,
            filter: self.filter.raw(),
            user_data: self.user_data,
        }
    }
}

/// The defaults of the library.
impl Default for BodyDefinition {
    fn default() -> BodyDefinition {
        BodyDefinition::of(&sys::ks_body_definition::new())
    }
}

/// Limits within which a body moves.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct MotionLimits {
    pub acceleration_limit: f64,
    pub position_error: f64,
    pub velocity_error: f64,
    pub planned_acceleration: Vec3,
}

impl MotionLimits {
    /// The record of C.
    pub(crate) fn raw(&self) -> sys::ks_motion_limits {
        sys::ks_motion_limits {
            acceleration_limit: self.acceleration_limit,
            position_error: self.position_error,
            velocity_error: self.velocity_error,
            planned_acceleration: self.planned_acceleration,
        }
    }
}

/// What the world knows of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyView {
    pub enabled: bool,
    pub is_static: bool,
    pub sleeping: bool,
    pub report_time: f64,
    /// Contains the body from now until box_end.
    pub bounds: Box3,
    pub bounds_end: f64,
    /// Boxes that it has travelled along periodic axes.
    pub image: [i64; 3],
    /// Its state is that of the last report.
    pub definition: BodyDefinition,
}

impl BodyView {
    pub(crate) fn of(raw: &sys::ks_body_view) -> BodyView {
        BodyView {
            enabled: raw.enabled != 0,
            is_static: raw.is_static != 0,
            sleeping: raw.sleeping != 0,
            report_time: raw.report_time,
            bounds: raw.box_,
            bounds_end: raw.box_end,
            image: raw.image,
            definition: BodyDefinition::of(&raw.definition),
        }
    }
}

/// Wall-clock time spent (seconds) since profiling was switched on.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Timings {
    /// Calls that advance the world.
    pub advances: u64,
    /// In these calls, including probes.
    pub advance: f64,
    /// In the caller's probes.
    pub probes: f64,
}

impl Timings {
    pub(crate) fn of(raw: &sys::ks_timings) -> Timings {
        Timings {
            advances: raw.advances,
            advance: raw.advance,
            probes: raw.probes,
        }
    }
}

/// A body that was probed while profiling was on; `probes` is the sum of the next five fields.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BusyBody {
    pub body: BodyId,
    pub reason: ProbeReason,
    /// Its probed states; the sum of the next five.
    pub probes: u64,
    /// For a body or wall that it touches.
    pub touching: u64,
    /// For a body, wall or sensor distance that it may reach or leave.
    pub near: u64,
    /// As it left its safe regions.
    pub windows: u64,
    /// After changes by the caller and violated bounds.
    pub changes: u64,
    /// For queries and predictions with a probe.
    pub queries: u64,
    /// Its begins of contacts with bodies and walls.
    pub contacts: u64,
    /// Its limit now (length / time^2).
    pub acceleration_limit: f64,
    /// Largest deviation from the plan that reports prove (length / time^2).
    pub largest_acceleration: f64,
}

impl BusyBody {
    pub(crate) fn of(raw: &sys::ks_busy_body) -> BusyBody {
        BusyBody {
            body: raw.body,
            reason: ProbeReason::of(raw.reason),
            probes: raw.probes,
            touching: raw.touching,
            near: raw.near_others,
            windows: raw.windows,
            changes: raw.changes,
            queries: raw.queries,
            contacts: raw.contacts,
            acceleration_limit: raw.acceleration_limit,
            largest_acceleration: raw.largest_acceleration,
        }
    }
}

/// As `Event` in C++.
#[derive(Clone, Copy, Debug)]
pub struct Event {
    pub kind: EventKind,
    pub time: f64,
    /// The body of the event or, for a pair, the body with the smaller id. A timer has none.
    pub first: BodyId,
    /// The other body of a pair; no body for walls, bound violations, timers and bodies that woke.
    pub second: Option<BodyId>,
    /// The wall of a wall event.
    pub wall: Option<Wall>,
    /// One of the two touched another body less than the Zeno interval ago: a response should take no energy here.
    pub repeated: bool,
    /// Each of the two has had 64 contacts at this instant, as if stuck: a response should part them, or stop both.
    pub jammed: bool,
    /// Of begins: the two have touched since an earlier begin, and approach again. To count contacts, count the
    /// others.
    pub already_touching: bool,
    /// The first body senses the second one.
    pub first_senses: bool,
    /// The second body senses the first one.
    pub second_senses: bool,
    /// The body never moves.
    pub first_is_static: bool,
    /// The body is not solid: it touches no other body.
    pub first_is_zone: bool,
    /// The body sleeps and stays asleep: contacts wake their bodies.
    pub first_is_sleeping: bool,
    /// The body never moves.
    pub second_is_static: bool,
    /// The body is not solid: it touches no other body.
    pub second_is_zone: bool,
    /// The body sleeps and stays asleep: contacts wake their bodies.
    pub second_is_sleeping: bool,
    /// The state that the two of a pair were given; 0 for all others.
    pub pair_state: i32,
    /// At `time`; of a static body one point of its shape. In periodic space the two are nearest images.
    pub first_state: State,
    pub second_state: State,
    /// The middle of the gap between the two surfaces.
    pub point: Vec3,
    /// Unit vector from `first` towards `second`, or towards the wall.
    pub normal: Vec3,
    /// Distance between the surfaces (length); negative when they overlap.
    pub gap: f64,
    /// Speed at which the gap closes (length / time); negative when it opens.
    pub approach_speed: f64,
    /// Of a bound violation: how far the reported position lies outside the bound (length).
    pub position_excess: f64,
    /// Of a bound violation: by how much the velocity changed more than promised (length / time).
    pub velocity_excess: f64,
    /// Of a sensor: the sensor distance that was crossed (length).
    pub distance: f64,
    /// What the definition of the body gave.
    pub first_user_data: u64,
    pub second_user_data: u64,
    /// Of the body; infinite for a static body.
    pub first_mass: f64,
    /// Of the body; infinite for a static body and for a wall.
    pub second_mass: f64,
    /// Of a rigid body: the number of the part at the contact; of a mesh: that of the triangle; 0 for all others.
    pub first_part: u32,
    pub second_part: u32,
    /// Of a rigid body (radians / time); zero for all others.
    pub first_angular_velocity: Vec3,
    pub second_angular_velocity: Vec3,
    /// Change of the angular velocity of a rigid body by a unit impulse along the normal (radians / (mass length)).
    pub first_spin_gain: Vec3,
    pub second_spin_gain: Vec3,
    /// Of a bound violation: the acceleration limit that the body has from now on (length / time^2).
    pub acceleration_limit: f64,
    raw: sys::ks_event,
}

impl Event {
    /// The record of C.
    pub fn raw(&self) -> &sys::ks_event {
        &self.raw
    }
    pub(crate) fn of(raw: &sys::ks_event) -> Option<Event> {
        Some(Event {
            kind: EventKind::of(raw.kind)?,
            time: raw.time,
            first: raw.first,
            second: raw.second.some(),
            wall: Wall::of(raw.wall),
            repeated: raw.repeated != 0,
            jammed: raw.jammed != 0,
            already_touching: raw.already_touching != 0,
            first_senses: raw.senses & sys::KS_SENSES_FIRST != 0,
            second_senses: raw.senses & sys::KS_SENSES_SECOND != 0,
            first_is_static: raw.first_traits & sys::KS_TRAIT_STATIC != 0,
            first_is_zone: raw.first_traits & sys::KS_TRAIT_ZONE != 0,
            first_is_sleeping: raw.first_traits & sys::KS_TRAIT_SLEEPING != 0,
            second_is_static: raw.second_traits & sys::KS_TRAIT_STATIC != 0,
            second_is_zone: raw.second_traits & sys::KS_TRAIT_ZONE != 0,
            second_is_sleeping: raw.second_traits & sys::KS_TRAIT_SLEEPING != 0,
            pair_state: raw.pair_state,
            first_state: raw.first_state,
            second_state: raw.second_state,
            point: raw.point,
            normal: raw.normal,
            gap: raw.gap,
            approach_speed: raw.approach_speed,
            position_excess: raw.position_excess,
            velocity_excess: raw.velocity_excess,
            distance: raw.distance,
            first_user_data: raw.first_user_data,
            second_user_data: raw.second_user_data,
            first_mass: raw.first_mass,
            second_mass: raw.second_mass,
            first_part: raw.first_part,
            second_part: raw.second_part,
            first_angular_velocity: raw.first_angular_velocity,
            second_angular_velocity: raw.second_angular_velocity,
            first_spin_gain: raw.first_spin_gain,
            second_spin_gain: raw.second_spin_gain,
            acceleration_limit: raw.acceleration_limit,
            raw: *raw,
        })
    }
}

/// How rough spheres or discs bounce: Walton's model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roughness {
    /// In [0, 1], default 1: along the normal.
    pub restitution: f64,
    /// In [-1, 1], default 1: what is left of the tangential velocity of the surfaces in a contact that sticks,
    /// turned back; -1 is smooth.
    pub tangential_restitution: f64,
    /// >= 0, default infinity: coefficient beyond which a contact slides.
    pub friction: f64,
    /// > 0, default 0.4: moment of inertia in units of mass and squared radius.
    pub inertia: f64,
}

impl Roughness {
    pub(crate) fn of(raw: &sys::ks_roughness) -> Roughness {
        Roughness {
            restitution: raw.restitution,
            tangential_restitution: raw.tangential_restitution,
            friction: raw.friction,
            inertia: raw.inertia,
        }
    }
    /// The record of C.
    pub(crate) fn raw(&self) -> sys::ks_roughness {
        sys::ks_roughness {
            struct_size: std::mem::size_of::<sys::ks_roughness>() as u32,
            reserved: Default::default(),
            restitution: self.restitution,
            tangential_restitution: self.tangential_restitution,
            friction: self.friction,
            inertia: self.inertia,
        }
    }
}

/// The defaults of the library.
impl Default for Roughness {
    fn default() -> Roughness {
        Roughness::of(&sys::ks_roughness::new())
    }
}

/// When a contact or an approach may happen first. It certainly does not happen before `time`.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Prediction {
    /// In [current time, infinity].
    pub time: f64,
    /// No body for a wall, or if the time is infinite.
    pub partner: Option<BodyId>,
    pub wall: Option<Wall>,
    /// The contact exists, or the partner certainly is within the distance.
    pub happens: bool,
    pub probed: bool,
}

impl Prediction {
    pub(crate) fn of(raw: &sys::ks_prediction) -> Prediction {
        Prediction {
            time: raw.time,
            partner: raw.partner.some(),
            wall: Wall::of(raw.wall),
            happens: raw.happens != 0,
            probed: raw.probed != 0,
        }
    }
}

/// A body that a query found. For the nearest bodies and for casts its distance is between `lower` and `upper`
/// (length); for overlaps both are 0.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Hit {
    pub body: BodyId,
    /// False: possibly.
    pub certain: bool,
    pub lower: f64,
    pub upper: f64,
}

impl Hit {
    pub(crate) fn of(raw: &sys::ks_hit) -> Hit {
        Hit {
            body: raw.body,
            certain: raw.certain != 0,
            lower: raw.lower,
            upper: raw.upper,
        }
    }
}

/// Limits of all tracks of a class; at least one of acceleration_limit and largest_speed is finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackClass {
    pub acceleration_limit: ErrorBound,
    pub largest_speed: ErrorBound,
    pub planned_acceleration: Vec3,
}

impl TrackClass {
    /// The record of C.
    pub(crate) fn raw(&self) -> sys::ks_track_class {
        sys::ks_track_class {
            acceleration_limit: self.acceleration_limit.raw(),
            largest_speed: self.largest_speed.raw(),
            planned_acceleration: self.planned_acceleration,
        }
    }
}

/// As `MonitorDefinition` in C++.
#[derive(Clone, Debug, PartialEq)]
pub struct MonitorDefinition {
    /// 2 or 3, default 3. In two dimensions, z is ignored.
    pub dimensions: i32,
    /// Without it the clock starts at the first report or the first time to advance to.
    pub start_time: Option<f64>,
    /// > 0 (length), default 1e-3: how far outside the separation a pair still is `within`.
    pub tolerance: f64,
    /// > 0 (time), default 1e-3: how late a verdict may be that time alone decides.
    pub time_resolution: f64,
    /// > 0 (time), default 1: about the time between two reports of a track.
    pub window: f64,
    /// > 0 (time), default infinity: age of the latest report at which a track is stale.
    pub stale_after: f64,
    /// > 0 (time), default infinity: age of the latest report at which a track is dropped.
    pub drop_after: f64,
    /// >= 0 (time): a prediction ends once it has not held for this long.
    pub prediction_hold: f64,
    /// >= 0 (time): a prediction begins once it has held for this long.
    pub prediction_confirmation: f64,
    /// In [0, 1]: a prediction goes on within the separation enlarged by this part of it.
    pub prediction_margin: f64,
    /// In [0, 1]: separations are enlarged for predictions by this part of the position errors of both tracks.
    pub prediction_error_part: f64,
    /// Motion limits of the track classes; a report names its class by its place.
    pub classes: Vec<TrackClass>,
    /// Pairs of classes that no rule names are not watched.
    pub separations: Vec<SeparationRule>,
    pub shard: Shard,
}

/// A part of a [`MonitorDefinition`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Default 1: the monitor watches shards shard_first, ..., shard_first + shard_count - 1 of all pairs, out of
    /// shard_of; a pair is in the shard that the lower of its ids modulo shard_of says.
    pub of: u64,
    /// The first one that it watches.
    pub first: u64,
    /// Default 1.
    pub count: u64,
}

impl MonitorDefinition {
    pub(crate) fn of(raw: &sys::ks_monitor_definition) -> MonitorDefinition {
        MonitorDefinition {
            dimensions: raw.dimensions,
            start_time: (raw.has_start_time != 0).then(|| raw.start_time),
            tolerance: raw.tolerance,
            time_resolution: raw.time_resolution,
            window: raw.window,
            stale_after: raw.stale_after,
            drop_after: raw.drop_after,
            prediction_hold: raw.prediction_hold,
            prediction_confirmation: raw.prediction_confirmation,
            prediction_margin: raw.prediction_margin,
            prediction_error_part: raw.prediction_error_part,
            classes: Vec::new(),
            separations: Vec::new(),
            shard: Shard { of: raw.shard_of, first: raw.shard_first, count: raw.shard_count },
        }
    }
    /// The record of C, without its lists.
    pub(crate) fn raw(&self) -> sys::ks_monitor_definition {
        sys::ks_monitor_definition {
            struct_size: std::mem::size_of::<sys::ks_monitor_definition>() as u32,
            dimensions: self.dimensions,
            has_start_time: self.start_time.is_some() as i32,
            start_time: self.start_time.unwrap_or(0.0),
            classes: std::ptr::null(),
            class_count: Default::default(),
            separations: std::ptr::null(),
            separation_count: Default::default(),
            tolerance: self.tolerance,
            time_resolution: self.time_resolution,
            window: self.window,
            stale_after: self.stale_after,
            drop_after: self.drop_after,
            prediction_hold: self.prediction_hold,
            prediction_confirmation: self.prediction_confirmation,
            prediction_margin: self.prediction_margin,
            prediction_error_part: self.prediction_error_part,
            shard_of: self.shard.of,
            shard_first: self.shard.first,
            shard_count: self.shard.count,
        }
    }
}

/// The defaults of the library.
impl Default for MonitorDefinition {
    fn default() -> MonitorDefinition {
        MonitorDefinition::of(&sys::ks_monitor_definition::new())
    }
}

/// A reported state of a track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackReport {
    /// Place of its class in those of the monitor.
    pub track_class: usize,
    /// Time of the state on the monitor's clock.
    pub timestamp: f64,
    /// Largest difference of the timestamp from the true time.
    pub timestamp_error: f64,
    pub state: State,
    /// Largest distance of the true position from the reported one (length).
    pub position_error: ErrorBound,
    /// Largest difference of the true velocity from the reported one (length / time); infinite if none was reported.
    pub velocity_error: ErrorBound,
    pub plan: Option<Plan>,
}

/// A part of a [`TrackReport`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// From the timestamp on, in place of what the class says.
    pub acceleration: Vec3,
    /// Largest deviation from that acceleration.
    pub limit: ErrorBound,
    /// Default infinity.
    pub valid_until: f64,
}

impl TrackReport {
    pub(crate) fn of(raw: &sys::ks_track_report) -> TrackReport {
        TrackReport {
            track_class: raw.track_class as usize,
            timestamp: raw.timestamp,
            timestamp_error: raw.timestamp_error,
            state: raw.state,
            position_error: ErrorBound::of(&raw.position_error),
            velocity_error: ErrorBound::of(&raw.velocity_error),
            plan: (raw.has_plan != 0).then(|| Plan { acceleration: raw.plan_acceleration, limit: ErrorBound::of(&raw.plan_limit), valid_until: raw.plan_valid_until }),
        }
    }
    /// The record of C.
    pub(crate) fn raw(&self) -> sys::ks_track_report {
        let mut raw = sys::ks_track_report {
            struct_size: std::mem::size_of::<sys::ks_track_report>() as u32,
            has_plan: Default::default(),
            track_class: self.track_class as u64,
            timestamp: self.timestamp,
            timestamp_error: self.timestamp_error,
            state: self.state,
            position_error: self.position_error.raw(),
            velocity_error: self.velocity_error.raw(),
            plan_acceleration: Default::default(),
            plan_limit: Default::default(),
            plan_valid_until: Default::default(),
        };
        if let Some(one) = self.plan {
            raw.has_plan = 1;
            raw.plan_acceleration = one.acceleration;
            raw.plan_limit = one.limit.raw();
            raw.plan_valid_until = one.valid_until;
        }
        raw
    }
}

/// The defaults of the library.
impl Default for TrackReport {
    fn default() -> TrackReport {
        TrackReport::of(&sys::ks_track_report::new())
    }
}

/// As `MonitorEvent` in C++.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MonitorEvent {
    pub kind: MonitorEventKind,
    pub time: f64,
    /// The track of the event; for a pair, the one with the lower id.
    pub first: u64,
    /// Of a verdict or a prediction: the track with the higher id.
    pub second: u64,
    /// Of a verdict or a prediction: the separation level.
    pub level: u32,
    /// Of a verdict: the new one.
    pub verdict: Verdict,
    /// Of a verdict: the one before.
    pub before: Verdict,
    /// Time at which the verdict before began, -infinity for a pair that was apart at all levels; of a prediction,
    /// time at which it began.
    pub since: f64,
    /// Of a prediction: the time at which the two come within; infinity if they never do.
    pub likely_time: f64,
    /// Of a prediction: the time of the closest approach.
    pub closest_time: f64,
    /// Of a prediction: the distance then (length); for a cylinder that in the plane.
    pub closest_distance: f64,
    /// Of a contradiction: how far the position is outside of what was possible (length).
    pub position_excess: f64,
    /// Of a contradiction: how far the velocity is outside (length / time).
    pub velocity_excess: f64,
}

impl MonitorEvent {
    pub(crate) fn of(raw: &sys::ks_monitor_event) -> Option<MonitorEvent> {
        Some(MonitorEvent {
            kind: MonitorEventKind::of(raw.kind)?,
            time: raw.time,
            first: raw.first,
            second: raw.second,
            level: raw.level,
            verdict: Verdict::of(raw.verdict),
            before: Verdict::of(raw.before),
            since: raw.since,
            likely_time: raw.likely_time,
            closest_time: raw.closest_time,
            closest_distance: raw.closest_distance,
            position_excess: raw.position_excess,
            velocity_excess: raw.velocity_excess,
        })
    }
}

/// The verdict about two tracks, with a forecast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairAnswer {
    pub verdict: Verdict,
    /// From `predicted` to `prediction_ended`.
    pub predicted: bool,
    /// Time since which the verdict has held; -infinity for a pair that is apart at all levels.
    pub since: f64,
    /// A certain verdict is true until this time, whatever is reported.
    pub until: f64,
    /// Lower limit of the distance now (length); for a cylinder, of that in the plane.
    pub lower: f64,
    /// Upper limit of it.
    pub upper: f64,
    /// Estimate, if both go straight on: distance at the closest approach; for a cylinder that in the plane.
    pub closest_distance: f64,
    /// Estimate: the time of the closest approach.
    pub closest_time: f64,
    /// Estimate: the horizontal part of the distance at that time.
    pub closest_horizontal: f64,
    /// Estimate: the vertical part.
    pub closest_vertical: f64,
    /// Estimate: speed of one relative to the other now.
    pub relative_speed: f64,
    /// Estimate: time at which they first are within the separation; infinity if they never are.
    pub likely_time: f64,
    /// The pair certainly is within at some time up to this one, whatever the tracks do within their limits.
    pub inevitable_by: f64,
    /// Estimate: if both go straight on until this time, no accelerations within their limits keep them out.
    pub avoidable_until: f64,
    /// The track whose report would tighten the bounds most.
    pub ask: u64,
    /// When that report is needed for the verdict to stay certain.
    pub ask_by: f64,
}

impl PairAnswer {
    pub(crate) fn of(raw: &sys::ks_pair_answer) -> PairAnswer {
        PairAnswer {
            verdict: Verdict::of(raw.verdict),
            predicted: raw.predicted != 0,
            since: raw.since,
            until: raw.until,
            lower: raw.lower,
            upper: raw.upper,
            closest_distance: raw.closest_distance,
            closest_time: raw.closest_time,
            closest_horizontal: raw.closest_horizontal,
            closest_vertical: raw.closest_vertical,
            relative_speed: raw.relative_speed,
            likely_time: raw.likely_time,
            inevitable_by: raw.inevitable_by,
            avoidable_until: raw.avoidable_until,
            ask: raw.ask,
            ask_by: raw.ask_by,
        }
    }
}

/// A pair that is not certainly apart at a level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenPair {
    pub first: u64,
    pub second: u64,
    pub level: u32,
    pub verdict: Verdict,
    pub since: f64,
}

impl OpenPair {
    pub(crate) fn of(raw: &sys::ks_open_pair) -> OpenPair {
        OpenPair {
            first: raw.first,
            second: raw.second,
            level: raw.level,
            verdict: Verdict::of(raw.verdict),
            since: raw.since,
        }
    }
}

/// A pair that is predicted to come within a separation; times and distance as in its event, from now.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct PredictedPair {
    pub first: u64,
    pub second: u64,
    pub level: u32,
    /// Time of its event `predicted`.
    pub since: f64,
    pub likely_time: f64,
    pub closest_time: f64,
    pub closest_distance: f64,
}

impl PredictedPair {
    pub(crate) fn of(raw: &sys::ks_predicted_pair) -> PredictedPair {
        PredictedPair {
            first: raw.first,
            second: raw.second,
            level: raw.level,
            since: raw.since,
            likely_time: raw.likely_time,
            closest_time: raw.closest_time,
            closest_distance: raw.closest_distance,
        }
    }
}

/// A report of `track` is needed by the time `by` for its verdict with `other` to stay certain.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct ReportRequest {
    pub track: u64,
    pub other: u64,
    pub by: f64,
}

impl ReportRequest {
    pub(crate) fn of(raw: &sys::ks_report_request) -> ReportRequest {
        ReportRequest {
            track: raw.track,
            other: raw.other,
            by: raw.by,
        }
    }
}

/// Where a track is now: within `radius` of `centre`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackPlace {
    pub centre: Vec3,
    pub velocity: Vec3,
    pub radius: ErrorBound,
}

impl TrackPlace {
    pub(crate) fn of(raw: &sys::ks_track_place) -> TrackPlace {
        TrackPlace {
            centre: raw.centre,
            velocity: raw.velocity,
            radius: ErrorBound::of(&raw.radius),
        }
    }
}
