// The scene of tests/same_hash/shared_scene.cpp, run in three ways, and the game. Each prints its hash. Then what C# adds to the C
// interface: exceptions of wrong use and of callbacks.
using System;
using System.Linq;
using Kinesphere;

static class SharedScene
{
    static World NewWorld(State[] start, double[] radii)
    {
        var definition = WorldDefinition.Default;
        definition.SetBox(new Vector(0, 0, 0), new Vector(20, 20, 20));
        var world = new World(definition);
        world.SetSensor(0, new[] { 0.5 });
        var limits = start.Select(_ => 5.0).ToArray();
        world.AddRandomForces(start, BodyDefinition.Default, limits, 0.2, 7, radii, radii);
        world.AddZone(Shape.Box(new Vector(5, 5, 5), new Vector(15, 15, 15)));
        return world;
    }

    static void StepByStep(World world)
    {
        var hash = new EventHash();
        for (var next = world.Advance(5); next.Kind != EventKind.None; next = world.Advance(5))
        {
            hash.Add(next);
            var after = next.Bounce(0.9);
            if (after.First.HasValue) world.SetVelocity(next.First, after.First.Value);
            if (after.Second.HasValue) world.SetVelocity(next.Second, after.Second.Value);
        }
        Console.WriteLine("{0:x16}", hash.Value);
        world.Dispose();
    }

    static void AtOnce(World world, Respond respond, int threads)
    {
        var hash = new EventHash();
        world.Run(5, 0.9, respond, happened => hash.Add(happened), threads);
        Console.WriteLine("{0:x16}", hash.Value);
        world.Dispose();
    }

    static void Require(bool holds, string what)
    {
        if (!holds) throw new Exception(what);
    }

    static void RequireStatus(string status, Action call)
    {
        try
        {
            call();
        }
        catch (KinesphereException refused)
        {
            Require(refused.Status == status && refused.Message != "", refused.Status + " instead of " + status);
            return;
        }
        throw new Exception(status + " was not said");
    }

    static void WrongUse()
    {
        var world = new World(WorldDefinition.Default);
        var ball = BodyDefinition.Default;
        ball.AccelerationLimit = 1;
        var first = world.Add(ball);
        ball.Position.X = 10;
        var second = world.Add(ball);
        RequireStatus("out_of_range", () => world.SetRadius(first, -1));
        RequireStatus("not_finite", () => world.SetVelocity(first, new Vector(0, double.NaN, 0)));
        RequireStatus("unknown_body", () => world.Advance(20));
        Exception game = null;
        try
        {
            world.Advance(20, (ids, time, states) => { throw new InvalidOperationException("game over"); });
        }
        catch (InvalidOperationException thrown)
        {
            game = thrown;
        }
        Require(game != null && game.Message == "game over", "the exception of a probe");
        Probe still = (ids, time, states) =>
        {
            for (int k = 0; k < ids.Length; ++k)
                states[k] = new State(new Vector(ids[k].Equals(second) ? 10 : 0, 0, 0), new Vector());
        };
        Require(world.Advance(20, still).Kind == EventKind.None && world.Time == 20, "nothing happens");
        Require(world.Cast(new Vector(-5, 0, 0), new Vector(1, 0, 0), 100).Length >= 1, "a ray hits");
        Require(world.EarliestContact(first).Partner.Equals(second), "who may come first");
        using (var restored = World.Restore(world.Save())) Require(restored.Size == 2, "a snapshot");
        world.Remove(first);
        RequireStatus("stale_body", () => world.SetRadius(first, 1));
        world.Dispose();
        RequireStatus("stale_handle", () => world.SetRadius(second, 1));
        RequireStatus("bad_snapshot", () => World.Restore(new byte[] { 1, 2, 3 }));
    }

    static void RequireArgument(string argument, Action call)
    {
        try
        {
            call();
        }
        catch (ArgumentException refused)
        {
            Require(refused.ParamName == argument, refused.ParamName + " instead of " + argument);
            return;
        }
        throw new Exception(argument + " was not refused");
    }

    // What `new` makes has no defaults, and arrays may be missing.
    static void WrongArguments()
    {
        var one = new[] { new State(new Vector(1, 1, 1), new Vector()) };
        RequireArgument("definition", () => new World(new WorldDefinition { Dimensions = 3 }));
        using (var world = new World(WorldDefinition.Default))
        {
            RequireArgument("bodies", () => world.Add(new BodyDefinition { Radius = 1 }));
            RequireArgument("bodies", () => world.AddAll(null));
            RequireArgument("bodies", () => world.AddStatic(new StaticDefinition { Shape = Shape.Ball(new Vector(), 1) }));
            RequireArgument("like", () => world.AddBallistic(one, new BodyDefinition(), new Vector()));
            RequireArgument("states", () => world.AddBallistic(null, BodyDefinition.Default, new Vector()));
            RequireArgument("accelerationLimits", () => world.AddRandomForces(one, BodyDefinition.Default, new double[2], 1, 1));
            RequireArgument("rigid", () => world.AddRigidBody(BodyDefinition.Default, new RigidDefinition()));
            RequireArgument("hulls", () => world.AddRigidBody(BodyDefinition.Default, RigidDefinition.Default, new RigidPart[0], null));
            RequireArgument("positions", () => world.PushFrame(0, null));
            RequireArgument("positions", () => world.PushFrame(0, null, 1));
            RequireArgument("distances", () => world.SetSensor(0, null));
            RequireArgument("velocities", () => world.SetVelocities(new BodyId[0], one.Select(state => state.Velocity).ToArray()));
            RequireArgument("bodies", () => world.Nearest(new Vector(), -1));
        }
        RequireArgument("snapshot", () => World.Restore(null));
        RequireArgument("definition", () => new Monitor(null));
    }

    // What a probe forgets, and what a pair filter throws, comes out of the call that asked.
    static void Callbacks()
    {
        using (var world = new World(WorldDefinition.Default))
        {
            var ball = BodyDefinition.Default;
            ball.AccelerationLimit = 1;
            var first = world.Add(ball);
            ball.Position.X = 3;
            world.Add(ball);
            RequireStatus("not_finite", () => world.Advance(20, (ids, time, states) => { }));
            world.SetPairFilter((a, b) => { throw new InvalidOperationException("no filter"); });
            string said = "";
            Probe still = (ids, time, states) =>
            {
                for (int k = 0; k < ids.Length; ++k) states[k] = new State(new Vector(3 * ids[k].Index, 0, 0), new Vector());
            };
            try { world.Advance(20, still); } catch (InvalidOperationException thrown) { said = thrown.Message; }
            Require(said == "no filter", "the exception of a pair filter");
            int asked = 0;
            world.SetPairFilter((a, b) => ++asked < 0);
            using (var copy = world.Clone())
            {
                GC.Collect();
                Require(copy.Advance(20, still).Kind == EventKind.None && asked > 0, "a pair filter of a clone");
            }
            var snapshot = world.Save();
            using (var restored = World.Restore(snapshot, (a, b) => true)) Require(restored.Contains(first), "a snapshot with a filter");
        }
    }

    // Ships are steered, bodies change, and a world tells what it knows of them.
    static void Knowledge()
    {
        using (var world = new World(WorldDefinition.Default))
        {
            uint motion;
            var start = new[] { new State(), new State(new Vector(10, 0, 0), new Vector()) };
            var ids = world.AddSteered(start, BodyDefinition.Default, new[] { 2.0, 2.0 }, out motion);
            world.Steer(ids[0], new Vector(2, 0, 0));
            RequireStatus("out_of_range", () => world.Steer(ids[0], new Vector(3, 0, 0)));
            double lower, upper;
            world.DistanceLimits(ids[0], ids[1], 0, out lower, out upper);
            Require(lower <= 8 && 8 <= upper && world.PairSafeUntil(ids[0], ids[1], 9).Happens, "distances");
            Require(world.SafeUntil().Time <= Math.Sqrt(8) && world.EarliestApproach(ids[0], 20).Happens, "predictions");
            Require(world.Nearest(new Vector(9, 0, 0), 1)[0].Body.Equals(ids[1]), "the nearest");
            Require(world.Overlapping(new Vector(), 5).Length == 1, "a sphere");
            var along = new Ray { Origin = new Vector(-5, 0, 0), Direction = new Vector(1, 0, 0), Length = 50 };
            var hits = world.CastAll(new[] { along, along }, new[] { ids[1], ids[0] });
            Require(hits.Length == 2 && hits[0][0].Body.Equals(ids[0]) && hits[1][0].Body.Equals(ids[1]), "two rays");
            var wide = new Sphere { Radius = 50 };
            Require(world.OverlappingAll(new[] { wide, new Sphere() })[0].Length == 2, "two spheres");
            Require(world.NearestAll(new[] { new Vector() }, 1, null, new Filter())[0].Length == 0, "nobody passes");
            RequireStatus("out_of_range", () => world.CastAll(new[] { along, new Ray() }));
            Require(world.OverlappingBox(new Vector(9, -1, -1), new Vector(12, 1, 1)).Length == 1, "a box");
            var met = world.Events(60).First();
            Require(Math.Abs(met.Time - Math.Sqrt(8)) < 1e-5 && met.ToString().EndsWith("ContactBegin body 0, body 1"), "two ships meet");
            world.Apply(met, met.Bounce(1));
            Require(world.States(ids, met.Time)[1].Velocity.X > 5, "the second ship flies on");
            world.SetUserData(ids[0], 7);
            world.SetMass(ids[0], 3);
            world.SetSolid(ids[0], false);
            world.SetSensorClass(ids[0], 1);
            world.SetMotionLimits(ids[0], new MotionLimits { AccelerationLimit = 5 });
            world.Reserve(10);
            world.SetPairState(ids[0], ids[1], -4);
            Require(world.PairState(ids[1], ids[0]) == -4, "the state of a pair");
            world.Schedule(world.Time + 1, 6);
            world.Schedule(world.Time + 0.5, 8, 0.5);
            Require(world.Unschedule(8) == 1, "a timer that is gone");
            var rung = world.Events(world.Time + 2).Last();
            Require(rung.Kind == EventKind.Timer && rung.FirstUserData == 6, "a timer");
            RequireStatus("out_of_range", () => world.TurnBack(met));
            var view = world.Body(ids[0]);
            Require(view.Enabled && !view.IsStatic && view.Definition.UserData == 7 && view.Definition.Mass == 3, "a body");
            Require(!view.Definition.Solid && view.Definition.SensorClass == 1 && view.Definition.AccelerationLimit == 5, "its limits");
            var zone = world.AddZone(Shape.Ball(new Vector(50, 0, 0), 1), 5, new Filter(1, 2));
            world.SetShape(zone, Shape.Ball(new Vector(60, 0, 0), 1));
            Require(world.Body(zone).Definition.Filter.Mask == 2 && world.SensorOverlaps(zone).Length == 0, "a zone");
            Require(world.Bodies().Length == 3 && world.ProbeCount > 0 && Library.Version.Contains("."), "what there is");
            world.RemoveAll(ids);
            Require(world.Size == 1, "what is left");
        }
    }

    static bool IsBurst(Event happened) { return happened.Kind == EventKind.ContactBegin && happened.FirstUserData == 1; }

    // A bullet (1) and a rock (2) vanish as they meet, and a fragment appears there, which is disabled at the wall; a tired
    // ball (3) falls asleep at a post (4).
    static ulong Shooting(int threads)
    {
        var definition = WorldDefinition.Default;
        definition.SetBox(new Vector(0, 0, 0), new Vector(20, 20, 20));
        using (var world = new World(definition))
        {
            world.UseThreads(threads);
            RequireStatus("out_of_range", () => world.UseThreads(0));
            var like = BodyDefinition.Default;
            like.Radius = 0.5;
            Func<double, double, double, State[]> at = (x, y, speed) =>
                new[] { new State { Position = new Vector(x, y, y), Velocity = new Vector(speed, 0, 0) } };
            uint motion;
            uint[] numbers;
            var none = new Vector(0, 0, 0);
            like.UserData = 1;
            var gone = world.AddBallistic(at(1, 5, 4), like, none, out motion)[0];
            like.UserData = 2;
            world.AddToMotion(motion, at(8, 5, 0), like, out numbers);
            like.UserData = 3;
            var tired = world.AddToMotion(motion, at(1, 9, 1), like, out numbers)[0];
            like.UserData = 4;
            world.AddToMotion(motion, at(8, 9, 0), like, out numbers);
            Respond respond = happened =>
            {
                var response = new Response();
                if (IsBurst(happened))
                {
                    response.FirstAction = response.SecondAction = BodyAction.Remove;
                    response.Stop = true;
                }
                else if (happened.Kind == EventKind.WallBegin) response.FirstAction = BodyAction.Disable;
                else if (happened.Kind == EventKind.ContactBegin) response.FirstAction = BodyAction.Sleep;
                return response;
            };
            var hash = new EventHash();
            int fragments = 0;
            Action<Event> sink = happened =>
            {
                hash.Add(happened);
                var state = new[] { new State { Position = happened.Point, Velocity = new Vector(2, 0, 0) } };
                if (!IsBurst(happened))
                {
                    RequireStatus("run_in_progress", () => world.AddToMotion(motion, state, like, out numbers));
                    return;
                }
                Require(!world.Contains(happened.First), "the bullet has gone");
                world.AddToMotion(motion, state, like, out numbers);
                Require(numbers[0] < 2, "the fragment has the number of one that has gone");
                ++fragments;
            };
            world.Run(10, respond: respond, sink: sink, threads: threads);
            Require(fragments == 1 && world.Size == 3, "a fragment instead of two bodies");
            RequireStatus("unknown_body", () => world.States(new[] { gone }, 10));
            Require(Math.Abs(world.States(new[] { tired }, 10)[0].Position.X - 7) < 1e-4, "the tired ball stands");
            world.Wake(tired);
            return hash.Value;
        }
    }

    static void Responses()
    {
        Require(Shooting(1) == Shooting(2), "removals and stops on two threads");
        var definition = WorldDefinition.Default;
        definition.SetBox(new Vector(0, 0, 0), new Vector(20, 20, 20));
        using (var world = new World(definition))
        {
            var state = new State { Position = new Vector(5, 5, 5), Velocity = new Vector(1, 0, 0) };
            world.AddBallistic(new[] { state }, BodyDefinition.Default, new Vector(0, 0, 0));
            Respond unknown = happened => new Response { SecondAction = (BodyAction)7 };
            RequireStatus("out_of_range", () => world.Run(20, respond: unknown));
            Respond wall = happened => new Response { SecondAction = BodyAction.Remove };
            RequireStatus("unknown_body", () => world.Run(20, respond: wall));
        }
    }

    static void WallsWithAFilter()
    {
        var like = BodyDefinition.Default;
        var filter = like.Filter;
        filter.Category = 2;
        var definition = WorldDefinition.Default;
        definition.SetBox(new Vector(0, 0, 0), new Vector(20, 20, 20));
        definition.SetWallFilter(filter);
        using (var world = new World(definition))
        {
            var state = new State { Position = new Vector(10, 10, 10), Velocity = new Vector(1, 0, 0) };
            like.Filter.Mask = 1;
            var ball = world.AddBallistic(new[] { state }, like, new Vector(0, 0, 0))[0];
            Require(world.Advance(15).Kind == EventKind.None, "a wall that lets a ball pass");
            world.SetFilter(ball, BodyDefinition.Default.Filter);
            Require(world.Advance(16).Kind == EventKind.WallBegin, "a wall that meets a ball");
        }
    }

    // A ball lands on the edge of two triangles, which are one body.
    static void Meshes()
    {
        using (var world = new World(WorldDefinition.Default))
        {
            var vertices = new[] { new Vector(-4, -4, 0), new Vector(4, -4, 0), new Vector(4, 4, 0), new Vector(-4, 4, 0) };
            var floor = world.AddMesh(vertices, new uint[] { 0, 1, 2, 0, 2, 3 });
            var ball = BodyDefinition.Default;
            ball.Position = new Vector(1, 1, 3);
            ball.Velocity.Z = -1;
            world.Add(ball);
            Probe probe = (ids, time, states) =>
            {
                for (int k = 0; k < ids.Length; ++k)
                {
                    states[k].Position = ball.Position + ball.Velocity * time;
                    states[k].Velocity = ball.Velocity;
                }
            };
            var met = world.Advance(5, probe);
            Require(met.Kind == EventKind.ContactBegin && Math.Abs(met.Time - 2) < 1e-5, "a ball meets a mesh");
            Require(met.First.Equals(floor) && met.Normal.X == 0 && met.Normal.Z == 1, "above an edge the floor is flat");
            var half = new Mesh(vertices, new uint[] { 0, 1, 2 });
            world.SetShape(floor, half.Shape);
            half.Dispose();
            RequireStatus("stale_handle", () => world.SetShape(floor, half.Shape));
            RequireStatus("out_of_range", () => new Mesh(vertices, new uint[] { 0, 1, 4 }));
            RequireStatus("out_of_range", () => Mesh.Chain(new[] { vertices[0] }));
            Mesh.Chain(vertices).Dispose();
        }
    }

    // A plate rises at 2 towards a ball that falls at 1, from a gap of 2.5.
    static void MovingShape()
    {
        using (var world = new World(WorldDefinition.Default))
        {
            var body = BodyDefinition.Default;
            body.Velocity.Z = 2;
            body.Mass = double.PositiveInfinity;
            var lift = world.AddMovingShape(body, Shape.Box(new Vector(-1, -1, 0), new Vector(1, 1, 0.5)));
            var ball = BodyDefinition.Default;
            ball.Position = new Vector(0.25, 0.5, 4);
            ball.Velocity.Z = -1;
            var falling = world.Add(ball);
            Probe probe = (ids, time, states) =>
            {
                for (int k = 0; k < ids.Length; ++k)
                {
                    var from = ids[k].Equals(lift) ? body : ball;
                    states[k].Position = from.Position + from.Velocity * time;
                    states[k].Velocity = from.Velocity;
                }
            };
            var met = world.Advance(5, probe);
            Require(met.Kind == EventKind.ContactBegin && Math.Abs(met.Time - 2.5 / 3) < 1e-5, "a lift meets a ball");
            Require(met.First.Equals(lift) && met.Second.Equals(falling), "the lift comes first");
            RequireStatus("unsupported", () => world.AddMovingShape(body, Shape.Ball(new Vector(0, 0, 0), 1)));
        }
    }

    // A ball hits one end of a dumbbell that rests, and a function turns a rod towards a ball.
    // A square or a cube that turns meets a ball of radius 1 with a side.
    static void Hulls()
    {
        Vector lower = new Vector(-1, -1, -1), upper = new Vector(1, 1, 1);
        var square = new RigidHull(0, new Vector(-1, -1, 0), new Vector(1, -1, 0), new Vector(1, 1, 0), new Vector(-1, 1, 0));
        foreach (var hull in new[] { square, RigidHull.Box(lower, upper, 0) })
        {
            using (var world = new World(WorldDefinition.Default))
            {
                var rigid = RigidDefinition.Default;
                rigid.Rotation.AngularVelocity = new Vector(0, 0, 1);
                world.AddRigidBody(BodyDefinition.Default, rigid, new RigidPart[0], new[] { hull });
                var ball = BodyDefinition.Default;
                ball.Position.X = 2.2;
                var still = world.Add(ball);
                var met = world.Advance(10, (ids, time, states) =>
                {
                    for (int k = 0; k < ids.Length; ++k)
                        states[k] = new State(new Vector(ids[k].Equals(still) ? 2.2 : 0, 0, 0), new Vector());
                });
                Require(Math.Abs(met.Time - Math.Acos(2 / 2.2)) < 1e-5, "a side meets a ball");
                RequireStatus("null_argument", () => world.AddRigidBody(
                    BodyDefinition.Default, rigid, new RigidPart[0], new[] { new RigidHull(1) }));
            }
        }
    }

    static void RigidBodies()
    {
        using (var world = new World(WorldDefinition.Default))
        {
            var body = BodyDefinition.Default;
            body.Mass = 2;
            var rigid = RigidDefinition.Default;
            rigid.Inertia = new Vector(0, 2, 2);
            Vector left = new Vector(-1, 0, 0), right = new Vector(1, 0, 0);
            RequireStatus("out_of_range", () => world.AddRigidBody(body, rigid));
            var dumbbell = world.AddRigidBody(body, rigid, new RigidPart(left, left, 0.5), new RigidPart(right, right, 0.5));
            var ball = BodyDefinition.Default;
            ball.Position = new Vector(1, 5, 0);
            ball.Velocity.Y = -1;
            var falling = world.Add(ball);
            var met = world.Advance(10, (ids, time, states) =>
            {
                for (int k = 0; k < ids.Length; ++k)
                    states[k] = ids[k].Equals(falling) ? new State(ball.Position + ball.Velocity * time, ball.Velocity) : new State();
            });
            Require(met.First.Equals(dumbbell) && met.FirstPart == 1, "a ball meets an end of a dumbbell");
            var after = met.Bounce(1);
            double v = after.First.Value.Y, w = after.FirstAngularVelocity.Value.Z, u = after.Second.Value.Y;
            Require(Math.Abs(2 * v + u + 1) < 1e-12 && Math.Abs(2 * w + u + 1) < 1e-12, "momenta are kept");
            Require(Math.Abs(2 * v * v + 2 * w * w + u * u - 1) < 1e-12, "energy is kept");
            world.SetAngularVelocity(dumbbell, after.FirstAngularVelocity.Value);
            Require(world.RotationOf(dumbbell).AngularVelocity.Z == w, "the dumbbell turns");
            RequireStatus("unsupported", () => world.RotationOf(falling));
        }
        using (var world = new World(WorldDefinition.Default))
        {
            var rigid = RigidDefinition.Default;
            rigid.AngularAccelerationLimit = 1;
            rigid.LargestAngularSpeed = 2;
            rigid.Rotation.AngularVelocity.Z = 1;
            var rod = world.AddRigidBody(BodyDefinition.Default, rigid,
                new RigidPart(new Vector(0, 0, 0), new Vector(4, 0, 0), 0.1));
            var ball = BodyDefinition.Default;
            ball.Position.Y = 2;
            world.Add(ball);
            Probe still = (ids, time, states) =>
            {
                for (int k = 0; k < ids.Length; ++k)
                    states[k] = ids[k].Equals(rod) ? new State() : new State(ball.Position, new Vector());
            };
            RequireStatus("null_probe", () => world.Advance(10, still));
            world.SetRotationProbe((ids, time, rotations) => { throw new InvalidOperationException("stuck"); });
            string said = "";
            try { world.Advance(10, still); } catch (InvalidOperationException thrown) { said = thrown.Message; }
            Require(said == "stuck", "the exception of a rotation probe");
            world.SetRotationProbe((ids, time, rotations) =>
            {
                for (int k = 0; k < ids.Length; ++k)
                    rotations[k] = new Rotation(new Quaternion(Math.Cos(time / 2), 0, 0, Math.Sin(time / 2)), new Vector(0, 0, 1));
            });
            using (var copy = world.Clone())
            {
                var met = copy.Advance(10, still);
                Require(Math.Abs(met.Time - (Math.PI / 2 - Math.Asin(1.1 / 2))) < 1e-5, "a rod meets a ball");
            }
        }
    }

    static void RecordingAndProfiling()
    {
        using (var world = new World(WorldDefinition.Default))
        {
            var states = new[] { new State(new Vector(0, 0, 0), new Vector(1, 0, 0)), new State(new Vector(10, 0, 0), new Vector()) };
            world.AddBallistic(states, BodyDefinition.Default, new Vector());
            world.StartRecording();
            world.SetProfiling(true);
            var met = world.Advance(20);
            var recording = world.StopRecording();
            Require(met.Kind == EventKind.ContactBegin && world.Timings.Advances == 1, "two balls meet");
            Require(world.Busiest(1).Single().Probes > 0 && world.Busiest(1)[0].Advice.Length > 20, "the busiest");
            using (var replay = new Replay(recording))
            {
                var again = replay.Advance();
                Require(again.Time == met.Time && again.First.Equals(met.First), "they meet again");
                Require(!replay.Finished && replay.Advance().Kind == EventKind.None, "the end of the recording");
                Require(replay.Finished && replay.Step == replay.StepCount && replay.Hash != 0, "the end of a replay");
                using (var copy = replay.CopyWorld()) Require(copy.Time == met.Time && copy.Size == 2, "its world");
            }
            RequireStatus("bad_recording", () => new Replay(new byte[] { 1, 2, 3 }));
        }
    }

    static void Predictions()
    {
        var unlimited = ErrorBound.Ball(double.PositiveInfinity);
        var level = Separation.Sphere(50);
        level.LookAhead = 60;
        var definition = new MonitorDefinition
        {
            Classes = new[] { new TrackClass { AccelerationLimit = ErrorBound.Ball(0.5), LargestSpeed = unlimited } },
            Separations = new[] { new SeparationRule { Levels = new[] { level } } },
        };
        using (var monitor = new Monitor(definition))
        {
            for (ulong k = 0; k < 2; ++k)
            {
                var report = TrackReport.Default;
                report.State = new State(new Vector(500.0 * k, 0, 0), new Vector(10 - 20.0 * k, 0, 0));
                report.VelocityError = ErrorBound.Ball(0);
                monitor.Report(k, report);
            }
            Require(monitor.Advance(1).Kind == MonitorEventKind.Predicted, "two tracks will meet");
            Require(monitor.PredictedPairs().Single().ClosestDistance < 1e-6, "where they will be");
            Require(monitor.Tracks().Length == 2 && monitor.Places(0).Single().Centre.X == 10 * monitor.Time, "where they are");
            RequireArgument("reports", () => monitor.Report(1, new TrackReport()));
            int asked = 0;
            Poll poll = (tracks, time, reports) =>
            {
                asked += tracks.Length;
                for (int k = 0; k < tracks.Length; ++k)
                {
                    var report = TrackReport.Default;
                    report.Timestamp = time;
                    report.State.Position = new Vector(500.0 * tracks[k], 0, 0);
                    reports[k] = report;
                }
            };
            using (var restored = Monitor.Restore(monitor.Save()))
            {
                Require(restored.Needed(30).All(request => request.By <= 30), "what is needed");
                restored.Events(30, poll).Count();
                Require(asked > 0 && restored.Time == 30, "a poll");
            }
        }
    }

    static void Play(Func<double> number)
    {
        var room = WorldDefinition.Default;
        room.SetBox(new Vector(0, 0, 0), new Vector(10, 10, 10));
        using (var game = new GameWorld(room, new Vector(0, 0, -9.81), 0.9))
        {
            var block = StaticDefinition.Default;
            block.Shape = Shape.Box(new Vector(4, 4, 0), new Vector(6, 6, 1));
            game.AddStatic(block);
            for (int k = 0; k < 27; ++k)
            {
                var ball = BodyDefinition.Default;
                ball.Mass = ball.Radius = 0.3 + 0.5 * number();
                ball.Position = new Vector(2 + k % 3 * 3.0, 2 + k / 3 % 3 * 3.0, 2 + k / 9 * 3.0);
                ball.Velocity.X = 10 * (number() - 0.5);
                ball.Velocity.Y = 10 * (number() - 0.5);
                ball.Velocity.Z = 10 * (number() - 0.5);
                game.Add(ball);
            }
            var hash = new EventHash();
            for (int frame = 0; frame < 128; ++frame)
            {
                if (frame % 16 == 0)
                    game.SetVelocities(game.Velocities.ToArray().Select(v => new Vector(v.Y, v.Z, v.X)).ToArray());
                if (frame == 32) game.Remove(game.Ids[3]);
                if (frame == 64)
                {
                    var ball = BodyDefinition.Default;
                    ball.Radius = 0.25;
                    ball.Position = new Vector(5, 5, 9.5);
                    game.Add(ball);
                }
                if (frame == 96) game.SetAcceleration(game.Ids[0], new Vector(0, 0, 20));
                foreach (var happened in game.Step(0.015625)) hash.Add(happened);
            }
            Console.WriteLine("{0:x16}", hash.Value);
        }
    }

    static GameWorld NewGame(out BodyId id, Respond respond = null)
    {
        var room = WorldDefinition.Default;
        room.Contacts = Contacts.Impacts;
        room.SetBox(new Vector(0, 0, 0), new Vector(10, 10, 10));
        var game = new GameWorld(room, new Vector(0, 0, -10), 0.5, 0.1, respond);
        var ball = BodyDefinition.Default;
        ball.Radius = 0.5;
        ball.Position = new Vector(5, 5, 5);
        id = game.Add(ball);
        return game;
    }

    static void Games()
    {
        BodyId ball;
        using (var game = NewGame(out ball))
        {
            Require(game.Step(0.5).Length == 0 && game.Velocities[0].Z == -5 && game.Ids[0].Equals(ball), "a flight");
            var other = game.Add(BodyDefinition.Default);
            game.Remove(ball);
            Require(game.Ids.Length == 1 && game.IndexOf(other) == 0 && game.Size == 1, "no gaps");
            game.Gravity = new Vector();
            game.SetVelocities(new[] { new Vector(0, 1, 0) });
            game.SetAcceleration(other, new Vector(0, 0, 4));
            using (var copy = game.Clone())
            using (var saved = GameWorld.Restore(game.Save()))
                foreach (var one in new[] { game, copy, saved })
                {
                    one.Step(0.5);
                    Require(one.Velocities[0].Z == 2 && one.Positions[0].Y == 0.5 && one.Gravity.Z == 0, "a copy");
                }
        }
        int calls = 0;
        Respond remove = happened =>
        {
            if (++calls == 1) return happened.Bounce(1);
            if (calls == 2) throw new InvalidOperationException("game over");
            return new Response { FirstAction = BodyAction.Remove };
        };
        using (var game = NewGame(out ball, remove))
        {
            var met = game.Advance(2);
            Require(met.Kind == EventKind.WallBegin && game.Time == met.Time && game.Velocities[0].Z > 0, "an event");
            Require(game.Advance(2).Kind == EventKind.None && game.Time == 2, "nothing more");
            string said = "";
            try
            {
                game.Step(2);
            }
            catch (InvalidOperationException thrown)
            {
                said = thrown.Message;
            }
            Require(said == "game over", "the exception of a response");
            Require(game.Step(2).Length == 1 && game.Ids.Length == 0, "what a response removes");
            game.SetResponse(0.5);
            game.Add(BodyDefinition.Default);
            game.Step(1);
            Require(calls == 3, "another response");
        }
        using (var game = NewGame(out ball))
        {
            var nan = new Vector(0, double.NaN, 0);
            RequireStatus("not_finite", () => game.Step(double.NaN));
            RequireStatus("out_of_range", () => game.SetVelocities(new Vector[2]));
            RequireStatus("not_finite", () => game.SetVelocities(new[] { nan }));
            RequireStatus("unsupported", () => game.SetMotionLimits(ball, new MotionLimits()));
            RequireStatus("unsupported", () => game.Run(1));
            RequireStatus("unsupported", () => game.Advance(1, (ids, time, states) => { }));
            game.Remove(ball);
            RequireStatus("stale_body", () => game.IndexOf(ball));
            RequireStatus("bad_snapshot", () => World.Restore(game.Save()));
            RequireStatus("out_of_range", () => new GameWorld(WorldDefinition.Default, new Vector(), 2));
            game.Dispose();
            RequireStatus("stale_handle", () => game.Step(1));
            RequireStatus("stale_handle", () => Console.WriteLine(game.Positions.Length));
        }
    }

    static void WellsAndRoughness()
    {
        var definition = WorldDefinition.Default;
        definition.Contacts = Contacts.Impacts;
        using (var world = new World(definition))
        {
            var start = new[] { new State(new Vector(-0.6, 0, 0), new Vector(0.5, 0, 0)),
                                new State(new Vector(0.6, 0, 0), new Vector(-0.5, 0, 0)) };
            var ids = world.AddBallistic(start, BodyDefinition.Default, new Vector(), new[] { 0.5, 0.5 });
            world.SetSensor(0, new[] { 0.5 });
            var well = new StepPotential(world, new[] { 0.5 }, new[] { -1.0 });
            Require(well.Energy(0.4) == -1 && well.Energy(0.6) == 0, "energies");
            int turns = 0, contacts = 0;
            world.Run(20, respond: well.Respond, sink: happened =>
            {
                turns += well.Respond(happened).TurnedBack ? 1 : 0;
                contacts += happened.Kind == EventKind.ContactBegin ? 1 : 0;
            });
            for (var next = world.Advance(40); next.Kind != EventKind.None; next = world.Advance(40))
            {
                turns += well.Respond(next).TurnedBack ? 1 : 0;
                world.Apply(next, well.Respond(next));
                contacts += next.Kind == EventKind.ContactBegin ? 1 : 0;
                if (next.Kind != EventKind.ContactBegin) continue;
                var smooth = Roughness.Default;
                smooth.TangentialRestitution = -1;
                Require(next.Bounce(smooth).First.Value.X == next.Bounce(1).First.Value.X, "smooth balls");
                smooth.Friction = -1;
                RequireArgument("rough", () => next.Bounce(new Roughness()));
                RequireStatus("out_of_range", () => next.Bounce(smooth));
            }
            Require(Math.Abs(turns - 40) <= 1 && Math.Abs(contacts - 40) <= 1, "turned back: " + turns);
            Require(world.SensorOverlaps(ids[0]).Length == 1, "still within the well");
            RequireStatus("out_of_range", () => new StepPotential(world, new[] { 0.5, 0.4 }, new[] { 0.0, 1.0 }));
            well.Dispose();
            RequireStatus("stale_handle", () => well.Energy(1));
        }
    }

    static int Main()
    {
        ulong random = 1;
        Func<double> number = () =>
        {
            random = random * 16807 % 2147483647;
            return random / 2147483647.0;
        };
        var start = new State[64];
        var radii = new double[64];
        for (int k = 0; k < 64; ++k)
        {
            radii[k] = 0.5 + number();
            start[k].Position = new Vector(2.5 + k % 4 * 5.0, 2.5 + k / 4 % 4 * 5.0, 2.5 + k / 16 * 5.0);
            start[k].Velocity.X = 20 * (number() - 0.5);
            start[k].Velocity.Y = 20 * (number() - 0.5);
            start[k].Velocity.Z = 20 * (number() - 0.5);
        }
        StepByStep(NewWorld(start, radii));
        AtOnce(NewWorld(start, radii), null, 1);
        AtOnce(NewWorld(start, radii), happened => happened.Bounce(0.9), 2);
        Play(number);
        Games();
        WellsAndRoughness();
        WrongUse();
        WrongArguments();
        Callbacks();
        Knowledge();
        Responses();
        WallsWithAFilter();
        Meshes();
        MovingShape();
        RigidBodies();
        Hulls();
        RecordingAndProfiling();
        Predictions();
        return 0;
    }
}
