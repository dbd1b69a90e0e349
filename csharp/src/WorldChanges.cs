// Changes of bodies.
using System;

namespace Kinesphere
{
    public unsafe partial class World
    {
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

        /// <summary>Sets the function that gives the rotations of rigid bodies, directly after the probe; null removes it.
        /// Clones share it.</summary>
        public void SetRotationProbe(RotationProbe probe)
        {
            Native.RotationProbe callback = probe == null ? null : RotationCallback(probe, kept);
            Check(Native.ks_world_set_rotation_probe(handle, callback, IntPtr.Zero));
            rotations = callback;
        }

        /// <summary>Informs the world, and the motion of the body if it has one, of a new velocity.</summary>
        public void SetVelocity(BodyId body, Vector velocity)
        {
            Check(Native.ks_world_set_velocity(handle, body, velocity));
        }

        /// <summary>Sets the velocities of all these bodies or, on an error, of none.</summary>
        public void SetVelocities(BodyId[] bodies, Vector[] velocities)
        {
            if (Arrays.Count(bodies, "bodies") != Arrays.Count(velocities, "velocities"))
                throw new ArgumentException("there must be one velocity for each body", "velocities");
            Check(Native.ks_world_set_velocities(handle, bodies, velocities, Arrays.Count(bodies, "bodies")));
        }

        /// <summary>Does what a response to this event says, but for Stop: between two events the world always stands still.</summary>
        public void Apply(Event happened, Response response)
        {
            if (response.First.HasValue) SetVelocity(happened.First, response.First.Value);
            if (response.Second.HasValue) SetVelocity(happened.Second, response.Second.Value);
            if (response.FirstAngularVelocity.HasValue) SetAngularVelocity(happened.First, response.FirstAngularVelocity.Value);
            if (response.SecondAngularVelocity.HasValue) SetAngularVelocity(happened.Second, response.SecondAngularVelocity.Value);
            if (response.TurnedBack) TurnBack(happened);
            if (response.PairState.HasValue) SetPairState(happened.First, happened.Second, response.PairState.Value);
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
            Check(Native.ks_world_set_sensor(handle, sensorClass, distances, Arrays.Count(distances, "distances"), mask));
        }

        public void SetSensorClass(BodyId body, int sensorClass)
        {
            Check(Native.ks_world_set_sensor_class(handle, body, sensorClass));
        }

        /// <summary>Gives two bodies a state, a number of the caller's own that their events have, until it is set to 0 or
        /// one of the two is removed.</summary>
        public void SetPairState(BodyId first, BodyId second, int state)
        {
            Check(Native.ks_world_set_pair_state(handle, first, second, state));
        }

        public int PairState(BodyId first, BodyId second)
        {
            int state;
            Check(Native.ks_world_pair_state(handle, first, second, out state));
            return state;
        }

        /// <summary>To be called at a SensorEnter or SensorLeave: velocities of the caller have turned the two back there, so
        /// they have not crossed the distance. The event comes again if they do.</summary>
        public void TurnBack(Event crossing) { Check(Native.ks_world_turn_back(handle, ref crossing)); }

        /// <summary>Schedules an event Timer at a time that has not passed, and, if the period is not 0, again after each
        /// period.</summary>
        public void Schedule(double time, ulong userData = 0, double period = 0)
        {
            Check(Native.ks_world_schedule(handle, time, userData, period));
        }

        /// <summary>Removes all timers with these data. Returns how many there were.</summary>
        public int Unschedule(ulong userData)
        {
            UIntPtr count;
            Check(Native.ks_world_unschedule(handle, userData, out count));
            return (int)count;
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

        internal static Native.PairFilter PairCallback(PairFilter filter, Caught caught)
        {
            if (filter == null) return null;
            return (first, second, user) =>
            {
                bool may = true;
                caught.Call(() => may = filter(first, second));
                return may ? 1 : 0;
            };
        }
    }
}
