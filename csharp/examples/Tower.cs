// A control tower: 30 drones report every second, each at its own time and with errors of up to a metre. The monitor
// says when two are certainly within 50 m of each other, and never wrongly. examples/c/monitor.c and
// rust/examples/monitor.rs have the same tower.
using System;
using System.Globalization;
using Kinesphere;

static class Tower
{
    static ulong random = 5;
    static double RandomNumber()
    {
        random = random * 16807 % 2147483647;
        return random / 2147483647.0;
    }

    static int Main()
    {
        const double noise = 1, warning = 50, tolerance = 4 * noise;
        const int drones = 30, seconds = 60;
        var unlimited = ErrorBound.Ball(double.PositiveInfinity);
        var definition = new MonitorDefinition
        {
            Classes = new[] { new TrackClass { AccelerationLimit = ErrorBound.Ball(4), LargestSpeed = unlimited } },
            Separations = new[] { new SeparationRule { Levels = new[] { Separation.Sphere(warning) } } },
            Tolerance = tolerance
        };

        // Hidden from the tower: the drones fly straight.
        var start = new State[drones];
        for (int k = 0; k < drones; ++k)
        {
            start[k].Position.X = 1000 * RandomNumber();
            start[k].Position.Y = 1000 * RandomNumber();
            start[k].Position.Z = 100;
            start[k].Velocity.X = 30 * (RandomNumber() - 0.5);
            start[k].Velocity.Y = 30 * (RandomNumber() - 0.5);
        }

        int within = 0, wrong = 0;
        using (var tower = new Monitor(definition))
        {
            for (int k = 0; k < drones * seconds; ++k)
            {
                int who = k % drones;
                double time = (double)k / drones;
                // Everything that becomes certain before the next report comes in.
                for (var next = tower.Advance(time); next.Kind != MonitorEventKind.None; next = tower.Advance(time))
                {
                    if (next.Kind != MonitorEventKind.Verdict || next.Verdict != Verdict.Within) continue;
                    ++within;
                    State a = start[next.First], b = start[next.Second];
                    var apart = b.Position - a.Position + (b.Velocity - a.Velocity) * next.Time;
                    if (Math.Sqrt(apart.X * apart.X + apart.Y * apart.Y) > warning + tolerance) ++wrong;
                    Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                        "{0,8:0.000} s  drones {1} and {2} are within {3} m", next.Time, next.First, next.Second, warning));
                }
                var report = TrackReport.Default;
                report.Timestamp = time;
                report.State = start[who];
                report.State.Position.X += start[who].Velocity.X * time + noise * (RandomNumber() - 0.5);
                report.State.Position.Y += start[who].Velocity.Y * time + noise * (RandomNumber() - 0.5);
                report.PositionError = ErrorBound.Ball(noise);
                tower.Report((ulong)who, report);
            }
        }
        Console.WriteLine("{0} warnings in a minute, {1} of them wrong", within, wrong);
        return wrong == 0 && within > 0 ? 0 : 1;
    }
}
