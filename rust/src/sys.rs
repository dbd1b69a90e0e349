// Generated from include/kinesphere.h by interface/generate.py: change the header, and run that.
//! The declarations of `kinesphere.h`, which explains them. Nothing here is safe by itself; a record whose layout
//! differed from that of C would be refused by its size.
#![allow(non_camel_case_types)]
#![allow(clippy::new_without_default)]

use crate::geometry::{BodyId, Box3, Quaternion, Ray, RigidPart, Rotation, Sphere, State, Vec3};
use std::os::raw::{c_char, c_void};

pub type ks_status = i32;
pub const KS_OK: ks_status = 0;
pub const KS_ERROR_INVALID_HANDLE: ks_status = 1;
pub const KS_ERROR_STALE_HANDLE: ks_status = 2;
pub const KS_ERROR_IN_USE: ks_status = 3;
pub const KS_ERROR_NULL_ARGUMENT: ks_status = 4;
pub const KS_ERROR_BAD_STRUCT: ks_status = 5;
pub const KS_ERROR_BUFFER_TOO_SMALL: ks_status = 6;
pub const KS_ERROR_CALLBACK_FAILED: ks_status = 7;
pub const KS_ERROR_OUT_OF_MEMORY: ks_status = 8;
pub const KS_ERROR_INTERNAL: ks_status = 9;
pub const KS_ERROR_NOT_FINITE: ks_status = 20;
pub const KS_ERROR_OUT_OF_RANGE: ks_status = 21;
pub const KS_ERROR_TIME_BACKWARDS: ks_status = 22;
pub const KS_ERROR_UNKNOWN_BODY: ks_status = 23;
pub const KS_ERROR_STALE_BODY: ks_status = 24;
pub const KS_ERROR_FOREIGN_BODY: ks_status = 25;
pub const KS_ERROR_DISABLED_BODY: ks_status = 26;
pub const KS_ERROR_ENABLED_BODY: ks_status = 27;
pub const KS_ERROR_STATIC_BODY: ks_status = 28;
pub const KS_ERROR_OUTSIDE_DOMAIN: ks_status = 29;
pub const KS_ERROR_OVERLAPPING: ks_status = 30;
pub const KS_ERROR_PROBE_IN_PROGRESS: ks_status = 31;
pub const KS_ERROR_FILTER_IN_PROGRESS: ks_status = 32;
pub const KS_ERROR_RUN_IN_PROGRESS: ks_status = 33;
pub const KS_ERROR_WORKERS_BUSY: ks_status = 34;
pub const KS_ERROR_NO_THREADS: ks_status = 35;
pub const KS_ERROR_NULL_PROBE: ks_status = 36;
pub const KS_ERROR_NULL_CALLBACK: ks_status = 37;
pub const KS_ERROR_CALLBACK_THREW: ks_status = 38;
pub const KS_ERROR_RANK_FAILED: ks_status = 39;
pub const KS_ERROR_MOVED_FROM: ks_status = 40;
pub const KS_ERROR_UNSUPPORTED: ks_status = 41;
pub const KS_ERROR_BAD_SNAPSHOT: ks_status = 42;
pub const KS_ERROR_BAD_BYTES: ks_status = 43;
pub const KS_ERROR_RECORDING: ks_status = 44;
pub const KS_ERROR_NOT_RECORDING: ks_status = 45;
pub const KS_ERROR_NOT_PROFILING: ks_status = 46;
pub const KS_ERROR_BAD_RECORDING: ks_status = 47;
pub const KS_ERROR_DIVERGED: ks_status = 48;
pub const KS_SHAPE_BALL: i32 = 0;
pub const KS_SHAPE_HALF_SPACE: i32 = 1;
pub const KS_SHAPE_BOX: i32 = 2;
pub const KS_SHAPE_TRIANGLE: i32 = 3;
pub const KS_SHAPE_MESH: i32 = 4;
pub const KS_CONTACTS_OF_WORLD: i32 = 0;
pub const KS_CONTACTS_IMPACTS: i32 = 1;
pub const KS_CONTACTS_BEGIN_AND_END: i32 = 2;
pub const KS_CONTACTS_ALL: i32 = 3;
pub const KS_AXIS_X: u32 = 1;
pub const KS_AXIS_Y: u32 = 2;
pub const KS_AXIS_Z: u32 = 4;
pub const KS_PROBE_REASON_TOUCHING: i32 = 0;
pub const KS_PROBE_REASON_NARROW_MISSES: i32 = 1;
pub const KS_PROBE_REASON_LOOSE_LIMIT: i32 = 2;
pub const KS_PROBE_REASON_CONTACTS: i32 = 3;
pub const KS_PROBE_REASON_TRAVEL: i32 = 4;
pub const KS_PROBE_REASON_CHANGES: i32 = 5;
pub const KS_PROBE_REASON_QUERIES: i32 = 6;
pub const KS_EVENT_NONE: i32 = 0;
pub const KS_EVENT_BOUND_VIOLATION: i32 = 1;
pub const KS_EVENT_CONTACT_BEGIN: i32 = 2;
pub const KS_EVENT_CONTACT_END: i32 = 3;
pub const KS_EVENT_WALL_BEGIN: i32 = 4;
pub const KS_EVENT_WALL_END: i32 = 5;
pub const KS_EVENT_ZENO_GUARD: i32 = 6;
pub const KS_EVENT_SENSOR_ENTER: i32 = 7;
pub const KS_EVENT_SENSOR_LEAVE: i32 = 8;
pub const KS_EVENT_WOKE: i32 = 9;
pub const KS_EVENT_TIMER: i32 = 10;
pub const KS_WALL_NONE: i32 = 0;
pub const KS_WALL_X_LOWER: i32 = 1;
pub const KS_WALL_X_UPPER: i32 = 2;
pub const KS_WALL_Y_LOWER: i32 = 3;
pub const KS_WALL_Y_UPPER: i32 = 4;
pub const KS_WALL_Z_LOWER: i32 = 5;
pub const KS_WALL_Z_UPPER: i32 = 6;
pub const KS_TRAIT_STATIC: u32 = 1;
pub const KS_TRAIT_ZONE: u32 = 2;
pub const KS_TRAIT_SLEEPING: u32 = 4;
pub const KS_SENSES_FIRST: u32 = 1;
pub const KS_SENSES_SECOND: u32 = 2;
pub const KS_ACTION_NONE: i32 = 0;
pub const KS_ACTION_REMOVE: i32 = 1;
pub const KS_ACTION_DISABLE: i32 = 2;
pub const KS_ACTION_SLEEP: i32 = 3;
pub const KS_MOTION_BALLISTIC: i32 = 0;
pub const KS_MOTION_RANDOM_FORCES: i32 = 1;
pub const KS_MOTION_FRAMES: i32 = 2;
pub const KS_MOTION_STEERED: i32 = 3;
pub const KS_BOUND_BALL: i32 = 0;
pub const KS_BOUND_CYLINDER: i32 = 1;
pub const KS_SEPARATION_ELLIPSOID: i32 = 0;
pub const KS_SEPARATION_CYLINDER: i32 = 1;
pub const KS_SEPARATION_WELL_CLEAR: i32 = 2;
pub const KS_VERDICT_APART: i32 = 0;
pub const KS_VERDICT_UNDECIDED: i32 = 1;
pub const KS_VERDICT_WITHIN: i32 = 2;
pub const KS_MONITOR_NONE: i32 = 0;
pub const KS_MONITOR_VERDICT: i32 = 1;
pub const KS_MONITOR_PREDICTED: i32 = 2;
pub const KS_MONITOR_PREDICTION_ENDED: i32 = 3;
pub const KS_MONITOR_CONTRADICTION: i32 = 4;
pub const KS_MONITOR_RESOLVED: i32 = 5;
pub const KS_MONITOR_STALE: i32 = 6;
pub const KS_MONITOR_RESUMED: i32 = 7;
pub const KS_MONITOR_DROPPED: i32 = 8;
pub const KS_MONITOR_RECLASSIFIED: i32 = 9;

pub type ks_rotation_probe = unsafe extern "C" fn(*const BodyId, usize, f64, *mut Rotation, *mut c_void) -> i32;
pub type ks_pair_filter = unsafe extern "C" fn(BodyId, BodyId, *mut c_void) -> i32;
pub type ks_probe = unsafe extern "C" fn(*const BodyId, usize, f64, *mut State, *mut c_void) -> i32;
pub type ks_respond = unsafe extern "C" fn(*const ks_event, *mut ks_response, *mut c_void) -> i32;
pub type ks_sink = unsafe extern "C" fn(*const ks_event, *mut c_void) -> i32;
pub type ks_poll = unsafe extern "C" fn(*const u64, usize, f64, *mut ks_track_report, *mut u8, *mut c_void) -> i32;

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_shape {
    pub kind: i32,
    pub points: [Vec3; 3],
    pub number: f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ks_mesh {
    pub value: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ks_world {
    pub value: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_filter {
    pub category: u64,
    pub mask: u64,
    pub group: i32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_world_definition {
    pub struct_size: u32,
    pub dimensions: i32,
    pub has_box: i32,
    pub periodic: u32,
    pub box_: Box3,
    pub contact_tolerance: f64,
    pub separation_distance: f64,
    pub zeno_interval: f64,
    pub start_time: f64,
    pub contacts: i32,
    pub allow_overlap: i32,
    pub spread_window_starts: i32,
    pub has_wall_filter: i32,
    pub wall_filter: ks_filter,
    pub adopt_observed_limits: i32,
    pub reserved: i32,
    pub shear_rate: f64,
}

impl ks_world_definition {
    /// The defaults of the library.
    pub fn new() -> Self {
        let mut made = std::mem::MaybeUninit::<Self>::zeroed();
        // It fails for a library with another layout only, and then leaves the size 0, which is refused.
        unsafe {
            ks_world_definition_init(made.as_mut_ptr(), std::mem::size_of::<Self>() as u32);
            made.assume_init()
        }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_body_definition {
    pub struct_size: u32,
    pub solid: i32,
    pub contacts: i32,
    pub sensor_class: i32,
    pub radius: f64,
    pub acceleration_limit: f64,
    pub position_error: f64,
    pub velocity_error: f64,
    pub mass: f64,
    pub planned_acceleration: Vec3,
    pub position: Vec3,
    pub velocity: Vec3,
    pub filter: ks_filter,
    pub user_data: u64,
}

impl ks_body_definition {
    /// The defaults of the library.
    pub fn new() -> Self {
        let mut made = std::mem::MaybeUninit::<Self>::zeroed();
        // It fails for a library with another layout only, and then leaves the size 0, which is refused.
        unsafe {
            ks_body_definition_init(made.as_mut_ptr(), std::mem::size_of::<Self>() as u32);
            made.assume_init()
        }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_static_definition {
    pub struct_size: u32,
    pub solid: i32,
    pub sensor_class: i32,
    pub shape: ks_shape,
    pub filter: ks_filter,
    pub user_data: u64,
}

impl ks_static_definition {
    /// The defaults of the library.
    pub fn new() -> Self {
        let mut made = std::mem::MaybeUninit::<Self>::zeroed();
        // It fails for a library with another layout only, and then leaves the size 0, which is refused.
        unsafe {
            ks_static_definition_init(made.as_mut_ptr(), std::mem::size_of::<Self>() as u32);
            made.assume_init()
        }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ks_rigid_hull {
    pub point_count: usize,
    pub points: *const Vec3,
    pub radius: f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ks_rigid_definition {
    pub struct_size: u32,
    pub part_count: usize,
    pub parts: *const RigidPart,
    pub rotation: Rotation,
    pub angular_acceleration_limit: f64,
    pub largest_angular_speed: f64,
    pub inertia: Vec3,
    pub hull_count: usize,
    pub hulls: *const ks_rigid_hull,
}

impl ks_rigid_definition {
    /// The defaults of the library.
    pub fn new() -> Self {
        let mut made = std::mem::MaybeUninit::<Self>::zeroed();
        // It fails for a library with another layout only, and then leaves the size 0, which is refused.
        unsafe {
            ks_rigid_definition_init(made.as_mut_ptr(), std::mem::size_of::<Self>() as u32);
            made.assume_init()
        }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_motion_limits {
    pub acceleration_limit: f64,
    pub position_error: f64,
    pub velocity_error: f64,
    pub planned_acceleration: Vec3,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_body_view {
    pub struct_size: u32,
    pub enabled: i32,
    pub is_static: i32,
    pub sleeping: i32,
    pub report_time: f64,
    pub box_: Box3,
    pub box_end: f64,
    pub image: [i64; 3],
    pub definition: ks_body_definition,
}

impl ks_body_view {
    /// All zeros, with its size: to be filled.
    pub fn new() -> Self {
        Self { struct_size: std::mem::size_of::<Self>() as u32, ..Default::default() }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_sensor_overlap {
    pub body: BodyId,
    pub distance: f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_timings {
    pub advances: u64,
    pub advance: f64,
    pub probes: f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_busy_body {
    pub body: BodyId,
    pub reason: i32,
    pub probes: u64,
    pub touching: u64,
    pub near_others: u64,
    pub windows: u64,
    pub changes: u64,
    pub queries: u64,
    pub contacts: u64,
    pub acceleration_limit: f64,
    pub largest_acceleration: f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_event {
    pub struct_size: u32,
    pub kind: i32,
    pub time: f64,
    pub first: BodyId,
    pub second: BodyId,
    pub wall: i32,
    pub repeated: i32,
    pub jammed: i32,
    pub already_touching: i32,
    pub senses: u32,
    pub first_traits: u32,
    pub second_traits: u32,
    pub pair_state: i32,
    pub first_state: State,
    pub second_state: State,
    pub point: Vec3,
    pub normal: Vec3,
    pub gap: f64,
    pub approach_speed: f64,
    pub position_excess: f64,
    pub velocity_excess: f64,
    pub distance: f64,
    pub first_user_data: u64,
    pub second_user_data: u64,
    pub first_mass: f64,
    pub second_mass: f64,
    pub first_part: u32,
    pub second_part: u32,
    pub first_angular_velocity: Vec3,
    pub second_angular_velocity: Vec3,
    pub first_spin_gain: Vec3,
    pub second_spin_gain: Vec3,
    pub acceleration_limit: f64,
}

impl ks_event {
    /// All zeros, with its size: to be filled.
    pub fn new() -> Self {
        Self { struct_size: std::mem::size_of::<Self>() as u32, ..Default::default() }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_response {
    pub struct_size: u32,
    pub stop: i32,
    pub turns_first: i32,
    pub turns_second: i32,
    pub spins_first: i32,
    pub spins_second: i32,
    pub first_action: i32,
    pub second_action: i32,
    pub first_velocity: Vec3,
    pub second_velocity: Vec3,
    pub first_angular_velocity: Vec3,
    pub second_angular_velocity: Vec3,
    pub turned_back: i32,
    pub sets_pair_state: i32,
    pub pair_state: i32,
    pub reserved: i32,
}

impl ks_response {
    /// All zeros, with its size: to be filled.
    pub fn new() -> Self {
        Self { struct_size: std::mem::size_of::<Self>() as u32, ..Default::default() }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_roughness {
    pub struct_size: u32,
    pub reserved: i32,
    pub restitution: f64,
    pub tangential_restitution: f64,
    pub friction: f64,
    pub inertia: f64,
}

impl ks_roughness {
    /// The defaults of the library.
    pub fn new() -> Self {
        let mut made = std::mem::MaybeUninit::<Self>::zeroed();
        // It fails for a library with another layout only, and then leaves the size 0, which is refused.
        unsafe {
            ks_roughness_init(made.as_mut_ptr(), std::mem::size_of::<Self>() as u32);
            made.assume_init()
        }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ks_step_potential {
    pub value: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ks_step_potential_definition {
    pub struct_size: u32,
    pub reserved: i32,
    pub count: usize,
    pub distances: *const f64,
    pub energies: *const f64,
    pub outside: f64,
    pub restitution: f64,
}

impl ks_step_potential_definition {
    /// The defaults of the library.
    pub fn new() -> Self {
        let mut made = std::mem::MaybeUninit::<Self>::zeroed();
        // It fails for a library with another layout only, and then leaves the size 0, which is refused.
        unsafe {
            ks_step_potential_definition_init(made.as_mut_ptr(), std::mem::size_of::<Self>() as u32);
            made.assume_init()
        }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_event_hash {
    pub sum: u64,
    pub count: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ks_run_definition {
    pub struct_size: u32,
    pub threads: i32,
    pub restitution: f64,
    pub resting_speed: f64,
    pub respond: Option<ks_respond>,
    pub respond_user: *mut c_void,
    pub sink: Option<ks_sink>,
    pub sink_user: *mut c_void,
}

impl ks_run_definition {
    /// The defaults of the library.
    pub fn new() -> Self {
        let mut made = std::mem::MaybeUninit::<Self>::zeroed();
        // It fails for a library with another layout only, and then leaves the size 0, which is refused.
        unsafe {
            ks_run_definition_init(made.as_mut_ptr(), std::mem::size_of::<Self>() as u32);
            made.assume_init()
        }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ks_game_definition {
    pub struct_size: u32,
    pub reserved: i32,
    pub gravity: Vec3,
    pub restitution: f64,
    pub resting_speed: f64,
    pub respond: Option<ks_respond>,
    pub respond_user: *mut c_void,
}

impl ks_game_definition {
    /// The defaults of the library.
    pub fn new() -> Self {
        let mut made = std::mem::MaybeUninit::<Self>::zeroed();
        // It fails for a library with another layout only, and then leaves the size 0, which is refused.
        unsafe {
            ks_game_definition_init(made.as_mut_ptr(), std::mem::size_of::<Self>() as u32);
            made.assume_init()
        }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ks_event_list {
    pub count: usize,
    pub events: *const ks_event,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ks_body_list {
    pub count: usize,
    pub ids: *const BodyId,
    pub positions: *const Vec3,
    pub velocities: *const Vec3,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ks_motion_definition {
    pub struct_size: u32,
    pub kind: i32,
    pub count: usize,
    pub states: *const State,
    pub radii: *const f64,
    pub masses: *const f64,
    pub acceleration_limits: *const f64,
    pub gravity: Vec3,
    pub interval: f64,
    pub position_error: f64,
    pub seed: u64,
    pub like: *const ks_body_definition,
}

impl ks_motion_definition {
    /// The defaults of the library.
    pub fn new() -> Self {
        let mut made = std::mem::MaybeUninit::<Self>::zeroed();
        // It fails for a library with another layout only, and then leaves the size 0, which is refused.
        unsafe {
            ks_motion_definition_init(made.as_mut_ptr(), std::mem::size_of::<Self>() as u32);
            made.assume_init()
        }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_prediction {
    pub time: f64,
    pub partner: BodyId,
    pub wall: i32,
    pub happens: i32,
    pub probed: i32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_hit {
    pub body: BodyId,
    pub certain: i32,
    pub lower: f64,
    pub upper: f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ks_replay {
    pub value: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ks_monitor {
    pub value: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_error_bound {
    pub kind: i32,
    pub horizontal: f64,
    pub vertical: f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_track_class {
    pub acceleration_limit: ks_error_bound,
    pub largest_speed: ks_error_bound,
    pub planned_acceleration: Vec3,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_separation {
    pub shape: i32,
    pub horizontal: f64,
    pub vertical: f64,
    pub look_ahead: f64,
    pub modified_tau: f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ks_separation_rule {
    pub first_class: usize,
    pub second_class: usize,
    pub levels: *const ks_separation,
    pub level_count: usize,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ks_monitor_definition {
    pub struct_size: u32,
    pub dimensions: i32,
    pub has_start_time: i32,
    pub start_time: f64,
    pub classes: *const ks_track_class,
    pub class_count: usize,
    pub separations: *const ks_separation_rule,
    pub separation_count: usize,
    pub tolerance: f64,
    pub time_resolution: f64,
    pub window: f64,
    pub stale_after: f64,
    pub drop_after: f64,
    pub prediction_hold: f64,
    pub prediction_confirmation: f64,
    pub prediction_margin: f64,
    pub prediction_error_part: f64,
    pub shard_of: u64,
    pub shard_first: u64,
    pub shard_count: u64,
}

impl ks_monitor_definition {
    /// The defaults of the library.
    pub fn new() -> Self {
        let mut made = std::mem::MaybeUninit::<Self>::zeroed();
        // It fails for a library with another layout only, and then leaves the size 0, which is refused.
        unsafe {
            ks_monitor_definition_init(made.as_mut_ptr(), std::mem::size_of::<Self>() as u32);
            made.assume_init()
        }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_track_report {
    pub struct_size: u32,
    pub has_plan: i32,
    pub track_class: u64,
    pub timestamp: f64,
    pub timestamp_error: f64,
    pub state: State,
    pub position_error: ks_error_bound,
    pub velocity_error: ks_error_bound,
    pub plan_acceleration: Vec3,
    pub plan_limit: ks_error_bound,
    pub plan_valid_until: f64,
}

impl ks_track_report {
    /// The defaults of the library.
    pub fn new() -> Self {
        let mut made = std::mem::MaybeUninit::<Self>::zeroed();
        // It fails for a library with another layout only, and then leaves the size 0, which is refused.
        unsafe {
            ks_track_report_init(made.as_mut_ptr(), std::mem::size_of::<Self>() as u32);
            made.assume_init()
        }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_monitor_event {
    pub struct_size: u32,
    pub kind: i32,
    pub time: f64,
    pub first: u64,
    pub second: u64,
    pub level: u32,
    pub verdict: i32,
    pub before: i32,
    pub reserved: u32,
    pub since: f64,
    pub likely_time: f64,
    pub closest_time: f64,
    pub closest_distance: f64,
    pub position_excess: f64,
    pub velocity_excess: f64,
}

impl ks_monitor_event {
    /// All zeros, with its size: to be filled.
    pub fn new() -> Self {
        Self { struct_size: std::mem::size_of::<Self>() as u32, ..Default::default() }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_pair_answer {
    pub struct_size: u32,
    pub verdict: i32,
    pub predicted: i32,
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

impl ks_pair_answer {
    /// All zeros, with its size: to be filled.
    pub fn new() -> Self {
        Self { struct_size: std::mem::size_of::<Self>() as u32, ..Default::default() }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_open_pair {
    pub first: u64,
    pub second: u64,
    pub level: u32,
    pub verdict: i32,
    pub since: f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_predicted_pair {
    pub first: u64,
    pub second: u64,
    pub level: u32,
    pub since: f64,
    pub likely_time: f64,
    pub closest_time: f64,
    pub closest_distance: f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_report_request {
    pub track: u64,
    pub other: u64,
    pub by: f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct ks_track_place {
    pub centre: Vec3,
    pub velocity: Vec3,
    pub radius: ks_error_bound,
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(std::mem::size_of::<BodyId>() == 12);
    assert!(std::mem::size_of::<Vec3>() == 24);
    assert!(std::mem::size_of::<State>() == 48);
    assert!(std::mem::size_of::<Box3>() == 48);
    assert!(std::mem::size_of::<ks_shape>() == 88);
    assert!(std::mem::size_of::<ks_mesh>() == 8);
    assert!(std::mem::size_of::<ks_world>() == 8);
    assert!(std::mem::size_of::<ks_filter>() == 24);
    assert!(std::mem::size_of::<ks_world_definition>() == 152);
    assert!(std::mem::size_of::<ks_body_definition>() == 160);
    assert!(std::mem::size_of::<ks_static_definition>() == 136);
    assert!(std::mem::size_of::<Quaternion>() == 32);
    assert!(std::mem::size_of::<Rotation>() == 56);
    assert!(std::mem::size_of::<RigidPart>() == 56);
    assert!(std::mem::size_of::<ks_rigid_hull>() == 24);
    assert!(std::mem::size_of::<ks_rigid_definition>() == 136);
    assert!(std::mem::size_of::<ks_motion_limits>() == 48);
    assert!(std::mem::size_of::<ks_body_view>() == 264);
    assert!(std::mem::size_of::<ks_sensor_overlap>() == 24);
    assert!(std::mem::size_of::<ks_timings>() == 24);
    assert!(std::mem::size_of::<ks_busy_body>() == 88);
    assert!(std::mem::size_of::<ks_event>() == 400);
    assert!(std::mem::size_of::<ks_response>() == 144);
    assert!(std::mem::size_of::<ks_roughness>() == 40);
    assert!(std::mem::size_of::<ks_step_potential>() == 8);
    assert!(std::mem::size_of::<ks_step_potential_definition>() == 48);
    assert!(std::mem::size_of::<ks_event_hash>() == 16);
    assert!(std::mem::size_of::<ks_run_definition>() == 56);
    assert!(std::mem::size_of::<ks_game_definition>() == 64);
    assert!(std::mem::size_of::<ks_event_list>() == 16);
    assert!(std::mem::size_of::<ks_body_list>() == 32);
    assert!(std::mem::size_of::<ks_motion_definition>() == 104);
    assert!(std::mem::size_of::<ks_prediction>() == 32);
    assert!(std::mem::size_of::<ks_hit>() == 32);
    assert!(std::mem::size_of::<Sphere>() == 32);
    assert!(std::mem::size_of::<Ray>() == 64);
    assert!(std::mem::size_of::<ks_replay>() == 8);
    assert!(std::mem::size_of::<ks_monitor>() == 8);
    assert!(std::mem::size_of::<ks_error_bound>() == 24);
    assert!(std::mem::size_of::<ks_track_class>() == 72);
    assert!(std::mem::size_of::<ks_separation>() == 40);
    assert!(std::mem::size_of::<ks_separation_rule>() == 32);
    assert!(std::mem::size_of::<ks_monitor_definition>() == 152);
    assert!(std::mem::size_of::<ks_track_report>() == 184);
    assert!(std::mem::size_of::<ks_monitor_event>() == 96);
    assert!(std::mem::size_of::<ks_pair_answer>() == 128);
    assert!(std::mem::size_of::<ks_open_pair>() == 32);
    assert!(std::mem::size_of::<ks_predicted_pair>() == 56);
    assert!(std::mem::size_of::<ks_report_request>() == 24);
    assert!(std::mem::size_of::<ks_track_place>() == 72);
};

extern "C" {
    pub fn ks_last_error_message() -> *const c_char;
    pub fn ks_last_error_argument() -> *const c_char;
    pub fn ks_last_error_body() -> BodyId;
    pub fn ks_last_error_callback() -> i32;
    pub fn ks_status_name(status: ks_status) -> *const c_char;
    pub fn ks_version() -> *const c_char;
    pub fn ks_abi_version() -> u32;
    pub fn ks_mesh_create(vertices: *const Vec3, vertex_count: usize, corners: *const u32, triangle_count: usize, mesh: *mut ks_mesh) -> ks_status;
    pub fn ks_mesh_create_chain(points: *const Vec3, count: usize, mesh: *mut ks_mesh) -> ks_status;
    pub fn ks_mesh_destroy(mesh: ks_mesh) -> ks_status;
    pub fn ks_world_definition_init(definition: *mut ks_world_definition, struct_size: u32) -> ks_status;
    pub fn ks_body_definition_init(definition: *mut ks_body_definition, struct_size: u32) -> ks_status;
    pub fn ks_static_definition_init(definition: *mut ks_static_definition, struct_size: u32) -> ks_status;
    pub fn ks_rigid_definition_init(definition: *mut ks_rigid_definition, struct_size: u32) -> ks_status;
    pub fn ks_world_create(definition: *const ks_world_definition, world: *mut ks_world) -> ks_status;
    pub fn ks_world_destroy(world: ks_world) -> ks_status;
    pub fn ks_world_clone(world: ks_world, copy: *mut ks_world) -> ks_status;
    pub fn ks_world_save(world: ks_world, bytes: *mut u8, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_world_restore(bytes: *const u8, count: usize, filter: Option<ks_pair_filter>, user: *mut c_void, world: *mut ks_world) -> ks_status;
    pub fn ks_world_add(world: ks_world, bodies: *const ks_body_definition, count: usize, ids: *mut BodyId) -> ks_status;
    pub fn ks_world_add_static(world: ks_world, bodies: *const ks_static_definition, count: usize, ids: *mut BodyId) -> ks_status;
    pub fn ks_world_add_moving_shape(world: ks_world, body: *const ks_body_definition, shape: *const ks_shape, id: *mut BodyId) -> ks_status;
    pub fn ks_world_add_rigid_body(world: ks_world, body: *const ks_body_definition, rigid: *const ks_rigid_definition, id: *mut BodyId) -> ks_status;
    pub fn ks_world_add_zone(world: ks_world, shape: *const ks_shape, user_data: u64, id: *mut BodyId) -> ks_status;
    pub fn ks_world_reserve(world: ks_world, bodies: usize) -> ks_status;
    pub fn ks_world_remove(world: ks_world, bodies: *const BodyId, count: usize) -> ks_status;
    pub fn ks_world_set_velocity(world: ks_world, body: BodyId, velocity: Vec3) -> ks_status;
    pub fn ks_world_set_velocities(world: ks_world, bodies: *const BodyId, velocities: *const Vec3, count: usize) -> ks_status;
    pub fn ks_world_set_angular_velocity(world: ks_world, body: BodyId, angular_velocity: Vec3) -> ks_status;
    pub fn ks_world_set_rotation(world: ks_world, body: BodyId, rotation: *const Rotation) -> ks_status;
    pub fn ks_world_set_rotation_probe(world: ks_world, probe: Option<ks_rotation_probe>, user: *mut c_void) -> ks_status;
    pub fn ks_world_teleport(world: ks_world, body: BodyId, state: *const State) -> ks_status;
    pub fn ks_world_set_radius(world: ks_world, body: BodyId, radius: f64) -> ks_status;
    pub fn ks_world_set_radius_rate(world: ks_world, body: BodyId, rate: f64) -> ks_status;
    pub fn ks_world_set_mass(world: ks_world, body: BodyId, mass: f64) -> ks_status;
    pub fn ks_world_set_motion_limits(world: ks_world, body: BodyId, limits: *const ks_motion_limits) -> ks_status;
    pub fn ks_world_set_shape(world: ks_world, body: BodyId, shape: *const ks_shape) -> ks_status;
    pub fn ks_world_disable(world: ks_world, body: BodyId) -> ks_status;
    pub fn ks_world_enable(world: ks_world, body: BodyId, state: *const State) -> ks_status;
    pub fn ks_world_sleep(world: ks_world, body: BodyId) -> ks_status;
    pub fn ks_world_wake(world: ks_world, body: BodyId) -> ks_status;
    pub fn ks_world_set_user_data(world: ks_world, body: BodyId, data: u64) -> ks_status;
    pub fn ks_world_set_filter(world: ks_world, body: BodyId, filter: *const ks_filter) -> ks_status;
    pub fn ks_world_set_pair_filter(world: ks_world, filter: Option<ks_pair_filter>, user: *mut c_void) -> ks_status;
    pub fn ks_world_refresh_filter(world: ks_world, body: BodyId) -> ks_status;
    pub fn ks_world_set_solid(world: ks_world, body: BodyId, solid: i32) -> ks_status;
    pub fn ks_world_set_sensor(world: ks_world, sensor_class: i32, distances: *const f64, count: usize, mask: u64) -> ks_status;
    pub fn ks_world_set_sensor_class(world: ks_world, body: BodyId, sensor_class: i32) -> ks_status;
    pub fn ks_world_time(world: ks_world, time: *mut f64) -> ks_status;
    pub fn ks_world_size(world: ks_world, bodies: *mut usize) -> ks_status;
    pub fn ks_world_contains(world: ks_world, body: BodyId, contains: *mut i32) -> ks_status;
    pub fn ks_world_body(world: ks_world, body: BodyId, view: *mut ks_body_view) -> ks_status;
    pub fn ks_world_rotation(world: ks_world, body: BodyId, rotation: *mut Rotation) -> ks_status;
    pub fn ks_world_bodies(world: ks_world, bodies: *mut BodyId, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_world_touching(world: ks_world, body: BodyId, partners: *mut BodyId, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_world_sensor_overlaps(world: ks_world, body: BodyId, overlaps: *mut ks_sensor_overlap, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_world_probe_count(world: ks_world, probes: *mut u64) -> ks_status;
    pub fn ks_world_set_profiling(world: ks_world, on: i32) -> ks_status;
    pub fn ks_world_timings(world: ks_world, timings: *mut ks_timings) -> ks_status;
    pub fn ks_world_busiest(world: ks_world, most: usize, bodies: *mut ks_busy_body, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_probe_reason_name(reason: i32) -> *const c_char;
    pub fn ks_probe_reason_advice(reason: i32) -> *const c_char;
    pub fn ks_event_kind_name(kind: i32) -> *const c_char;
    pub fn ks_bounce(event: *const ks_event, restitution: f64, resting_speed: f64, response: *mut ks_response) -> ks_status;
    pub fn ks_roughness_init(roughness: *mut ks_roughness, struct_size: u32) -> ks_status;
    pub fn ks_bounce_rough(event: *const ks_event, roughness: *const ks_roughness, response: *mut ks_response) -> ks_status;
    pub fn ks_step_potential_definition_init(definition: *mut ks_step_potential_definition, struct_size: u32) -> ks_status;
    pub fn ks_step_potential_create(world: ks_world, definition: *const ks_step_potential_definition, potential: *mut ks_step_potential) -> ks_status;
    pub fn ks_step_potential_destroy(potential: ks_step_potential) -> ks_status;
    pub fn ks_step_potential_respond(potential: ks_step_potential, event: *const ks_event, response: *mut ks_response) -> ks_status;
    pub fn ks_step_potential_energy(potential: ks_step_potential, gap: f64, energy: *mut f64) -> ks_status;
    pub fn ks_event_hash_add(hash: *mut ks_event_hash, event: *const ks_event) -> ks_status;
    pub fn ks_event_hash_value(hash: *const ks_event_hash, value: *mut u64) -> ks_status;
    pub fn ks_world_set_pair_state(world: ks_world, first: BodyId, second: BodyId, state: i32) -> ks_status;
    pub fn ks_world_pair_state(world: ks_world, first: BodyId, second: BodyId, state: *mut i32) -> ks_status;
    pub fn ks_world_turn_back(world: ks_world, crossing: *const ks_event) -> ks_status;
    pub fn ks_world_schedule(world: ks_world, time: f64, user_data: u64, period: f64) -> ks_status;
    pub fn ks_world_unschedule(world: ks_world, user_data: u64, count: *mut usize) -> ks_status;
    pub fn ks_probe_motions(bodies: *const BodyId, count: usize, time: f64, states: *mut State, user: *mut c_void) -> i32;
    pub fn ks_world_advance(world: ks_world, until: f64, probe: Option<ks_probe>, user: *mut c_void, event: *mut ks_event) -> ks_status;
    pub fn ks_run_definition_init(definition: *mut ks_run_definition, struct_size: u32) -> ks_status;
    pub fn ks_world_run(world: ks_world, until: f64, definition: *const ks_run_definition) -> ks_status;
    pub fn ks_world_use_threads(world: ks_world, threads: i32) -> ks_status;
    pub fn ks_game_definition_init(definition: *mut ks_game_definition, struct_size: u32) -> ks_status;
    pub fn ks_game_create(world: *const ks_world_definition, definition: *const ks_game_definition, game: *mut ks_world) -> ks_status;
    pub fn ks_game_restore(bytes: *const u8, count: usize, definition: *const ks_game_definition, filter: Option<ks_pair_filter>, user: *mut c_void, game: *mut ks_world) -> ks_status;
    pub fn ks_game_step(game: ks_world, dt: f64, happened: *mut ks_event_list) -> ks_status;
    pub fn ks_game_bodies(game: ks_world, found: *mut ks_body_list) -> ks_status;
    pub fn ks_game_index_of(game: ks_world, body: BodyId, index: *mut usize) -> ks_status;
    pub fn ks_game_set_response(game: ks_world, definition: *const ks_game_definition) -> ks_status;
    pub fn ks_game_set_velocities(game: ks_world, velocities: *const Vec3, count: usize) -> ks_status;
    pub fn ks_game_set_acceleration(game: ks_world, body: BodyId, acceleration: Vec3) -> ks_status;
    pub fn ks_game_set_gravity(game: ks_world, gravity: Vec3) -> ks_status;
    pub fn ks_game_gravity(game: ks_world, gravity: *mut Vec3) -> ks_status;
    pub fn ks_motion_definition_init(definition: *mut ks_motion_definition, struct_size: u32) -> ks_status;
    pub fn ks_world_add_motion(world: ks_world, definition: *const ks_motion_definition, motion: *mut u32, ids: *mut BodyId) -> ks_status;
    pub fn ks_world_add_to_motion(world: ks_world, motion: u32, definition: *const ks_motion_definition, numbers: *mut u32, ids: *mut BodyId) -> ks_status;
    pub fn ks_world_steer(world: ks_world, body: BodyId, acceleration: Vec3) -> ks_status;
    pub fn ks_world_push_frame(world: ks_world, motion: u32, positions: *const Vec3, count: usize) -> ks_status;
    pub fn ks_world_push_frame_at(world: ks_world, motion: u32, positions: *const Vec3, count: usize, time: f64) -> ks_status;
    pub fn ks_world_latest_frame(world: ks_world, motion: u32, positions: *mut Vec3, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_world_latest_frame_time(world: ks_world, motion: u32, time: *mut f64) -> ks_status;
    pub fn ks_world_states(world: ks_world, bodies: *const BodyId, count: usize, time: f64, states: *mut State) -> ks_status;
    pub fn ks_world_safe_until(world: ks_world, probe: Option<ks_probe>, user: *mut c_void, prediction: *mut ks_prediction) -> ks_status;
    pub fn ks_world_earliest_contact(world: ks_world, body: BodyId, probe: Option<ks_probe>, user: *mut c_void, prediction: *mut ks_prediction) -> ks_status;
    pub fn ks_world_earliest_approach(world: ks_world, body: BodyId, distance: f64, probe: Option<ks_probe>, user: *mut c_void, prediction: *mut ks_prediction) -> ks_status;
    pub fn ks_world_pair_safe_until(world: ks_world, first: BodyId, second: BodyId, distance: f64, probe: Option<ks_probe>, user: *mut c_void, prediction: *mut ks_prediction) -> ks_status;
    pub fn ks_world_distance_limits(world: ks_world, first: BodyId, second: BodyId, time: f64, probe: Option<ks_probe>, user: *mut c_void, lower: *mut f64, upper: *mut f64) -> ks_status;
    pub fn ks_world_overlapping_sphere(world: ks_world, centre: Vec3, radius: f64, probe: Option<ks_probe>, user: *mut c_void, hits: *mut ks_hit, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_world_overlapping_box(world: ks_world, box_: *const Box3, probe: Option<ks_probe>, user: *mut c_void, hits: *mut ks_hit, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_world_nearest(world: ks_world, point: Vec3, bodies: usize, probe: Option<ks_probe>, user: *mut c_void, hits: *mut ks_hit, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_world_cast(world: ks_world, origin: Vec3, direction: Vec3, length: f64, radius: f64, probe: Option<ks_probe>, user: *mut c_void, hits: *mut ks_hit, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_world_overlapping_all(world: ks_world, spheres: *const Sphere, except_ids: *const BodyId, queries: usize, filter: *const ks_filter, probe: Option<ks_probe>, user: *mut c_void, ends: *mut usize, hits: *mut ks_hit, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_world_nearest_all(world: ks_world, points: *const Vec3, except_ids: *const BodyId, queries: usize, bodies: usize, filter: *const ks_filter, probe: Option<ks_probe>, user: *mut c_void, ends: *mut usize, hits: *mut ks_hit, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_world_cast_all(world: ks_world, rays: *const Ray, except_ids: *const BodyId, queries: usize, filter: *const ks_filter, probe: Option<ks_probe>, user: *mut c_void, ends: *mut usize, hits: *mut ks_hit, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_world_start_recording(world: ks_world) -> ks_status;
    pub fn ks_world_stop_recording(world: ks_world) -> ks_status;
    pub fn ks_world_recording(world: ks_world, bytes: *mut u8, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_replay_open(bytes: *const u8, count: usize, filter: Option<ks_pair_filter>, user: *mut c_void, replay: *mut ks_replay) -> ks_status;
    pub fn ks_replay_destroy(replay: ks_replay) -> ks_status;
    pub fn ks_replay_advance(replay: ks_replay, event: *mut ks_event) -> ks_status;
    pub fn ks_replay_finished(replay: ks_replay, finished: *mut i32) -> ks_status;
    pub fn ks_replay_steps(replay: ks_replay, repeated: *mut usize, total: *mut usize) -> ks_status;
    pub fn ks_replay_hash(replay: ks_replay, hash: *mut u64) -> ks_status;
    pub fn ks_replay_world(replay: ks_replay, copy: *mut ks_world) -> ks_status;
    pub fn ks_monitor_definition_init(definition: *mut ks_monitor_definition, struct_size: u32) -> ks_status;
    pub fn ks_track_report_init(report: *mut ks_track_report, struct_size: u32) -> ks_status;
    pub fn ks_monitor_event_kind_name(kind: i32) -> *const c_char;
    pub fn ks_verdict_name(verdict: i32) -> *const c_char;
    pub fn ks_monitor_create(definition: *const ks_monitor_definition, monitor: *mut ks_monitor) -> ks_status;
    pub fn ks_monitor_destroy(monitor: ks_monitor) -> ks_status;
    pub fn ks_monitor_save(monitor: ks_monitor, bytes: *mut u8, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_monitor_restore(bytes: *const u8, count: usize, monitor: *mut ks_monitor) -> ks_status;
    pub fn ks_monitor_report(monitor: ks_monitor, tracks: *const u64, reports: *const ks_track_report, count: usize) -> ks_status;
    pub fn ks_monitor_remove(monitor: ks_monitor, track: u64) -> ks_status;
    pub fn ks_monitor_advance(monitor: ks_monitor, until: f64, poll: Option<ks_poll>, user: *mut c_void, event: *mut ks_monitor_event) -> ks_status;
    pub fn ks_monitor_time(monitor: ks_monitor, time: *mut f64) -> ks_status;
    pub fn ks_monitor_tracks(monitor: ks_monitor, tracks: *mut u64, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_monitor_places(monitor: ks_monitor, track: u64, places: *mut ks_track_place, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_monitor_answer(monitor: ks_monitor, first: u64, second: u64, level: u32, answer: *mut ks_pair_answer) -> ks_status;
    pub fn ks_monitor_open_pairs(monitor: ks_monitor, pairs: *mut ks_open_pair, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_monitor_predicted_pairs(monitor: ks_monitor, pairs: *mut ks_predicted_pair, capacity: usize, count: *mut usize) -> ks_status;
    pub fn ks_monitor_needed(monitor: ks_monitor, until: f64, requests: *mut ks_report_request, capacity: usize, count: *mut usize) -> ks_status;
}
