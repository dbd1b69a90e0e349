// Kinesphere: finds every collision among moving spheres with trajectories that are unknown in advance.
export { KinesphereError, load, type LoadOptions, usesSimd, version } from "./module.js";
export type { BodyId, PerBody, State, States, Vec3 } from "./state.js";
export { Event, EventHash, Events } from "./event.js";
export {
  Ballistic, type BallisticOptions, FrameMotion, type FrameMotionOptions, type FrameViolation, type LimitedMotion, Motion,
  type MotionDefinition, RandomForces, type RandomForcesOptions, RecordedTracks, SteeredMotion, type Track,
} from "./motion.js";
export {
  bounce, type Bounce, type BounceOptions, type Bounces, type Roughness, StepPotential, type StepPotentialDefinition,
} from "./response.js";
export type { AnswerOptions, Limits, PairOptions, QueriesOptions, QueryOptions } from "./answers.js";
export type { Answer, Probe, ProbeFunction, RespondFunction, RunOptions } from "./asking.js";
export type {
  BodyBatch, BodyDefinition, BodyOptions, MeshShape, MovedBodyDefinition, MovedOptions, Shape, ShapeCarrier,
  StaticOptions, ZoneOptions,
} from "./body.js";
export type {
  MovedRigidBodyDefinition, Quaternion, RigidBodyDefinition, RigidPart, Rotation, RotationProbeFunction, Turning,
} from "./rigid_body.js";
export { BodyMap } from "./body_map.js";
export {
  type BodyView, type BusyBody, type Certain, type Counters, type Earliest, type Located, World, WorldView,
} from "./world.js";
export { type GameOptions, GameWorld } from "./game_world.js";
export type { Box, Definition, WorldDefinition } from "./definition.js";
export type { Filter, PairFilter } from "./filter.js";
export { Scene, sceneNames, type SceneSettings } from "./scene.js";
export { Replay } from "./replay.js";
export {
  Monitor, type MonitorCounters, type Poll, type TrackPlace, type TrackView,
} from "./monitor.js";
export type {
  FullMonitorDefinition, LookAhead, MonitorDefinition, Separation, SeparationRule, Shard, SphereSeparation, TrackClass,
  VolumeSeparation, WellClearSeparation,
} from "./monitor_definition.js";
export { MonitorEvent, MonitorEvents } from "./monitor_event.js";
export type { ErrorBound, ErrorBounds } from "./error_bound.js";
export type { Plan, PlanBatch, ReportBatch, TrackReport } from "./report.js";
export {
  type BodyAction, type BodyTraits, type ContactEvents, type ErrorCode, type EventKind, eventKinds, type MonitorEventKind,
  monitorEventKinds, type MotionLimits, type OpenPair, type PairAnswer, type PredictedPair, type ProbeReason, type ReportRequest,
  type Timings, type TrackId, type Verdict, type Wall,
} from "./records.js";
