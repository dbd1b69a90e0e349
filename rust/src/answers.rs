//! Certified answers and queries at a world's current time.
use crate::error::{filled, Guarded, Result};
use crate::geometry::{BodyId, Box3, Ray, Sphere, State, Vec3};
use crate::records::{Filter, Hit, Prediction};
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
    /// [`World::overlapping`], for many spheres.
    pub fn overlapping_all(&self, spheres: &[Sphere], choice: &Choice) -> Result<Vec<Vec<Hit>>> {
        self.answers().overlapping_all(spheres, choice)
    }
    /// [`World::nearest`], for many points.
    pub fn nearest_all(&self, points: &[Vec3], bodies: usize, choice: &Choice) -> Result<Vec<Vec<Hit>>> {
        self.answers().nearest_all(points, bodies, choice)
    }
    /// [`World::cast`], for many rays.
    pub fn cast_all(&self, rays: &[Ray], choice: &Choice) -> Result<Vec<Vec<Hit>>> {
        self.answers().cast_all(rays, choice)
    }
}

/// Which bodies many queries look at. They pass through all others.
#[derive(Clone, Copy, Debug, Default)]
pub struct Choice<'a> {
    /// Those that a body with this filter may touch; without one, all.
    pub filter: Option<Filter>,
    /// Empty, or for each query the body that it leaves out.
    pub except: &'a [BodyId],
}

impl Choice<'_> {
    /// What C takes of it. Fails by the call's own words if there are not as many ids as queries.
    fn checked(&self, queries: usize, call: &str) -> (*const BodyId, Option<sys::ks_filter>) {
        assert!(
            self.except.is_empty() || self.except.len() == queries,
            "{call}: except must have an id for each of the {queries} queries, but has {}",
            self.except.len()
        );
        let except = if self.except.is_empty() { ptr::null() } else { self.except.as_ptr() };
        (except, self.filter.map(|filter| filter.raw()))
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

    pub fn overlapping_all(&mut self, spheres: &[Sphere], choice: &Choice) -> Result<Vec<Vec<Hit>>> {
        let (except, filter) = choice.checked(spheres.len(), "overlapping_all");
        let filter = filter.as_ref().map_or(ptr::null(), |filter| filter as *const _);
        self.find_all(spheres.len(), |world, probe, user, ends, hits, capacity, count| unsafe {
            let queries = spheres.as_ptr();
            sys::ks_world_overlapping_all(
                world, queries, except, spheres.len(), filter, probe, user, ends, hits, capacity, count,
            )
        })
    }
    pub fn nearest_all(&mut self, points: &[Vec3], bodies: usize, choice: &Choice) -> Result<Vec<Vec<Hit>>> {
        let (except, filter) = choice.checked(points.len(), "nearest_all");
        let filter = filter.as_ref().map_or(ptr::null(), |filter| filter as *const _);
        self.find_all(points.len(), |world, probe, user, ends, hits, capacity, count| unsafe {
            let queries = points.as_ptr();
            sys::ks_world_nearest_all(
                world, queries, except, points.len(), bodies, filter, probe, user, ends, hits, capacity, count,
            )
        })
    }
    pub fn cast_all(&mut self, rays: &[Ray], choice: &Choice) -> Result<Vec<Vec<Hit>>> {
        let (except, filter) = choice.checked(rays.len(), "cast_all");
        let filter = filter.as_ref().map_or(ptr::null(), |filter| filter as *const _);
        self.find_all(rays.len(), |world, probe, user, ends, hits, capacity, count| unsafe {
            let queries = rays.as_ptr();
            sys::ks_world_cast_all(
                world, queries, except, rays.len(), filter, probe, user, ends, hits, capacity, count,
            )
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
    /// Returns the hits of each query.
    fn find_all(
        &mut self,
        queries: usize,
        call: impl Fn(
            sys::ks_world,
            Option<sys::ks_probe>,
            *mut c_void,
            *mut usize,
            *mut sys::ks_hit,
            usize,
            *mut usize,
        ) -> sys::ks_status,
    ) -> Result<Vec<Vec<Hit>>> {
        let mut ends = vec![0; queries];
        let to = ends.as_mut_ptr();
        let found = self.find(|world, probe, user, hits, capacity, count| {
            call(world, probe, user, to, hits, capacity, count)
        })?;
        let mut begin = 0;
        let of_query = |end: usize| found[std::mem::replace(&mut begin, end)..end].to_vec();
        Ok(ends.into_iter().map(of_query).collect())
    }
}
