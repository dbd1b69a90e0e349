// What an event does to its bodies, and potentials that say it.
using System;

namespace Kinesphere
{
    public partial struct Response
    {
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
            get { return turnsFirst != 0 ? firstVelocity : (Vector?)null; }
            set { turnsFirst = value.HasValue ? 1 : 0; firstVelocity = value.GetValueOrDefault(); }
        }
        public Vector? Second
        {
            get { return turnsSecond != 0 ? secondVelocity : (Vector?)null; }
            set { turnsSecond = value.HasValue ? 1 : 0; secondVelocity = value.GetValueOrDefault(); }
        }
        /// <summary>Of rigid bodies (radians / time); null: the body turns as before.</summary>
        public Vector? FirstAngularVelocity
        {
            get { return spinsFirst != 0 ? firstAngularVelocity : (Vector?)null; }
            set { spinsFirst = value.HasValue ? 1 : 0; firstAngularVelocity = value.GetValueOrDefault(); }
        }
        public Vector? SecondAngularVelocity
        {
            get { return spinsSecond != 0 ? secondAngularVelocity : (Vector?)null; }
            set { spinsSecond = value.HasValue ? 1 : 0; secondAngularVelocity = value.GetValueOrDefault(); }
        }
        /// <summary>Of sensors: the two have been turned back at the sensor distance (World.TurnBack).</summary>
        public bool TurnedBack
        {
            get { return turnedBack != 0; }
            set { turnedBack = value ? 1 : 0; }
        }
        /// <summary>The two get this state (World.SetPairState); null: they keep theirs.</summary>
        public int? PairState
        {
            get { return setsPairState != 0 ? pairState : (int?)null; }
            set { setsPairState = value.HasValue ? 1 : 0; pairState = value.GetValueOrDefault(); }
        }
    }

    /// <summary>A potential of steps between pairs of bodies, as a response to events: square wells, Lennard-Jones
    /// potentials in steps, bonds.</summary>
    public sealed unsafe class StepPotential : IDisposable
    {
        readonly ulong handle;
        bool disposed;

        /// <summary>A potential for worlds with the definition of this one, whose bodies need a sensor with its distances
        /// (World.SetSensor). Distances are gaps between surfaces, ascending; energies those of pairs that are nearer, but
        /// not than the distance before; `outside` the one beyond the last, infinite for a bond. The restitution is that of
        /// contacts.</summary>
        public StepPotential(World world, double[] distances, double[] energies, double outside = 0, double restitution = 1)
        {
            if (world == null) throw new ArgumentNullException("world");
            if (Arrays.Count(distances, "distances") != Arrays.Count(energies, "energies"))
                throw new ArgumentException("there must be one energy for each distance", "energies");
            var definition = Native.StepPotentialDefinition.Default;
            definition.Count = (UIntPtr)distances.Length;
            definition.Outside = outside;
            definition.Restitution = restitution;
            fixed (double* gaps = distances)
            fixed (double* steps = energies)
            {
                definition.Distances = gaps;
                definition.Energies = steps;
                Native.Check(Native.ks_step_potential_create(world.handle, ref definition, out handle));
            }
        }
        ~StepPotential() { Native.ks_step_potential_destroy(handle); }
        public void Dispose()
        {
            if (disposed) return;
            Native.Check(Native.ks_step_potential_destroy(handle));
            disposed = true;
            GC.SuppressFinalize(this);
        }

        /// <summary>At a step of the potential the two gain or lose what their energy changes by, or are turned back; at a
        /// contact they bounce.</summary>
        public Response Respond(Event happened)
        {
            var response = new Response().Sized();
            Native.Check(Native.ks_step_potential_respond(handle, ref happened, ref response));
            GC.KeepAlive(this);
            return response;
        }
        /// <summary>The potential energy of a pair with this gap (length).</summary>
        public double Energy(double gap)
        {
            double energy;
            Native.Check(Native.ks_step_potential_energy(handle, gap, out energy));
            return energy;
        }
    }
}
