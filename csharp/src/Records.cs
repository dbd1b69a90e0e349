// Generated from include/kinesphere.h by interface/generate.py: change the header, and run that.
using System;
using System.Runtime.InteropServices;

// Some fields are for C alone.
#pragma warning disable 169, 414, 649

namespace Kinesphere
{
    /// <summary>Which contact events bodies ask for.</summary>
    public enum Contacts
    {
        /// <summary>Of a body: what its world says.</summary>
        OfWorld = 0,
        /// <summary>A begin whenever two touch and approach, or are put into each other, and no ends.</summary>
        Impacts = 1,
        /// <summary>One begin and one end for each contact.</summary>
        BeginAndEnd = 2,
        /// <summary>Begins, ends, and each further approach in between.</summary>
        All = 3,
    }

    [Flags]
    public enum Axes : uint
    {
        None = 0,
        X = 1,
        Y = 2,
        Z = 4,
    }

    /// <summary>Main reason for the probes of a body.</summary>
    public enum ProbeReason
    {
        Touching = 0,
        NarrowMisses = 1,
        LooseLimit = 2,
        Contacts = 3,
        Travel = 4,
        Changes = 5,
        Queries = 6,
    }

    /// <summary>Kinds of events, in the order of their delivery within one instant.</summary>
    public enum EventKind
    {
        /// <summary>Nothing more happens until the time that was asked for.</summary>
        None = 0,
        /// <summary>A reported state contradicts the motion limits of its body.</summary>
        BoundViolation = 1,
        /// <summary>Two bodies touch: their gap has come down to at most the contact tolerance.</summary>
        ContactBegin = 2,
        /// <summary>Two bodies that touched are apart: their gap has grown to the separation distance.</summary>
        ContactEnd = 3,
        /// <summary>A body touches a wall of the box.</summary>
        WallBegin = 4,
        /// <summary>A body that touched a wall is clear of it.</summary>
        WallEnd = 5,
        /// <summary>Time would have stopped at a contact deep within its tolerance; it goes on by its least step. The two
        /// may come to overlap by more than the tolerance. If it comes often, a response does not part its bodies, or a
        /// body reaches through a wall.</summary>
        ZenoGuard = 6,
        /// <summary>The gap of two bodies has come down to a sensor distance.</summary>
        SensorEnter = 7,
        /// <summary>The gap of two bodies that were within a sensor distance has grown beyond it.</summary>
        SensorLeave = 8,
        /// <summary>A body that slept is awake again.</summary>
        Woke = 9,
        /// <summary>A timer of the caller's own, after all other events of its time. It names no body, and its
        /// FirstUserData is that of the timer.</summary>
        Timer = 10,
    }

    /// <summary>The walls of the box of a world.</summary>
    public enum Wall
    {
        None = 0,
        XLower = 1,
        XUpper = 2,
        YLower = 3,
        YUpper = 4,
        ZLower = 5,
        ZUpper = 6,
    }

    /// <summary>Properties of one body of an event.</summary>
    [Flags]
    public enum Traits : uint
    {
        None = 0,
        /// <summary>The body never moves.</summary>
        Static = 1,
        /// <summary>The body is not solid: it touches no other body.</summary>
        Zone = 2,
        /// <summary>The body sleeps and stays asleep: contacts wake their bodies.</summary>
        Sleeping = 4,
    }

    /// <summary>Which bodies of an event sense the other one.</summary>
    [Flags]
    public enum Senses : uint
    {
        Neither = 0,
        /// <summary>The first body senses the second one.</summary>
        First = 1,
        /// <summary>The second body senses the first one.</summary>
        Second = 2,
    }

    /// <summary>What a response does to a body, after the body has got its velocity.</summary>
    public enum BodyAction
    {
        None = 0,
        Remove = 1,
        Disable = 2,
        /// <summary>With velocity 0.</summary>
        Sleep = 3,
    }

    /// <summary>Kinesphere/monitor/separation.hpp explains each.</summary>
    public enum SeparationShape
    {
        Ellipsoid = 0,
        Cylinder = 1,
        WellClear = 2,
    }

    /// <summary>What the reports prove about two tracks and a separation.</summary>
    public enum Verdict
    {
        /// <summary>The two certainly are not within the separation.</summary>
        Apart = 0,
        /// <summary>The reports prove neither of the other two.</summary>
        Undecided = 1,
        /// <summary>They certainly are within it, or outside of it by at most the tolerance.</summary>
        Within = 2,
    }

    /// <summary>Kinds of events of a monitor.</summary>
    public enum MonitorEventKind
    {
        /// <summary>Nothing more happens until the time that was asked for.</summary>
        None = 0,
        /// <summary>The verdict about two tracks and a separation changes.</summary>
        Verdict = 1,
        /// <summary>If both go straight on, two tracks come within a separation, in its look-ahead time: no
        /// guarantee.</summary>
        Predicted = 2,
        /// <summary>They have passed each other, or a report shows that they will not come near.</summary>
        PredictionEnded = 3,
        /// <summary>A report contradicts the earlier ones of its track.</summary>
        Contradiction = 4,
        /// <summary>A contradiction has ended: later reports show which one was wrong.</summary>
        Resolved = 5,
        /// <summary>The latest report of a track has reached the age StaleAfter.</summary>
        Stale = 6,
        /// <summary>A stale track has reported again.</summary>
        Resumed = 7,
        /// <summary>A track was removed, or its latest report has reached the age DropAfter.</summary>
        Dropped = 8,
        /// <summary>A report has given the track another class; it starts anew. Comes before all others of its
        /// time.</summary>
        Reclassified = 9,
    }

    /// <summary>Shape of a static body, a zone or a body that carries it, best made by one of the functions
    /// below.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Shape
    {
        Native.ShapeKind kind;
        Vector points0, points1, points2;
        double number;
    }

    /// <summary>Selects the bodies that a body may touch: the category of each must have a bit in the mask of the other,
    /// unless both are in one group, which decides by its sign. A body without a filter of its own, as a floor, has the
    /// category 1: a mask without that bit lets its body fall through the floor.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Filter
    {
        /// <summary>Default 1.</summary>
        public ulong Category;
        /// <summary>Default all bits.</summary>
        public ulong Mask;
        public int Group;
    }

    /// <summary>As in C++.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct WorldDefinition
    {
        uint structSize;
        /// <summary>2 or 3, default 3. With 2, bodies are discs in the plane z = 0.</summary>
        public int Dimensions;
        int hasBox;
        /// <summary>These axes repeat, and have no walls.</summary>
        public Axes Periodic;
        Native.Box box;
        /// <summary>&gt; 0 (length), default 1e-6: the largest gap of a contact.</summary>
        public double ContactTolerance;
        /// <summary>&gt; ContactTolerance (length), default NaN, which is four tolerances: the gap at which a contact
        /// ends.</summary>
        public double SeparationDistance;
        /// <summary>&gt;= 0 (time): contacts of a body that follow each other sooner are `repeated`.</summary>
        public double ZenoInterval;
        /// <summary>The time at which the world begins.</summary>
        public double StartTime;
        /// <summary>Default `all`: what bodies ask for that do not say it themselves.</summary>
        public Contacts Contacts;
        int allowOverlap;
        int spreadWindowStarts;
        int hasWallFilter;
        Filter wallFilter;
        int adoptObservedLimits;
        int reserved;
        /// <summary>(1 / time): the images of bodies across y slide along x, so that a flow goes on through the borders. x
        /// and y repeat then, and all bodies are balls.</summary>
        public double ShearRate;
        /// <summary>Default true. If false, bodies that certainly overlap are refused.</summary>
        public bool AllowOverlap { get { return allowOverlap != 0; } set { allowOverlap = value ? 1 : 0; } }
        /// <summary>Has no effect.</summary>
        public bool SpreadWindowStarts { get { return spreadWindowStarts != 0; } set { spreadWindowStarts = value ? 1 : 0; } }
        /// <summary>Default true: a report that breaks the promise of its body raises the body's acceleration limit to what
        /// explains the report.</summary>
        public bool AdoptObservedLimits { get { return adoptObservedLimits != 0; } set { adoptObservedLimits = value ? 1 : 0; } }
        public static WorldDefinition Default
        {
            get
            {
                WorldDefinition made;
                Native.Check(Native.ks_world_definition_init(out made, Native.SizeOf<WorldDefinition>()));
                return made;
            }
        }
        internal void Require(string name) { Native.RequireDefault(structSize, "WorldDefinition", name); }
    }

    /// <summary>As in C++.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct BodyDefinition
    {
        uint structSize;
        int solid;
        /// <summary>Which contact events it asks for; by default those of the world.</summary>
        public Contacts Contacts;
        /// <summary>From 0 to 255; 255 is that of zones.</summary>
        public int SensorClass;
        /// <summary>&gt;= 0 (length), default 1.</summary>
        public double Radius;
        /// <summary>&gt;= 0 (length / time^2): the largest deviation from the planned acceleration.</summary>
        public double AccelerationLimit;
        /// <summary>&gt;= 0 (length): every reported position is within this of the true one.</summary>
        public double PositionError;
        /// <summary>&gt;= 0 (length / time): every reported velocity is within this of the true one.</summary>
        public double VelocityError;
        /// <summary>&gt;= 0, or infinity, default 1: every event of the body has it, and bounces use it.</summary>
        public double Mass;
        /// <summary>Known acceleration, such as gravity (length / time^2).</summary>
        public Vector PlannedAcceleration;
        public Vector Position;
        public Vector Velocity;
        /// <summary>Selects the bodies that it may touch.</summary>
        public Filter Filter;
        /// <summary>Stored for the caller.</summary>
        public ulong UserData;
        /// <summary>Default true. If false, the body only senses and is sensed.</summary>
        public bool Solid { get { return solid != 0; } set { solid = value ? 1 : 0; } }
        public static BodyDefinition Default
        {
            get
            {
                BodyDefinition made;
                Native.Check(Native.ks_body_definition_init(out made, Native.SizeOf<BodyDefinition>()));
                return made;
            }
        }
        internal void Require(string name) { Native.RequireDefault(structSize, "BodyDefinition", name); }
    }

    /// <summary>A body that never moves.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct StaticDefinition
    {
        uint structSize;
        int solid;
        /// <summary>From 0 to 255.</summary>
        public int SensorClass;
        /// <summary>Default: a ball of radius 1 at the origin.</summary>
        public Shape Shape;
        /// <summary>Selects the bodies that it may touch.</summary>
        public Filter Filter;
        /// <summary>Stored for the caller.</summary>
        public ulong UserData;
        /// <summary>Default true. If false, the body only senses and is sensed.</summary>
        public bool Solid { get { return solid != 0; } set { solid = value ? 1 : 0; } }
        public static StaticDefinition Default
        {
            get
            {
                StaticDefinition made;
                Native.Check(Native.ks_static_definition_init(out made, Native.SizeOf<StaticDefinition>()));
                return made;
            }
        }
        internal void Require(string name) { Native.RequireDefault(structSize, "StaticDefinition", name); }
    }

    /// <summary>As in C++.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe partial struct RigidDefinition
    {
        uint structSize;
        UIntPtr partCount;
        RigidPart* parts;
        /// <summary>At the world's current time; default: no rotation.</summary>
        public Rotation Rotation;
        /// <summary>&gt;= 0 (radians / time^2). At 0 the body keeps its angular velocity, and the world knows its
        /// rotation.</summary>
        public double AngularAccelerationLimit;
        /// <summary>&gt;= 0 (radians / time), default infinity; finite if the limit above is not 0.</summary>
        public double LargestAngularSpeed;
        /// <summary>Moments about the axes of the body, its principal ones (mass length^2).</summary>
        public Vector Inertia;
        UIntPtr hullCount;
        Native.Hull* hulls;
        public static RigidDefinition Default
        {
            get
            {
                RigidDefinition made;
                Native.Check(Native.ks_rigid_definition_init(out made, Native.SizeOf<RigidDefinition>()));
                return made;
            }
        }
        internal void Require(string name) { Native.RequireDefault(structSize, "RigidDefinition", name); }
    }

    /// <summary>Limits within which a body moves.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct MotionLimits
    {
        public double AccelerationLimit;
        public double PositionError;
        public double VelocityError;
        public Vector PlannedAcceleration;
    }

    /// <summary>What the world knows of a body.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct BodyView
    {
        uint structSize;
        int enabled;
        int isStatic;
        int sleeping;
        public double ReportTime;
        Native.Box box;
        public double BoxEnd;
        long image0, image1, image2;
        /// <summary>Its state is that of the last report.</summary>
        public BodyDefinition Definition;
        public bool Enabled { get { return enabled != 0; } }
        public bool IsStatic { get { return isStatic != 0; } }
        public bool Sleeping { get { return sleeping != 0; } }
        internal static BodyView New { get { return new BodyView { structSize = Native.SizeOf<BodyView>() }; } }
    }

    /// <summary>A body within a sensor distance (length) of another one.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct SensorOverlap
    {
        public BodyId Body;
        public double Distance;
    }

    /// <summary>Wall-clock time spent (seconds) since profiling was switched on.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Timings
    {
        /// <summary>Calls that advance the world.</summary>
        public ulong Advances;
        /// <summary>In these calls, including probes.</summary>
        public double Advance;
        /// <summary>In the caller's probes.</summary>
        public double Probes;
    }

    /// <summary>A body that was probed while profiling was on; `probes` is the sum of the next five fields.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct BusyBody
    {
        public BodyId Body;
        public ProbeReason Reason;
        /// <summary>Its probed states; the sum of the next five.</summary>
        public ulong Probes;
        /// <summary>For a body or wall that it touches.</summary>
        public ulong Touching;
        /// <summary>For a body, wall or sensor distance that it may reach or leave.</summary>
        public ulong NearOthers;
        /// <summary>As it left its safe regions.</summary>
        public ulong Windows;
        /// <summary>After changes by the caller and violated bounds.</summary>
        public ulong Changes;
        /// <summary>For queries and predictions with a probe.</summary>
        public ulong Queries;
        /// <summary>Its begins of contacts with bodies and walls.</summary>
        public ulong Contacts;
        /// <summary>Its limit now (length / time^2).</summary>
        public double AccelerationLimit;
        /// <summary>Largest deviation from the plan that reports prove (length / time^2).</summary>
        public double LargestAcceleration;
    }

    /// <summary>As in C++.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Event
    {
        uint structSize;
        public EventKind Kind;
        public double Time;
        /// <summary>The body of the event or, for a pair, the body with the smaller id. A timer has none.</summary>
        public BodyId First;
        /// <summary>The other body of a pair; no body for walls, bound violations, timers and bodies that woke.</summary>
        public BodyId Second;
        /// <summary>The wall of a wall event.</summary>
        public Wall Wall;
        int repeated;
        int jammed;
        int alreadyTouching;
        /// <summary>Of sensors: the body or bodies that sense the other one.</summary>
        public Senses Senses;
        public Traits FirstTraits;
        /// <summary>None for a wall.</summary>
        public Traits SecondTraits;
        /// <summary>The state that the two of a pair were given; 0 for all others.</summary>
        public int PairState;
        /// <summary>At `time`; of a static body one point of its shape. In periodic space the two are nearest
        /// images.</summary>
        public State FirstState;
        public State SecondState;
        /// <summary>The middle of the gap between the two surfaces.</summary>
        public Vector Point;
        /// <summary>Unit vector from `first` towards `second`, or towards the wall.</summary>
        public Vector Normal;
        /// <summary>Distance between the surfaces (length); negative when they overlap.</summary>
        public double Gap;
        /// <summary>Speed at which the gap closes (length / time); negative when it opens.</summary>
        public double ApproachSpeed;
        /// <summary>Of a bound violation: how far the reported position lies outside the bound (length).</summary>
        public double PositionExcess;
        /// <summary>Of a bound violation: by how much the velocity changed more than promised (length / time).</summary>
        public double VelocityExcess;
        /// <summary>Of a sensor: the sensor distance that was crossed (length).</summary>
        public double Distance;
        /// <summary>What the definition of the body gave.</summary>
        public ulong FirstUserData;
        public ulong SecondUserData;
        /// <summary>Of the body; infinite for a static body.</summary>
        public double FirstMass;
        /// <summary>Of the body; infinite for a static body and for a wall.</summary>
        public double SecondMass;
        /// <summary>Of a rigid body: the number of the part at the contact; of a mesh: that of the triangle; 0 for all
        /// others.</summary>
        public uint FirstPart;
        public uint SecondPart;
        /// <summary>Of a rigid body (radians / time); zero for all others.</summary>
        public Vector FirstAngularVelocity;
        public Vector SecondAngularVelocity;
        /// <summary>Change of the angular velocity of a rigid body by a unit impulse along the normal (radians / (mass
        /// length)).</summary>
        public Vector FirstSpinGain;
        public Vector SecondSpinGain;
        /// <summary>Of a bound violation: the acceleration limit that the body has from now on (length / time^2).</summary>
        public double AccelerationLimit;
        /// <summary>One of the two touched another body less than the Zeno interval ago: a response should take no energy
        /// here.</summary>
        public bool Repeated { get { return repeated != 0; } }
        /// <summary>Each of the two has had 64 contacts at this instant, as if stuck: a response should part them, or stop
        /// both.</summary>
        public bool Jammed { get { return jammed != 0; } }
        /// <summary>Of begins: the two have touched since an earlier begin, and approach again. To count contacts, count
        /// the others.</summary>
        public bool AlreadyTouching { get { return alreadyTouching != 0; } }
        internal static Event New { get { return new Event { structSize = Native.SizeOf<Event>() }; } }
    }

    /// <summary>A body that is not turned continues as before.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Response
    {
        uint structSize;
        int stop;
        int turnsFirst;
        int turnsSecond;
        int spinsFirst;
        int spinsSecond;
        public BodyAction FirstAction;
        public BodyAction SecondAction;
        Vector firstVelocity;
        Vector secondVelocity;
        Vector firstAngularVelocity;
        Vector secondAngularVelocity;
        int turnedBack;
        int setsPairState;
        int pairState;
        int reserved;
    }

    /// <summary>How rough spheres or discs bounce: Walton's model.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Roughness
    {
        uint structSize;
        int reserved;
        /// <summary>In [0, 1], default 1: along the normal.</summary>
        public double Restitution;
        /// <summary>In [-1, 1], default 1: what is left of the tangential velocity of the surfaces in a contact that
        /// sticks, turned back; -1 is smooth.</summary>
        public double TangentialRestitution;
        /// <summary>&gt;= 0, default infinity: coefficient beyond which a contact slides.</summary>
        public double Friction;
        /// <summary>&gt; 0, default 0.4: moment of inertia in units of mass and squared radius.</summary>
        public double Inertia;
        public static Roughness Default
        {
            get
            {
                Roughness made;
                Native.Check(Native.ks_roughness_init(out made, Native.SizeOf<Roughness>()));
                return made;
            }
        }
        internal void Require(string name) { Native.RequireDefault(structSize, "Roughness", name); }
    }

    /// <summary>Hash of a set of events ; all zeros at first. Equal values mean bit-identical runs.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct EventHash
    {
        ulong sum;
        ulong count;
    }

    /// <summary>When a contact or an approach may happen first. It certainly does not happen before `time`.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Prediction
    {
        /// <summary>In [current time, infinity].</summary>
        public double Time;
        /// <summary>No body for a wall, or if the time is infinite.</summary>
        public BodyId Partner;
        public Wall Wall;
        int happens;
        int probed;
        /// <summary>The contact exists, or the partner certainly is within the distance.</summary>
        public bool Happens { get { return happens != 0; } }
        public bool Probed { get { return probed != 0; } }
    }

    /// <summary>A body that a query found. For the nearest bodies and for casts its distance is between `lower` and `upper`
    /// (length); for overlaps both are 0.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Hit
    {
        public BodyId Body;
        int certain;
        public double Lower;
        public double Upper;
        /// <summary>False: possibly.</summary>
        public bool Certain { get { return certain != 0; } }
    }

    /// <summary>A sphere in which to look for bodies (length).</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Sphere
    {
        public Vector Centre;
        public double Radius;
    }

    /// <summary>A ray or, with a radius &gt; 0, the way of a sphere (length). `direction` may have any length &gt;
    /// 0.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Ray
    {
        public Vector Origin;
        public Vector Direction;
        public double Length;
        public double Radius;
    }

    /// <summary>Upper limit of an error: a ball of radius `horizontal`, or a limit in the plane and one along z.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct ErrorBound
    {
        Native.BoundKind kind;
        double horizontal;
        double vertical;
    }

    /// <summary>Limits of all tracks of a class; at least one of AccelerationLimit and LargestSpeed is finite.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct TrackClass
    {
        public ErrorBound AccelerationLimit;
        public ErrorBound LargestSpeed;
        public Vector PlannedAcceleration;
    }

    /// <summary>As in C++.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct Separation
    {
        public SeparationShape Shape;
        /// <summary>&gt; 0 (length).</summary>
        public double Horizontal;
        /// <summary>&gt; 0 (length).</summary>
        public double Vertical;
        /// <summary>&gt;= 0 (time); 0: nothing is predicted.</summary>
        public double LookAhead;
        public double ModifiedTau;
    }

    /// <summary>A reported state of a track.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct TrackReport
    {
        uint structSize;
        int hasPlan;
        /// <summary>Place of its class in those of the monitor.</summary>
        public ulong TrackClass;
        /// <summary>Time of the state on the monitor's clock.</summary>
        public double Timestamp;
        /// <summary>Largest difference of the timestamp from the true time.</summary>
        public double TimestampError;
        public State State;
        /// <summary>Largest distance of the true position from the reported one (length).</summary>
        public ErrorBound PositionError;
        /// <summary>Largest difference of the true velocity from the reported one (length / time); infinite if none was
        /// reported.</summary>
        public ErrorBound VelocityError;
        Vector planAcceleration;
        ErrorBound planLimit;
        double planValidUntil;
        public static TrackReport Default
        {
            get
            {
                TrackReport made;
                Native.Check(Native.ks_track_report_init(out made, Native.SizeOf<TrackReport>()));
                return made;
            }
        }
        internal void Require(string name) { Native.RequireDefault(structSize, "TrackReport", name); }
    }

    /// <summary>As in C++.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct MonitorEvent
    {
        uint structSize;
        public MonitorEventKind Kind;
        public double Time;
        /// <summary>The track of the event; for a pair, the one with the lower id.</summary>
        public ulong First;
        /// <summary>Of a verdict or a prediction: the track with the higher id.</summary>
        public ulong Second;
        /// <summary>Of a verdict or a prediction: the separation level.</summary>
        public uint Level;
        /// <summary>Of a verdict: the new one.</summary>
        public Verdict Verdict;
        /// <summary>Of a verdict: the one before.</summary>
        public Verdict Before;
        uint reserved;
        /// <summary>Time at which the verdict before began, -infinity for a pair that was apart at all levels; of a
        /// prediction, time at which it began.</summary>
        public double Since;
        /// <summary>Of a prediction: the time at which the two come within; infinity if they never do.</summary>
        public double LikelyTime;
        /// <summary>Of a prediction: the time of the closest approach.</summary>
        public double ClosestTime;
        /// <summary>Of a prediction: the distance then (length); for a cylinder that in the plane.</summary>
        public double ClosestDistance;
        /// <summary>Of a contradiction: how far the position is outside of what was possible (length).</summary>
        public double PositionExcess;
        /// <summary>Of a contradiction: how far the velocity is outside (length / time).</summary>
        public double VelocityExcess;
        internal static MonitorEvent New { get { return new MonitorEvent { structSize = Native.SizeOf<MonitorEvent>() }; } }
    }

    /// <summary>The verdict about two tracks, with a forecast.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct PairAnswer
    {
        uint structSize;
        public Verdict Verdict;
        int predicted;
        /// <summary>Time since which the verdict has held; -infinity for a pair that is apart at all levels.</summary>
        public double Since;
        /// <summary>A certain verdict is true until this time, whatever is reported.</summary>
        public double Until;
        /// <summary>Lower limit of the distance now (length); for a cylinder, of that in the plane.</summary>
        public double Lower;
        /// <summary>Upper limit of it.</summary>
        public double Upper;
        /// <summary>Estimate, if both go straight on: distance at the closest approach; for a cylinder that in the
        /// plane.</summary>
        public double ClosestDistance;
        /// <summary>Estimate: the time of the closest approach.</summary>
        public double ClosestTime;
        /// <summary>Estimate: the horizontal part of the distance at that time.</summary>
        public double ClosestHorizontal;
        /// <summary>Estimate: the vertical part.</summary>
        public double ClosestVertical;
        /// <summary>Estimate: speed of one relative to the other now.</summary>
        public double RelativeSpeed;
        /// <summary>Estimate: time at which they first are within the separation; infinity if they never are.</summary>
        public double LikelyTime;
        /// <summary>The pair certainly is within at some time up to this one, whatever the tracks do within their
        /// limits.</summary>
        public double InevitableBy;
        /// <summary>Estimate: if both go straight on until this time, no accelerations within their limits keep them
        /// out.</summary>
        public double AvoidableUntil;
        /// <summary>The track whose report would tighten the bounds most.</summary>
        public ulong Ask;
        /// <summary>When that report is needed for the verdict to stay certain.</summary>
        public double AskBy;
        /// <summary>From `predicted` to `prediction_ended`.</summary>
        public bool Predicted { get { return predicted != 0; } }
        internal static PairAnswer New { get { return new PairAnswer { structSize = Native.SizeOf<PairAnswer>() }; } }
    }

    /// <summary>A pair that is not certainly apart at a level.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct OpenPair
    {
        public ulong First;
        public ulong Second;
        public uint Level;
        public Verdict Verdict;
        public double Since;
    }

    /// <summary>A pair that is predicted to come within a separation; times and distance as in its event, from
    /// now.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct PredictedPair
    {
        public ulong First;
        public ulong Second;
        public uint Level;
        /// <summary>Time of its event `predicted`.</summary>
        public double Since;
        public double LikelyTime;
        public double ClosestTime;
        public double ClosestDistance;
    }

    /// <summary>A report of `track` is needed by the time `by` for its verdict with `other` to stay certain.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct ReportRequest
    {
        public ulong Track;
        public ulong Other;
        public double By;
    }

    /// <summary>Where a track is now: within `radius` of `centre`.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public partial struct TrackPlace
    {
        public Vector Centre;
        public Vector Velocity;
        public ErrorBound Radius;
    }

    public sealed unsafe partial class MonitorDefinition
    {
        /// <summary>2 or 3, default 3. In two dimensions, z is ignored.</summary>
        public int Dimensions;
        /// <summary>Without it the clock starts at the first report or the first time to advance to.</summary>
        public double? StartTime;
        /// <summary>&gt; 0 (length), default 1e-3: how far outside the separation a pair still is `within`.</summary>
        public double Tolerance;
        /// <summary>&gt; 0 (time), default 1e-3: how late a verdict may be that time alone decides.</summary>
        public double TimeResolution;
        /// <summary>&gt; 0 (time), default 1: about the time between two reports of a track.</summary>
        public double Window;
        /// <summary>&gt; 0 (time), default infinity: age of the latest report at which a track is stale.</summary>
        public double StaleAfter;
        /// <summary>&gt; 0 (time), default infinity: age of the latest report at which a track is dropped.</summary>
        public double DropAfter;
        /// <summary>&gt;= 0 (time): a prediction ends once it has not held for this long.</summary>
        public double PredictionHold;
        /// <summary>&gt;= 0 (time): a prediction begins once it has held for this long.</summary>
        public double PredictionConfirmation;
        /// <summary>In [0, 1]: a prediction goes on within the separation enlarged by this part of it.</summary>
        public double PredictionMargin;
        /// <summary>In [0, 1]: separations are enlarged for predictions by this part of the position errors of both
        /// tracks.</summary>
        public double PredictionErrorPart;
        /// <summary>Default 1: the monitor watches shards ShardFirst, ..., ShardFirst + ShardCount - 1 of all pairs, out of
        /// ShardOf; a pair is in the shard that the lower of its ids modulo ShardOf says.</summary>
        public ulong ShardOf;
        /// <summary>The first one that it watches.</summary>
        public ulong ShardFirst;
        /// <summary>Default 1.</summary>
        public ulong ShardCount;
        public MonitorDefinition()
        {
            var made = Native.MonitorDefinition.Default;
            Dimensions = made.Dimensions;
            Tolerance = made.Tolerance;
            TimeResolution = made.TimeResolution;
            Window = made.Window;
            StaleAfter = made.StaleAfter;
            DropAfter = made.DropAfter;
            PredictionHold = made.PredictionHold;
            PredictionConfirmation = made.PredictionConfirmation;
            PredictionMargin = made.PredictionMargin;
            PredictionErrorPart = made.PredictionErrorPart;
            ShardOf = made.ShardOf;
            ShardFirst = made.ShardFirst;
            ShardCount = made.ShardCount;
        }
        /// <summary>The record of C, without its lists.</summary>
        Native.MonitorDefinition Raw()
        {
            var made = Native.MonitorDefinition.Default;
            made.Dimensions = Dimensions;
            made.Tolerance = Tolerance;
            made.TimeResolution = TimeResolution;
            made.Window = Window;
            made.StaleAfter = StaleAfter;
            made.DropAfter = DropAfter;
            made.PredictionHold = PredictionHold;
            made.PredictionConfirmation = PredictionConfirmation;
            made.PredictionMargin = PredictionMargin;
            made.PredictionErrorPart = PredictionErrorPart;
            made.ShardOf = ShardOf;
            made.ShardFirst = ShardFirst;
            made.ShardCount = ShardCount;
            made.HasStartTime = StartTime.HasValue ? 1 : 0;
            made.StartTime = StartTime.GetValueOrDefault();
            return made;
        }
    }
}
