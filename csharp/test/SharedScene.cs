// The scene of tests/same_hash/shared_scene.cpp, run in three ways. Each prints its hash. Then what C# adds to the C
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
            for (int k = 0; k < ids.Length; ++k) states[k].Position.X = ids[k].Equals(second) ? 10 : 0;
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
        WrongUse();
        return 0;
    }
}
