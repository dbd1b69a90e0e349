// A game at 60 frames a second. It moves its balls as games do, v += g dt, x += v dt, and hands each frame over.
// Contacts come with their exact times between the last two frames and are answered there: fast balls never pass
// through each other or the walls. examples/c and rust/examples have the same game.
using System;
using System.Globalization;
using Kinesphere;

static class GameLoop
{
    static ulong random = 7;
    static double RandomNumber()
    {
        random = random * 16807 % 2147483647;
        return random / 2147483647.0;
    }

    static int Main()
    {
        const double dt = 1.0 / 60, radius = 0.2, edge = 10;
        const int balls = 216, frames = 600;

        // The game's own bodies.
        var game = new State[balls];
        for (int k = 0; k < balls; ++k)
        {
            game[k].Position = new Vector(0.5 + 1.8 * (k % 6), 0.5 + 1.8 * (k / 6 % 6), 1.0 + 1.5 * (k / 36));
            game[k].Velocity.X = 60 * (RandomNumber() - 0.5);
            game[k].Velocity.Y = 60 * (RandomNumber() - 0.5);
            game[k].Velocity.Z = 60 * (RandomNumber() - 0.5);
        }

        var definition = WorldDefinition.Default;
        definition.SetBox(new Vector(0, 0, 0), new Vector(edge, edge, edge));
        definition.ContactTolerance = 1e-3;
        definition.Contacts = Contacts.Impacts;
        var like = BodyDefinition.Default;
        like.Radius = radius;
        int betweenBalls = 0, offWalls = 0;
        double deepest = 0;
        using (var world = new World(definition))
        {
            uint motion;
            world.AddFrames(game, like, dt, out motion);
            for (int frame = 1; frame <= frames; ++frame)
            {
                var positions = new Vector[balls];
                for (int k = 0; k < balls; ++k)
                {
                    game[k].Velocity.Z += -9.81 * dt;
                    positions[k] = game[k].Position + game[k].Velocity * dt;
                }
                double now = world.PushFrame(motion, positions);
                for (var next = world.Advance(now); next.Kind != EventKind.None; next = world.Advance(now))
                {
                    if (next.Kind == EventKind.ContactBegin) ++betweenBalls;
                    if (next.Kind == EventKind.WallBegin) ++offWalls;
                    var after = next.Bounce(0.8);
                    if (after.First.HasValue)
                    {
                        game[next.First.Index].Velocity = after.First.Value;
                        world.SetVelocity(next.First, after.First.Value);
                    }
                    if (after.Second.HasValue)
                    {
                        game[next.Second.Index].Velocity = after.Second.Value;
                        world.SetVelocity(next.Second, after.Second.Value);
                    }
                }
                positions = world.LatestFrame(motion);
                for (int k = 0; k < balls; ++k)  // here the game draws them
                {
                    var p = game[k].Position = positions[k];
                    foreach (double margin in new[] { p.X, p.Y, p.Z, edge - p.X, edge - p.Y, edge - p.Z })
                        deepest = Math.Max(deepest, radius - margin);
                }
            }
        }
        Console.WriteLine("{0} bounces between balls, {1} off walls, in {2} frames", betweenBalls, offWalls, frames);
        Console.WriteLine("no ball was ever deeper in a wall than " + deepest.ToString("0.0000", CultureInfo.InvariantCulture));
        return deepest <= 1e-3 ? 0 : 1;
    }
}
