"""Finds every collision among moving spheres whose trajectories nobody knows in advance.

    import numpy as np
    from kinesphere import Bouncing, RandomForces, World

    positions = np.random.default_rng(1).uniform(2, 98, (300, 3))
    motion = RandomForces(positions, acceleration_limits=20.0)
    world = World(box=((0, 0, 0), (100, 100, 100)))
    world.add_motion(motion, radii=1.0)
    events = world.run(10.0, motion, Bouncing())

Each body promises a bound on its acceleration, and nothing else is known of it. The world asks for states
only when that can matter, and tells each contact at its exact time. There is no time step, and nothing is
missed between two of them.
"""

from ._kinesphere import (
    Ball,
    Ballistic,
    BodyMap,
    BodyView,
    Bouncing,
    Box,
    BusyBody,
    Capsule,
    Circulation,
    Counters,
    DistanceLimits,
    EarliestApproach,
    EarliestContact,
    ErrorBound,
    Event,
    EventHash,
    EventIterator,
    FrameMotion,
    HalfSpace,
    Monitor,
    MonitorCounters,
    MonitorEvent,
    MonitorEventIterator,
    Motion,
    MotionSource,
    PairAnswer,
    RandomForces,
    RecordedTracks,
    Replay,
    SafeSeparation,
    SafeTime,
    Scene,
    Separation,
    SeparationRule,
    Shard,
    SteeredMotion,
    TrackClass,
    TrackPlace,
    TrackView,
    Triangle,
    VelocityField,
    Workers,
    World,
    bounce,
    bounce_rigid,
    event_dtype,
    least_resting_speed,
    monitor_event_dtype,
    no_body,
    pair_answer_dtype,
    place_spheres,
    scene_names,
    settle,
    zone_class,
)
from ._kinesphere import version as __version__
from .approaches import Approaches, tracks
from .errors import BodyError, InvalidValue, KinesphereError, StateError
from .events import Events, MonitorEvents
from .ids import BodyId, index_of
from .kinds import EventKind, MonitorEventKind, Senses, Verdict, Wall
from .paths import PathApproaches, PolynomialPaths
from .recordings import RecordedRun, read_recording
from .scene_files import read_scene
from .streams import Alerts, watch
from .track_files import tracks_in

__all__ = [
    "Alerts",
    "Approaches",
    "Ball",
    "Ballistic",
    "BodyError",
    "BodyId",
    "BodyMap",
    "BodyView",
    "Bouncing",
    "Box",
    "BusyBody",
    "Capsule",
    "Circulation",
    "Counters",
    "DistanceLimits",
    "EarliestApproach",
    "EarliestContact",
    "ErrorBound",
    "Event",
    "EventHash",
    "EventIterator",
    "EventKind",
    "Events",
    "FrameMotion",
    "HalfSpace",
    "InvalidValue",
    "KinesphereError",
    "Monitor",
    "MonitorCounters",
    "MonitorEvent",
    "MonitorEventIterator",
    "MonitorEventKind",
    "MonitorEvents",
    "Motion",
    "MotionSource",
    "PairAnswer",
    "PathApproaches",
    "PolynomialPaths",
    "RandomForces",
    "RecordedRun",
    "RecordedTracks",
    "Replay",
    "SafeSeparation",
    "SafeTime",
    "Scene",
    "Senses",
    "Separation",
    "SeparationRule",
    "Shard",
    "StateError",
    "SteeredMotion",
    "TrackClass",
    "TrackPlace",
    "TrackView",
    "Triangle",
    "VelocityField",
    "Verdict",
    "Wall",
    "Workers",
    "World",
    "__version__",
    "bounce",
    "bounce_rigid",
    "event_dtype",
    "index_of",
    "least_resting_speed",
    "monitor_event_dtype",
    "no_body",
    "pair_answer_dtype",
    "place_spheres",
    "read_recording",
    "read_scene",
    "scene_names",
    "settle",
    "tracks",
    "tracks_in",
    "watch",
    "zone_class",
]
