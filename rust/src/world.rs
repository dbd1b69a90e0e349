//! Worlds.
use crate::bodies::{RigidDefinition, StaticDefinition};
use crate::error::{check, filled, Guarded, Result};
use crate::events::Response;
use crate::geometry::{BodyId, Mesh, Rotation, Shape, State, Vec3};
use crate::records::{BodyAction, BodyDefinition, BodyView, Event, Filter, MotionLimits, WorldDefinition};
use crate::sys;
use std::mem::size_of;
use std::os::raw::c_void;
use std::ptr;
use std::slice;
use std::sync::Arc;

/// Bodies that the library moves: states at the world's current time, and what moves them.
#[derive(Clone, Copy, Debug)]
pub enum Motion<'a> {
    /// Free flight.
    Ballistic { gravity: Vec3 },
    /// Random accelerations up to a limit for each body, new at multiples of the interval.
    RandomForces { acceleration_limits: &'a [f64], interval: f64, seed: u64 },
    /// A game's frames: straight from the position in one to that in the next. `interval` is the time between frames
    /// without times of their own. There is a limit for each body, or, if there are none, all velocities are news at
    /// each frame.
    Frames { interval: f64, position_error: f64, acceleration_limits: &'a [f64] },
    /// Each body keeps its acceleration, at first zero, until [`World::steer`], within a limit for each body.
    Steered { acceleration_limits: &'a [f64] },
}

impl Motion<'_> {
    /// The record of C, which points to the arguments.
    fn raw(
        &self,
        states: &[State],
        radii: &[f64],
        masses: &[f64],
        like: &sys::ks_body_definition,
    ) -> sys::ks_motion_definition {
        let mut raw = sys::ks_motion_definition {
            struct_size: size_of::<sys::ks_motion_definition>() as u32,
            kind: sys::KS_MOTION_BALLISTIC,
            count: states.len(),
            states: states.as_ptr(),
            radii: optional(radii, states),
            masses: optional(masses, states),
            acceleration_limits: ptr::null(),
            gravity: Vec3::default(),
            interval: 0.0,
            position_error: 0.0,
            seed: 0,
            like,
        };
        match *self {
            Motion::Ballistic { gravity } => raw.gravity = gravity,
            Motion::RandomForces { acceleration_limits, interval, seed } => {
                assert_eq!(acceleration_limits.len(), states.len(), "one limit for each state");
                raw.kind = sys::KS_MOTION_RANDOM_FORCES;
                raw.acceleration_limits = acceleration_limits.as_ptr();
                raw.interval = interval;
                raw.seed = seed;
            }
            Motion::Steered { acceleration_limits } => {
                assert_eq!(acceleration_limits.len(), states.len(), "one limit for each state");
                raw.kind = sys::KS_MOTION_STEERED;
                raw.acceleration_limits = acceleration_limits.as_ptr();
            }
            Motion::Frames { interval, position_error, acceleration_limits } => {
                raw.kind = sys::KS_MOTION_FRAMES;
                raw.acceleration_limits = optional(acceleration_limits, states);
                raw.interval = interval;
                raw.position_error = position_error;
            }
        }
        raw
    }
}

/// How `World::run` answers events.
pub enum Run<'a> {
    /// Bodies pass through each other.
    PassThrough,
    Bounce {
        restitution: f64,
    },
    Settle {
        restitution: f64,
        resting_speed: f64,
    },
    /// The same answer for the same event. It is asked at every event, at ends too: look at `Event::kind` first, as
    /// velocities that are exchanged at each end turn the two back to each other, for ever.
    Respond(&'a (dyn Fn(&Event) -> Response + Sync)),
}

pub(crate) type GameFunction = Box<dyn Fn(&Event) -> Response + Send + Sync>;
pub(crate) type PairFilter = Box<dyn Fn(BodyId, BodyId) -> bool + Send + Sync>;
type RotationProbe = Box<dyn Fn(&[BodyId], f64, &mut [Rotation]) + Send + Sync>;

/// A world of moving spheres. Methods have the meanings, errors and costs of those of `World` in C++.
pub struct World {
    pub(crate) handle: sys::ks_world,
    /// Keep alive what the library has a pointer to; clones share them.
    pub(crate) filter: Option<Arc<Guarded<PairFilter>>>,
    rotations: Option<Arc<Guarded<RotationProbe>>>,
    /// Of a game.
    pub(crate) respond: Option<Arc<Guarded<GameFunction>>>,
}

impl Drop for World {
    fn drop(&mut self) {
        // It fails only if the function that `run` lent the world replaced it: the run still needs it, and may still
        // call what it has a pointer to.
        if unsafe { sys::ks_world_destroy(self.handle) } != 0 {
            std::mem::forget((self.filter.take(), self.rotations.take(), self.respond.take()));
        }
    }
}

unsafe extern "C" fn probe<F: FnMut(&[BodyId], f64, &mut [State])>(
    bodies: *const BodyId,
    count: usize,
    time: f64,
    states: *mut State,
    user: *mut c_void,
) -> i32 {
    Guarded::<F>::call(user, |function| {
        function(slice::from_raw_parts(bodies, count), time, slice::from_raw_parts_mut(states, count))
    })
}

pub(crate) unsafe extern "C" fn respond<F: Fn(&Event) -> Response + Sync>(
    event: *const sys::ks_event,
    response: *mut sys::ks_response,
    user: *mut c_void,
) -> i32 {
    Guarded::<F>::call_shared(user, |function| {
        if let Some(event) = Event::of(&*event) {
            *response = function(&event).raw();
        }
    })
}

unsafe extern "C" fn sink<F: FnMut(&Event)>(event: *const sys::ks_event, user: *mut c_void) -> i32 {
    Guarded::<F>::call(user, |function| {
        if let Some(event) = Event::of(&*event) {
            function(&event)
        }
    })
}

pub(crate) unsafe extern "C" fn pair_filter(first: BodyId, second: BodyId, user: *mut c_void) -> i32 {
    let mut passes = true;
    Guarded::<PairFilter>::call_shared(user, |filter| passes = filter(first, second));
    passes as i32
}

unsafe extern "C" fn rotation_probe(
    bodies: *const BodyId,
    count: usize,
    time: f64,
    rotations: *mut Rotation,
    user: *mut c_void,
) -> i32 {
    Guarded::<RotationProbe>::call_shared(user, |function| {
        let bodies = slice::from_raw_parts(bodies, count);
        function(bodies, time, slice::from_raw_parts_mut(rotations, count))
    })
}

impl World {
    pub(crate) fn of(handle: sys::ks_world) -> World {
        World { handle, filter: None, rotations: None, respond: None }
    }
    /// The handle of C, for calls of [`crate::sys`]; the world still owns it.
    pub fn handle(&self) -> sys::ks_world {
        self.handle
    }

    /// Returns the error of a call that has just failed in this thread, or continues the panic of a closure that the
    /// world keeps.
    pub(crate) fn check(&self, status: sys::ks_status) -> Result<()> {
        self.resume();
        check(status)
    }
    /// Continues the panic of a closure that the world keeps, if there was one in the last call.
    pub(crate) fn resume(&self) {
        if let Some(filter) = &self.filter {
            filter.resume();
        }
        if let Some(rotations) = &self.rotations {
            rotations.resume();
        }
        if let Some(respond) = &self.respond {
            respond.resume();
        }
    }

    pub fn new(definition: &WorldDefinition) -> Result<World> {
        let mut handle = sys::ks_world { value: 0 };
        check(unsafe { sys::ks_world_create(&definition.raw(), &mut handle) })?;
        Ok(World::of(handle))
    }

    /// Returns a copy that continues as this world does, with its motions and ids: for rollback.
    pub fn try_clone(&self) -> Result<World> {
        let mut handle = sys::ks_world { value: 0 };
        check(unsafe { sys::ks_world_clone(self.handle, &mut handle) })?;
        let (filter, rotations) = (self.filter.clone(), self.rotations.clone());
        Ok(World { handle, filter, rotations, respond: self.respond.clone() })
    }

    /// Returns a snapshot, without motions and pair filter.
    pub fn save(&self) -> Result<Vec<u8>> {
        filled(|bytes, capacity, count| unsafe { sys::ks_world_save(self.handle, bytes, capacity, count) })
    }

    /// Returns the world of a snapshot of a world without a pair filter.
    pub fn restore(snapshot: &[u8]) -> Result<World> {
        let mut handle = sys::ks_world { value: 0 };
        check(unsafe {
            sys::ks_world_restore(snapshot.as_ptr(), snapshot.len(), None, ptr::null_mut(), &mut handle)
        })?;
        Ok(World::of(handle))
    }
    /// Returns the world of a snapshot of a world that had this pair filter, which clones share.
    pub fn restore_with_pair_filter(
        snapshot: &[u8],
        filter: impl Fn(BodyId, BodyId) -> bool + Send + Sync + 'static,
    ) -> Result<World> {
        let filter: Arc<Guarded<PairFilter>> = Arc::new(Guarded::new(Box::new(filter)));
        let user = Arc::as_ptr(&filter) as *mut c_void;
        let mut handle = sys::ks_world { value: 0 };
        check(unsafe {
            sys::ks_world_restore(snapshot.as_ptr(), snapshot.len(), Some(pair_filter), user, &mut handle)
        })?;
        Ok(World { handle, filter: Some(filter), rotations: None, respond: None })
    }

    pub fn add(&mut self, body: &BodyDefinition) -> Result<BodyId> {
        let mut id = BodyId::default();
        self.check(unsafe { sys::ks_world_add(self.handle, &body.raw(), 1, &mut id) })?;
        Ok(id)
    }

    /// Adds all bodies or, on an error, none.
    pub fn add_all(&mut self, bodies: &[BodyDefinition]) -> Result<Vec<BodyId>> {
        let raw: Vec<_> = bodies.iter().map(BodyDefinition::raw).collect();
        let mut ids = vec![BodyId::default(); raw.len()];
        self.check(unsafe { sys::ks_world_add(self.handle, raw.as_ptr(), raw.len(), ids.as_mut_ptr()) })?;
        Ok(ids)
    }

    pub fn add_static(&mut self, body: &StaticDefinition) -> Result<BodyId> {
        let mut id = BodyId::default();
        self.check(unsafe { sys::ks_world_add_static(self.handle, &body.raw(), 1, &mut id) })?;
        Ok(id)
    }

    /// Adds a surface of triangles as one body that never moves: `add_static` of the shape of a [`Mesh`].
    pub fn add_mesh(&mut self, vertices: &[Vec3], corners: &[[u32; 3]]) -> Result<BodyId> {
        let mesh = Mesh::new(vertices, corners)?;
        self.add_static(&StaticDefinition::new(mesh.shape()))
    }

    /// Adds a body that carries a box, a triangle or a mesh, relative to its position; the radius is ignored. The probe moves
    /// it. It meets all bodies, static ones and other moving shapes too, but no walls of the world. An infinite mass makes a
    /// body that no contact turns.
    pub fn add_moving_shape(&mut self, body: &BodyDefinition, shape: &Shape) -> Result<BodyId> {
        let mut id = BodyId::default();
        self.check(unsafe {
            sys::ks_world_add_moving_shape(self.handle, &body.raw(), &shape.raw(), &mut id)
        })?;
        Ok(id)
    }

    /// Adds a rigid body: parts that move and turn together; the radius is ignored. The probe moves it.
    pub fn add_rigid_body(&mut self, body: &BodyDefinition, rigid: &RigidDefinition) -> Result<BodyId> {
        let mut id = BodyId::default();
        let (hulls, body) = (rigid.raw_hulls(), body.raw());
        self.check(unsafe { sys::ks_world_add_rigid_body(self.handle, &body, &rigid.raw(&hulls), &mut id) })?;
        Ok(id)
    }

    /// Adds a zone, which reports who enters and leaves it.
    pub fn add_zone(&mut self, shape: &Shape, user_data: u64) -> Result<BodyId> {
        let mut id = BodyId::default();
        self.check(unsafe { sys::ks_world_add_zone(self.handle, &shape.raw(), user_data, &mut id) })?;
        Ok(id)
    }

    /// Makes room for this number of bodies in total.
    pub fn reserve(&mut self, bodies: usize) -> Result<()> {
        self.check(unsafe { sys::ks_world_reserve(self.handle, bodies) })
    }

    pub fn remove(&mut self, body: BodyId) -> Result<()> {
        self.remove_all(&[body])
    }
    /// Removes all bodies or, on an error, none.
    pub fn remove_all(&mut self, bodies: &[BodyId]) -> Result<()> {
        self.check(unsafe { sys::ks_world_remove(self.handle, bodies.as_ptr(), bodies.len()) })
    }

    /// Informs the world, and the motion of the body if it has one, of a new velocity from now on.
    pub fn set_velocity(&mut self, body: BodyId, velocity: Vec3) -> Result<()> {
        self.check(unsafe { sys::ks_world_set_velocity(self.handle, body, velocity) })
    }

    /// Sets the velocities of all these bodies or, on an error, of none.
    ///
    /// # Panics
    /// If the lengths differ.
    pub fn set_velocities(&mut self, bodies: &[BodyId], velocities: &[Vec3]) -> Result<()> {
        assert_eq!(bodies.len(), velocities.len(), "one velocity for each body");
        self.check(unsafe {
            sys::ks_world_set_velocities(self.handle, bodies.as_ptr(), velocities.as_ptr(), bodies.len())
        })
    }

    /// Informs the world that a rigid body turns with this angular velocity (radians / time) from now on.
    pub fn set_angular_velocity(&mut self, body: BodyId, angular_velocity: Vec3) -> Result<()> {
        self.check(unsafe { sys::ks_world_set_angular_velocity(self.handle, body, angular_velocity) })
    }
    /// Turns a rigid body at once, as `teleport` moves it.
    pub fn set_rotation(&mut self, body: BodyId, rotation: Rotation) -> Result<()> {
        self.check(unsafe { sys::ks_world_set_rotation(self.handle, body, &rotation) })
    }
    /// The rotation of a rigid body at its last report.
    pub fn rotation(&self, body: BodyId) -> Result<Rotation> {
        let mut rotation = Rotation::default();
        self.check(unsafe { sys::ks_world_rotation(self.handle, body, &mut rotation) })?;
        Ok(rotation)
    }
    /// Sets the function that gives the rotations of rigid bodies, directly after the probe; clones share it.
    pub fn set_rotation_probe(
        &mut self,
        probe: impl Fn(&[BodyId], f64, &mut [Rotation]) + Send + Sync + 'static,
    ) -> Result<()> {
        let probe: Arc<Guarded<RotationProbe>> = Arc::new(Guarded::new(Box::new(probe)));
        let user = Arc::as_ptr(&probe) as *mut c_void;
        self.check(unsafe { sys::ks_world_set_rotation_probe(self.handle, Some(rotation_probe), user) })?;
        self.rotations = Some(probe);
        Ok(())
    }

    /// Does what a response to this event says, but for `stop`: between two events the world always stands still.
    pub fn apply(&mut self, event: &Event, response: Response) -> Result<()> {
        if let Some(velocity) = response.first {
            self.set_velocity(event.first, velocity)?;
        }
        if let (Some(body), Some(velocity)) = (event.second, response.second) {
            self.set_velocity(body, velocity)?;
        }
        if let Some(spin) = response.first_angular_velocity {
            self.set_angular_velocity(event.first, spin)?;
        }
        if let (Some(body), Some(spin)) = (event.second, response.second_angular_velocity) {
            self.set_angular_velocity(body, spin)?;
        }
        if response.turned_back {
            self.turn_back(event)?;
        }
        if let (Some(second), Some(state)) = (event.second, response.pair_state) {
            self.set_pair_state(event.first, second, state)?;
        }
        self.act(event.first, response.first_action)?;
        event.second.map_or(Ok(()), |body| self.act(body, response.second_action))
    }
    fn act(&mut self, body: BodyId, action: BodyAction) -> Result<()> {
        match action {
            BodyAction::None => Ok(()),
            BodyAction::Remove => self.remove(body),
            BodyAction::Disable => self.disable(body),
            BodyAction::Sleep => {
                self.set_velocity(body, Vec3::default())?;
                self.sleep(body)
            }
        }
    }

    pub fn teleport(&mut self, body: BodyId, state: State) -> Result<()> {
        self.check(unsafe { sys::ks_world_teleport(self.handle, body, &state) })
    }
    pub fn set_radius(&mut self, body: BodyId, radius: f64) -> Result<()> {
        self.check(unsafe { sys::ks_world_set_radius(self.handle, body, radius) })
    }
    /// Lets the radius of a ball change at this rate (length / time) from the current time on; negative for one
    /// that shrinks, which stays a point once it is one.
    pub fn set_radius_rate(&mut self, body: BodyId, rate: f64) -> Result<()> {
        self.check(unsafe { sys::ks_world_set_radius_rate(self.handle, body, rate) })
    }
    pub fn set_mass(&mut self, body: BodyId, mass: f64) -> Result<()> {
        self.check(unsafe { sys::ks_world_set_mass(self.handle, body, mass) })
    }
    pub fn set_motion_limits(&mut self, body: BodyId, limits: &MotionLimits) -> Result<()> {
        self.check(unsafe { sys::ks_world_set_motion_limits(self.handle, body, &limits.raw()) })
    }
    pub fn set_shape(&mut self, body: BodyId, shape: &Shape) -> Result<()> {
        self.check(unsafe { sys::ks_world_set_shape(self.handle, body, &shape.raw()) })
    }
    pub fn disable(&mut self, body: BodyId) -> Result<()> {
        self.check(unsafe { sys::ks_world_disable(self.handle, body) })
    }
    pub fn enable(&mut self, body: BodyId, state: State) -> Result<()> {
        self.check(unsafe { sys::ks_world_enable(self.handle, body, &state) })
    }
    pub fn sleep(&mut self, body: BodyId) -> Result<()> {
        self.check(unsafe { sys::ks_world_sleep(self.handle, body) })
    }
    pub fn wake(&mut self, body: BodyId) -> Result<()> {
        self.check(unsafe { sys::ks_world_wake(self.handle, body) })
    }

    pub fn set_filter(&mut self, body: BodyId, filter: Filter) -> Result<()> {
        self.check(unsafe { sys::ks_world_set_filter(self.handle, body, &filter.raw()) })
    }
    /// Sets a symmetric predicate for pairs whose filters let them touch; clones share it. Its answers must stay the
    /// same until `refresh_filter`. A panic in it passes through the call that asked, which has gone on as if the two
    /// might touch.
    pub fn set_pair_filter(
        &mut self,
        filter: impl Fn(BodyId, BodyId) -> bool + Send + Sync + 'static,
    ) -> Result<()> {
        let filter: Arc<Guarded<PairFilter>> = Arc::new(Guarded::new(Box::new(filter)));
        let user = Arc::as_ptr(&filter) as *mut c_void;
        self.check(unsafe { sys::ks_world_set_pair_filter(self.handle, Some(pair_filter), user) })?;
        self.filter = Some(filter);
        Ok(())
    }
    /// Asks the pair filter again about all pairs of a body.
    pub fn refresh_filter(&mut self, body: BodyId) -> Result<()> {
        self.check(unsafe { sys::ks_world_refresh_filter(self.handle, body) })
    }
    pub fn set_solid(&mut self, body: BodyId, solid: bool) -> Result<()> {
        self.check(unsafe { sys::ks_world_set_solid(self.handle, body, solid as i32) })
    }
    /// Stores a number for the caller: events have it.
    pub fn set_user_data(&mut self, body: BodyId, data: u64) -> Result<()> {
        self.check(unsafe { sys::ks_world_set_user_data(self.handle, body, data) })
    }
    /// Sets the distances at which bodies of a class sense bodies with a category in the mask.
    pub fn set_sensor(&mut self, sensor_class: u8, distances: &[f64], mask: u64) -> Result<()> {
        self.check(unsafe {
            sys::ks_world_set_sensor(
                self.handle,
                sensor_class.into(),
                distances.as_ptr(),
                distances.len(),
                mask,
            )
        })
    }
    pub fn set_sensor_class(&mut self, body: BodyId, sensor_class: u8) -> Result<()> {
        self.check(unsafe { sys::ks_world_set_sensor_class(self.handle, body, sensor_class.into()) })
    }

    /// Gives two bodies a state, a number of the caller's own that their events have, until it is set to 0 or one of
    /// the two is removed.
    pub fn set_pair_state(&mut self, first: BodyId, second: BodyId, state: i32) -> Result<()> {
        self.check(unsafe { sys::ks_world_set_pair_state(self.handle, first, second, state) })
    }
    pub fn pair_state(&self, first: BodyId, second: BodyId) -> Result<i32> {
        let mut state = 0;
        self.check(unsafe { sys::ks_world_pair_state(self.handle, first, second, &mut state) })?;
        Ok(state)
    }
    /// To be called at a `SensorEnter` or `SensorLeave`: velocities of the caller have turned the two back there, so
    /// they have not crossed the distance. The event comes again if they do.
    pub fn turn_back(&mut self, crossing: &Event) -> Result<()> {
        self.check(unsafe { sys::ks_world_turn_back(self.handle, crossing.raw()) })
    }
    /// Schedules an event `Timer` at a time that has not passed, and, if the period is not 0, again after each period.
    pub fn schedule(&mut self, time: f64, user_data: u64, period: f64) -> Result<()> {
        self.check(unsafe { sys::ks_world_schedule(self.handle, time, user_data, period) })
    }
    /// Removes all timers with these data. Returns how many there were.
    pub fn unschedule(&mut self, user_data: u64) -> Result<usize> {
        let mut count = 0;
        self.check(unsafe { sys::ks_world_unschedule(self.handle, user_data, &mut count) })?;
        Ok(count)
    }

    pub fn time(&self) -> f64 {
        let mut time = 0.0;
        unsafe { sys::ks_world_time(self.handle, &mut time) };
        time
    }
    /// The number of bodies.
    pub fn len(&self) -> usize {
        let mut bodies = 0;
        unsafe { sys::ks_world_size(self.handle, &mut bodies) };
        bodies
    }
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
    pub fn contains(&self, body: BodyId) -> bool {
        let mut contains = 0;
        unsafe { sys::ks_world_contains(self.handle, body, &mut contains) };
        contains != 0
    }
    pub fn bodies(&self) -> Result<Vec<BodyId>> {
        filled(|bodies, capacity, count| unsafe {
            sys::ks_world_bodies(self.handle, bodies, capacity, count)
        })
    }
    /// What the world knows of a body.
    pub fn body(&self, body: BodyId) -> Result<BodyView> {
        let mut raw = sys::ks_body_view::new();
        self.check(unsafe { sys::ks_world_body(self.handle, body, &mut raw) })?;
        Ok(BodyView::of(&raw))
    }
    /// The number of states that the world has asked for so far.
    pub fn probe_count(&self) -> u64 {
        let mut probes = 0;
        unsafe { sys::ks_world_probe_count(self.handle, &mut probes) };
        probes
    }
    /// The bodies in contact with a body.
    pub fn touching(&self, body: BodyId) -> Result<Vec<BodyId>> {
        filled(|partners, capacity, count| unsafe {
            sys::ks_world_touching(self.handle, body, partners, capacity, count)
        })
    }
    /// The bodies within sensor distances of a body, with these distances.
    pub fn sensor_overlaps(&self, body: BodyId) -> Result<Vec<(BodyId, f64)>> {
        let found: Vec<sys::ks_sensor_overlap> = filled(|overlaps, capacity, count| unsafe {
            sys::ks_world_sensor_overlaps(self.handle, body, overlaps, capacity, count)
        })?;
        Ok(found.iter().map(|overlap| (overlap.body, overlap.distance)).collect())
    }

    /// Advances to the next event, at most to time `until`: returns the event, with the world at its time, or
    /// nothing, with the world at `until`. The probe sets the states of the bodies that no motion moves.
    pub fn advance<F>(&mut self, until: f64, probe: F) -> Result<Option<Event>>
    where
        F: FnMut(&[BodyId], f64, &mut [State]),
    {
        let mut event = sys::ks_event::new();
        self.with_probe(probe, |probe, user| unsafe {
            sys::ks_world_advance(self.handle, until, probe, user, &mut event)
        })?;
        Ok(Event::of(&event))
    }

    /// Like `advance`, for a world whose bodies are all moved by motions.
    pub fn advance_motions(&mut self, until: f64) -> Result<Option<Event>> {
        let mut event = sys::ks_event::new();
        self.check(unsafe {
            let probe: sys::ks_probe = sys::ks_probe_motions;
            sys::ks_world_advance(self.handle, until, Some(probe), ptr::null_mut(), &mut event)
        })?;
        Ok(Event::of(&event))
    }

    /// Advances to time `until` and answers all events; `on_event` receives each, in order, with this world to read.
    /// At an event whose response has [`Response::stop`] the world is at the time of the event, and `on_event` may
    /// change it: add and remove bodies, teleport them. Elsewhere such calls fail with `run_in_progress`, as `advance`
    /// and `run` always do. Motions must move all bodies; one that a response removes leaves its motion, too. The
    /// outcome is the same, bit for bit, for any number of threads.
    pub fn run<F: FnMut(&mut World, &Event)>(
        &mut self,
        until: f64,
        how: Run,
        threads: i32,
        mut on_event: F,
    ) -> Result<()> {
        let handle = self.handle;
        let world: *mut World = self;
        let function: &(dyn Fn(&Event) -> Response + Sync) = match how {
            Run::Respond(function) => function,
            _ => &|_| Response::default(),
        };
        let mut responses = Guarded::new(function);
        // Until C returns, no one uses `self` but this function.
        let mut events = Guarded::new(|event: &Event| on_event(unsafe { &mut *world }, event));
        let (restitution, resting_speed) = match how {
            Run::Bounce { restitution } => (restitution, 0.0),
            Run::Settle { restitution, resting_speed } => (restitution, resting_speed),
            Run::PassThrough | Run::Respond(_) => (f64::NAN, 0.0),
        };
        let definition = sys::ks_run_definition {
            struct_size: size_of::<sys::ks_run_definition>() as u32,
            threads,
            restitution,
            resting_speed,
            respond: match how {
                Run::Respond(_) => Some(respond_of(function)),
                _ => None,
            },
            respond_user: responses.user(),
            sink: Some(sink_of(&events)),
            sink_user: events.user(),
        };
        let status = unsafe { sys::ks_world_run(handle, until, &definition) };
        responses.resume();
        events.resume();
        self.check(status)
    }

    /// From now on, so many threads, from 1 to 256 with the calling one, share what a call does for thousands of bodies
    /// at one time, as where all velocities change; 1, as at first: the calling thread alone. They call no function of
    /// yours, and the outcome is the same, bit for bit. Clones and restored worlds begin with 1.
    pub fn use_threads(&mut self, threads: i32) -> Result<()> {
        self.check(unsafe { sys::ks_world_use_threads(self.handle, threads) })
    }

    /// Adds bodies that the library moves; their other properties are those of `like`. `radii` and `masses` are empty
    /// or have one entry for each state. Returns the number of the motion in this world, and the ids.
    ///
    /// # Panics
    /// If the lengths differ.
    pub fn add_motion(
        &mut self,
        motion: Motion,
        states: &[State],
        radii: &[f64],
        masses: &[f64],
        like: &BodyDefinition,
    ) -> Result<(u32, Vec<BodyId>)> {
        let like = like.raw();
        let raw = motion.raw(states, radii, masses, &like);
        let mut number = 0;
        let mut ids = vec![BodyId::default(); states.len()];
        self.check(unsafe { sys::ks_world_add_motion(self.handle, &raw, &mut number, ids.as_mut_ptr()) })?;
        Ok((number, ids))
    }

    /// Adds more bodies, such as bullets, to a motion of this number; of `motion` only acceleration limits count.
    /// Returns their numbers in the motion, which are their indices in frames, and their ids.
    ///
    /// # Panics
    /// As `add_motion`.
    pub fn add_to_motion(
        &mut self,
        number: u32,
        motion: Motion,
        states: &[State],
        like: &BodyDefinition,
    ) -> Result<(Vec<u32>, Vec<BodyId>)> {
        let like = like.raw();
        let raw = motion.raw(states, &[], &[], &like);
        let mut numbers = vec![0; states.len()];
        let mut ids = vec![BodyId::default(); states.len()];
        self.check(unsafe {
            sys::ks_world_add_to_motion(self.handle, number, &raw, numbers.as_mut_ptr(), ids.as_mut_ptr())
        })?;
        Ok((numbers, ids))
    }

    /// Sets the acceleration of a body of [`Motion::Steered`], within its limit, from now on.
    pub fn steer(&mut self, body: BodyId, acceleration: Vec3) -> Result<()> {
        self.check(unsafe { sys::ks_world_steer(self.handle, body, acceleration) })
    }

    /// Appends the next frame of a motion of frames, its interval after the one before, and returns its time, to which
    /// to advance then. A game whose frames differ in length needs [`World::push_frame_at`].
    pub fn push_frame(&mut self, motion: u32, positions: &[Vec3]) -> Result<f64> {
        self.check(unsafe {
            sys::ks_world_push_frame(self.handle, motion, positions.as_ptr(), positions.len())
        })?;
        let mut time = 0.0;
        self.check(unsafe { sys::ks_world_latest_frame_time(self.handle, motion, &mut time) })?;
        Ok(time)
    }

    /// Appends the next frame of a motion of frames, at a time after that of the latest frame.
    pub fn push_frame_at(&mut self, motion: u32, positions: &[Vec3], time: f64) -> Result<()> {
        self.check(unsafe {
            sys::ks_world_push_frame_at(self.handle, motion, positions.as_ptr(), positions.len(), time)
        })
    }

    /// The positions in the latest frame, with the changes that events made.
    pub fn latest_frame(&self, motion: u32) -> Result<Vec<Vec3>> {
        filled(|positions, capacity, count| unsafe {
            sys::ks_world_latest_frame(self.handle, motion, positions, capacity, count)
        })
    }

    /// The true states at a time of bodies that motions move.
    pub fn states(&self, bodies: &[BodyId], time: f64) -> Result<Vec<State>> {
        let mut states = vec![State::default(); bodies.len()];
        self.check(unsafe {
            sys::ks_world_states(self.handle, bodies.as_ptr(), bodies.len(), time, states.as_mut_ptr())
        })?;
        Ok(states)
    }

    fn with_probe<F: FnMut(&[BodyId], f64, &mut [State])>(
        &self,
        function: F,
        call: impl FnOnce(Option<sys::ks_probe>, *mut c_void) -> sys::ks_status,
    ) -> Result<()> {
        let mut guarded = Guarded::new(function);
        let status = call(Some(probe_of(&guarded)), guarded.user());
        guarded.resume();
        self.check(status)
    }
}

/// The callback for a function of this type.
fn respond_of<F: Fn(&Event) -> Response + Sync>(_: F) -> sys::ks_respond {
    respond::<F>
}

/// The callback for a function that gives states.
pub(crate) fn probe_of<F: FnMut(&[BodyId], f64, &mut [State])>(_: &Guarded<F>) -> sys::ks_probe {
    probe::<F>
}

/// The callback for a function that receives events.
fn sink_of<F: FnMut(&Event)>(_: &Guarded<F>) -> sys::ks_sink {
    sink::<F>
}

/// The pointer to an optional array, which has no entries or one for each state.
fn optional(numbers: &[f64], states: &[State]) -> *const f64 {
    if numbers.is_empty() {
        return ptr::null();
    }
    assert_eq!(numbers.len(), states.len(), "one entry for each state");
    numbers.as_ptr()
}
