//! Monitors: what is certain about tracks that report when they like.
use crate::error::{check, filled, Guarded, Result};
use crate::geometry::Vec3;
use crate::records::{
    MonitorDefinition, MonitorEvent, OpenPair, PairAnswer, PredictedPair, ReportRequest, TrackClass,
    TrackPlace, TrackReport,
};
use crate::sys;
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
    pub(crate) fn of(raw: &sys::ks_error_bound) -> ErrorBound {
        match raw.kind {
            sys::KS_BOUND_BALL => ErrorBound::Ball(raw.horizontal),
            _ => ErrorBound::Cylinder { horizontal: raw.horizontal, vertical: raw.vertical },
        }
    }
    pub(crate) fn raw(self) -> sys::ks_error_bound {
        match self {
            ErrorBound::Ball(radius) => {
                sys::ks_error_bound { kind: sys::KS_BOUND_BALL, horizontal: radius, vertical: radius }
            }
            ErrorBound::Cylinder { horizontal, vertical } => {
                sys::ks_error_bound { kind: sys::KS_BOUND_CYLINDER, horizontal, vertical }
            }
        }
    }
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
                (sys::KS_SEPARATION_ELLIPSOID, horizontal, vertical, look_ahead, 0.0)
            }
            Separation::Cylinder { horizontal, vertical, look_ahead } => {
                (sys::KS_SEPARATION_CYLINDER, horizontal, vertical, look_ahead, 0.0)
            }
            Separation::WellClear { horizontal, vertical, modified_tau, look_ahead } => {
                (sys::KS_SEPARATION_WELL_CLEAR, horizontal, vertical, look_ahead, modified_tau)
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
        let classes: Vec<_> = definition.classes.iter().map(TrackClass::raw).collect();
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
            classes: classes.as_ptr(),
            class_count: classes.len(),
            separations: rules.as_ptr(),
            separation_count: rules.len(),
            ..definition.raw()
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
        let mut event = sys::ks_monitor_event::new();
        check(unsafe { sys::ks_monitor_advance(self.handle, until, None, ptr::null_mut(), &mut event) })?;
        Ok(MonitorEvent::of(&event))
    }
    /// Like `advance`, and asks for the reports without which pairs would turn undecided: `poll(tracks, time)`
    /// returns the latest report of each track, no later than `time`, or nothing if there is no newer one.
    pub fn advance_with<F>(&mut self, until: f64, function: F) -> Result<Option<MonitorEvent>>
    where
        F: FnMut(&[u64], f64) -> Vec<Option<TrackReport>>,
    {
        let mut event = sys::ks_monitor_event::new();
        let mut guarded = Guarded::new(function);
        let user = guarded.user();
        let done =
            check(unsafe { sys::ks_monitor_advance(self.handle, until, Some(poll::<F>), user, &mut event) });
        guarded.resume();
        done?;
        Ok(MonitorEvent::of(&event))
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
        Ok(found.iter().map(TrackPlace::of).collect())
    }
    pub fn answer(&self, first: u64, second: u64, level: u32) -> Result<PairAnswer> {
        let mut raw = sys::ks_pair_answer::new();
        check(unsafe { sys::ks_monitor_answer(self.handle, first, second, level, &mut raw) })?;
        Ok(PairAnswer::of(&raw))
    }
    pub fn open_pairs(&self) -> Result<Vec<OpenPair>> {
        let found: Vec<sys::ks_open_pair> = filled(|pairs, capacity, count| unsafe {
            sys::ks_monitor_open_pairs(self.handle, pairs, capacity, count)
        })?;
        Ok(found.iter().map(OpenPair::of).collect())
    }
    /// The pairs that are predicted to come within a separation.
    pub fn predicted_pairs(&self) -> Result<Vec<PredictedPair>> {
        let found: Vec<sys::ks_predicted_pair> = filled(|pairs, capacity, count| unsafe {
            sys::ks_monitor_predicted_pairs(self.handle, pairs, capacity, count)
        })?;
        Ok(found.iter().map(PredictedPair::of).collect())
    }
    /// The reports that are needed by `until` for no verdict to turn undecided.
    pub fn needed(&self, until: f64) -> Result<Vec<ReportRequest>> {
        let found: Vec<sys::ks_report_request> = filled(|requests, capacity, count| unsafe {
            sys::ks_monitor_needed(self.handle, until, requests, capacity, count)
        })?;
        Ok(found.iter().map(ReportRequest::of).collect())
    }
}
