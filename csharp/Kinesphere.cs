// Worlds and monitors in C#. Methods have the meanings, errors and costs of those of the C++ headers; wrong use throws a
// KinesphereException. An exception in a callback passes through the call that called it.
using System;
using System.Runtime.ExceptionServices;
using System.Runtime.InteropServices;

namespace Kinesphere
{
    /// <summary>Sets the states of bodies at a time.</summary>
    public delegate void Probe(BodyId[] bodies, double time, State[] states);
    /// <summary>Sets the rotations of rigid bodies at a time.</summary>
    public delegate void RotationProbe(BodyId[] bodies, double time, Rotation[] rotations);
    /// <summary>Chooses what an event does to its bodies: the same for the same event, and in any thread.</summary>
    public delegate Response Respond(Event happened);

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
        public void Check(int status)
        {
            Rethrow(status);
            Native.Check(status);
        }
        /// <summary>Throws the exception if there was one, once.</summary>
        public void Rethrow(int status)
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
        // The library keeps a pointer to the function, also in clones of this world.
        Native.RotationProbe rotations;
        Caught turning = new Caught();

        public World(WorldDefinition definition) { Native.Check(Native.ks_world_create(ref definition, out handle)); }
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
            Native.Check(Native.ks_world_clone(handle, out copy));
            return new World(copy) { rotations = rotations, turning = turning };
        }
        /// <summary>Returns a snapshot, without motions.</summary>
        public byte[] Save()
        {
            return Filled<byte>((byte[] bytes, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_save(handle, bytes, capacity, out count));
        }
        public static World Restore(byte[] snapshot)
        {
            ulong restored;
            Native.Check(Native.ks_world_restore(snapshot, Count(snapshot), IntPtr.Zero, IntPtr.Zero, out restored));
            return new World(restored);
        }

        public BodyId Add(BodyDefinition body) { return AddAll(new[] { body })[0]; }
        /// <summary>Adds all bodies or, on an error, none.</summary>
        public BodyId[] AddAll(BodyDefinition[] bodies)
        {
            var ids = new BodyId[bodies.Length];
            Native.Check(Native.ks_world_add(handle, bodies, Count(bodies), ids));
            return ids;
        }
        public BodyId AddStatic(StaticDefinition body)
        {
            var ids = new BodyId[1];
            Native.Check(Native.ks_world_add_static(handle, new[] { body }, Count(ids), ids));
            return ids[0];
        }
        /// <summary>
        /// Adds a body that carries a box or a triangle, relative to its position; the radius is ignored. The probe
        /// moves it. It meets no walls and no other body with a shape.
        /// </summary>
        public BodyId AddMovingShape(BodyDefinition body, Shape shape)
        {
            BodyId id;
            Native.Check(Native.ks_world_add_moving_shape(handle, ref body, ref shape, out id));
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
            var found = new Native.Hull[hulls.Length];
            var pinned = new GCHandle[hulls.Length];
            try
            {
                for (int k = 0; k < found.Length; ++k)
                {
                    pinned[k] = GCHandle.Alloc(hulls[k].Points, GCHandleType.Pinned);
                    found[k].PointCount = Count(hulls[k].Points);
                    found[k].Points = (Vector*)pinned[k].AddrOfPinnedObject();
                    found[k].Radius = hulls[k].Radius;
                }
                fixed (RigidPart* first = parts)
                fixed (Native.Hull* firstHull = found)
                {
                    rigid.SetParts(first, parts.Length);
                    rigid.SetHulls(firstHull, found.Length);
                    Native.Check(Native.ks_world_add_rigid_body(handle, ref body, ref rigid, out id));
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
            Native.Check(Native.ks_world_set_angular_velocity(handle, body, angularVelocity));
        }
        /// <summary>Turns a rigid body at once, as Teleport moves it.</summary>
        public void SetRotation(BodyId body, Rotation rotation)
        {
            Native.Check(Native.ks_world_set_rotation(handle, body, ref rotation));
        }
        /// <summary>The rotation of a rigid body at its last report.</summary>
        public Rotation RotationOf(BodyId body)
        {
            Rotation rotation;
            Native.Check(Native.ks_world_rotation(handle, body, out rotation));
            return rotation;
        }
        /// <summary>Sets the function that gives the rotations of rigid bodies, directly after the probe; null removes it.
        /// Clones share it.</summary>
        public void SetRotationProbe(RotationProbe probe)
        {
            var caught = new Caught();
            Native.RotationProbe callback = probe == null ? null : RotationCallback(probe, caught);
            Native.Check(Native.ks_world_set_rotation_probe(handle, callback, IntPtr.Zero));
            rotations = callback;
            turning = caught;
        }
        /// <summary>Adds a zone, which reports who enters and leaves it.</summary>
        public BodyId AddZone(Shape shape, ulong userData = 0)
        {
            BodyId id;
            Native.Check(Native.ks_world_add_zone(handle, ref shape, userData, out id));
            return id;
        }
        public void Remove(BodyId body) { Native.Check(Native.ks_world_remove(handle, new[] { body }, (UIntPtr)1)); }

        /// <summary>Informs the world, and the motion of the body if it has one, of a new velocity.</summary>
        public void SetVelocity(BodyId body, Vector velocity)
        {
            Native.Check(Native.ks_world_set_velocity(handle, body, velocity));
        }
        public void Teleport(BodyId body, State state) { Native.Check(Native.ks_world_teleport(handle, body, ref state)); }
        public void SetRadius(BodyId body, double radius) { Native.Check(Native.ks_world_set_radius(handle, body, radius)); }
        /// <summary>Lets the radius of a ball change at this rate (length / time); negative for one that shrinks.</summary>
        public void SetRadiusRate(BodyId body, double rate) { Native.Check(Native.ks_world_set_radius_rate(handle, body, rate)); }
        public void SetFilter(BodyId body, Filter filter) { Native.Check(Native.ks_world_set_filter(handle, body, ref filter)); }
        public void Disable(BodyId body) { Native.Check(Native.ks_world_disable(handle, body)); }
        public void Enable(BodyId body, State state) { Native.Check(Native.ks_world_enable(handle, body, ref state)); }
        public void Sleep(BodyId body) { Native.Check(Native.ks_world_sleep(handle, body)); }
        public void Wake(BodyId body) { Native.Check(Native.ks_world_wake(handle, body)); }
        /// <summary>Sets the distances at which bodies of a class sense bodies with a category in the mask.</summary>
        public void SetSensor(int sensorClass, double[] distances, ulong mask = ulong.MaxValue)
        {
            Native.Check(Native.ks_world_set_sensor(handle, sensorClass, distances, Count(distances), mask));
        }

        public double Time
        {
            get
            {
                double time;
                Native.Check(Native.ks_world_time(handle, out time));
                return time;
            }
        }
        public int Size
        {
            get
            {
                UIntPtr bodies;
                Native.Check(Native.ks_world_size(handle, out bodies));
                return (int)bodies;
            }
        }
        public bool Contains(BodyId body)
        {
            int contains;
            Native.Check(Native.ks_world_contains(handle, body, out contains));
            return contains != 0;
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
            var caught = new Caught();
            var callback = probe == null ? motions : Callback(probe, caught);
            int status = Native.ks_world_advance(handle, until, callback, IntPtr.Zero, ref next);
            GC.KeepAlive(callback);
            GC.KeepAlive(this);
            turning.Rethrow(status);
            caught.Check(status);
            return next;
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
            turning.Rethrow(status);
            caught.Check(status);
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
            double[] accelerationLimits = null)
        {
            var found = new uint[states.Length];
            numbers = found;
            return AddMoved(Motion(0), states, like, accelerationLimits, null, null,
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
        /// <summary>Adds bodies of a game's frames: straight from the position in one frame to that in the next.</summary>
        public BodyId[] AddFrames(State[] states, BodyDefinition like, double interval, out uint motion)
        {
            var definition = Motion(2);
            definition.Interval = interval;
            return AddMotion(definition, states, like, null, null, null, out motion);
        }
        /// <summary>Appends the next frame, and returns its time, to which to advance then.</summary>
        public double PushFrame(uint motion, Vector[] positions)
        {
            double time;
            Native.Check(Native.ks_world_push_frame(handle, motion, positions, Count(positions)));
            Native.Check(Native.ks_world_latest_frame_time(handle, motion, out time));
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
            var states = new State[bodies.Length];
            Native.Check(Native.ks_world_states(handle, bodies, Count(bodies), time, states));
            return states;
        }

        public Prediction EarliestContact(BodyId body)
        {
            Prediction prediction;
            Native.Check(Native.ks_world_earliest_contact(handle, body, null, IntPtr.Zero, out prediction));
            return prediction;
        }
        /// <summary>All that a ray, or with a radius > 0 a moving sphere, may hit first.</summary>
        public Hit[] Cast(Vector origin, Vector direction, double length, double radius = 0)
        {
            return Filled<Hit>((Hit[] hits, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_cast(handle, origin, direction, length, radius, null, IntPtr.Zero, hits, capacity, out count));
        }

        /// <summary>Switches profiling on, from zero, or off.</summary>
        public void SetProfiling(bool on) { Native.Check(Native.ks_world_set_profiling(handle, on ? 1 : 0)); }
        public Timings Timings
        {
            get
            {
                Timings timings;
                Native.Check(Native.ks_world_timings(handle, out timings));
                return timings;
            }
        }
        /// <summary>The bodies that were probed most often while profiling was on, the most probed first.</summary>
        public BusyBody[] Busiest(int most)
        {
            return Filled<BusyBody>((BusyBody[] bodies, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_busiest(handle, (UIntPtr)most, bodies, capacity, out count));
        }

        /// <summary>Starts to record all input and output of the world, in memory.</summary>
        public void StartRecording() { Native.Check(Native.ks_world_start_recording(handle)); }
        /// <summary>Stops recording and returns the recording, for a Replay.</summary>
        public byte[] StopRecording()
        {
            Native.Check(Native.ks_world_stop_recording(handle));
            return Filled<byte>((byte[] bytes, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_recording(handle, bytes, capacity, out count));
        }

        static Native.Probe Callback(Probe probe, Caught caught)
        {
            return (bodies, count, time, states, user) => caught.Call(() =>
            {
                var ids = new BodyId[(int)count];
                var answers = new State[ids.Length];
                for (int k = 0; k < ids.Length; ++k) ids[k] = bodies[k];
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
                for (int k = 0; k < ids.Length; ++k) ids[k] = bodies[k];
                probe(ids, time, answers);
                for (int k = 0; k < ids.Length; ++k) rotations[k] = answers[k];
            });
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
        static BodyId[] AddMoved(Native.MotionDefinition definition, State[] states, BodyDefinition like, double[] limits,
            double[] radii, double[] masses, AddDefined add)
        {
            foreach (var numbers in new[] { limits, radii, masses })
                if (numbers != null && numbers.Length != states.Length)
                    throw new ArgumentException("there must be one entry for each state");
            var ids = new BodyId[states.Length];
            fixed (State* fixedStates = states)
            fixed (double* fixedLimits = limits, fixedRadii = radii, fixedMasses = masses)
            {
                definition.Count = Count(states);
                definition.States = fixedStates;
                definition.AccelerationLimits = fixedLimits;
                definition.Radii = fixedRadii;
                definition.Masses = fixedMasses;
                definition.Like = &like;
                Native.Check(add(ref definition, ids));
            }
            return ids;
        }

        internal static UIntPtr Count(Array array) { return (UIntPtr)array.Length; }

        internal delegate int Fill<T>(T[] elements, UIntPtr capacity, out UIntPtr count);
        /// <summary>Calls a function that writes all elements if they fit, until they do.</summary>
        internal static T[] Filled<T>(Fill<T> fill)
        {
            var elements = new T[16];
            for (;;)
            {
                UIntPtr count;
                int status = fill(elements, Count(elements), out count);
                if (status != Native.BufferTooSmall) Native.Check(status);
                Array.Resize(ref elements, (int)count);
                if (status == 0) return elements;
            }
        }
    }

    /// <summary>A recording that is being replayed.</summary>
    public sealed class Replay : IDisposable
    {
        readonly ulong handle;
        bool disposed;

        public Replay(byte[] recording)
        {
            Native.Check(Native.ks_replay_open(recording, World.Count(recording), IntPtr.Zero, IntPtr.Zero, out handle));
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
            definition.ShardOf = ShardOf;
            definition.ShardFirst = ShardFirst;
            definition.ShardCount = ShardCount;
            var rules = new Native.SeparationRule[Separations.Length];
            var pinned = new GCHandle[Separations.Length];
            try
            {
                for (int k = 0; k < rules.Length; ++k)
                {
                    pinned[k] = GCHandle.Alloc(Separations[k].Levels, GCHandleType.Pinned);
                    rules[k].FirstClass = (UIntPtr)Separations[k].FirstClass;
                    rules[k].SecondClass = (UIntPtr)Separations[k].SecondClass;
                    rules[k].Levels = (Separation*)pinned[k].AddrOfPinnedObject();
                    rules[k].LevelCount = World.Count(Separations[k].Levels);
                }
                ulong monitor;
                fixed (TrackClass* classes = Classes)
                fixed (Native.SeparationRule* separations = rules)
                {
                    definition.Classes = classes;
                    definition.ClassCount = World.Count(Classes);
                    definition.Separations = separations;
                    definition.SeparationCount = World.Count(rules);
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
    public sealed class Monitor : IDisposable
    {
        readonly ulong handle;
        bool disposed;

        public Monitor(MonitorDefinition definition) { handle = definition.Create(); }
        ~Monitor() { Native.ks_monitor_destroy(handle); }
        /// <summary>Destroys the monitor; each later call but Dispose throws.</summary>
        public void Dispose()
        {
            if (disposed) return;
            Native.Check(Native.ks_monitor_destroy(handle));
            disposed = true;
            GC.SuppressFinalize(this);
        }

        /// <summary>Accepts a report that arrives now. The first one of an id adds a track.</summary>
        public void Report(ulong track, TrackReport report)
        {
            Native.Check(Native.ks_monitor_report(handle, new[] { track }, new[] { report }, (UIntPtr)1));
        }
        public void Remove(ulong track) { Native.Check(Native.ks_monitor_remove(handle, track)); }
        /// <summary>Advances to the next event, at most to time `until`; returns it, or one of kind None.</summary>
        public MonitorEvent Advance(double until)
        {
            var next = MonitorEvent.New;
            Native.Check(Native.ks_monitor_advance(handle, until, IntPtr.Zero, IntPtr.Zero, ref next));
            return next;
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
