// Generated from include/kinesphere.h by interface/generate.py: change the header, and run that.
// The functions of kinesphere.h, which explains them, and its records with pointers.
using System;
using System.Runtime.InteropServices;

// Some fields are for C alone.
#pragma warning disable 169, 414, 649

namespace Kinesphere
{
    unsafe static partial class Native
    {
        public enum BoundKind
        {
            Ball = 0,
            Cylinder = 1,
        }

        public enum MotionKind
        {
            /// <summary>Free flight under `gravity`.</summary>
            Ballistic = 0,
            /// <summary>Random accelerations up to AccelerationLimits, new at multiples of `interval`.</summary>
            RandomForces = 1,
            /// <summary>A game's frames: each body goes straight from its position in one frame to that in the
            /// next.</summary>
            Frames = 2,
            Steered = 3,
        }

        public enum ShapeKind
        {
            Ball = 0,
            HalfSpace = 1,
            Box = 2,
            Triangle = 3,
            Mesh = 4,
        }

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        public delegate int RotationProbe(BodyId* bodies, UIntPtr count, double time, Rotation* rotations, IntPtr user);
        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        public delegate int PairFilter(BodyId first, BodyId second, IntPtr user);
        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        public delegate int Probe(BodyId* bodies, UIntPtr count, double time, State* states, IntPtr user);
        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        public delegate int Respond(Event* @event, Response* response, IntPtr user);
        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        public delegate int Sink(Event* @event, IntPtr user);
        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        public delegate int Poll(ulong* tracks, UIntPtr count, double time, TrackReport* reports, byte* hasReport, IntPtr user);

        [StructLayout(LayoutKind.Sequential)]
        public struct Box
        {
            public Vector Lower;
            public Vector Upper;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct Hull
        {
            public UIntPtr PointCount;
            public Vector* Points;
            public double Radius;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct RunDefinition
        {
            public uint structSize;
            public int Threads;
            public double Restitution;
            public double RestingSpeed;
            public IntPtr Respond;
            public IntPtr RespondUser;
            public IntPtr Sink;
            public IntPtr SinkUser;
            public static RunDefinition Default
            {
                get
                {
                    RunDefinition made;
                    Native.Check(Native.ks_run_definition_init(out made, Native.SizeOf<RunDefinition>()));
                    return made;
                }
            }
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct GameDefinition
        {
            public uint structSize;
            public int Reserved;
            public Vector Gravity;
            public double Restitution;
            public double RestingSpeed;
            public IntPtr Respond;
            public IntPtr RespondUser;
            public static GameDefinition Default
            {
                get
                {
                    GameDefinition made;
                    Native.Check(Native.ks_game_definition_init(out made, Native.SizeOf<GameDefinition>()));
                    return made;
                }
            }
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct StepPotentialDefinition
        {
            public uint structSize;
            public int Reserved;
            public UIntPtr Count;
            public double* Distances;
            public double* Energies;
            public double Outside;
            public double Restitution;
            public static StepPotentialDefinition Default
            {
                get
                {
                    StepPotentialDefinition made;
                    Native.Check(Native.ks_step_potential_definition_init(out made, Native.SizeOf<StepPotentialDefinition>()));
                    return made;
                }
            }
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct EventList
        {
            public UIntPtr Count;
            public Event* Events;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct BodyList
        {
            public UIntPtr Count;
            public BodyId* Ids;
            public Vector* Positions;
            public Vector* Velocities;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct MotionDefinition
        {
            public uint structSize;
            public MotionKind Kind;
            public UIntPtr Count;
            public State* States;
            public double* Radii;
            public double* Masses;
            public double* AccelerationLimits;
            public Vector Gravity;
            public double Interval;
            public double PositionError;
            public ulong Seed;
            public BodyDefinition* Like;
            public static MotionDefinition Default
            {
                get
                {
                    MotionDefinition made;
                    Native.Check(Native.ks_motion_definition_init(out made, Native.SizeOf<MotionDefinition>()));
                    return made;
                }
            }
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct SeparationRule
        {
            public UIntPtr FirstClass;
            public UIntPtr SecondClass;
            public Separation* Levels;
            public UIntPtr LevelCount;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct MonitorDefinition
        {
            public uint structSize;
            public int Dimensions;
            public int HasStartTime;
            public double StartTime;
            public TrackClass* Classes;
            public UIntPtr ClassCount;
            public SeparationRule* Separations;
            public UIntPtr SeparationCount;
            public double Tolerance;
            public double TimeResolution;
            public double Window;
            public double StaleAfter;
            public double DropAfter;
            public double PredictionHold;
            public double PredictionConfirmation;
            public double PredictionMargin;
            public double PredictionErrorPart;
            public ulong ShardOf;
            public ulong ShardFirst;
            public ulong ShardCount;
            public static MonitorDefinition Default
            {
                get
                {
                    MonitorDefinition made;
                    Native.Check(Native.ks_monitor_definition_init(out made, Native.SizeOf<MonitorDefinition>()));
                    return made;
                }
            }
        }

        [DllImport(library)]
        public static extern IntPtr ks_last_error_message();
        [DllImport(library)]
        public static extern IntPtr ks_last_error_argument();
        [DllImport(library)]
        public static extern BodyId ks_last_error_body();
        [DllImport(library)]
        public static extern int ks_last_error_callback();
        [DllImport(library)]
        public static extern IntPtr ks_status_name(int status);
        [DllImport(library)]
        public static extern IntPtr ks_version();
        [DllImport(library)]
        public static extern uint ks_abi_version();
        [DllImport(library)]
        public static extern int ks_mesh_create(Vector[] vertices, UIntPtr vertexCount, uint[] corners, UIntPtr triangleCount, out ulong mesh);
        [DllImport(library)]
        public static extern int ks_mesh_create_chain(Vector[] points, UIntPtr count, out ulong mesh);
        [DllImport(library)]
        public static extern int ks_mesh_destroy(ulong mesh);
        [DllImport(library)]
        public static extern int ks_world_definition_init(out WorldDefinition definition, uint structSize);
        [DllImport(library)]
        public static extern int ks_body_definition_init(out BodyDefinition definition, uint structSize);
        [DllImport(library)]
        public static extern int ks_static_definition_init(out StaticDefinition definition, uint structSize);
        [DllImport(library)]
        public static extern int ks_rigid_definition_init(out RigidDefinition definition, uint structSize);
        [DllImport(library)]
        public static extern int ks_world_create(ref WorldDefinition definition, out ulong world);
        [DllImport(library)]
        public static extern int ks_world_destroy(ulong world);
        [DllImport(library)]
        public static extern int ks_world_clone(ulong world, out ulong copy);
        [DllImport(library)]
        public static extern int ks_world_save(ulong world, [Out] byte[] bytes, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_restore(byte[] bytes, UIntPtr count, PairFilter filter, IntPtr user, out ulong world);
        [DllImport(library)]
        public static extern int ks_world_add(ulong world, BodyDefinition[] bodies, UIntPtr count, [Out] BodyId[] ids);
        [DllImport(library)]
        public static extern int ks_world_add_static(ulong world, StaticDefinition[] bodies, UIntPtr count, [Out] BodyId[] ids);
        [DllImport(library)]
        public static extern int ks_world_add_moving_shape(ulong world, ref BodyDefinition body, ref Shape shape, out BodyId id);
        [DllImport(library)]
        public static extern int ks_world_add_rigid_body(ulong world, ref BodyDefinition body, ref RigidDefinition rigid, out BodyId id);
        [DllImport(library)]
        public static extern int ks_world_add_zone(ulong world, ref Shape shape, ulong userData, out BodyId id);
        [DllImport(library)]
        public static extern int ks_world_reserve(ulong world, UIntPtr bodies);
        [DllImport(library)]
        public static extern int ks_world_remove(ulong world, BodyId[] bodies, UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_set_velocity(ulong world, BodyId body, Vector velocity);
        [DllImport(library)]
        public static extern int ks_world_set_velocities(ulong world, BodyId[] bodies, Vector[] velocities, UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_set_angular_velocity(ulong world, BodyId body, Vector angularVelocity);
        [DllImport(library)]
        public static extern int ks_world_set_rotation(ulong world, BodyId body, ref Rotation rotation);
        [DllImport(library)]
        public static extern int ks_world_set_rotation_probe(ulong world, RotationProbe probe, IntPtr user);
        [DllImport(library)]
        public static extern int ks_world_teleport(ulong world, BodyId body, ref State state);
        [DllImport(library)]
        public static extern int ks_world_set_radius(ulong world, BodyId body, double radius);
        [DllImport(library)]
        public static extern int ks_world_set_radius_rate(ulong world, BodyId body, double rate);
        [DllImport(library)]
        public static extern int ks_world_set_mass(ulong world, BodyId body, double mass);
        [DllImport(library)]
        public static extern int ks_world_set_motion_limits(ulong world, BodyId body, ref MotionLimits limits);
        [DllImport(library)]
        public static extern int ks_world_set_shape(ulong world, BodyId body, ref Shape shape);
        [DllImport(library)]
        public static extern int ks_world_disable(ulong world, BodyId body);
        [DllImport(library)]
        public static extern int ks_world_enable(ulong world, BodyId body, ref State state);
        [DllImport(library)]
        public static extern int ks_world_sleep(ulong world, BodyId body);
        [DllImport(library)]
        public static extern int ks_world_wake(ulong world, BodyId body);
        [DllImport(library)]
        public static extern int ks_world_set_user_data(ulong world, BodyId body, ulong data);
        [DllImport(library)]
        public static extern int ks_world_set_filter(ulong world, BodyId body, ref Filter filter);
        [DllImport(library)]
        public static extern int ks_world_set_pair_filter(ulong world, PairFilter filter, IntPtr user);
        [DllImport(library)]
        public static extern int ks_world_refresh_filter(ulong world, BodyId body);
        [DllImport(library)]
        public static extern int ks_world_set_solid(ulong world, BodyId body, int solid);
        [DllImport(library)]
        public static extern int ks_world_set_sensor(ulong world, int sensorClass, double[] distances, UIntPtr count, ulong mask);
        [DllImport(library)]
        public static extern int ks_world_set_sensor_class(ulong world, BodyId body, int sensorClass);
        [DllImport(library)]
        public static extern int ks_world_time(ulong world, out double time);
        [DllImport(library)]
        public static extern int ks_world_size(ulong world, out UIntPtr bodies);
        [DllImport(library)]
        public static extern int ks_world_contains(ulong world, BodyId body, out int contains);
        [DllImport(library)]
        public static extern int ks_world_body(ulong world, BodyId body, ref BodyView view);
        [DllImport(library)]
        public static extern int ks_world_rotation(ulong world, BodyId body, out Rotation rotation);
        [DllImport(library)]
        public static extern int ks_world_bodies(ulong world, [Out] BodyId[] bodies, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_touching(ulong world, BodyId body, [Out] BodyId[] partners, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_sensor_overlaps(ulong world, BodyId body, [Out] SensorOverlap[] overlaps, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_probe_count(ulong world, out ulong probes);
        [DllImport(library)]
        public static extern int ks_world_set_profiling(ulong world, int on);
        [DllImport(library)]
        public static extern int ks_world_timings(ulong world, out Timings timings);
        [DllImport(library)]
        public static extern int ks_world_busiest(ulong world, UIntPtr most, [Out] BusyBody[] bodies, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern IntPtr ks_probe_reason_name(ProbeReason reason);
        [DllImport(library)]
        public static extern IntPtr ks_probe_reason_advice(ProbeReason reason);
        [DllImport(library)]
        public static extern IntPtr ks_event_kind_name(EventKind kind);
        [DllImport(library)]
        public static extern int ks_bounce(ref Event @event, double restitution, double restingSpeed, ref Response response);
        [DllImport(library)]
        public static extern int ks_roughness_init(out Roughness roughness, uint structSize);
        [DllImport(library)]
        public static extern int ks_bounce_rough(ref Event @event, ref Roughness roughness, ref Response response);
        [DllImport(library)]
        public static extern int ks_step_potential_definition_init(out StepPotentialDefinition definition, uint structSize);
        [DllImport(library)]
        public static extern int ks_step_potential_create(ulong world, ref StepPotentialDefinition definition, out ulong potential);
        [DllImport(library)]
        public static extern int ks_step_potential_destroy(ulong potential);
        [DllImport(library)]
        public static extern int ks_step_potential_respond(ulong potential, ref Event @event, ref Response response);
        [DllImport(library)]
        public static extern int ks_step_potential_energy(ulong potential, double gap, out double energy);
        [DllImport(library)]
        public static extern int ks_event_hash_add(ref EventHash hash, ref Event @event);
        [DllImport(library)]
        public static extern int ks_event_hash_value(ref EventHash hash, out ulong value);
        [DllImport(library)]
        public static extern int ks_world_set_pair_state(ulong world, BodyId first, BodyId second, int state);
        [DllImport(library)]
        public static extern int ks_world_pair_state(ulong world, BodyId first, BodyId second, out int state);
        [DllImport(library)]
        public static extern int ks_world_turn_back(ulong world, ref Event crossing);
        [DllImport(library)]
        public static extern int ks_world_schedule(ulong world, double time, ulong userData, double period);
        [DllImport(library)]
        public static extern int ks_world_unschedule(ulong world, ulong userData, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_probe_motions(BodyId* bodies, UIntPtr count, double time, State* states, IntPtr user);
        [DllImport(library)]
        public static extern int ks_world_advance(ulong world, double until, Probe probe, IntPtr user, ref Event @event);
        [DllImport(library)]
        public static extern int ks_run_definition_init(out RunDefinition definition, uint structSize);
        [DllImport(library)]
        public static extern int ks_world_run(ulong world, double until, ref RunDefinition definition);
        [DllImport(library)]
        public static extern int ks_world_use_threads(ulong world, int threads);
        [DllImport(library)]
        public static extern int ks_game_definition_init(out GameDefinition definition, uint structSize);
        [DllImport(library)]
        public static extern int ks_game_create(ref WorldDefinition world, ref GameDefinition definition, out ulong game);
        [DllImport(library)]
        public static extern int ks_game_restore(byte[] bytes, UIntPtr count, ref GameDefinition definition, PairFilter filter, IntPtr user, out ulong game);
        [DllImport(library)]
        public static extern int ks_game_step(ulong game, double dt, out EventList happened);
        [DllImport(library)]
        public static extern int ks_game_bodies(ulong game, out BodyList found);
        [DllImport(library)]
        public static extern int ks_game_index_of(ulong game, BodyId body, out UIntPtr index);
        [DllImport(library)]
        public static extern int ks_game_set_response(ulong game, ref GameDefinition definition);
        [DllImport(library)]
        public static extern int ks_game_set_velocities(ulong game, Vector[] velocities, UIntPtr count);
        [DllImport(library)]
        public static extern int ks_game_set_acceleration(ulong game, BodyId body, Vector acceleration);
        [DllImport(library)]
        public static extern int ks_game_set_gravity(ulong game, Vector gravity);
        [DllImport(library)]
        public static extern int ks_game_gravity(ulong game, out Vector gravity);
        [DllImport(library)]
        public static extern int ks_motion_definition_init(out MotionDefinition definition, uint structSize);
        [DllImport(library)]
        public static extern int ks_world_add_motion(ulong world, ref MotionDefinition definition, out uint motion, [Out] BodyId[] ids);
        [DllImport(library)]
        public static extern int ks_world_add_to_motion(ulong world, uint motion, ref MotionDefinition definition, [Out] uint[] numbers, [Out] BodyId[] ids);
        [DllImport(library)]
        public static extern int ks_world_steer(ulong world, BodyId body, Vector acceleration);
        [DllImport(library)]
        public static extern int ks_world_push_frame(ulong world, uint motion, Vector[] positions, UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_push_frame_at(ulong world, uint motion, Vector[] positions, UIntPtr count, double time);
        [DllImport(library)]
        public static extern int ks_world_latest_frame(ulong world, uint motion, [Out] Vector[] positions, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_latest_frame_time(ulong world, uint motion, out double time);
        [DllImport(library)]
        public static extern int ks_world_states(ulong world, BodyId[] bodies, UIntPtr count, double time, [Out] State[] states);
        [DllImport(library)]
        public static extern int ks_world_safe_until(ulong world, Probe probe, IntPtr user, out Prediction prediction);
        [DllImport(library)]
        public static extern int ks_world_earliest_contact(ulong world, BodyId body, Probe probe, IntPtr user, out Prediction prediction);
        [DllImport(library)]
        public static extern int ks_world_earliest_approach(ulong world, BodyId body, double distance, Probe probe, IntPtr user, out Prediction prediction);
        [DllImport(library)]
        public static extern int ks_world_pair_safe_until(ulong world, BodyId first, BodyId second, double distance, Probe probe, IntPtr user, out Prediction prediction);
        [DllImport(library)]
        public static extern int ks_world_distance_limits(ulong world, BodyId first, BodyId second, double time, Probe probe, IntPtr user, out double lower, out double upper);
        [DllImport(library)]
        public static extern int ks_world_overlapping_sphere(ulong world, Vector centre, double radius, Probe probe, IntPtr user, [Out] Hit[] hits, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_overlapping_box(ulong world, ref Box box, Probe probe, IntPtr user, [Out] Hit[] hits, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_nearest(ulong world, Vector point, UIntPtr bodies, Probe probe, IntPtr user, [Out] Hit[] hits, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_cast(ulong world, Vector origin, Vector direction, double length, double radius, Probe probe, IntPtr user, [Out] Hit[] hits, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_overlapping_all(ulong world, Sphere[] spheres, BodyId[] exceptIds, UIntPtr queries, ref Filter filter, Probe probe, IntPtr user, [Out] UIntPtr[] ends, [Out] Hit[] hits, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_nearest_all(ulong world, Vector[] points, BodyId[] exceptIds, UIntPtr queries, UIntPtr bodies, ref Filter filter, Probe probe, IntPtr user, [Out] UIntPtr[] ends, [Out] Hit[] hits, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_cast_all(ulong world, Ray[] rays, BodyId[] exceptIds, UIntPtr queries, ref Filter filter, Probe probe, IntPtr user, [Out] UIntPtr[] ends, [Out] Hit[] hits, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_start_recording(ulong world);
        [DllImport(library)]
        public static extern int ks_world_stop_recording(ulong world);
        [DllImport(library)]
        public static extern int ks_world_recording(ulong world, [Out] byte[] bytes, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_replay_open(byte[] bytes, UIntPtr count, PairFilter filter, IntPtr user, out ulong replay);
        [DllImport(library)]
        public static extern int ks_replay_destroy(ulong replay);
        [DllImport(library)]
        public static extern int ks_replay_advance(ulong replay, ref Event @event);
        [DllImport(library)]
        public static extern int ks_replay_finished(ulong replay, out int finished);
        [DllImport(library)]
        public static extern int ks_replay_steps(ulong replay, out UIntPtr repeated, out UIntPtr total);
        [DllImport(library)]
        public static extern int ks_replay_hash(ulong replay, out ulong hash);
        [DllImport(library)]
        public static extern int ks_replay_world(ulong replay, out ulong copy);
        [DllImport(library)]
        public static extern int ks_monitor_definition_init(out MonitorDefinition definition, uint structSize);
        [DllImport(library)]
        public static extern int ks_track_report_init(out TrackReport report, uint structSize);
        [DllImport(library)]
        public static extern IntPtr ks_monitor_event_kind_name(MonitorEventKind kind);
        [DllImport(library)]
        public static extern IntPtr ks_verdict_name(Verdict verdict);
        [DllImport(library)]
        public static extern int ks_monitor_create(ref MonitorDefinition definition, out ulong monitor);
        [DllImport(library)]
        public static extern int ks_monitor_destroy(ulong monitor);
        [DllImport(library)]
        public static extern int ks_monitor_save(ulong monitor, [Out] byte[] bytes, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_monitor_restore(byte[] bytes, UIntPtr count, out ulong monitor);
        [DllImport(library)]
        public static extern int ks_monitor_report(ulong monitor, ulong[] tracks, TrackReport[] reports, UIntPtr count);
        [DllImport(library)]
        public static extern int ks_monitor_remove(ulong monitor, ulong track);
        [DllImport(library)]
        public static extern int ks_monitor_advance(ulong monitor, double until, Poll poll, IntPtr user, ref MonitorEvent @event);
        [DllImport(library)]
        public static extern int ks_monitor_time(ulong monitor, out double time);
        [DllImport(library)]
        public static extern int ks_monitor_tracks(ulong monitor, [Out] ulong[] tracks, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_monitor_places(ulong monitor, ulong track, [Out] TrackPlace[] places, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_monitor_answer(ulong monitor, ulong first, ulong second, uint level, ref PairAnswer answer);
        [DllImport(library)]
        public static extern int ks_monitor_open_pairs(ulong monitor, [Out] OpenPair[] pairs, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_monitor_predicted_pairs(ulong monitor, [Out] PredictedPair[] pairs, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_monitor_needed(ulong monitor, double until, [Out] ReportRequest[] requests, UIntPtr capacity, out UIntPtr count);
    }
}
