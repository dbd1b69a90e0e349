//! Vectors, boxes, shapes and ids.
use crate::error::{check, Result};
use crate::sys;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// A vector of three numbers.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec3 {
    pub x: f64,
    pub y: f64,
    pub z: f64,
}

impl Vec3 {
    pub const fn new(x: f64, y: f64, z: f64) -> Vec3 {
        Vec3 { x, y, z }
    }
    pub fn dot(self, other: Vec3) -> f64 {
        self.x * other.x + self.y * other.y + self.z * other.z
    }
}

impl Add for Vec3 {
    type Output = Vec3;
    fn add(self, other: Vec3) -> Vec3 {
        Vec3::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}
impl AddAssign for Vec3 {
    fn add_assign(&mut self, other: Vec3) {
        *self = *self + other;
    }
}
impl Sub for Vec3 {
    type Output = Vec3;
    fn sub(self, other: Vec3) -> Vec3 {
        Vec3::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}
impl Neg for Vec3 {
    type Output = Vec3;
    fn neg(self) -> Vec3 {
        Vec3::new(-self.x, -self.y, -self.z)
    }
}
impl Mul<f64> for Vec3 {
    type Output = Vec3;
    fn mul(self, factor: f64) -> Vec3 {
        Vec3::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

/// Position (length) and velocity (length / time) at one time.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    pub position: Vec3,
    pub velocity: Vec3,
}

/// All points between two corners.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Box3 {
    pub lower: Vec3,
    pub upper: Vec3,
}

/// A sphere in which to look for bodies (length).
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sphere {
    pub centre: Vec3,
    pub radius: f64,
}

/// A ray or, with a radius > 0, the way of a sphere (length). `direction` may have any length > 0.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ray {
    pub origin: Vec3,
    pub direction: Vec3,
    pub length: f64,
    pub radius: f64,
}

/// Shape of a static body, a zone or a body that carries it. Bodies may be where `dot(normal, p) >= offset` of a
/// half-space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    Ball {
        centre: Vec3,
        radius: f64,
    },
    HalfSpace {
        normal: Vec3,
        offset: f64,
    },
    Box(Box3),
    Triangle([Vec3; 3]),
    /// Made by [`Mesh::shape`].
    Mesh(sys::ks_mesh),
}

/// A surface of triangles that is one shape (`Mesh` in C++): terrain, a level. What slides over its edges meets one
/// surface, and events name the triangle (`first_part`, `second_part`). Bodies that have it keep it when it is
/// dropped.
#[derive(Debug)]
pub struct Mesh {
    handle: sys::ks_mesh,
}

impl Mesh {
    /// One triangle for each three numbers of vertices. Errors: "out_of_range", "not_finite".
    pub fn new(vertices: &[Vec3], corners: &[[u32; 3]]) -> Result<Mesh> {
        let mut handle = sys::ks_mesh { value: 0 };
        check(unsafe {
            sys::ks_mesh_create(
                vertices.as_ptr(),
                vertices.len(),
                corners.as_ptr().cast(),
                corners.len(),
                &mut handle,
            )
        })?;
        Ok(Mesh { handle })
    }
    /// A chain of segments from each point to the next, for worlds of two dimensions.
    pub fn chain(points: &[Vec3]) -> Result<Mesh> {
        let mut handle = sys::ks_mesh { value: 0 };
        check(unsafe { sys::ks_mesh_create_chain(points.as_ptr(), points.len(), &mut handle) })?;
        Ok(Mesh { handle })
    }
    /// The shape, for as many bodies as you like. Calls refuse it once the mesh has been dropped.
    pub fn shape(&self) -> Shape {
        Shape::Mesh(self.handle)
    }
}

impl Drop for Mesh {
    fn drop(&mut self) {
        // It cannot fail: calls only read it.
        unsafe { sys::ks_mesh_destroy(self.handle) };
    }
}

/// A rotation as a unit quaternion w + x i + y j + z k.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quaternion {
    pub w: f64,
    pub x: f64,
    pub y: f64,
    pub z: f64,
}

/// No rotation.
impl Default for Quaternion {
    fn default() -> Quaternion {
        Quaternion { w: 1.0, x: 0.0, y: 0.0, z: 0.0 }
    }
}

/// Orientation and angular velocity of a rigid body at one instant.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rotation {
    /// Turns a vector of the body into one of the world.
    pub orientation: Quaternion,
    /// In the world's axes (radians / time).
    pub angular_velocity: Vec3,
}

/// A part of a rigid body: all points within `radius` of the segment from a to b, relative to the body's position. A
/// capsule, or a ball if a and b are equal.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidPart {
    pub a: Vec3,
    pub b: Vec3,
    /// >= 0 (length)
    pub radius: f64,
}

/// A part of a rigid body: all points within `radius` of the convex hull of 1 to 64 points, relative to the body's
/// position. Three points make a plate.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RigidHull {
    pub points: Vec<Vec3>,
    /// >= 0 (length). A body that bounces needs two contact tolerances.
    pub radius: f64,
}

impl RigidHull {
    /// All points within `radius` of a box.
    pub fn cuboid(bounds: Box3, radius: f64) -> RigidHull {
        let Box3 { lower, upper } = bounds;
        let side =
            |k: usize, axis: usize, lower: f64, upper: f64| if k >> axis & 1 == 0 { lower } else { upper };
        let corner = |k| Vec3 {
            x: side(k, 0, lower.x, upper.x),
            y: side(k, 1, lower.y, upper.y),
            z: side(k, 2, lower.z, upper.z),
        };
        RigidHull { points: (0..8).map(corner).collect(), radius }
    }
}

/// Names a body of a world until it is removed; a later body never has an equal id.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct BodyId {
    index: u32,
    generation: u32,
    world: u32,
}

impl BodyId {
    /// A small number, which no other body has meanwhile: for tables. It is used again after a removal.
    pub fn index(self) -> usize {
        self.index as usize
    }
    /// Returns nothing for the id that names no body.
    pub(crate) fn some(self) -> Option<BodyId> {
        if self == BodyId::default() {
            None
        } else {
            Some(self)
        }
    }
}

/// The id that names no body.
impl Default for BodyId {
    fn default() -> BodyId {
        BodyId { index: u32::MAX, generation: 0, world: 0 }
    }
}
impl PartialEq for BodyId {
    fn eq(&self, other: &BodyId) -> bool {
        (self.index, self.generation) == (other.index, other.generation)
    }
}
impl Eq for BodyId {}
impl Hash for BodyId {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (self.index, self.generation).hash(state);
    }
}
impl fmt::Debug for BodyId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "body {}", self.index)?;
        if self.generation != 0 {
            write!(f, " (generation {})", self.generation)?;
        }
        Ok(())
    }
}
