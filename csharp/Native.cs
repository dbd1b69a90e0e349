// The records and functions of kinesphere.h, which explains them. Records with struct_size are made by Default or New.
using System;
using System.Runtime.InteropServices;

namespace Kinesphere
{
    public enum Contacts { OfWorld, Impacts, BeginAndEnd, All }
    public enum EventKind
    {
        None, BoundViolation, ContactBegin, ContactEnd, WallBegin, WallEnd, ZenoGuard, SensorEnter, SensorLeave, Woke
    }
    public enum Wall { None, XLower, XUpper, YLower, YUpper, ZLower, ZUpper }
    public enum Verdict { Apart, Undecided, Within }
    public enum MonitorEventKind
    {
        None, Verdict, Predicted, PredictionEnded, Contradiction, Resolved, Stale, Resumed, Dropped, Reclassified
    }
    public enum ProbeReason { Touching, NarrowMisses, LooseLimit, Contacts, Travel, Changes, Queries }
    public enum SeparationShape { Ellipsoid, Cylinder, WellClear }
    [Flags] public enum Axes : uint { None = 0, X = 1, Y = 2, Z = 4 }
    [Flags] public enum Senses : uint { Neither = 0, First = 1, Second = 2 }
    [Flags] public enum Traits : uint { None = 0, Static = 1, Zone = 2, Sleeping = 4 }

    [StructLayout(LayoutKind.Sequential)]
    public struct Vector
    {
        public double X, Y, Z;
        public Vector(double x, double y, double z) { X = x; Y = y; Z = z; }
        public static Vector operator +(Vector a, Vector b) { return new Vector(a.X + b.X, a.Y + b.Y, a.Z + b.Z); }
        public static Vector operator -(Vector a, Vector b) { return new Vector(a.X - b.X, a.Y - b.Y, a.Z - b.Z); }
        public static Vector operator *(Vector a, double by) { return new Vector(a.X * by, a.Y * by, a.Z * by); }
        public override string ToString() { return FormattableString.Invariant($"({X}, {Y}, {Z})"); }
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct State
    {
        public Vector Position, Velocity;
        public State(Vector position, Vector velocity) { Position = position; Velocity = velocity; }
        public override string ToString() { return Position + " at velocity " + Velocity; }
    }

    /// <summary>Names a body until it is removed; a later body never has an equal id.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct BodyId : IEquatable<BodyId>
    {
        readonly uint index, generation, world;
        /// <summary>A small number, which no other body has meanwhile: for tables.</summary>
        public int Index { get { return (int)index; } }
        public bool IsNone { get { return index == uint.MaxValue && generation == 0; } }
        public bool Equals(BodyId other) { return index == other.index && generation == other.generation; }
        public override bool Equals(object other) { return other is BodyId && Equals((BodyId)other); }
        public override int GetHashCode() { return (int)(index * 31 + generation); }
        public override string ToString() { return IsNone ? "no body" : "body " + index; }
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct Shape
    {
        int kind;
        Vector a, b, c;
        double number;
        public static Shape Ball(Vector centre, double radius) { return new Shape { a = centre, number = radius }; }
        public static Shape HalfSpace(Vector normal, double offset)
        {
            return new Shape { kind = 1, a = normal, number = offset };
        }
        public static Shape Box(Vector lower, Vector upper) { return new Shape { kind = 2, a = lower, b = upper }; }
        public static Shape Triangle(Vector a, Vector b, Vector c) { return new Shape { kind = 3, a = a, b = b, c = c }; }
    }

    /// <summary>Begin with Default: a definition that `new` made has no defaults, and is refused.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct WorldDefinition
    {
        uint structSize;
        public int Dimensions;
        int hasBox;
        public Axes Periodic;
        Vector lower, upper;
        public double ContactTolerance, SeparationDistance, ZenoInterval, StartTime;
        public Contacts Contacts;
        int allowOverlap, spreadWindowStarts, hasWallFilter;
        Filter wallFilter;
        public bool AllowOverlap { get { return allowOverlap != 0; } set { allowOverlap = value ? 1 : 0; } }
        /// <summary>For games: frames of equal length cost about the same, and more in total. Has no effect in periodic space.</summary>
        public bool SpreadWindowStarts { get { return spreadWindowStarts != 0; } set { spreadWindowStarts = value ? 1 : 0; } }
        /// <summary>Gives the world walls, or on periodic axes a period, at the sides of a box.</summary>
        public void SetBox(Vector from, Vector to) { hasBox = 1; lower = from; upper = to; }
        /// <summary>Gives all walls a filter; without one they meet every body.</summary>
        public void SetWallFilter(Filter filter) { hasWallFilter = 1; wallFilter = filter; }
        internal void Require(string name) { Native.RequireDefault(structSize, "WorldDefinition", name); }
        public static WorldDefinition Default
        {
            get
            {
                WorldDefinition made;
                Native.Check(Native.ks_world_definition_init(out made, Native.SizeOf<WorldDefinition>()));
                return made;
            }
        }
    }

    /// <summary>Selects the bodies that a body may touch: the category of each must have a bit in the mask of the other,
    /// unless both are in one group, which decides by its sign. `new Filter()`, with the mask 0, lets it touch none.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Filter
    {
        public ulong Category, Mask;
        public int Group;
        public Filter(ulong category, ulong mask = ulong.MaxValue, int group = 0)
        {
            Category = category;
            Mask = mask;
            Group = group;
        }
        /// <summary>Lets a body touch all others.</summary>
        public static Filter Default { get { return new Filter(1); } }
    }

    /// <summary>Limits within which a body moves; fields as in BodyDefinition.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MotionLimits
    {
        public double AccelerationLimit, PositionError, VelocityError;
        public Vector PlannedAcceleration;
    }

    /// <summary>A sphere and the limits of its motion. Begin with Default.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct BodyDefinition
    {
        uint structSize;
        int solid;
        public Contacts Contacts;
        public int SensorClass;
        public double Radius, AccelerationLimit, PositionError, VelocityError, Mass;
        public Vector PlannedAcceleration, Position, Velocity;
        public Filter Filter;
        public ulong UserData;
        public bool Solid { get { return solid != 0; } set { solid = value ? 1 : 0; } }
        internal void Require(string name) { Native.RequireDefault(structSize, "BodyDefinition", name); }
        public static BodyDefinition Default
        {
            get
            {
                BodyDefinition made;
                Native.Check(Native.ks_body_definition_init(out made, Native.SizeOf<BodyDefinition>()));
                return made;
            }
        }
    }

    /// <summary>What a world knows of a body.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct BodyView
    {
        uint structSize;
        int enabled, isStatic, sleeping;
        public double ReportTime;
        /// <summary>Corners of a box that contains the body from now until BoxEnd.</summary>
        public Vector Lower, Upper;
        public double BoxEnd;
        /// <summary>Boxes that it has travelled along periodic axes.</summary>
        public long ImageX, ImageY, ImageZ;
        /// <summary>Its state is that of the last report.</summary>
        public BodyDefinition Definition;
        public bool Enabled { get { return enabled != 0; } }
        public bool IsStatic { get { return isStatic != 0; } }
        public bool Sleeping { get { return sleeping != 0; } }
        internal static BodyView New { get { return new BodyView { structSize = Native.SizeOf<BodyView>() }; } }
    }

    /// <summary>A body within a sensor distance (length) of another one.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct SensorOverlap
    {
        public BodyId Body;
        public double Distance;
    }

    /// <summary>A rotation as a unit quaternion W + X i + Y j + Z k.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Quaternion
    {
        public double W, X, Y, Z;
        public Quaternion(double w, double x, double y, double z) { W = w; X = x; Y = y; Z = z; }
    }

    /// <summary>Orientation and angular velocity (radians / time, in the world's axes) of a rigid body.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Rotation
    {
        public Quaternion Orientation;
        public Vector AngularVelocity;
        public Rotation(Quaternion orientation, Vector angularVelocity)
        {
            Orientation = orientation;
            AngularVelocity = angularVelocity;
        }
    }

    /// <summary>All points within a radius of the segment from A to B: a capsule, or a ball if A and B are equal.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct RigidPart
    {
        public Vector A, B;
        public double Radius;
        public RigidPart(Vector a, Vector b, double radius) { A = a; B = b; Radius = radius; }
    }

    /// <summary>All points within a radius of the convex hull of 1 to 64 points; three make a plate.</summary>
    public sealed class RigidHull
    {
        public readonly Vector[] Points;
        public readonly double Radius;
        public RigidHull(double radius, params Vector[] points)
        {
            Radius = radius;
            Points = points;
        }
        /// <summary>All points within a radius of a box.</summary>
        public static RigidHull Box(Vector lower, Vector upper, double radius)
        {
            var corners = new Vector[8];
            for (int k = 0; k < 8; ++k)
                corners[k] = new Vector((k & 1) == 0 ? lower.X : upper.X, (k & 2) == 0 ? lower.Y : upper.Y,
                    (k & 4) == 0 ? lower.Z : upper.Z);
            return new RigidHull(radius, corners);
        }
    }

    /// <summary>What a rigid body has beside its BodyDefinition and its parts. Begin with Default.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct RigidDefinition
    {
        uint structSize;
        UIntPtr partCount;
        RigidPart* parts;
        public Rotation Rotation;
        /// <summary>At 0 the body keeps its angular velocity; otherwise LargestAngularSpeed must be finite.</summary>
        public double AngularAccelerationLimit, LargestAngularSpeed;
        public Vector Inertia;
        UIntPtr hullCount;
        Native.Hull* hulls;
        internal void Require(string name) { Native.RequireDefault(structSize, "RigidDefinition", name); }
        internal void SetParts(RigidPart* first, int count) { parts = first; partCount = (UIntPtr)count; }
        internal void SetHulls(Native.Hull* first, int count) { hulls = first; hullCount = (UIntPtr)count; }
        public static RigidDefinition Default
        {
            get
            {
                RigidDefinition made;
                Native.Check(Native.ks_rigid_definition_init(out made, Native.SizeOf<RigidDefinition>()));
                return made;
            }
        }
    }

    /// <summary>A body that never moves. Begin with Default.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct StaticDefinition
    {
        uint structSize;
        int solid;
        public int SensorClass;
        public Shape Shape;
        public Filter Filter;
        public ulong UserData;
        public bool Solid { get { return solid != 0; } set { solid = value ? 1 : 0; } }
        internal void Require(string name) { Native.RequireDefault(structSize, "StaticDefinition", name); }
        public static StaticDefinition Default
        {
            get
            {
                StaticDefinition made;
                Native.Check(Native.ks_static_definition_init(out made, Native.SizeOf<StaticDefinition>()));
                return made;
            }
        }
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct Event
    {
        uint structSize;
        public EventKind Kind;
        public double Time;
        public BodyId First, Second;
        public Wall Wall;
        int repeated, jammed, alreadyTouching;
        public Senses Senses;
        public Traits FirstTraits, SecondTraits;
        uint reserved;
        public State FirstState, SecondState;
        public Vector Point, Normal;
        public double Gap, ApproachSpeed, PositionExcess, VelocityExcess, Distance;
        public ulong FirstUserData, SecondUserData;
        public double FirstMass, SecondMass;
        /// <summary>Of rigid bodies: the parts at the contact, and what an impulse along the normal does to them.</summary>
        public uint FirstPart, SecondPart;
        public Vector FirstAngularVelocity, SecondAngularVelocity, FirstSpinGain, SecondSpinGain;
        public bool Repeated { get { return repeated != 0; } }
        public bool Jammed { get { return jammed != 0; } }
        public bool AlreadyTouching { get { return alreadyTouching != 0; } }
        public override string ToString()
        {
            var partner = Wall != Wall.None ? ", wall " + Wall : Second.IsNone ? "" : ", " + Second;
            return FormattableString.Invariant($"{Time} {Kind}") + (Kind == EventKind.None ? "" : " " + First + partner);
        }
        internal static Event New { get { return new Event { structSize = Native.SizeOf<Event>(), reserved = 0 }; } }

        /// <summary>Velocities after a frictionless bounce; events other than begins of contacts turn nobody.</summary>
        public Response Bounce(double restitution, double restingSpeed = 0)
        {
            var response = new Response().Sized();
            Native.Check(Native.ks_bounce(ref this, restitution, restingSpeed, ref response));
            return response;
        }
    }

    /// <summary>What a response does to a body, after the body has got its velocity; Sleep gives it velocity 0.</summary>
    public enum BodyAction { None, Remove, Disable, Sleep }

    /// <summary>
    /// What an event does to its bodies, for World.Run. It has no effect on a body that an earlier response at the same time
    /// has removed, and none but Remove on one that it has disabled.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Response
    {
        uint structSize;
        int stop, turnsFirst, turnsSecond, spinsFirst, spinsSecond;
        public BodyAction FirstAction, SecondAction;
        Vector first, second, firstSpin, secondSpin;
        internal Response Sized()
        {
            structSize = Native.SizeOf<Response>();
            return this;
        }
        /// <summary>The sink may change the world when it receives this event: add and remove bodies, teleport them.</summary>
        public bool Stop
        {
            get { return stop != 0; }
            set { stop = value ? 1 : 0; }
        }
        /// <summary>The velocity from now on; null: the body continues as before.</summary>
        public Vector? First
        {
            get { return turnsFirst != 0 ? first : (Vector?)null; }
            set { turnsFirst = value.HasValue ? 1 : 0; first = value.GetValueOrDefault(); }
        }
        public Vector? Second
        {
            get { return turnsSecond != 0 ? second : (Vector?)null; }
            set { turnsSecond = value.HasValue ? 1 : 0; second = value.GetValueOrDefault(); }
        }
        /// <summary>Of rigid bodies (radians / time); null: the body turns as before.</summary>
        public Vector? FirstAngularVelocity
        {
            get { return spinsFirst != 0 ? firstSpin : (Vector?)null; }
            set { spinsFirst = value.HasValue ? 1 : 0; firstSpin = value.GetValueOrDefault(); }
        }
        public Vector? SecondAngularVelocity
        {
            get { return spinsSecond != 0 ? secondSpin : (Vector?)null; }
            set { spinsSecond = value.HasValue ? 1 : 0; secondSpin = value.GetValueOrDefault(); }
        }
    }

    /// <summary>One number for all events of a run: equal numbers mean bit-identical runs.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct EventHash
    {
        ulong sum, count;
        public void Add(Event happened) { Native.Check(Native.ks_event_hash_add(ref this, ref happened)); }
        public ulong Value
        {
            get
            {
                ulong value;
                Native.Check(Native.ks_event_hash_value(ref this, out value));
                return value;
            }
        }
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct Prediction
    {
        public double Time;
        public BodyId Partner;
        public Wall Wall;
        int happens, probed;
        public bool Happens { get { return happens != 0; } }
        public bool Probed { get { return probed != 0; } }
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct Hit
    {
        public BodyId Body;
        int certain;
        public double Lower, Upper;
        public bool Certain { get { return certain != 0; } }
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct ErrorBound
    {
        int kind;
        double horizontal, vertical;
        public double Horizontal { get { return horizontal; } }
        public double Vertical { get { return vertical; } }
        public static ErrorBound Ball(double radius) { return new ErrorBound { horizontal = radius, vertical = radius }; }
        public static ErrorBound Cylinder(double horizontal, double vertical)
        {
            return new ErrorBound { kind = 1, horizontal = horizontal, vertical = vertical };
        }
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct TrackClass
    {
        public ErrorBound AccelerationLimit, LargestSpeed;
        public Vector PlannedAcceleration;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct Separation
    {
        public SeparationShape Shape;
        public double Horizontal, Vertical, LookAhead, ModifiedTau;
        public static Separation Sphere(double distance)
        {
            return new Separation { Horizontal = distance, Vertical = distance };
        }
    }

    /// <summary>A reported state of a track. Begin with Default.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct TrackReport
    {
        uint structSize;
        int hasPlan;
        public ulong TrackClass;
        public double Timestamp, TimestampError;
        public State State;
        public ErrorBound PositionError, VelocityError;
        Vector planAcceleration;
        ErrorBound planLimit;
        double planValidUntil;
        public void SetPlan(Vector acceleration, ErrorBound limit, double validUntil)
        {
            hasPlan = 1;
            planAcceleration = acceleration;
            planLimit = limit;
            planValidUntil = validUntil;
        }
        internal void Require(string name) { Native.RequireDefault(structSize, "TrackReport", name); }
        public static TrackReport Default
        {
            get
            {
                TrackReport made;
                Native.Check(Native.ks_track_report_init(out made, Native.SizeOf<TrackReport>()));
                return made;
            }
        }
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct MonitorEvent
    {
        uint structSize;
        public MonitorEventKind Kind;
        public double Time;
        public ulong First, Second;
        public uint Level;
        public Verdict Verdict, Before;
        uint reserved;
        public double Since, LikelyTime, ClosestTime, ClosestDistance, PositionExcess, VelocityExcess;
        internal static MonitorEvent New
        {
            get { return new MonitorEvent { structSize = Native.SizeOf<MonitorEvent>(), reserved = 0 }; }
        }
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct PairAnswer
    {
        uint structSize;
        public Verdict Verdict;
        int predicted;
        public double Since, Until, Lower, Upper, ClosestDistance, ClosestTime, ClosestHorizontal, ClosestVertical;
        public double RelativeSpeed, LikelyTime, InevitableBy, AvoidableUntil;
        public ulong Ask;
        public double AskBy;
        public bool Predicted { get { return predicted != 0; } }
        internal static PairAnswer New
        {
            get { return new PairAnswer { structSize = Native.SizeOf<PairAnswer>(), predicted = 0 }; }
        }
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct OpenPair
    {
        public ulong First, Second;
        public uint Level;
        public Verdict Verdict;
        public double Since;
    }

    /// <summary>A pair that is predicted to come within a separation.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct PredictedPair
    {
        public ulong First, Second;
        public uint Level;
        public double Since, LikelyTime, ClosestTime, ClosestDistance;
    }

    /// <summary>A report of `Track` is needed by the time `By` for its verdict with `Other` to stay certain.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct ReportRequest
    {
        public ulong Track, Other;
        public double By;
    }

    /// <summary>Where a track is now: within `Radius` of `Centre`.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct TrackPlace
    {
        public Vector Centre, Velocity;
        public ErrorBound Radius;
    }

    /// <summary>Wall-clock time spent (seconds) since profiling was switched on.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Timings
    {
        public ulong Advances;
        public double Advance, Probes;
    }

    /// <summary>A body that was probed while profiling was on, and why.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct BusyBody
    {
        public BodyId Body;
        public ProbeReason Reason;
        public ulong Probes, Touching, NearOthers, Windows, Changes, Queries, Contacts;
        public double AccelerationLimit, LargestAcceleration;
        /// <summary>What the reason means, and what makes such a body cheaper.</summary>
        public string Advice { get { return Marshal.PtrToStringAnsi(Native.ks_probe_reason_advice(Reason)); } }
    }

    /// <summary>A call was refused; nothing has changed.</summary>
    public sealed class KinesphereException : Exception
    {
        /// <summary>The name of the status, such as "stale_body".</summary>
        public string Status { get; private set; }
        public string Argument { get; private set; }
        public BodyId Body { get; private set; }
        internal KinesphereException(string status, string argument, BodyId body, string message) : base(message)
        {
            Status = status;
            Argument = argument;
            Body = body;
        }
    }

    unsafe static class Native
    {
        const string library = "kinesphere-c";

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        public delegate int Probe(BodyId* bodies, UIntPtr count, double time, State* states, IntPtr user);
        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        public delegate int RotationProbe(BodyId* bodies, UIntPtr count, double time, Rotation* rotations, IntPtr user);
        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        public delegate int Respond(Event* happened, Response* response, IntPtr user);
        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        public delegate int Sink(Event* happened, IntPtr user);
        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        public delegate int PairFilter(BodyId first, BodyId second, IntPtr user);
        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        public delegate int Poll(ulong* tracks, UIntPtr count, double time, TrackReport* reports, byte* hasReport, IntPtr user);

        [StructLayout(LayoutKind.Sequential)]
        public struct Box
        {
            public Vector Lower, Upper;
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
            public uint StructSize;
            public int Threads;
            public double Restitution, RestingSpeed;
            public IntPtr Respond, RespondUser, Sink, SinkUser;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct MotionDefinition
        {
            public uint StructSize;
            public int Kind;
            public UIntPtr Count;
            public State* States;
            public double* Radii, Masses, AccelerationLimits;
            public Vector Gravity;
            public double Interval, PositionError;
            public ulong Seed;
            public BodyDefinition* Like;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct SeparationRule
        {
            public UIntPtr FirstClass, SecondClass;
            public Separation* Levels;
            public UIntPtr LevelCount;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct MonitorDefinition
        {
            public uint StructSize;
            public int Dimensions, HasStartTime;
            public double StartTime;
            public TrackClass* Classes;
            public UIntPtr ClassCount;
            public SeparationRule* Separations;
            public UIntPtr SeparationCount;
            public double Tolerance, TimeResolution, Window, StaleAfter, DropAfter, PredictionHold;
            public double PredictionConfirmation, PredictionMargin, PredictionErrorPart;
            public ulong ShardOf, ShardFirst, ShardCount;
        }

        public const int BufferTooSmall = 6;
        public const int CallbackFailed = 7;

        public static uint SizeOf<T>() { return (uint)Marshal.SizeOf(typeof(T)); }

        /// <summary>Throws unless a definition was made by its property Default, which sets its size.</summary>
        public static void RequireDefault(uint size, string type, string argument)
        {
            if (size != 0) return;
            throw new ArgumentException(
                "begin with " + type + ".Default and change its fields: `new " + type + "()` has no defaults", argument);
        }

        /// <summary>Throws what the last call of this thread has to say, unless it succeeded.</summary>
        public static void Check(int status)
        {
            if (status == 0) return;
            throw new KinesphereException(Marshal.PtrToStringAnsi(ks_status_name(status)),
                Marshal.PtrToStringAnsi(ks_last_error_argument()), ks_last_error_body(),
                Marshal.PtrToStringAnsi(ks_last_error_message()));
        }

        [DllImport(library)] public static extern IntPtr ks_version();
        [DllImport(library)] public static extern IntPtr ks_status_name(int status);
        [DllImport(library)] public static extern IntPtr ks_last_error_message();
        [DllImport(library)] public static extern IntPtr ks_last_error_argument();
        [DllImport(library)] public static extern BodyId ks_last_error_body();

        [DllImport(library)] public static extern int ks_world_definition_init(out WorldDefinition made, uint size);
        [DllImport(library)] public static extern int ks_body_definition_init(out BodyDefinition made, uint size);
        [DllImport(library)] public static extern int ks_static_definition_init(out StaticDefinition made, uint size);
        [DllImport(library)] public static extern int ks_rigid_definition_init(out RigidDefinition made, uint size);
        [DllImport(library)] public static extern int ks_run_definition_init(out RunDefinition made, uint size);
        [DllImport(library)] public static extern int ks_motion_definition_init(out MotionDefinition made, uint size);
        [DllImport(library)] public static extern int ks_monitor_definition_init(out MonitorDefinition made, uint size);
        [DllImport(library)] public static extern int ks_track_report_init(out TrackReport made, uint size);

        [DllImport(library)] public static extern int ks_world_create(ref WorldDefinition definition, out ulong world);
        [DllImport(library)] public static extern int ks_world_destroy(ulong world);
        [DllImport(library)] public static extern int ks_world_clone(ulong world, out ulong copy);
        [DllImport(library)]
        public static extern int ks_world_save(ulong world, byte[] bytes, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_restore(byte[] bytes, UIntPtr count, PairFilter filter, IntPtr user, out ulong world);
        [DllImport(library)]
        public static extern int ks_world_add(ulong world, BodyDefinition[] bodies, UIntPtr count, [Out] BodyId[] ids);
        [DllImport(library)]
        public static extern int ks_world_add_static(ulong world, StaticDefinition[] bodies, UIntPtr count, [Out] BodyId[] ids);
        [DllImport(library)]
        public static extern int ks_world_add_moving_shape(
            ulong world, ref BodyDefinition body, ref Shape shape, out BodyId id);
        [DllImport(library)]
        public static extern int ks_world_add_rigid_body(
            ulong world, ref BodyDefinition body, ref RigidDefinition rigid, out BodyId id);
        [DllImport(library)]
        public static extern int ks_world_set_angular_velocity(ulong world, BodyId body, Vector angularVelocity);
        [DllImport(library)] public static extern int ks_world_set_rotation(ulong world, BodyId body, ref Rotation rotation);
        [DllImport(library)]
        public static extern int ks_world_set_rotation_probe(ulong world, RotationProbe probe, IntPtr user);
        [DllImport(library)] public static extern int ks_world_rotation(ulong world, BodyId body, out Rotation rotation);
        [DllImport(library)]
        public static extern int ks_world_add_zone(ulong world, ref Shape shape, ulong userData, out BodyId id);
        [DllImport(library)] public static extern int ks_world_remove(ulong world, BodyId[] bodies, UIntPtr count);
        [DllImport(library)] public static extern int ks_world_set_velocity(ulong world, BodyId body, Vector velocity);
        [DllImport(library)]
        public static extern int ks_world_set_velocities(ulong world, BodyId[] bodies, Vector[] velocities, UIntPtr count);
        [DllImport(library)] public static extern int ks_world_teleport(ulong world, BodyId body, ref State state);
        [DllImport(library)] public static extern int ks_world_set_radius_rate(ulong world, BodyId body, double rate);
        [DllImport(library)] public static extern int ks_world_set_radius(ulong world, BodyId body, double radius);
        [DllImport(library)] public static extern int ks_world_set_mass(ulong world, BodyId body, double mass);
        [DllImport(library)]
        public static extern int ks_world_set_motion_limits(ulong world, BodyId body, ref MotionLimits limits);
        [DllImport(library)] public static extern int ks_world_set_shape(ulong world, BodyId body, ref Shape shape);
        [DllImport(library)] public static extern int ks_world_set_solid(ulong world, BodyId body, int solid);
        [DllImport(library)] public static extern int ks_world_set_user_data(ulong world, BodyId body, ulong data);
        [DllImport(library)] public static extern int ks_world_set_sensor_class(ulong world, BodyId body, int sensorClass);
        [DllImport(library)] public static extern int ks_world_set_pair_filter(ulong world, PairFilter filter, IntPtr user);
        [DllImport(library)] public static extern int ks_world_refresh_filter(ulong world, BodyId body);
        [DllImport(library)] public static extern int ks_world_reserve(ulong world, UIntPtr bodies);
        [DllImport(library)] public static extern int ks_world_set_filter(ulong world, BodyId body, ref Filter filter);
        [DllImport(library)]
        public static extern int ks_world_set_sensor(ulong world, int sensorClass, double[] distances, UIntPtr count, ulong mask);
        [DllImport(library)] public static extern int ks_world_disable(ulong world, BodyId body);
        [DllImport(library)] public static extern int ks_world_enable(ulong world, BodyId body, ref State state);
        [DllImport(library)] public static extern int ks_world_sleep(ulong world, BodyId body);
        [DllImport(library)] public static extern int ks_world_wake(ulong world, BodyId body);
        [DllImport(library)] public static extern int ks_world_time(ulong world, out double time);
        [DllImport(library)] public static extern int ks_world_size(ulong world, out UIntPtr bodies);
        [DllImport(library)] public static extern int ks_world_contains(ulong world, BodyId body, out int contains);
        [DllImport(library)] public static extern int ks_world_body(ulong world, BodyId body, ref BodyView view);
        [DllImport(library)] public static extern int ks_world_probe_count(ulong world, out ulong probes);
        [DllImport(library)]
        public static extern int ks_world_bodies(ulong world, [Out] BodyId[] bodies, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_sensor_overlaps(
            ulong world, BodyId body, [Out] SensorOverlap[] overlaps, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_touching(ulong world, BodyId body, [Out] BodyId[] partners, UIntPtr capacity, out UIntPtr count);

        [DllImport(library)]
        public static extern int ks_bounce(ref Event happened, double restitution, double restingSpeed, ref Response response);
        [DllImport(library)] public static extern int ks_event_hash_add(ref EventHash hash, ref Event happened);
        [DllImport(library)] public static extern int ks_event_hash_value(ref EventHash hash, out ulong value);

        [DllImport(library)]
        public static extern int ks_probe_motions(BodyId* bodies, UIntPtr count, double time, State* states, IntPtr user);
        [DllImport(library)]
        public static extern int ks_world_advance(ulong world, double until, Probe probe, IntPtr user, ref Event next);
        [DllImport(library)] public static extern int ks_world_run(ulong world, double until, ref RunDefinition definition);
        [DllImport(library)]
        public static extern int ks_world_add_motion(ulong world, ref MotionDefinition definition, out uint motion, [Out] BodyId[] ids);
        [DllImport(library)]
        public static extern int ks_world_add_to_motion(
            ulong world, uint motion, ref MotionDefinition definition, [Out] uint[] numbers, [Out] BodyId[] ids);
        [DllImport(library)]
        public static extern int ks_world_push_frame(ulong world, uint motion, Vector[] positions, UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_latest_frame(ulong world, uint motion, [Out] Vector[] positions, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_latest_frame_time(ulong world, uint motion, out double time);
        [DllImport(library)]
        public static extern int ks_world_states(ulong world, BodyId[] bodies, UIntPtr count, double time, [Out] State[] states);
        [DllImport(library)] public static extern int ks_world_steer(ulong world, BodyId body, Vector acceleration);
        [DllImport(library)]
        public static extern int ks_world_safe_until(ulong world, Probe probe, IntPtr user, out Prediction prediction);
        [DllImport(library)]
        public static extern int ks_world_earliest_approach(
            ulong world, BodyId body, double distance, Probe probe, IntPtr user, out Prediction prediction);
        [DllImport(library)]
        public static extern int ks_world_pair_safe_until(
            ulong world, BodyId first, BodyId second, double distance, Probe probe, IntPtr user, out Prediction prediction);
        [DllImport(library)]
        public static extern int ks_world_distance_limits(ulong world, BodyId first, BodyId second, double time, Probe probe,
            IntPtr user, out double lower, out double upper);
        [DllImport(library)]
        public static extern int ks_world_overlapping_sphere(ulong world, Vector centre, double radius, Probe probe, IntPtr user,
            [Out] Hit[] hits, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_overlapping_box(ulong world, ref Box box, Probe probe, IntPtr user, [Out] Hit[] hits,
            UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_nearest(ulong world, Vector point, UIntPtr bodies, Probe probe, IntPtr user,
            [Out] Hit[] hits, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_world_earliest_contact(ulong world, BodyId body, Probe probe, IntPtr user, out Prediction prediction);
        [DllImport(library)]
        public static extern int ks_world_cast(ulong world, Vector origin, Vector direction, double length, double radius, Probe probe,
            IntPtr user, [Out] Hit[] hits, UIntPtr capacity, out UIntPtr count);

        [DllImport(library)] public static extern int ks_world_set_profiling(ulong world, int on);
        [DllImport(library)] public static extern int ks_world_timings(ulong world, out Timings timings);
        [DllImport(library)]
        public static extern int ks_world_busiest(ulong world, UIntPtr most, [Out] BusyBody[] bodies, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)] public static extern IntPtr ks_probe_reason_advice(ProbeReason reason);

        [DllImport(library)] public static extern int ks_world_start_recording(ulong world);
        [DllImport(library)] public static extern int ks_world_stop_recording(ulong world);
        [DllImport(library)]
        public static extern int ks_world_recording(ulong world, byte[] bytes, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_replay_open(byte[] bytes, UIntPtr count, PairFilter filter, IntPtr user, out ulong replay);
        [DllImport(library)] public static extern int ks_replay_destroy(ulong replay);
        [DllImport(library)] public static extern int ks_replay_advance(ulong replay, ref Event next);
        [DllImport(library)] public static extern int ks_replay_finished(ulong replay, out int finished);
        [DllImport(library)] public static extern int ks_replay_steps(ulong replay, out UIntPtr repeated, out UIntPtr total);
        [DllImport(library)] public static extern int ks_replay_hash(ulong replay, out ulong hash);
        [DllImport(library)] public static extern int ks_replay_world(ulong replay, out ulong copy);

        [DllImport(library)]
        public static extern int ks_monitor_create(ref MonitorDefinition definition, out ulong monitor);
        [DllImport(library)] public static extern int ks_monitor_destroy(ulong monitor);
        [DllImport(library)]
        public static extern int ks_monitor_report(ulong monitor, ulong[] tracks, TrackReport[] reports, UIntPtr count);
        [DllImport(library)] public static extern int ks_monitor_remove(ulong monitor, ulong track);
        [DllImport(library)]
        public static extern int ks_monitor_advance(ulong monitor, double until, Poll poll, IntPtr user, ref MonitorEvent next);
        [DllImport(library)]
        public static extern int ks_monitor_save(ulong monitor, byte[] bytes, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)] public static extern int ks_monitor_restore(byte[] bytes, UIntPtr count, out ulong monitor);
        [DllImport(library)]
        public static extern int ks_monitor_tracks(ulong monitor, [Out] ulong[] tracks, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_monitor_places(
            ulong monitor, ulong track, [Out] TrackPlace[] places, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_monitor_needed(
            ulong monitor, double until, [Out] ReportRequest[] requests, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)] public static extern int ks_monitor_time(ulong monitor, out double time);
        [DllImport(library)]
        public static extern int ks_monitor_answer(ulong monitor, ulong first, ulong second, uint level, ref PairAnswer answer);
        [DllImport(library)]
        public static extern int ks_monitor_open_pairs(ulong monitor, [Out] OpenPair[] pairs, UIntPtr capacity, out UIntPtr count);
        [DllImport(library)]
        public static extern int ks_monitor_predicted_pairs(ulong monitor, [Out] PredictedPair[] pairs, UIntPtr capacity,
            out UIntPtr count);
    }
}
