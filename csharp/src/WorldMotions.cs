// Motions that move bodies, so that no probe has to.
using System;

namespace Kinesphere
{
    public unsafe partial class World
    {
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
            var definition = Motion(Native.MotionKind.Ballistic);
            definition.Gravity = gravity;
            return AddMotion(definition, states, like, null, radii, masses, out motion);
        }

        /// <summary>Adds more bodies, such as bullets, to a motion. Their numbers there, which are their indices in frames,
        /// are the next ones, or those of removed bodies.</summary>
        public BodyId[] AddToMotion(uint motion, State[] states, BodyDefinition like, out uint[] numbers,
            double[] accelerationLimits = null, double[] radii = null, double[] masses = null)
        {
            var found = new uint[(int)Arrays.Count(states, "states")];
            numbers = found;
            return AddMoved(Motion(Native.MotionKind.Ballistic), states, like, accelerationLimits, radii, masses,
                (ref Native.MotionDefinition definition, BodyId[] ids) =>
                    Native.ks_world_add_to_motion(handle, motion, ref definition, found, ids));
        }

        /// <summary>Adds bodies under random accelerations up to their limits, new at multiples of the interval.</summary>
        public BodyId[] AddRandomForces(State[] states, BodyDefinition like, double[] accelerationLimits, double interval,
            ulong seed, double[] radii = null, double[] masses = null)
        {
            uint motion;
            var definition = Motion(Native.MotionKind.RandomForces);
            definition.Interval = interval;
            definition.Seed = seed;
            return AddMotion(definition, states, like, accelerationLimits, radii, masses, out motion);
        }

        /// <summary>Adds bodies that Steer moves: each keeps its acceleration, at first zero, within its limit.</summary>
        public BodyId[] AddSteered(State[] states, BodyDefinition like, double[] accelerationLimits, out uint motion,
            double[] radii = null, double[] masses = null)
        {
            return AddMotion(Motion(Native.MotionKind.Steered), states, like, accelerationLimits, radii, masses, out motion);
        }

        /// <summary>Sets the acceleration of a body that AddSteered added, from the current time on.</summary>
        public void Steer(BodyId body, Vector acceleration) { Check(Native.ks_world_steer(handle, body, acceleration)); }

        /// <summary>Adds bodies of a game's frames: straight from the position in one frame to that in the next. The
        /// interval is the time between frames without times of their own. Without limits the world is informed of all
        /// new velocities at each frame.</summary>
        public BodyId[] AddFrames(State[] states, BodyDefinition like, double interval, out uint motion,
            double[] radii = null, double[] masses = null, double[] accelerationLimits = null, double positionError = 0)
        {
            var definition = Motion(Native.MotionKind.Frames);
            definition.Interval = interval;
            definition.PositionError = positionError;
            return AddMotion(definition, states, like, accelerationLimits, radii, masses, out motion);
        }

        /// <summary>Appends the next frame, its interval after the one before, and returns its time, to which to advance
        /// then. A game whose frames differ in length gives their times.</summary>
        public double PushFrame(uint motion, Vector[] positions)
        {
            double time;
            Check(Native.ks_world_push_frame(handle, motion, positions, Arrays.Count(positions, "positions")));
            Check(Native.ks_world_latest_frame_time(handle, motion, out time));
            return time;
        }

        /// <summary>Appends the next frame, at a time after that of the latest frame.</summary>
        public void PushFrame(uint motion, Vector[] positions, double time)
        {
            Check(Native.ks_world_push_frame_at(handle, motion, positions, Arrays.Count(positions, "positions"), time));
        }

        /// <summary>The positions in the latest frame, with the changes that events made.</summary>
        public Vector[] LatestFrame(uint motion)
        {
            return Arrays.Filled<Vector>((Vector[] positions, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_latest_frame(handle, motion, positions, capacity, out count));
        }

        /// <summary>The true states at a time of bodies that motions move.</summary>
        public State[] States(BodyId[] bodies, double time)
        {
            var count = Arrays.Count(bodies, "bodies");
            var states = new State[bodies.Length];
            Check(Native.ks_world_states(handle, bodies, count, time, states));
            return states;
        }

        static Native.MotionDefinition Motion(Native.MotionKind kind)
        {
            var definition = Native.MotionDefinition.Default;
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
            definition.Count = Arrays.Count(states, "states");
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
    }
}
