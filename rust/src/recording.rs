//! Recordings of worlds and their replays, and where the time of a world goes.
use crate::error::{check, filled, Result};
use crate::records::{BusyBody, Event, Timings};
use crate::sys;
use crate::world::World;
use std::ptr;

impl World {
    /// Switches profiling on, from zero, or off.
    pub fn set_profiling(&mut self, on: bool) -> Result<()> {
        check(unsafe { sys::ks_world_set_profiling(self.handle, on.into()) })
    }
    pub fn timings(&self) -> Result<Timings> {
        let mut raw = sys::ks_timings::default();
        check(unsafe { sys::ks_world_timings(self.handle, &mut raw) })?;
        Ok(Timings::of(&raw))
    }
    /// The bodies that were probed most often, at most `most`, the most probed first.
    pub fn busiest(&self, most: usize) -> Result<Vec<BusyBody>> {
        let found: Vec<sys::ks_busy_body> = filled(|bodies, capacity, count| unsafe {
            sys::ks_world_busiest(self.handle, most, bodies, capacity, count)
        })?;
        Ok(found.iter().map(BusyBody::of).collect())
    }
    /// Starts to record all input and output of the world, in memory.
    pub fn start_recording(&mut self) -> Result<()> {
        check(unsafe { sys::ks_world_start_recording(self.handle) })
    }
    /// Stops recording and returns the recording, for `Replay::open`.
    pub fn stop_recording(&mut self) -> Result<Vec<u8>> {
        check(unsafe { sys::ks_world_stop_recording(self.handle) })?;
        filled(|bytes, capacity, count| unsafe {
            sys::ks_world_recording(self.handle, bytes, capacity, count)
        })
    }
}

/// A recording that is being replayed (`Replay` in C++).
pub struct Replay {
    handle: sys::ks_replay,
}

impl Drop for Replay {
    fn drop(&mut self) {
        // It cannot fail: no call of this replay is active, since none borrows it.
        unsafe { sys::ks_replay_destroy(self.handle) };
    }
}

impl Replay {
    /// Opens a recording of a world without a pair filter.
    pub fn open(recording: &[u8]) -> Result<Replay> {
        let mut handle = sys::ks_replay { value: 0 };
        check(unsafe {
            sys::ks_replay_open(recording.as_ptr(), recording.len(), None, ptr::null_mut(), &mut handle)
        })?;
        Ok(Replay { handle })
    }
    /// Repeats everything up to the end of the next recorded advance, or of the recording, and returns what that
    /// advance returned. The error "diverged" names the step that differs.
    pub fn advance(&mut self) -> Result<Option<Event>> {
        let mut event = sys::ks_event::new();
        check(unsafe { sys::ks_replay_advance(self.handle, &mut event) })?;
        Ok(Event::of(&event))
    }
    /// True if no step is left and the world has ended as the recorded one did, to the last bit.
    pub fn finished(&self) -> bool {
        let mut finished = 0;
        unsafe { sys::ks_replay_finished(self.handle, &mut finished) };
        finished != 0
    }
    /// The numbers of steps repeated so far and in total.
    pub fn steps(&self) -> (usize, usize) {
        let (mut repeated, mut total) = (0, 0);
        unsafe { sys::ks_replay_steps(self.handle, &mut repeated, &mut total) };
        (repeated, total)
    }
    /// The hash of all outcomes so far.
    pub fn hash(&self) -> u64 {
        let mut hash = 0;
        unsafe { sys::ks_replay_hash(self.handle, &mut hash) };
        hash
    }
    /// Returns a copy of the world after the last repeated step, without motions.
    pub fn world(&self) -> Result<World> {
        let mut handle = sys::ks_world { value: 0 };
        check(unsafe { sys::ks_replay_world(self.handle, &mut handle) })?;
        Ok(World::of(handle))
    }
}
