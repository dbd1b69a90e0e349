//! Definitions of static and rigid bodies, and shapes.
use crate::geometry::{Box3, RigidHull, RigidPart, Rotation, Shape, State, Vec3};
use crate::records::{BodyDefinition, Filter};
use crate::sys;
use std::mem::size_of;

impl Shape {
    pub(crate) fn raw(&self) -> sys::ks_shape {
        let zero = Vec3::default();
        let (kind, points, number) = match *self {
            Shape::Ball { centre, radius } => (sys::KS_SHAPE_BALL, [centre, zero, zero], radius),
            Shape::HalfSpace { normal, offset } => (sys::KS_SHAPE_HALF_SPACE, [normal, zero, zero], offset),
            Shape::Box(Box3 { lower, upper }) => (sys::KS_SHAPE_BOX, [lower, upper, zero], 0.0),
            Shape::Triangle(corners) => (sys::KS_SHAPE_TRIANGLE, corners, 0.0),
            Shape::Mesh(mesh) => (sys::KS_SHAPE_MESH, [zero; 3], f64::from_bits(mesh.value)),
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

impl From<State> for BodyDefinition {
    /// A body with the defaults in this state.
    fn from(state: State) -> BodyDefinition {
        BodyDefinition { position: state.position, velocity: state.velocity, ..Default::default() }
    }
}
