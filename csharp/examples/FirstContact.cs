// Two drones, one circling and one hovering in its way. The world gets their limits, but not their paths.
using System;
using Kinesphere;

static class FirstContact
{
    static int Main()
    {
        int contacts = 0;
        using (var world = new World(WorldDefinition.Default))
        {
            var drone = BodyDefinition.Default;
            drone.Radius = 1;
            drone.AccelerationLimit = 5.001;  // a circle of radius 20 flown at speed 10 takes 5
            drone.Position = new Vector(20, 0, 0);
            drone.Velocity = new Vector(0, 10, 0);
            BodyId circling = world.Add(drone);
            drone.AccelerationLimit = 0.5;
            drone.Position = new Vector(-20, 1.5, 0);
            drone.Velocity = new Vector(0, 0, 0);
            world.Add(drone);

            // Called only when it can matter; gives the true positions and velocities of bodies.
            Probe probe = (bodies, time, states) =>
            {
                double c = Math.Cos(time / 2), s = Math.Sin(time / 2);
                for (int k = 0; k < bodies.Length; ++k)
                {
                    bool circles = bodies[k].Equals(circling);
                    states[k].Position = circles ? new Vector(20 * c, 20 * s, 0) : new Vector(-20, 1.5, 0);
                    states[k].Velocity = circles ? new Vector(-10 * s, 10 * c, 0) : new Vector(0, 0, 0);
                }
            };
            foreach (Event next in world.Events(30.0, probe))
            {
                if (next.Kind == EventKind.BoundViolation) Console.WriteLine("A drone accelerates more than promised.");
                if (next.Kind != EventKind.ContactBegin) continue;
                Console.WriteLine("{0,9:F6} s  contact, closing at {1:F3}", next.Time, next.ApproachSpeed);
                ++contacts;
            }
        }
        return contacts == 2 ? 0 : 1;
    }
}
