//! Games: worlds that move their own bodies.
use crate::error::{check, Guarded, Result};
use crate::events::Response;
use crate::geometry::{BodyId, Vec3};
use crate::records::{Event, WorldDefinition};
use crate::sys;
use crate::world::{GameFunction, PairFilter, World};
use std::mem::size_of;
use std::ops::{Deref, DerefMut};
use std::os::raw::c_void;
use std::ptr;
use std::slice;
use std::sync::Arc;

/// How a game answers its events.
pub enum GameResponse {
    /// Bodies pass through each other.
    PassThrough,
    Bounce {
        restitution: f64,
    },
    Settle {
        restitution: f64,
        resting_speed: f64,
    },
    /// A function of the event alone, which the game and its clones share; [`Response::stop`] has no effect. A panic
    /// in it passes through the call that advances; the game can then go on, as after an error.
    Respond(Box<dyn Fn(&Event) -> Response + Send + Sync>),
}

/// What C keeps a pointer to, and the record of C.
type Answering = (Option<Arc<Guarded<GameFunction>>>, sys::ks_game_definition);

impl GameResponse {
    fn raw(self, gravity: Vec3) -> Answering {
        let mut raw = sys::ks_game_definition {
            struct_size: size_of::<sys::ks_game_definition>() as u32,
            reserved: 0,
            gravity,
            restitution: f64::NAN,
            resting_speed: 0.0,
            respond: None,
            respond_user: ptr::null_mut(),
        };
        let mut kept = None;
        match self {
            GameResponse::PassThrough => {}
            GameResponse::Bounce { restitution } => raw.restitution = restitution,
            GameResponse::Settle { restitution, resting_speed } => {
                raw.restitution = restitution;
                raw.resting_speed = resting_speed;
            }
            GameResponse::Respond(function) => {
                let function = Arc::new(Guarded::new(function));
                raw.respond = Some(crate::world::respond::<GameFunction>);
                raw.respond_user = Arc::as_ptr(&function) as *mut c_void;
                kept = Some(function);
            }
        }
        (kept, raw)
    }
}

/// A world that moves its own bodies, so that a game keeps nothing of them but ids. Between events each body flies
/// freely, by the gravity of the game and its own planned acceleration, so steps of any length miss nothing.
///
/// It is a [`World`] for all other calls: `add`, `remove`, `set_velocity`, queries. Those that ask for states, and
/// motions, runs and motion limits, are `unsupported`.
///
/// ```
/// use kinesphere::{BodyDefinition, Box3, EventKind, GameResponse, GameWorld, Vec3, WorldDefinition};
///
/// # fn main() -> kinesphere::Result<()> {
/// let room = Box3 { lower: Vec3::default(), upper: Vec3::new(10.0, 10.0, 10.0) };
/// let definition = WorldDefinition { bounds: Some(room), ..Default::default() };
/// let bouncing = GameResponse::Bounce { restitution: 0.8 };
/// let mut game = GameWorld::new(&definition, Vec3::new(0.0, 0.0, -9.81), bouncing)?;
/// let position = Vec3::new(5.0, 5.0, 5.0);
/// game.add(&BodyDefinition { radius: 0.5, position, ..Default::default() })?;
/// for _frame in 0..60 {
///     for event in game.step(1.0 / 60.0)? {
///         if event.kind == EventKind::WallBegin {
///             println!("{} hits the floor at {}", event.first.index(), event.approach_speed);
///         }
///     }
/// }
/// assert!(game.positions()[0].z > 0.5);
/// # Ok(())
/// # }
/// ```
pub struct GameWorld {
    world: World,
    /// Of the last step.
    events: Vec<Event>,
}

impl Deref for GameWorld {
    type Target = World;
    fn deref(&self) -> &World {
        &self.world
    }
}
impl DerefMut for GameWorld {
    fn deref_mut(&mut self) -> &mut World {
        &mut self.world
    }
}

impl GameWorld {
    /// A game without bodies. `gravity` acts on all bodies (length / time^2).
    pub fn new(definition: &WorldDefinition, gravity: Vec3, response: GameResponse) -> Result<GameWorld> {
        let (kept, raw) = response.raw(gravity);
        let mut handle = sys::ks_world { value: 0 };
        check(unsafe { sys::ks_game_create(&definition.raw(), &raw, &mut handle) })?;
        let mut world = World::of(handle);
        world.respond = kept;
        Ok(GameWorld { world, events: vec![] })
    }
    /// The game of a snapshot of a game, which continues bit for bit, with the pair filter that it had.
    pub fn restore(
        snapshot: &[u8],
        response: GameResponse,
        filter: Option<Box<dyn Fn(BodyId, BodyId) -> bool + Send + Sync>>,
    ) -> Result<GameWorld> {
        let (kept, raw) = response.raw(Vec3::default());
        let filter: Option<Arc<Guarded<PairFilter>>> = filter.map(|filter| Arc::new(Guarded::new(filter)));
        let user = filter.as_ref().map_or(ptr::null_mut(), |filter| Arc::as_ptr(filter) as *mut c_void);
        let callback = filter.as_ref().map(|_| crate::world::pair_filter as sys::ks_pair_filter);
        let mut handle = sys::ks_world { value: 0 };
        check(unsafe {
            sys::ks_game_restore(snapshot.as_ptr(), snapshot.len(), &raw, callback, user, &mut handle)
        })?;
        let mut world = World::of(handle);
        (world.respond, world.filter) = (kept, filter);
        Ok(GameWorld { world, events: vec![] })
    }
    /// Returns a copy that continues as this game does: for rollback, or to look ahead.
    pub fn try_clone(&self) -> Result<GameWorld> {
        Ok(GameWorld { world: self.world.try_clone()?, events: vec![] })
    }

    /// Advances by dt > 0, answers all events by the response of the game, and returns them in order. After an error
    /// the next step goes on from where the game stands, and returns the events of this step, too.
    pub fn step(&mut self, dt: f64) -> Result<&[Event]> {
        let mut happened = sys::ks_event_list { count: 0, events: ptr::null() };
        self.check(unsafe { sys::ks_game_step(self.handle, dt, &mut happened) })?;
        // Valid until the next step.
        let events = unsafe { array(happened.events, happened.count) };
        self.events.clear();
        self.events.extend(events.iter().filter_map(Event::of));
        Ok(&self.events)
    }
    /// Advances to the next event, at most to the time `until`, and answers it: returns the event, with the game at its
    /// time, or nothing, with the game at `until`.
    pub fn advance(&mut self, until: f64) -> Result<Option<Event>> {
        self.world.advance_motions(until)
    }

    fn bodies_now(&self) -> sys::ks_body_list {
        let mut found =
            sys::ks_body_list { count: 0, ids: ptr::null(), positions: ptr::null(), velocities: ptr::null() };
        // It fails only if another world took the place of this one.
        self.check(unsafe { sys::ks_game_bodies(self.handle, &mut found) }).expect("a game");
        found
    }
    /// The bodies that can move, disabled ones too: the last one takes the place of a removed one.
    pub fn ids(&self) -> &[BodyId] {
        let found = self.bodies_now();
        // Valid until the next call that changes the game, as for the two below.
        unsafe { array(found.ids, found.count) }
    }
    /// Where they are now, in the order of `ids`; on periodic axes in the box.
    pub fn positions(&self) -> &[Vec3] {
        let found = self.bodies_now();
        unsafe { array(found.positions, found.count) }
    }
    /// Their velocities now, in the order of `ids`.
    pub fn velocities(&self) -> &[Vec3] {
        let found = self.bodies_now();
        unsafe { array(found.velocities, found.count) }
    }
    /// The place of a body in these arrays, or the error of one that is not in them.
    pub fn index_of(&self, body: BodyId) -> Result<usize> {
        let mut index = 0;
        self.check(unsafe { sys::ks_game_index_of(self.handle, body, &mut index) })?;
        Ok(index)
    }

    /// Replaces the response of the game; its clones keep theirs.
    pub fn set_response(&mut self, response: GameResponse) -> Result<()> {
        let (kept, raw) = response.raw(Vec3::default());
        self.check(unsafe { sys::ks_game_set_response(self.handle, &raw) })?;
        self.respond = kept;
        Ok(())
    }
    /// Sets the velocities of all bodies, in the order of `ids`, or, on an error, of none.
    pub fn set_all_velocities(&mut self, velocities: &[Vec3]) -> Result<()> {
        self.check(unsafe { sys::ks_game_set_velocities(self.handle, velocities.as_ptr(), velocities.len()) })
    }
    /// Sets the acceleration of a body beside the gravity (length / time^2).
    pub fn set_acceleration(&mut self, body: BodyId, acceleration: Vec3) -> Result<()> {
        self.check(unsafe { sys::ks_game_set_acceleration(self.handle, body, acceleration) })
    }
    /// Sets the gravity of the game; wakes all that sleep.
    pub fn set_gravity(&mut self, gravity: Vec3) -> Result<()> {
        self.check(unsafe { sys::ks_game_set_gravity(self.handle, gravity) })
    }
    pub fn gravity(&self) -> Result<Vec3> {
        let mut gravity = Vec3::default();
        self.check(unsafe { sys::ks_game_gravity(self.handle, &mut gravity) })?;
        Ok(gravity)
    }
}

/// # Safety
/// The array is valid as long as the result is used.
unsafe fn array<'a, T>(elements: *const T, count: usize) -> &'a [T] {
    if count == 0 {
        return &[];
    }
    slice::from_raw_parts(elements, count)
}
