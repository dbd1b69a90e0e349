//! Monitors: what is certain about tracks that report when they like.
use crate::error::{check, filled, literal, Guarded, Result};
use crate::geometry::{State, Vec3};
use crate::sys;
use std::fmt;
use std::mem::size_of;
use std::os::raw::c_void;
use std::ptr;
use std::slice;

/// Upper limit of an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ErrorBound {
    Ball(f64),
    Cylinder { horizontal: f64, vertical: f64 },
}

impl ErrorBound {
    fn of(raw: sys::ks_error_bound) -> ErrorBound {
        match raw.kind {
            0 => ErrorBound::Ball(raw.horizontal),
            _ => ErrorBound::Cylinder { horizontal: raw.horizontal, vertical: raw.vertical },
        }
    }
    fn raw(self) -> sys::ks_error_bound {
        match self {
            ErrorBound::Ball(radius) => sys::ks_error_bound { kind: 0, horizontal: radius, vertical: radius },
            ErrorBound::Cylinder { horizontal, vertical } => {
                sys::ks_error_bound { kind: 1, horizontal, vertical }
            }
        }
    }
}

/// Limits of all tracks of a class. At least one of `acceleration_limit` and `largest_speed` is finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackClass {
    pub acceleration_limit: ErrorBound,
    pub planned_acceleration: Vec3,
    pub largest_speed: ErrorBound,
}

impl Default for TrackClass {
    /// Without limits.
    fn default() -> TrackClass {
        TrackClass {
            acceleration_limit: ErrorBound::Ball(f64::INFINITY),
            planned_acceleration: Vec3::default(),
            largest_speed: ErrorBound::Ball(f64::INFINITY),
        }
    }
}

/// A region around a track. With `look_ahead` > 0 (time) closest approaches in it are predicted, too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Separation {
    Ellipsoid { horizontal: f64, vertical: f64, look_ahead: f64 },
    Cylinder { horizontal: f64, vertical: f64, look_ahead: f64 },
    WellClear { horizontal: f64, vertical: f64, modified_tau: f64, look_ahead: f64 },
}

impl Separation {
    pub fn sphere(distance: f64) -> Separation {
        Separation::Ellipsoid { horizontal: distance, vertical: distance, look_ahead: 0.0 }
    }
    fn raw(&self) -> sys::ks_separation {
        let (shape, horizontal, vertical, look_ahead, modified_tau) = match *self {
            Separation::Ellipsoid { horizontal, vertical, look_ahead } => {
                (0, horizontal, vertical, look_ahead, 0.0)
            }
            Separation::Cylinder { horizontal, vertical, look_ahead } => {
                (1, horizontal, vertical, look_ahead, 0.0)
            }
            Separation::WellClear { horizontal, vertical, modified_tau, look_ahead } => {
                (2, horizontal, vertical, look_ahead, modified_tau)
            }
        };
        sys::ks_separation { shape, horizontal, vertical, look_ahead, modified_tau }
    }
}

/// The separation levels between two classes, the widest first.
#[derive(Clone, Debug, PartialEq)]
pub struct SeparationRule {
    pub classes: (usize, usize),
    pub levels: Vec<Separation>,
}

/// The part of all pairs that a monitor watches: shards `first` to `first + count - 1` out of `of`. A pair is in the
/// shard that the lower of its ids modulo `of` says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    pub of: u64,
    pub first: u64,
    pub count: u64,
}

/// Parameters of a monitor (`MonitorDefinition` in C++).
#[derive(Clone, Debug, PartialEq)]
pub struct MonitorDefinition {
    pub dimensions: i32,
    pub start_time: Option<f64>,
    pub classes: Vec<TrackClass>,
    pub separations: Vec<SeparationRule>,
    pub tolerance: f64,
    pub time_resolution: f64,
    pub window: f64,
    pub stale_after: f64,
    pub drop_after: f64,
    pub prediction_hold: f64,
    pub prediction_confirmation: f64,
    pub prediction_margin: f64,
    pub prediction_error_part: f64,
    pub shard: Shard,
}

fn default_definition() -> sys::ks_monitor_definition {
    let mut raw = sys::ks_monitor_definition {
        struct_size: 0,
        dimensions: 0,
        has_start_time: 0,
        start_time: 0.0,
        classes: ptr::null(),
        class_count: 0,
        separations: ptr::null(),
        separation_count: 0,
        tolerance: 0.0,
        time_resolution: 0.0,
        window: 0.0,
        stale_after: 0.0,
        drop_after: 0.0,
        prediction_hold: 0.0,
        prediction_confirmation: 0.0,
        prediction_margin: 0.0,
        prediction_error_part: 0.0,
        shard_of: 0,
        shard_first: 0,
        shard_count: 0,
    };
    unsafe { sys::ks_monitor_definition_init(&mut raw, size_of::<sys::ks_monitor_definition>() as u32) };
    raw
}

impl Default for MonitorDefinition {
    /// Without classes and separations.
    fn default() -> MonitorDefinition {
        let raw = default_definition();
        MonitorDefinition {
            dimensions: raw.dimensions,
            start_time: None,
            classes: Vec::new(),
            separations: Vec::new(),
            tolerance: raw.tolerance,
            time_resolution: raw.time_resolution,
            window: raw.window,
            stale_after: raw.stale_after,
            drop_after: raw.drop_after,
            prediction_hold: raw.prediction_hold,
            prediction_confirmation: raw.prediction_confirmation,
            prediction_margin: raw.prediction_margin,
            prediction_error_part: raw.prediction_error_part,
            shard: Shard { of: raw.shard_of, first: raw.shard_first, count: raw.shard_count },
        }
    }
}

/// A reported state of a track. Errors are bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackReport {
    pub timestamp: f64,
    pub state: State,
    pub position_error: ErrorBound,
    /// Infinite if no velocity was reported.
    pub velocity_error: ErrorBound,
    pub timestamp_error: f64,
    pub track_class: usize,
    /// In force from the timestamp on.
    pub plan: Option<Plan>,
}

/// What a track will do until `valid_until`, in place of what its class says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    pub acceleration: Vec3,
    /// Largest deviation from that acceleration.
    pub limit: ErrorBound,
    pub valid_until: f64,
}

impl Default for TrackReport {
    fn default() -> TrackReport {
        TrackReport {
            timestamp: 0.0,
            state: State::default(),
            position_error: ErrorBound::Ball(0.0),
            velocity_error: ErrorBound::Ball(0.0),
            timestamp_error: 0.0,
            track_class: 0,
            plan: None,
        }
    }
}

impl TrackReport {
    fn raw(&self) -> sys::ks_track_report {
        let mut raw = sys::ks_track_report::default();
        unsafe { sys::ks_track_report_init(&mut raw, size_of::<sys::ks_track_report>() as u32) };
        raw.track_class = self.track_class as u64;
        raw.timestamp = self.timestamp;
        raw.timestamp_error = self.timestamp_error;
        raw.state = self.state;
        raw.position_error = self.position_error.raw();
        raw.velocity_error = self.velocity_error.raw();
        if let Some(plan) = self.plan {
            raw.has_plan = 1;
            raw.plan_acceleration = plan.acceleration;
            raw.plan_limit = plan.limit.raw();
            raw.plan_valid_until = plan.valid_until;
        }
        raw
    }
}

/// What the reports prove about two tracks and a separation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    Apart,
    Undecided,
    Within,
}

impl Verdict {
    fn of(number: i32) -> Verdict {
        match number {
            0 => Verdict::Apart,
            2 => Verdict::Within,
            _ => Verdict::Undecided,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MonitorEventKind {
    Verdict,
    Predicted,
    PredictionEnded,
    Contradiction,
    Resolved,
    Stale,
    Resumed,
    Dropped,
    Reclassified,
}

impl MonitorEventKind {
    fn of(number: i32) -> Option<MonitorEventKind> {
        use MonitorEventKind::*;
        let all = [
            Verdict,
            Predicted,
            PredictionEnded,
            Contradiction,
            Resolved,
            Stale,
            Resumed,
            Dropped,
            Reclassified,
        ];
        all.get((number as usize).wrapping_sub(1)).copied()
    }
    /// Returns a name such as "verdict".
    pub fn name(self) -> &'static str {
        literal(unsafe { sys::ks_monitor_event_kind_name(self as i32 + 1) })
    }
}

impl fmt::Display for MonitorEventKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// An event of a monitor (`MonitorEvent` in C++).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MonitorEvent {
    pub time: f64,
    pub kind: MonitorEventKind,
    pub first: u64,
    pub second: u64,
    pub level: u32,
    pub verdict: Verdict,
    pub before: Verdict,
    pub since: f64,
    pub likely_time: f64,
    pub closest_time: f64,
    pub closest_distance: f64,
    pub position_excess: f64,
    pub velocity_excess: f64,
}

impl MonitorEvent {
    fn of(raw: sys::ks_monitor_event) -> Option<MonitorEvent> {
        Some(MonitorEvent {
            time: raw.time,
            kind: MonitorEventKind::of(raw.kind)?,
            first: raw.first,
            second: raw.second,
            level: raw.level,
            verdict: Verdict::of(raw.verdict),
            before: Verdict::of(raw.before),
            since: raw.since,
            likely_time: raw.likely_time,
            closest_time: raw.closest_time,
            closest_distance: raw.closest_distance,
            position_excess: raw.position_excess,
            velocity_excess: raw.velocity_excess,
        })
    }
}

/// The verdict about two tracks, with a forecast (`PairAnswer` in C++).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairAnswer {
    pub verdict: Verdict,
    pub predicted: bool,
    pub since: f64,
    pub until: f64,
    pub lower: f64,
    pub upper: f64,
    pub closest_distance: f64,
    pub closest_time: f64,
    pub closest_horizontal: f64,
    pub closest_vertical: f64,
    pub relative_speed: f64,
    pub likely_time: f64,
    pub inevitable_by: f64,
    pub avoidable_until: f64,
    pub ask: u64,
    pub ask_by: f64,
}

/// A pair that is not certainly apart at a level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenPair {
    pub first: u64,
    pub second: u64,
    pub level: u32,
    pub verdict: Verdict,
    pub since: f64,
}

/// A pair that is predicted to come within a separation; times and distance as in `MonitorEvent`, from now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PredictedPair {
    pub first: u64,
    pub second: u64,
    pub level: u32,
    pub since: f64,
    pub likely_time: f64,
    pub closest_time: f64,
    pub closest_distance: f64,
}

/// A report of `track` is needed by the time `by` for its verdict with `other` to stay certain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReportRequest {
    pub track: u64,
    pub other: u64,
    pub by: f64,
}

/// Where a track is now: within `radius` of `centre`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackPlace {
    pub centre: Vec3,
    pub velocity: Vec3,
    pub radius: ErrorBound,
}

/// Tracks, their reports and the verdicts about their pairs. Methods are those of `Monitor` in C++.
pub struct Monitor {
    handle: sys::ks_monitor,
}

impl Drop for Monitor {
    fn drop(&mut self) {
        // It cannot fail: no call of this monitor is active, since none borrows it.
        unsafe { sys::ks_monitor_destroy(self.handle) };
    }
}

unsafe extern "C" fn poll<F: FnMut(&[u64], f64) -> Vec<Option<TrackReport>>>(
    tracks: *const u64,
    count: usize,
    time: f64,
    reports: *mut sys::ks_track_report,
    has_report: *mut u8,
    user: *mut c_void,
) -> i32 {
    Guarded::<F>::call(user, |function| {
        let answers = function(slice::from_raw_parts(tracks, count), time);
        for (k, answer) in answers.iter().enumerate().take(count) {
            if let Some(report) = answer {
                *reports.add(k) = report.raw();
                *has_report.add(k) = 1;
            }
        }
    })
}

impl Monitor {
    pub fn new(definition: &MonitorDefinition) -> Result<Monitor> {
        let classes: Vec<_> = definition
            .classes
            .iter()
            .map(|class| sys::ks_track_class {
                acceleration_limit: class.acceleration_limit.raw(),
                largest_speed: class.largest_speed.raw(),
                planned_acceleration: class.planned_acceleration,
            })
            .collect();
        let levels: Vec<Vec<_>> = definition
            .separations
            .iter()
            .map(|rule| rule.levels.iter().map(Separation::raw).collect())
            .collect();
        let rules: Vec<_> = definition
            .separations
            .iter()
            .zip(&levels)
            .map(|(rule, levels)| sys::ks_separation_rule {
                first_class: rule.classes.0,
                second_class: rule.classes.1,
                levels: levels.as_ptr(),
                level_count: levels.len(),
            })
            .collect();
        let raw = sys::ks_monitor_definition {
            dimensions: definition.dimensions,
            has_start_time: definition.start_time.is_some() as i32,
            start_time: definition.start_time.unwrap_or(0.0),
            classes: classes.as_ptr(),
            class_count: classes.len(),
            separations: rules.as_ptr(),
            separation_count: rules.len(),
            tolerance: definition.tolerance,
            time_resolution: definition.time_resolution,
            window: definition.window,
            stale_after: definition.stale_after,
            drop_after: definition.drop_after,
            prediction_hold: definition.prediction_hold,
            prediction_confirmation: definition.prediction_confirmation,
            prediction_margin: definition.prediction_margin,
            prediction_error_part: definition.prediction_error_part,
            shard_of: definition.shard.of,
            shard_first: definition.shard.first,
            shard_count: definition.shard.count,
            ..default_definition()
        };
        let mut handle = sys::ks_monitor { value: 0 };
        check(unsafe { sys::ks_monitor_create(&raw, &mut handle) })?;
        Ok(Monitor { handle })
    }

    /// The handle of C, for calls of [`crate::sys`]; the monitor still owns it.
    pub fn handle(&self) -> sys::ks_monitor {
        self.handle
    }
    pub fn save(&self) -> Result<Vec<u8>> {
        filled(|bytes, capacity, count| unsafe { sys::ks_monitor_save(self.handle, bytes, capacity, count) })
    }
    pub fn restore(snapshot: &[u8]) -> Result<Monitor> {
        let mut handle = sys::ks_monitor { value: 0 };
        check(unsafe { sys::ks_monitor_restore(snapshot.as_ptr(), snapshot.len(), &mut handle) })?;
        Ok(Monitor { handle })
    }

    /// Accepts a report that arrives now. The first one of an id adds a track.
    pub fn report(&mut self, track: u64, report: &TrackReport) -> Result<()> {
        check(unsafe { sys::ks_monitor_report(self.handle, &track, &report.raw(), 1) })
    }
    pub fn remove(&mut self, track: u64) -> Result<()> {
        check(unsafe { sys::ks_monitor_remove(self.handle, track) })
    }

    /// Advances to the next event, at most to time `until`: returns the event, or nothing, at `until`.
    pub fn advance(&mut self, until: f64) -> Result<Option<MonitorEvent>> {
        let mut event = new_event();
        check(unsafe { sys::ks_monitor_advance(self.handle, until, None, ptr::null_mut(), &mut event) })?;
        Ok(MonitorEvent::of(event))
    }
    /// Like `advance`, and asks for the reports without which pairs would turn undecided: `poll(tracks, time)`
    /// returns the latest report of each track, no later than `time`, or nothing if there is no newer one.
    pub fn advance_with<F>(&mut self, until: f64, function: F) -> Result<Option<MonitorEvent>>
    where
        F: FnMut(&[u64], f64) -> Vec<Option<TrackReport>>,
    {
        let mut event = new_event();
        let mut guarded = Guarded::new(function);
        let user = guarded.user();
        let done =
            check(unsafe { sys::ks_monitor_advance(self.handle, until, Some(poll::<F>), user, &mut event) });
        guarded.resume();
        done?;
        Ok(MonitorEvent::of(event))
    }

    pub fn time(&self) -> f64 {
        let mut time = 0.0;
        unsafe { sys::ks_monitor_time(self.handle, &mut time) };
        time
    }
    /// The ids of all tracks, in ascending order.
    pub fn tracks(&self) -> Result<Vec<u64>> {
        filled(|tracks, capacity, count| unsafe {
            sys::ks_monitor_tracks(self.handle, tracks, capacity, count)
        })
    }
    /// The places of a track; several only while its reports contradict each other.
    pub fn places(&self, track: u64) -> Result<Vec<TrackPlace>> {
        let found: Vec<sys::ks_track_place> = filled(|places, capacity, count| unsafe {
            sys::ks_monitor_places(self.handle, track, places, capacity, count)
        })?;
        let of = |raw: &sys::ks_track_place| TrackPlace {
            centre: raw.centre,
            velocity: raw.velocity,
            radius: ErrorBound::of(raw.radius),
        };
        Ok(found.iter().map(of).collect())
    }
    pub fn answer(&self, first: u64, second: u64, level: u32) -> Result<PairAnswer> {
        let mut raw = sys::ks_pair_answer {
            struct_size: size_of::<sys::ks_pair_answer>() as u32,
            ..Default::default()
        };
        check(unsafe { sys::ks_monitor_answer(self.handle, first, second, level, &mut raw) })?;
        Ok(PairAnswer {
            verdict: Verdict::of(raw.verdict),
            predicted: raw.predicted != 0,
            since: raw.since,
            until: raw.until,
            lower: raw.lower,
            upper: raw.upper,
            closest_distance: raw.closest_distance,
            closest_time: raw.closest_time,
            closest_horizontal: raw.closest_horizontal,
            closest_vertical: raw.closest_vertical,
            relative_speed: raw.relative_speed,
            likely_time: raw.likely_time,
            inevitable_by: raw.inevitable_by,
            avoidable_until: raw.avoidable_until,
            ask: raw.ask,
            ask_by: raw.ask_by,
        })
    }
    pub fn open_pairs(&self) -> Result<Vec<OpenPair>> {
        let found: Vec<sys::ks_open_pair> = filled(|pairs, capacity, count| unsafe {
            sys::ks_monitor_open_pairs(self.handle, pairs, capacity, count)
        })?;
        let of = |raw: &sys::ks_open_pair| OpenPair {
            first: raw.first,
            second: raw.second,
            level: raw.level,
            verdict: Verdict::of(raw.verdict),
            since: raw.since,
        };
        Ok(found.iter().map(of).collect())
    }
    /// The pairs that are predicted to come within a separation.
    pub fn predicted_pairs(&self) -> Result<Vec<PredictedPair>> {
        let found: Vec<sys::ks_predicted_pair> = filled(|pairs, capacity, count| unsafe {
            sys::ks_monitor_predicted_pairs(self.handle, pairs, capacity, count)
        })?;
        let of = |raw: &sys::ks_predicted_pair| PredictedPair {
            first: raw.first,
            second: raw.second,
            level: raw.level,
            since: raw.since,
            likely_time: raw.likely_time,
            closest_time: raw.closest_time,
            closest_distance: raw.closest_distance,
        };
        Ok(found.iter().map(of).collect())
    }
    /// The reports that are needed by `until` for no verdict to turn undecided.
    pub fn needed(&self, until: f64) -> Result<Vec<ReportRequest>> {
        let found: Vec<sys::ks_report_request> = filled(|requests, capacity, count| unsafe {
            sys::ks_monitor_needed(self.handle, until, requests, capacity, count)
        })?;
        let of =
            |raw: &sys::ks_report_request| ReportRequest { track: raw.track, other: raw.other, by: raw.by };
        Ok(found.iter().map(of).collect())
    }
}

fn new_event() -> sys::ks_monitor_event {
    sys::ks_monitor_event { struct_size: size_of::<sys::ks_monitor_event>() as u32, ..Default::default() }
}
