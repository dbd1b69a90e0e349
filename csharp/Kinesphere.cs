// Worlds and monitors in C#. Methods have the meanings, errors and costs of those of the C++ headers; wrong use throws a
// KinesphereException. An exception in a callback passes through the call that called it.
using System;
using System.Collections.Generic;
using System.Runtime.ExceptionServices;
using System.Runtime.InteropServices;

namespace Kinesphere
{
    /// <summary>Sets the states of bodies at a time, position and velocity of each: they are NaN at first, so that one that is
    /// forgotten is an error.</summary>
    public delegate void Probe(BodyId[] bodies, double time, State[] states);
    /// <summary>Sets the rotations of rigid bodies at a time, which are NaN at first.</summary>
    public delegate void RotationProbe(BodyId[] bodies, double time, Rotation[] rotations);
    /// <summary>Chooses what an event does to its bodies: the same for the same event, and in any thread.</summary>
    public delegate Response Respond(Event happened);
    /// <summary>Decides whether two bodies whose filters let them touch may do so: the same for both orders, and until
    /// World.RefreshFilter. It may read the world.</summary>
    public delegate bool PairFilter(BodyId first, BodyId second);
    /// <summary>Sets the latest reports of tracks, no later than the time; null for a track without a newer one.</summary>
    public delegate void Poll(ulong[] tracks, double time, TrackReport?[] reports);

    /// <summary>The library that has been loaded.</summary>
    public static class Library
    {
        /// <summary>Such as "0.3.0".</summary>
        public static string Version { get { return Marshal.PtrToStringAnsi(Native.ks_version()); } }
    }

    /// <summary>An exception of a callback, which must not pass through C.</summary>
    sealed class Caught
    {
        ExceptionDispatchInfo exception;

        public int Call(Action body)
        {
            try
            {
                body();
                return 0;
            }
            catch (Exception thrown)
            {
                exception = ExceptionDispatchInfo.Capture(thrown);
                return 1;
            }
        }
        /// <summary>Throws the exception, once, if there was one and it made a call fail.</summary>
        public void Rethrow(int status = Native.CallbackFailed)
        {
            var thrown = exception;
            exception = null;
            if (status == Native.CallbackFailed && thrown != null) thrown.Throw();
        }
    }

    /// <summary>A world of moving spheres.</summary>
    public sealed unsafe class World : IDisposable
    {
        static readonly Native.Probe motions = Native.ks_probe_motions;
        ulong handle;
        bool disposed;
        // The library keeps pointers to these functions, also in clones of this world, which share `kept`.
        Native.RotationProbe rotations;
        Native.PairFilter pairs;
        Caught kept = new Caught();

        public World(WorldDefinition definition)
        {
            definition.Require("definition");
            Native.Check(Native.ks_world_create(ref definition, out handle));
        }
        internal World(ulong handle) { this.handle = handle; }
        ~World() { Native.ks_world_destroy(handle); }
        /// <summary>Destroys the world; each later call but Dispose throws.</summary>
        public void Dispose()
        {
            if (disposed) return;
            Native.Check(Native.ks_world_destroy(handle));
            disposed = true;
            GC.SuppressFinalize(this);
        }

        /// <summary>Returns a copy that continues as this world does, with its motions and ids: for rollback.</summary>
        public World Clone()
        {
            ulong copy;
            Check(Native.ks_world_clone(handle, out copy));
            return new World(copy) { rotations = rotations, pairs = pairs, kept = kept };
        }
        /// <summary>Returns a snapshot, without motions, rotation probe and pair filter.</summary>
        public byte[] Save()
        {
            return Filled<byte>((byte[] bytes, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_save(handle, bytes, capacity, out count));
        }
        /// <summary>The world of a snapshot; `filter` is the pair filter that it had.</summary>
        public static World Restore(byte[] snapshot, PairFilter filter = null)
        {
            ulong restored;
            var caught = new Caught();
            var callback = PairCallback(filter, caught);
            int status = Native.ks_world_restore(snapshot, Count(snapshot, "snapshot"), callback, IntPtr.Zero, out restored);
            Native.Check(status);
            return new World(restored) { pairs = callback, kept = caught };
        }

        public BodyId Add(BodyDefinition body) { return AddAll(new[] { body })[0]; }
        /// <summary>Adds all bodies or, on an error, none.</summary>
        public BodyId[] AddAll(BodyDefinition[] bodies)
        {
            var count = Count(bodies, "bodies");
            foreach (var body in bodies) body.Require("bodies");
            var ids = new BodyId[bodies.Length];
            Check(Native.ks_world_add(handle, bodies, count, ids));
            return ids;
        }
        public BodyId AddStatic(StaticDefinition body) { return AddStaticAll(new[] { body })[0]; }
        /// <summary>Adds all bodies or, on an error, none.</summary>
        public BodyId[] AddStaticAll(StaticDefinition[] bodies)
        {
            var count = Count(bodies, "bodies");
            foreach (var body in bodies) body.Require("bodies");
            var ids = new BodyId[bodies.Length];
            Check(Native.ks_world_add_static(handle, bodies, count, ids));
            return ids;
        }
        /// <summary>
        /// Adds a body that carries a box or a triangle, relative to its position; the radius is ignored. The probe
        /// moves it. It meets no walls and no other body with a shape.
        /// </summary>
        public BodyId AddMovingShape(BodyDefinition body, Shape shape)
        {
            BodyId id;
            body.Require("body");
            Check(Native.ks_world_add_moving_shape(handle, ref body, ref shape, out id));
            return id;
        }
        /// <summary>
        /// Adds a rigid body: balls and capsules that move and turn together; the radius is ignored. The probe moves it.
        /// </summary>
        public BodyId AddRigidBody(BodyDefinition body, RigidDefinition rigid, params RigidPart[] parts)
        {
            return AddRigidBody(body, rigid, parts, new RigidHull[0]);
        }
        /// <summary>The same with convex hulls, whose numbers as parts follow those of the others.</summary>
        public BodyId AddRigidBody(BodyDefinition body, RigidDefinition rigid, RigidPart[] parts, RigidHull[] hulls)
        {
            BodyId id;
            body.Require("body");
            rigid.Require("rigid");
            Count(parts, "parts");
            Count(hulls, "hulls");
            foreach (var hull in hulls)
                if (hull == null || hull.Points == null) throw new ArgumentNullException("hulls");
            var found = new Native.Hull[hulls.Length];
            var pinned = new GCHandle[hulls.Length];
            try
            {
                for (int k = 0; k < found.Length; ++k)
                {
                    pinned[k] = GCHandle.Alloc(hulls[k].Points, GCHandleType.Pinned);
                    found[k].PointCount = Count(hulls[k].Points, "hulls");
                    found[k].Points = (Vector*)pinned[k].AddrOfPinnedObject();
                    found[k].Radius = hulls[k].Radius;
                }
                fixed (RigidPart* first = parts)
                fixed (Native.Hull* firstHull = found)
                {
                    rigid.SetParts(first, parts.Length);
                    rigid.SetHulls(firstHull, found.Length);
                    Check(Native.ks_world_add_rigid_body(handle, ref body, ref rigid, out id));
                }
            }
            finally
            {
                foreach (var one in pinned)
                    if (one.IsAllocated) one.Free();
            }
            return id;
        }
        /// <summary>Informs the world that a rigid body turns with this angular velocity from now on.</summary>
        public void SetAngularVelocity(BodyId body, Vector angularVelocity)
        {
            Check(Native.ks_world_set_angular_velocity(handle, body, angularVelocity));
        }
        /// <summary>Turns a rigid body at once, as Teleport moves it.</summary>
        public void SetRotation(BodyId body, Rotation rotation)
        {
            Check(Native.ks_world_set_rotation(handle, body, ref rotation));
        }
        /// <summary>The rotation of a rigid body at its last report.</summary>
        public Rotation RotationOf(BodyId body)
        {
            Rotation rotation;
            Check(Native.ks_world_rotation(handle, body, out rotation));
            return rotation;
        }
        /// <summary>Sets the function that gives the rotations of rigid bodies, directly after the probe; null removes it.
        /// Clones share it.</summary>
        public void SetRotationProbe(RotationProbe probe)
        {
            Native.RotationProbe callback = probe == null ? null : RotationCallback(probe, kept);
            Check(Native.ks_world_set_rotation_probe(handle, callback, IntPtr.Zero));
            rotations = callback;
        }
        /// <summary>Adds a zone, which reports who enters and leaves it: all bodies, or those that the filter selects.</summary>
        public BodyId AddZone(Shape shape, ulong userData = 0, Filter? filter = null)
        {
            BodyId id;
            Check(Native.ks_world_add_zone(handle, ref shape, userData, out id));
            if (filter.HasValue) SetFilter(id, filter.Value);
            return id;
        }
        /// <summary>Makes room for this number of bodies in total.</summary>
        public void Reserve(int bodies) { Check(Native.ks_world_reserve(handle, NotNegative(bodies, "bodies"))); }
        public void Remove(BodyId body) { RemoveAll(new[] { body }); }
        /// <summary>Removes all bodies or, on an error, none.</summary>
        public void RemoveAll(BodyId[] bodies) { Check(Native.ks_world_remove(handle, bodies, Count(bodies, "bodies"))); }

        /// <summary>Informs the world, and the motion of the body if it has one, of a new velocity.</summary>
        public void SetVelocity(BodyId body, Vector velocity)
        {
            Check(Native.ks_world_set_velocity(handle, body, velocity));
        }
        /// <summary>Sets the velocities of all these bodies or, on an error, of none.</summary>
        public void SetVelocities(BodyId[] bodies, Vector[] velocities)
        {
            if (Count(bodies, "bodies") != Count(velocities, "velocities"))
                throw new ArgumentException("there must be one velocity for each body", "velocities");
            Check(Native.ks_world_set_velocities(handle, bodies, velocities, Count(bodies, "bodies")));
        }
        /// <summary>Does what a response to this event says, but for Stop: between two events the world always stands still.</summary>
        public void Apply(Event happened, Response response)
        {
            if (response.First.HasValue) SetVelocity(happened.First, response.First.Value);
            if (response.Second.HasValue) SetVelocity(happened.Second, response.Second.Value);
            if (response.FirstAngularVelocity.HasValue) SetAngularVelocity(happened.First, response.FirstAngularVelocity.Value);
            if (response.SecondAngularVelocity.HasValue) SetAngularVelocity(happened.Second, response.SecondAngularVelocity.Value);
            Act(happened.First, response.FirstAction);
            Act(happened.Second, response.SecondAction);
        }
        void Act(BodyId body, BodyAction action)
        {
            if (action == BodyAction.Remove) Remove(body);
            if (action == BodyAction.Disable) Disable(body);
            if (action != BodyAction.Sleep) return;
            SetVelocity(body, new Vector());
            Sleep(body);
        }
        public void Teleport(BodyId body, State state) { Check(Native.ks_world_teleport(handle, body, ref state)); }
        public void SetRadius(BodyId body, double radius) { Check(Native.ks_world_set_radius(handle, body, radius)); }
        /// <summary>Lets the radius of a ball change at this rate (length / time); negative for one that shrinks.</summary>
        public void SetRadiusRate(BodyId body, double rate) { Check(Native.ks_world_set_radius_rate(handle, body, rate)); }
        public void SetMass(BodyId body, double mass) { Check(Native.ks_world_set_mass(handle, body, mass)); }
        public void SetMotionLimits(BodyId body, MotionLimits limits)
        {
            Check(Native.ks_world_set_motion_limits(handle, body, ref limits));
        }
        /// <summary>Gives a static body, a zone or a moving shape another shape.</summary>
        public void SetShape(BodyId body, Shape shape) { Check(Native.ks_world_set_shape(handle, body, ref shape)); }
        public void SetSolid(BodyId body, bool solid) { Check(Native.ks_world_set_solid(handle, body, solid ? 1 : 0)); }
        /// <summary>Stores a number for the caller: events have it.</summary>
        public void SetUserData(BodyId body, ulong data) { Check(Native.ks_world_set_user_data(handle, body, data)); }
        public void SetFilter(BodyId body, Filter filter) { Check(Native.ks_world_set_filter(handle, body, ref filter)); }
        public void Disable(BodyId body) { Check(Native.ks_world_disable(handle, body)); }
        public void Enable(BodyId body, State state) { Check(Native.ks_world_enable(handle, body, ref state)); }
        public void Sleep(BodyId body) { Check(Native.ks_world_sleep(handle, body)); }
        public void Wake(BodyId body) { Check(Native.ks_world_wake(handle, body)); }
        /// <summary>Sets the distances at which bodies of a class sense bodies with a category in the mask.</summary>
        public void SetSensor(int sensorClass, double[] distances, ulong mask = ulong.MaxValue)
        {
            Check(Native.ks_world_set_sensor(handle, sensorClass, distances, Count(distances, "distances"), mask));
        }
        public void SetSensorClass(BodyId body, int sensorClass)
        {
            Check(Native.ks_world_set_sensor_class(handle, body, sensorClass));
        }
        /// <summary>Sets a predicate for pairs whose filters let them touch; null removes it. Clones share it. An exception
        /// passes through the call that asked, which has gone on as if the two might touch.</summary>
        public void SetPairFilter(PairFilter filter)
        {
            var callback = PairCallback(filter, kept);
            Check(Native.ks_world_set_pair_filter(handle, callback, IntPtr.Zero));
            pairs = callback;
        }
        /// <summary>Asks the pair filter again about all pairs of a body.</summary>
        public void RefreshFilter(BodyId body) { Check(Native.ks_world_refresh_filter(handle, body)); }

        public double Time
        {
            get
            {
                double time;
                Check(Native.ks_world_time(handle, out time));
                return time;
            }
        }
        public int Size
        {
            get
            {
                UIntPtr bodies;
                Check(Native.ks_world_size(handle, out bodies));
                return (int)bodies;
            }
        }
        public bool Contains(BodyId body)
        {
            int contains;
            Check(Native.ks_world_contains(handle, body, out contains));
            return contains != 0;
        }
        public BodyId[] Bodies()
        {
            return Filled<BodyId>((BodyId[] bodies, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_bodies(handle, bodies, capacity, out count));
        }
        /// <summary>What the world knows of a body.</summary>
        public BodyView Body(BodyId body)
        {
            var view = BodyView.New;
            Check(Native.ks_world_body(handle, body, ref view));
            return view;
        }
        /// <summary>The bodies within sensor distances of a body, with these distances.</summary>
        public SensorOverlap[] SensorOverlaps(BodyId body)
        {
            return Filled<SensorOverlap>((SensorOverlap[] overlaps, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_sensor_overlaps(handle, body, overlaps, capacity, out count));
        }
        /// <summary>The number of states that the world has asked for so far.</summary>
        public ulong ProbeCount
        {
            get
            {
                ulong probes;
                Check(Native.ks_world_probe_count(handle, out probes));
                return probes;
            }
        }
        /// <summary>The bodies in contact with a body.</summary>
        public BodyId[] Touching(BodyId body)
        {
            return Filled<BodyId>((BodyId[] partners, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_touching(handle, body, partners, capacity, out count));
        }

        /// <summary>Advances to the next event, at most to time `until`. Returns the event, with the world at its time;
        /// or one of kind None, with the world at `until`. The probe is for the bodies that no motion moves; null if
        /// motions move all.</summary>
        public Event Advance(double until, Probe probe = null)
        {
            var next = Event.New;
            Ask(probe, callback => Native.ks_world_advance(handle, until, callback ?? motions, IntPtr.Zero, ref next));
            return next;
        }
        /// <summary>Goes through the events up to `until`, for a loop in which bodies may be changed.</summary>
        public IEnumerable<Event> Events(double until, Probe probe = null)
        {
            for (var next = Advance(until, probe); next.Kind != EventKind.None; next = Advance(until, probe)) yield return next;
        }
        /// <summary>Makes a call that may ask for states; null: of no body.</summary>
        void Ask(Probe probe, Func<Native.Probe, int> call)
        {
            var caught = new Caught();
            var callback = probe == null ? null : Callback(probe, caught);
            int status = call(callback);
            GC.KeepAlive(callback);
            GC.KeepAlive(this);
            caught.Rethrow(status);
            Check(status);
        }
        /// <summary>Throws an exception of a function that the world keeps, or the error of the library, if there is one.</summary>
        void Check(int status)
        {
            kept.Rethrow();
            Native.Check(status);
        }

        /// <summary>Advances to time `until` and answers all events by bouncing, which with a resting speed lets heaps come
        /// to rest, or by `respond`. Motions must move all
        /// bodies; one that a response removes leaves its motion, too. The sink receives each event, in order, and may read
        /// the world. At an event whose response has Stop the world is at the time of the event, and the sink may change it;
        /// elsewhere such calls throw "run_in_progress", as Advance and Run always do.</summary>
        public void Run(double until, double restitution = 1, Respond respond = null, Action<Event> sink = null, int threads = 1,
            double restingSpeed = 0)
        {
            Native.RunDefinition definition;
            Native.Check(Native.ks_run_definition_init(out definition, Native.SizeOf<Native.RunDefinition>()));
            var caught = new Caught();
            Native.Respond answer = (happened, response, user) => caught.Call(() => *response = respond(*happened).Sized());
            Native.Sink tell = (happened, user) => caught.Call(() => sink(*happened));
            definition.Threads = threads;
            definition.Restitution = restitution;
            definition.RestingSpeed = restingSpeed;
            if (respond != null) definition.Respond = Marshal.GetFunctionPointerForDelegate(answer);
            if (sink != null) definition.Sink = Marshal.GetFunctionPointerForDelegate(tell);
            int status = Native.ks_world_run(handle, until, ref definition);
            GC.KeepAlive(answer);
            GC.KeepAlive(tell);
            GC.KeepAlive(this);
            caught.Rethrow(status);
            Check(status);
        }

        /// <summary>Adds bodies in free flight.</summary>
        public BodyId[] AddBallistic(State[] states, BodyDefinition like, Vector gravity, double[] radii = null, double[] masses = null)
        {
            uint motion;
            return AddBallistic(states, like, gravity, out motion, radii, masses);
        }
        /// <summary>The same, with the number of the motion for AddToMotion.</summary>
        public BodyId[] AddBallistic(State[] states, BodyDefinition like, Vector gravity, out uint motion,
            double[] radii = null, double[] masses = null)
        {
            var definition = Motion(0);
            definition.Gravity = gravity;
            return AddMotion(definition, states, like, null, radii, masses, out motion);
        }
        /// <summary>Adds more bodies, such as bullets, to a motion. Their numbers there, which are their indices in frames,
        /// are the next ones, or those of removed bodies.</summary>
        public BodyId[] AddToMotion(uint motion, State[] states, BodyDefinition like, out uint[] numbers,
            double[] accelerationLimits = null, double[] radii = null, double[] masses = null)
        {
            var found = new uint[(int)Count(states, "states")];
            numbers = found;
            return AddMoved(Motion(0), states, like, accelerationLimits, radii, masses,
                (ref Native.MotionDefinition definition, BodyId[] ids) =>
                    Native.ks_world_add_to_motion(handle, motion, ref definition, found, ids));
        }
        /// <summary>Adds bodies under random accelerations up to their limits, new at multiples of the interval.</summary>
        public BodyId[] AddRandomForces(State[] states, BodyDefinition like, double[] accelerationLimits, double interval,
            ulong seed, double[] radii = null, double[] masses = null)
        {
            uint motion;
            var definition = Motion(1);
            definition.Interval = interval;
            definition.Seed = seed;
            return AddMotion(definition, states, like, accelerationLimits, radii, masses, out motion);
        }
        /// <summary>Adds bodies that Steer moves: each keeps its acceleration, at first zero, within its limit.</summary>
        public BodyId[] AddSteered(State[] states, BodyDefinition like, double[] accelerationLimits, out uint motion,
            double[] radii = null, double[] masses = null)
        {
            return AddMotion(Motion(3), states, like, accelerationLimits, radii, masses, out motion);
        }
        /// <summary>Sets the acceleration of a body that AddSteered added, from the current time on.</summary>
        public void Steer(BodyId body, Vector acceleration) { Check(Native.ks_world_steer(handle, body, acceleration)); }
        /// <summary>Adds bodies of a game's frames: straight from the position in one frame to that in the next. Without
        /// limits the world is informed of all new velocities at each frame.</summary>
        public BodyId[] AddFrames(State[] states, BodyDefinition like, double interval, out uint motion,
            double[] radii = null, double[] masses = null, double[] accelerationLimits = null, double positionError = 0)
        {
            var definition = Motion(2);
            definition.Interval = interval;
            definition.PositionError = positionError;
            return AddMotion(definition, states, like, accelerationLimits, radii, masses, out motion);
        }
        /// <summary>Appends the next frame, and returns its time, to which to advance then.</summary>
        public double PushFrame(uint motion, Vector[] positions)
        {
            double time;
            Check(Native.ks_world_push_frame(handle, motion, positions, Count(positions, "positions")));
            Check(Native.ks_world_latest_frame_time(handle, motion, out time));
            return time;
        }
        /// <summary>The positions in the latest frame, with the changes that events made.</summary>
        public Vector[] LatestFrame(uint motion)
        {
            return Filled<Vector>((Vector[] positions, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_latest_frame(handle, motion, positions, capacity, out count));
        }
        /// <summary>The true states at a time of bodies that motions move.</summary>
        public State[] States(BodyId[] bodies, double time)
        {
            var count = Count(bodies, "bodies");
            var states = new State[bodies.Length];
            Check(Native.ks_world_states(handle, bodies, count, time, states));
            return states;
        }

        // Certified answers at the current time: from what the world knows, or better with a probe.

        /// <summary>No contact of the whole world begins before this time; it names no partner.</summary>
        public Prediction SafeUntil(Probe probe = null)
        {
            return Predicted(probe, (Native.Probe callback, out Prediction prediction) =>
                Native.ks_world_safe_until(handle, callback, IntPtr.Zero, out prediction));
        }
        public Prediction EarliestContact(BodyId body, Probe probe = null)
        {
            return Predicted(probe, (Native.Probe callback, out Prediction prediction) =>
                Native.ks_world_earliest_contact(handle, body, callback, IntPtr.Zero, out prediction));
        }
        /// <summary>The first time at which anything may be within a distance (length, >= 0) of a body.</summary>
        public Prediction EarliestApproach(BodyId body, double distance, Probe probe = null)
        {
            return Predicted(probe, (Native.Probe callback, out Prediction prediction) =>
                Native.ks_world_earliest_approach(handle, body, distance, callback, IntPtr.Zero, out prediction));
        }
        /// <summary>The first time at which two bodies may be within a distance (length, >= 0) of each other.</summary>
        public Prediction PairSafeUntil(BodyId first, BodyId second, double distance = 0, Probe probe = null)
        {
            return Predicted(probe, (Native.Probe callback, out Prediction prediction) =>
                Native.ks_world_pair_safe_until(handle, first, second, distance, callback, IntPtr.Zero, out prediction));
        }
        /// <summary>Limits of the distance between two bodies at a time from now on.</summary>
        public void DistanceLimits(BodyId first, BodyId second, double time, out double lower, out double upper,
            Probe probe = null)
        {
            double least = 0, most = 0;
            Ask(probe, callback => Native.ks_world_distance_limits(
                handle, first, second, time, callback, IntPtr.Zero, out least, out most));
            lower = least;
            upper = most;
        }
        /// <summary>All that a ray, or with a radius > 0 a moving sphere, may hit first.</summary>
        public Hit[] Cast(Vector origin, Vector direction, double length, double radius = 0, Probe probe = null)
        {
            return Hits(probe, (Native.Probe callback, Hit[] hits, UIntPtr capacity, out UIntPtr count) => Native.ks_world_cast(
                handle, origin, direction, length, radius, callback, IntPtr.Zero, hits, capacity, out count));
        }
        /// <summary>The bodies that may overlap a sphere.</summary>
        public Hit[] Overlapping(Vector centre, double radius, Probe probe = null)
        {
            return Hits(probe, (Native.Probe callback, Hit[] hits, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_overlapping_sphere(handle, centre, radius, callback, IntPtr.Zero, hits, capacity, out count));
        }
        /// <summary>The bodies that may overlap a box.</summary>
        public Hit[] OverlappingBox(Vector lower, Vector upper, Probe probe = null)
        {
            var box = new Native.Box { Lower = lower, Upper = upper };
            return Hits(probe, (Native.Probe callback, Hit[] hits, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_overlapping_box(handle, ref box, callback, IntPtr.Zero, hits, capacity, out count));
        }
        /// <summary>All that may be among the `bodies` nearest to a point.</summary>
        public Hit[] Nearest(Vector point, int bodies, Probe probe = null)
        {
            var most = NotNegative(bodies, "bodies");
            return Hits(probe, (Native.Probe callback, Hit[] hits, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_nearest(handle, point, most, callback, IntPtr.Zero, hits, capacity, out count));
        }
        delegate int Predict(Native.Probe probe, out Prediction prediction);
        Prediction Predicted(Probe probe, Predict predict)
        {
            var prediction = new Prediction();
            Ask(probe, callback => predict(callback, out prediction));
            return prediction;
        }
        delegate int Find(Native.Probe probe, Hit[] hits, UIntPtr capacity, out UIntPtr count);
        Hit[] Hits(Probe probe, Find find)
        {
            Hit[] found = null;
            Ask(probe, callback => FillAll((Hit[] hits, UIntPtr capacity, out UIntPtr count) =>
                find(callback, hits, capacity, out count), out found));
            return found;
        }

        /// <summary>Switches profiling on, from zero, or off.</summary>
        public void SetProfiling(bool on) { Check(Native.ks_world_set_profiling(handle, on ? 1 : 0)); }
        public Timings Timings
        {
            get
            {
                Timings timings;
                Check(Native.ks_world_timings(handle, out timings));
                return timings;
            }
        }
        /// <summary>The bodies that were probed most often while profiling was on, the most probed first.</summary>
        public BusyBody[] Busiest(int most)
        {
            return Filled<BusyBody>((BusyBody[] bodies, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_busiest(handle, NotNegative(most, "most"), bodies, capacity, out count));
        }

        /// <summary>Starts to record all input and output of the world, in memory.</summary>
        public void StartRecording() { Check(Native.ks_world_start_recording(handle)); }
        /// <summary>Stops recording and returns the recording, for a Replay.</summary>
        public byte[] StopRecording()
        {
            Check(Native.ks_world_stop_recording(handle));
            return Filled<byte>((byte[] bytes, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_recording(handle, bytes, capacity, out count));
        }

        static Native.Probe Callback(Probe probe, Caught caught)
        {
            return (bodies, count, time, states, user) => caught.Call(() =>
            {
                var ids = new BodyId[(int)count];
                var answers = new State[ids.Length];
                for (int k = 0; k < ids.Length; ++k)
                {
                    ids[k] = bodies[k];
                    answers[k] = states[k];  // NaN, so that a body that the probe forgets is an error
                }
                probe(ids, time, answers);
                for (int k = 0; k < ids.Length; ++k) states[k] = answers[k];
            });
        }

        static Native.RotationProbe RotationCallback(RotationProbe probe, Caught caught)
        {
            return (bodies, count, time, rotations, user) => caught.Call(() =>
            {
                var ids = new BodyId[(int)count];
                var answers = new Rotation[ids.Length];
                for (int k = 0; k < ids.Length; ++k)
                {
                    ids[k] = bodies[k];
                    answers[k] = rotations[k];
                }
                probe(ids, time, answers);
                for (int k = 0; k < ids.Length; ++k) rotations[k] = answers[k];
            });
        }

        static Native.PairFilter PairCallback(PairFilter filter, Caught caught)
        {
            if (filter == null) return null;
            return (first, second, user) =>
            {
                bool may = true;
                caught.Call(() => may = filter(first, second));
                return may ? 1 : 0;
            };
        }

        static Native.MotionDefinition Motion(int kind)
        {
            Native.MotionDefinition definition;
            Native.Check(Native.ks_motion_definition_init(out definition, Native.SizeOf<Native.MotionDefinition>()));
            definition.Kind = kind;
            return definition;
        }

        BodyId[] AddMotion(Native.MotionDefinition definition, State[] states, BodyDefinition like, double[] limits,
            double[] radii, double[] masses, out uint motion)
        {
            uint number = 0;
            var ids = AddMoved(definition, states, like, limits, radii, masses,
                (ref Native.MotionDefinition all, BodyId[] added) =>
                    Native.ks_world_add_motion(handle, ref all, out number, added));
            motion = number;
            return ids;
        }

        delegate int AddDefined(ref Native.MotionDefinition definition, BodyId[] ids);
        BodyId[] AddMoved(Native.MotionDefinition definition, State[] states, BodyDefinition like, double[] limits,
            double[] radii, double[] masses, AddDefined add)
        {
            like.Require("like");
            definition.Count = Count(states, "states");
            RequireOneEach(limits, states, "accelerationLimits");
            RequireOneEach(radii, states, "radii");
            RequireOneEach(masses, states, "masses");
            var ids = new BodyId[states.Length];
            fixed (State* fixedStates = states)
            fixed (double* fixedLimits = limits, fixedRadii = radii, fixedMasses = masses)
            {
                definition.States = fixedStates;
                definition.AccelerationLimits = fixedLimits;
                definition.Radii = fixedRadii;
                definition.Masses = fixedMasses;
                definition.Like = &like;
                Check(add(ref definition, ids));
            }
            return ids;
        }

        static void RequireOneEach(double[] numbers, State[] states, string name)
        {
            if (numbers != null && numbers.Length != states.Length)
                throw new ArgumentException("there must be one entry for each of " + states.Length + " states", name);
        }

        static UIntPtr NotNegative(int number, string name)
        {
            if (number < 0) throw new ArgumentOutOfRangeException(name, number, "must be >= 0");
            return (UIntPtr)number;
        }
        /// <summary>The number of elements. Throws if there is no array.</summary>
        internal static UIntPtr Count(Array array, string name)
        {
            if (array == null) throw new ArgumentNullException(name);
            return (UIntPtr)array.Length;
        }

        internal delegate int Fill<T>(T[] elements, UIntPtr capacity, out UIntPtr count);
        /// <summary>Calls a function that writes all elements if they fit, until they do; returns its status.</summary>
        static int FillAll<T>(Fill<T> fill, out T[] elements)
        {
            elements = new T[16];
            for (;;)
            {
                UIntPtr count;
                int status = fill(elements, (UIntPtr)elements.Length, out count);
                if (status != 0 && status != Native.BufferTooSmall) return status;
                Array.Resize(ref elements, (int)count);
                if (status == 0) return 0;
            }
        }
        internal static T[] Filled<T>(Fill<T> fill)
        {
            T[] elements;
            Native.Check(FillAll(fill, out elements));
            return elements;
        }
    }

    /// <summary>A recording that is being replayed.</summary>
    public sealed class Replay : IDisposable
    {
        readonly ulong handle;
        bool disposed;

        /// <summary>Opens a recording of a world without a pair filter.</summary>
        public Replay(byte[] recording)
        {
            Native.Check(Native.ks_replay_open(recording, World.Count(recording, "recording"), null, IntPtr.Zero, out handle));
        }
        ~Replay() { Native.ks_replay_destroy(handle); }
        public void Dispose()
        {
            if (disposed) return;
            Native.Check(Native.ks_replay_destroy(handle));
            disposed = true;
            GC.SuppressFinalize(this);
        }
        /// <summary>Repeats everything up to the end of the next recorded advance, or of the recording, and returns what
        /// that advance returned. The error "diverged" names the step that differs.</summary>
        public Event Advance()
        {
            var next = Event.New;
            Native.Check(Native.ks_replay_advance(handle, ref next));
            return next;
        }
        /// <summary>True if no step is left and the world has ended as the recorded one did, to the last bit.</summary>
        public bool Finished
        {
            get
            {
                int finished;
                Native.Check(Native.ks_replay_finished(handle, out finished));
                return finished != 0;
            }
        }
        /// <summary>The number of steps repeated so far, and in total.</summary>
        public int Step { get { return Steps(false); } }
        public int StepCount { get { return Steps(true); } }
        int Steps(bool all)
        {
            UIntPtr repeated, total;
            Native.Check(Native.ks_replay_steps(handle, out repeated, out total));
            return (int)(all ? total : repeated);
        }
        /// <summary>The hash of all outcomes so far.</summary>
        public ulong Hash
        {
            get
            {
                ulong hash;
                Native.Check(Native.ks_replay_hash(handle, out hash));
                return hash;
            }
        }
        /// <summary>Returns a copy of the world after the last repeated step, without motions.</summary>
        public World CopyWorld()
        {
            ulong copy;
            Native.Check(Native.ks_replay_world(handle, out copy));
            return new World(copy);
        }
    }

    /// <summary>The separation levels between two classes of tracks, the widest first.</summary>
    public sealed class SeparationRule
    {
        public int FirstClass, SecondClass;
        public Separation[] Levels = new Separation[0];
    }

    public sealed unsafe class MonitorDefinition
    {
        public int Dimensions;
        public double? StartTime;
        public TrackClass[] Classes = new TrackClass[0];
        public SeparationRule[] Separations = new SeparationRule[0];
        public double Tolerance, TimeResolution, Window, StaleAfter, DropAfter;
        public double PredictionHold, PredictionConfirmation, PredictionMargin, PredictionErrorPart;
        /// <summary>The monitor watches this many shards of all pairs, from the first one.</summary>
        public ulong ShardOf = 1, ShardFirst, ShardCount = 1;

        public MonitorDefinition()
        {
            var defaults = Defaults();
            Dimensions = defaults.Dimensions;
            Tolerance = defaults.Tolerance;
            TimeResolution = defaults.TimeResolution;
            Window = defaults.Window;
            StaleAfter = defaults.StaleAfter;
            DropAfter = defaults.DropAfter;
            PredictionHold = defaults.PredictionHold;
            PredictionConfirmation = defaults.PredictionConfirmation;
            PredictionMargin = defaults.PredictionMargin;
            PredictionErrorPart = defaults.PredictionErrorPart;
        }

        static Native.MonitorDefinition Defaults()
        {
            Native.MonitorDefinition defaults;
            Native.Check(Native.ks_monitor_definition_init(out defaults, Native.SizeOf<Native.MonitorDefinition>()));
            return defaults;
        }

        internal ulong Create()
        {
            var definition = Defaults();
            definition.Dimensions = Dimensions;
            definition.HasStartTime = StartTime.HasValue ? 1 : 0;
            definition.StartTime = StartTime.GetValueOrDefault();
            definition.Tolerance = Tolerance;
            definition.TimeResolution = TimeResolution;
            definition.Window = Window;
            definition.StaleAfter = StaleAfter;
            definition.DropAfter = DropAfter;
            definition.PredictionHold = PredictionHold;
            definition.PredictionConfirmation = PredictionConfirmation;
            definition.PredictionMargin = PredictionMargin;
            definition.PredictionErrorPart = PredictionErrorPart;
            definition.ShardOf = ShardOf;
            definition.ShardFirst = ShardFirst;
            definition.ShardCount = ShardCount;
            World.Count(Classes, "Classes");
            World.Count(Separations, "Separations");
            var rules = new Native.SeparationRule[Separations.Length];
            var pinned = new GCHandle[Separations.Length];
            try
            {
                for (int k = 0; k < rules.Length; ++k)
                {
                    if (Separations[k] == null) throw new ArgumentNullException("Separations");
                    rules[k].LevelCount = World.Count(Separations[k].Levels, "Levels");
                    pinned[k] = GCHandle.Alloc(Separations[k].Levels, GCHandleType.Pinned);
                    rules[k].FirstClass = (UIntPtr)Separations[k].FirstClass;
                    rules[k].SecondClass = (UIntPtr)Separations[k].SecondClass;
                    rules[k].Levels = (Separation*)pinned[k].AddrOfPinnedObject();
                }
                ulong monitor;
                fixed (TrackClass* classes = Classes)
                fixed (Native.SeparationRule* separations = rules)
                {
                    definition.Classes = classes;
                    definition.ClassCount = World.Count(Classes, "Classes");
                    definition.Separations = separations;
                    definition.SeparationCount = World.Count(rules, "Separations");
                    Native.Check(Native.ks_monitor_create(ref definition, out monitor));
                }
                return monitor;
            }
            finally
            {
                foreach (var one in pinned)
                    if (one.IsAllocated) one.Free();
            }
        }
    }

    /// <summary>Tracks, their reports and the verdicts about their pairs.</summary>
    public sealed unsafe class Monitor : IDisposable
    {
        readonly ulong handle;
        bool disposed;

        public Monitor(MonitorDefinition definition)
        {
            if (definition == null) throw new ArgumentNullException("definition");
            handle = definition.Create();
        }
        Monitor(ulong handle) { this.handle = handle; }
        ~Monitor() { Native.ks_monitor_destroy(handle); }
        /// <summary>Destroys the monitor; each later call but Dispose throws.</summary>
        public void Dispose()
        {
            if (disposed) return;
            Native.Check(Native.ks_monitor_destroy(handle));
            disposed = true;
            GC.SuppressFinalize(this);
        }

        /// <summary>Returns a snapshot.</summary>
        public byte[] Save()
        {
            return World.Filled<byte>((byte[] bytes, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_monitor_save(handle, bytes, capacity, out count));
        }
        public static Monitor Restore(byte[] snapshot)
        {
            ulong restored;
            Native.Check(Native.ks_monitor_restore(snapshot, World.Count(snapshot, "snapshot"), out restored));
            return new Monitor(restored);
        }

        /// <summary>Accepts a report that arrives now. The first one of an id adds a track.</summary>
        public void Report(ulong track, TrackReport report) { ReportAll(new[] { track }, new[] { report }); }
        /// <summary>Accepts reports, each of the track of the same index, in this order; or, on an error, none.</summary>
        public void ReportAll(ulong[] tracks, TrackReport[] reports)
        {
            var count = World.Count(tracks, "tracks");
            if (World.Count(reports, "reports") != count)
                throw new ArgumentException("there must be one report for each track", "reports");
            foreach (var report in reports) report.Require("reports");
            Native.Check(Native.ks_monitor_report(handle, tracks, reports, count));
        }
        public void Remove(ulong track) { Native.Check(Native.ks_monitor_remove(handle, track)); }
        /// <summary>Advances to the next event, at most to time `until`; returns it, or one of kind None. `poll` is asked for the
        /// reports without which pairs would turn undecided.</summary>
        public MonitorEvent Advance(double until, Poll poll = null)
        {
            var next = MonitorEvent.New;
            var caught = new Caught();
            var callback = poll == null ? null : Callback(poll, caught);
            int status = Native.ks_monitor_advance(handle, until, callback, IntPtr.Zero, ref next);
            GC.KeepAlive(callback);
            GC.KeepAlive(this);
            caught.Rethrow(status);
            Native.Check(status);
            return next;
        }
        static Native.Poll Callback(Poll poll, Caught caught)
        {
            return (tracks, count, time, reports, hasReport, user) => caught.Call(() =>
            {
                var ids = new ulong[(int)count];
                var answers = new TrackReport?[ids.Length];
                for (int k = 0; k < ids.Length; ++k) ids[k] = tracks[k];
                poll(ids, time, answers);
                for (int k = 0; k < ids.Length; ++k)
                {
                    if (!answers[k].HasValue) continue;
                    answers[k].Value.Require("reports");
                    reports[k] = answers[k].Value;
                    hasReport[k] = 1;
                }
            });
        }
        /// <summary>Goes through the events up to `until`.</summary>
        public IEnumerable<MonitorEvent> Events(double until, Poll poll = null)
        {
            for (var next = Advance(until, poll); next.Kind != MonitorEventKind.None; next = Advance(until, poll))
                yield return next;
        }
        public double Time
        {
            get
            {
                double time;
                Native.Check(Native.ks_monitor_time(handle, out time));
                return time;
            }
        }
        public PairAnswer Answer(ulong first, ulong second, uint level = 0)
        {
            var answer = PairAnswer.New;
            Native.Check(Native.ks_monitor_answer(handle, first, second, level, ref answer));
            return answer;
        }
        /// <summary>The ids of all tracks, in ascending order.</summary>
        public ulong[] Tracks()
        {
            return World.Filled<ulong>((ulong[] tracks, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_monitor_tracks(handle, tracks, capacity, out count));
        }
        /// <summary>The places of a track; several only while its reports contradict each other.</summary>
        public TrackPlace[] Places(ulong track)
        {
            return World.Filled<TrackPlace>((TrackPlace[] places, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_monitor_places(handle, track, places, capacity, out count));
        }
        /// <summary>The reports that are needed by `until` for no verdict to turn undecided, in the order of their times.</summary>
        public ReportRequest[] Needed(double until)
        {
            return World.Filled<ReportRequest>((ReportRequest[] requests, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_monitor_needed(handle, until, requests, capacity, out count));
        }
        /// <summary>The pairs that are not certainly apart.</summary>
        public OpenPair[] OpenPairs()
        {
            return World.Filled<OpenPair>((OpenPair[] pairs, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_monitor_open_pairs(handle, pairs, capacity, out count));
        }
        /// <summary>The pairs that are predicted to come within a separation.</summary>
        public PredictedPair[] PredictedPairs()
        {
            return World.Filled<PredictedPair>((PredictedPair[] pairs, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_monitor_predicted_pairs(handle, pairs, capacity, out count));
        }
    }
}
