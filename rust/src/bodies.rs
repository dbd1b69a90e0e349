//! Definitions of bodies.
use crate::geometry::{Box3, RigidHull, RigidPart, Rotation, Shape, State, Vec3};
use crate::sys;
use std::mem::size_of;

/// Which contact events bodies ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contacts {
    /// A begin whenever two touch and approach, and no ends.
    Impacts = 1,
    /// One begin and one end for each contact.
    BeginAndEnd = 2,
    /// Begins, ends, and each further approach in between.
    All = 3,
}

impl Contacts {
    pub(crate) fn of(number: i32) -> Option<Contacts> {
        [Contacts::Impacts, Contacts::BeginAndEnd, Contacts::All]
            .into_iter()
            .find(|&contacts| contacts as i32 == number)
    }
}

/// Selects the bodies that a body may touch: the category of each must have a bit in the mask of the other, unless
/// both are in one group, which decides by its sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Filter {
    pub category: u64,
    pub mask: u64,
    pub group: i32,
}

impl Filter {
    pub(crate) fn raw(self) -> sys::ks_filter {
        sys::ks_filter { category: self.category, mask: self.mask, group: self.group }
    }
    fn of(raw: sys::ks_filter) -> Filter {
        Filter { category: raw.category, mask: raw.mask, group: raw.group }
    }
}

impl Default for Filter {
    fn default() -> Filter {
        Filter { category: 1, mask: u64::MAX, group: 0 }
    }
}

/// A sphere and the limits of its motion (`BodyDefinition` in C++).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyDefinition {
    /// >= 0 (length)
    pub radius: f64,
    /// >= 0 (length / time^2): the largest deviation from the planned acceleration.
    pub acceleration_limit: f64,
    /// Known acceleration, such as gravity (length / time^2).
    pub planned_acceleration: Vec3,
    /// >= 0 (length): how far reported positions are from the true ones at most.
    pub position_error: f64,
    /// >= 0 (length / time)
    pub velocity_error: f64,
    pub position: Vec3,
    pub velocity: Vec3,
    pub filter: Filter,
    /// False for a body that only senses and is sensed.
    pub solid: bool,
    /// Which contact events it asks for; nothing: those of the world.
    pub contacts: Option<Contacts>,
    pub sensor_class: u8,
    /// Stored for the caller.
    pub user_data: u64,
    /// >= 0, or infinity
    pub mass: f64,
}

impl BodyDefinition {
    fn of(raw: &sys::ks_body_definition) -> BodyDefinition {
        BodyDefinition {
            radius: raw.radius,
            acceleration_limit: raw.acceleration_limit,
            planned_acceleration: raw.planned_acceleration,
            position_error: raw.position_error,
            velocity_error: raw.velocity_error,
            position: raw.position,
            velocity: raw.velocity,
            filter: Filter::of(raw.filter),
            solid: raw.solid != 0,
            contacts: Contacts::of(raw.contacts),
            sensor_class: raw.sensor_class as u8,
            user_data: raw.user_data,
            mass: raw.mass,
        }
    }
    pub(crate) fn raw(&self) -> sys::ks_body_definition {
        sys::ks_body_definition {
            struct_size: size_of::<sys::ks_body_definition>() as u32,
            solid: self.solid as i32,
            contacts: self.contacts.map_or(0, |contacts| contacts as i32),
            sensor_class: self.sensor_class.into(),
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

/// The defaults of the library: radius 1, mass 1, at rest.
impl Default for BodyDefinition {
    fn default() -> BodyDefinition {
        let mut raw = sys::ks_body_definition::default();
        unsafe { sys::ks_body_definition_init(&mut raw, size_of::<sys::ks_body_definition>() as u32) };
        BodyDefinition::of(&raw)
    }
}

/// What a world knows of a body (`BodyView` in C++).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyView {
    pub enabled: bool,
    pub is_static: bool,
    pub sleeping: bool,
    pub report_time: f64,
    /// Contain the body from now until `bounds_end`.
    pub bounds: Box3,
    pub bounds_end: f64,
    /// Boxes that it has travelled along periodic axes.
    pub image: [i64; 3],
    /// Its state is that of the last report.
    pub definition: BodyDefinition,
}

impl BodyView {
    pub(crate) fn raw() -> sys::ks_body_view {
        sys::ks_body_view { struct_size: size_of::<sys::ks_body_view>() as u32, ..Default::default() }
    }
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

impl Shape {
    pub(crate) fn raw(&self) -> sys::ks_shape {
        let zero = Vec3::default();
        let (kind, points, number) = match *self {
            Shape::Ball { centre, radius } => (0, [centre, zero, zero], radius),
            Shape::HalfSpace { normal, offset } => (1, [normal, zero, zero], offset),
            Shape::Box(Box3 { lower, upper }) => (2, [lower, upper, zero], 0.0),
            Shape::Triangle(corners) => (3, corners, 0.0),
            Shape::Mesh(mesh) => (4, [zero; 3], f64::from_bits(mesh.value)),
        };
        sys::ks_shape { kind, points, number }
    }
}

/// A body that never moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StaticDefinition {
    pub shape: Shape,
    pub filter: Filter,
    pub solid: bool,
    pub sensor_class: u8,
    pub user_data: u64,
}

impl StaticDefinition {
    /// A solid body of this shape, that every body may touch.
    pub fn new(shape: Shape) -> StaticDefinition {
        StaticDefinition { shape, filter: Filter::default(), solid: true, sensor_class: 0, user_data: 0 }
    }
    pub(crate) fn raw(&self) -> sys::ks_static_definition {
        sys::ks_static_definition {
            struct_size: size_of::<sys::ks_static_definition>() as u32,
            solid: self.solid as i32,
            sensor_class: self.sensor_class.into(),
            shape: self.shape.raw(),
            filter: self.filter.raw(),
            user_data: self.user_data,
        }
    }
}

/// What a rigid body has beside its [`BodyDefinition`] (`RigidBody` in C++).
#[derive(Clone, Debug, PartialEq)]
pub struct RigidDefinition {
    /// Balls and capsules; at least one part or hull.
    pub parts: Vec<RigidPart>,
    /// Parts whose numbers follow those of `parts`.
    pub hulls: Vec<RigidHull>,
    /// At the world's current time.
    pub rotation: Rotation,
    /// >= 0 (radians / time^2). At 0 the body keeps its angular velocity, and the world knows its rotation.
    pub angular_acceleration_limit: f64,
    /// >= 0 (radians / time); finite if the limit above is not 0.
    pub largest_angular_speed: f64,
    /// Moments about the axes of the body, its principal ones (mass length^2). Contacts do not turn it about an axis
    /// with moment 0 or infinity.
    pub inertia: Vec3,
}

impl RigidDefinition {
    /// A body of these parts that does not turn.
    pub fn new(parts: Vec<RigidPart>) -> RigidDefinition {
        RigidDefinition {
            parts,
            hulls: vec![],
            rotation: Rotation::default(),
            angular_acceleration_limit: 0.0,
            largest_angular_speed: f64::INFINITY,
            inertia: Vec3::default(),
        }
    }
    /// The records of C of the hulls, which point to their points.
    pub(crate) fn raw_hulls(&self) -> Vec<sys::ks_rigid_hull> {
        let raw = |hull: &RigidHull| sys::ks_rigid_hull {
            point_count: hull.points.len(),
            points: hull.points.as_ptr(),
            radius: hull.radius,
        };
        self.hulls.iter().map(raw).collect()
    }
    /// The record of C, which points to the parts and the hulls.
    pub(crate) fn raw(&self, hulls: &[sys::ks_rigid_hull]) -> sys::ks_rigid_definition {
        sys::ks_rigid_definition {
            struct_size: size_of::<sys::ks_rigid_definition>() as u32,
            part_count: self.parts.len(),
            parts: self.parts.as_ptr(),
            rotation: self.rotation,
            angular_acceleration_limit: self.angular_acceleration_limit,
            largest_angular_speed: self.largest_angular_speed,
            inertia: self.inertia,
            hull_count: hulls.len(),
            hulls: hulls.as_ptr(),
        }
    }
}

/// Limits within which a body moves; fields as in [`BodyDefinition`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionLimits {
    pub acceleration_limit: f64,
    pub planned_acceleration: Vec3,
    pub position_error: f64,
    pub velocity_error: f64,
}

impl MotionLimits {
    pub(crate) fn raw(&self) -> sys::ks_motion_limits {
        sys::ks_motion_limits {
            acceleration_limit: self.acceleration_limit,
            position_error: self.position_error,
            velocity_error: self.velocity_error,
            planned_acceleration: self.planned_acceleration,
        }
    }
}

impl From<State> for BodyDefinition {
    /// A body with the defaults in this state.
    fn from(state: State) -> BodyDefinition {
        BodyDefinition { position: state.position, velocity: state.velocity, ..Default::default() }
    }
}
