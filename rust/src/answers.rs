//! Certified answers and queries at a world's current time.
use crate::error::{filled, Guarded, Result};
use crate::geometry::{BodyId, Box3, State, Vec3};
use crate::records::{Hit, Prediction};
use crate::sys;
use crate::world::{probe_of, World};
use std::os::raw::c_void;
use std::ptr;

/// What a world answers: from what it knows, or, with a probe ([`World::answers_with`]), as well as fresh reports allow.
pub struct Answers<'a> {
    world: &'a World,
    probe: Option<Probe<'a>>,
}

type Probe<'a> = Box<dyn FnMut(&[BodyId], f64, &mut [State]) + 'a>;

impl World {
    /// The answers of fresh reports: the probe gives the states of the bodies that no motion moves.
    pub fn answers_with<'a>(&'a self, probe: impl FnMut(&[BodyId], f64, &mut [State]) + 'a) -> Answers<'a> {
        Answers { world: self, probe: Some(Box::new(probe)) }
    }
    fn answers(&self) -> Answers<'_> {
        Answers { world: self, probe: None }
    }

    /// No contact begins before this time, whatever the bodies do within their limits.
    pub fn safe_until(&self) -> Result<Prediction> {
        self.answers().safe_until()
    }
    /// The first possible contact of a body.
    pub fn earliest_contact(&self, body: BodyId) -> Result<Prediction> {
        self.answers().earliest_contact(body)
    }
    /// The first time at which anything may be within `distance` of a body.
    pub fn earliest_approach(&self, body: BodyId, distance: f64) -> Result<Prediction> {
        self.answers().earliest_approach(body, distance)
    }
    /// The first time at which two bodies may be within `distance` of each other.
    pub fn pair_safe_until(&self, first: BodyId, second: BodyId, distance: f64) -> Result<Prediction> {
        self.answers().pair_safe_until(first, second, distance)
    }
    /// A lower and an upper limit of the distance between two bodies at a time from now on.
    pub fn distance_limits(&self, first: BodyId, second: BodyId, time: f64) -> Result<(f64, f64)> {
        self.answers().distance_limits(first, second, time)
    }
    /// The bodies that may overlap a sphere.
    pub fn overlapping(&self, centre: Vec3, radius: f64) -> Result<Vec<Hit>> {
        self.answers().overlapping(centre, radius)
    }
    /// The bodies that may overlap a box.
    pub fn overlapping_box(&self, bounds: &Box3) -> Result<Vec<Hit>> {
        self.answers().overlapping_box(bounds)
    }
    /// All that may be among the `bodies` nearest to a point.
    pub fn nearest(&self, point: Vec3, bodies: usize) -> Result<Vec<Hit>> {
        self.answers().nearest(point, bodies)
    }
    /// All that a ray of this length, or with a radius > 0 a moving sphere, may hit first.
    pub fn cast(&self, origin: Vec3, direction: Vec3, length: f64, radius: f64) -> Result<Vec<Hit>> {
        self.answers().cast(origin, direction, length, radius)
    }
}

/// The methods of [`World`] with these names.
impl Answers<'_> {
    pub fn safe_until(&mut self) -> Result<Prediction> {
        self.predict(|world, probe, user, raw| unsafe { sys::ks_world_safe_until(world, probe, user, raw) })
    }
    pub fn earliest_contact(&mut self, body: BodyId) -> Result<Prediction> {
        self.predict(|world, probe, user, raw| unsafe {
            sys::ks_world_earliest_contact(world, body, probe, user, raw)
        })
    }
    pub fn earliest_approach(&mut self, body: BodyId, distance: f64) -> Result<Prediction> {
        self.predict(|world, probe, user, raw| unsafe {
            sys::ks_world_earliest_approach(world, body, distance, probe, user, raw)
        })
    }
    pub fn pair_safe_until(&mut self, first: BodyId, second: BodyId, distance: f64) -> Result<Prediction> {
        self.predict(|world, probe, user, raw| unsafe {
            sys::ks_world_pair_safe_until(world, first, second, distance, probe, user, raw)
        })
    }
    pub fn distance_limits(&mut self, first: BodyId, second: BodyId, time: f64) -> Result<(f64, f64)> {
        let (mut lower, mut upper) = (0.0, 0.0);
        let status = self.ask(|world, probe, user| unsafe {
            sys::ks_world_distance_limits(world, first, second, time, probe, user, &mut lower, &mut upper)
        });
        self.world.check(status)?;
        Ok((lower, upper))
    }

    pub fn overlapping(&mut self, centre: Vec3, radius: f64) -> Result<Vec<Hit>> {
        self.find(|world, probe, user, found, capacity, count| unsafe {
            sys::ks_world_overlapping_sphere(world, centre, radius, probe, user, found, capacity, count)
        })
    }
    pub fn overlapping_box(&mut self, bounds: &Box3) -> Result<Vec<Hit>> {
        self.find(|world, probe, user, found, capacity, count| unsafe {
            sys::ks_world_overlapping_box(world, bounds, probe, user, found, capacity, count)
        })
    }
    pub fn nearest(&mut self, point: Vec3, bodies: usize) -> Result<Vec<Hit>> {
        self.find(|world, probe, user, found, capacity, count| unsafe {
            sys::ks_world_nearest(world, point, bodies, probe, user, found, capacity, count)
        })
    }
    pub fn cast(&mut self, origin: Vec3, direction: Vec3, length: f64, radius: f64) -> Result<Vec<Hit>> {
        self.find(|world, probe, user, hits, capacity, count| unsafe {
            sys::ks_world_cast(world, origin, direction, length, radius, probe, user, hits, capacity, count)
        })
    }

    /// Makes a call with the probe of C, if there is one.
    fn ask(
        &mut self,
        call: impl FnOnce(sys::ks_world, Option<sys::ks_probe>, *mut c_void) -> sys::ks_status,
    ) -> sys::ks_status {
        let function = match &mut self.probe {
            Some(function) => function,
            None => return call(self.world.handle, None, ptr::null_mut()),
        };
        let mut guarded = Guarded::new(function);
        let probe = probe_of(&guarded);
        let status = call(self.world.handle, Some(probe), guarded.user());
        guarded.resume();
        status
    }
    fn predict(
        &mut self,
        call: impl FnOnce(
            sys::ks_world,
            Option<sys::ks_probe>,
            *mut c_void,
            *mut sys::ks_prediction,
        ) -> sys::ks_status,
    ) -> Result<Prediction> {
        let mut raw = sys::ks_prediction::default();
        let status = self.ask(|world, probe, user| call(world, probe, user, &mut raw));
        self.world.check(status)?;
        Ok(Prediction::of(&raw))
    }
    fn find(
        &mut self,
        call: impl Fn(
            sys::ks_world,
            Option<sys::ks_probe>,
            *mut c_void,
            *mut sys::ks_hit,
            usize,
            *mut usize,
        ) -> sys::ks_status,
    ) -> Result<Vec<Hit>> {
        let world = self.world;
        let found: Vec<sys::ks_hit> = filled(|hits, capacity, count| {
            let status = self.ask(|world, probe, user| call(world, probe, user, hits, capacity, count));
            world.resume();
            status
        })?;
        Ok(found.iter().map(Hit::of).collect())
    }
}
