//! Where the time of a world goes.
use crate::error::{check, filled, literal, Result};
use crate::geometry::BodyId;
use crate::sys;
use crate::world::World;
use std::fmt;

/// Wall-clock time spent (seconds) since profiling was switched on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Timings {
    /// Calls of `advance`.
    pub advances: u64,
    /// In `advance`, including probes.
    pub advance: f64,
    /// In the caller's probes.
    pub probes: f64,
}

/// Main reason for the probes of a body (`ProbeReason` in C++).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ProbeReason {
    Touching,
    NarrowMisses,
    LooseLimit,
    Contacts,
    Travel,
    Changes,
    Queries,
}

impl ProbeReason {
    fn of(number: i32) -> ProbeReason {
        use ProbeReason::*;
        [Touching, NarrowMisses, LooseLimit, Contacts, Travel, Changes, Queries][number as usize]
    }
    /// Returns a name such as "narrow_misses".
    pub fn name(self) -> &'static str {
        literal(unsafe { sys::ks_probe_reason_name(self as i32) })
    }
    /// Returns two sentences: what the reason means, and what makes such a body cheaper.
    pub fn advice(self) -> &'static str {
        literal(unsafe { sys::ks_probe_reason_advice(self as i32) })
    }
}

impl fmt::Display for ProbeReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A body that was probed while profiling was on (`BusyBody` in C++); `probes` is the sum of the next five fields.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BusyBody {
    pub body: BodyId,
    pub reason: ProbeReason,
    pub probes: u64,
    pub touching: u64,
    pub near: u64,
    pub windows: u64,
    pub changes: u64,
    pub queries: u64,
    pub contacts: u64,
    pub acceleration_limit: f64,
    pub largest_acceleration: f64,
}

impl World {
    /// Switches profiling on, from zero, or off.
    pub fn set_profiling(&mut self, on: bool) -> Result<()> {
        check(unsafe { sys::ks_world_set_profiling(self.handle, on.into()) })
    }
    pub fn timings(&self) -> Result<Timings> {
        let mut raw = sys::ks_timings::default();
        check(unsafe { sys::ks_world_timings(self.handle, &mut raw) })?;
        Ok(Timings { advances: raw.advances, advance: raw.advance, probes: raw.probes })
    }
    /// The bodies that were probed most often, at most `most`, the most probed first.
    pub fn busiest(&self, most: usize) -> Result<Vec<BusyBody>> {
        let found: Vec<sys::ks_busy_body> = filled(|bodies, capacity, count| unsafe {
            sys::ks_world_busiest(self.handle, most, bodies, capacity, count)
        })?;
        let of = |raw: &sys::ks_busy_body| BusyBody {
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
        };
        Ok(found.iter().map(of).collect())
    }
}
