//! Where the time of a world goes.
use crate::error::{check, filled, Result};
use crate::records::{BusyBody, Timings};
use crate::sys;
use crate::world::World;

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
}
