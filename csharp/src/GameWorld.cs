// Games: worlds that move their own bodies.
using System;
using System.Runtime.InteropServices;

namespace Kinesphere
{
    /// <summary>A world that moves its own bodies, so that a game keeps nothing of them but ids. Between events each body
    /// flies freely, by the gravity of the game and its own planned acceleration, so steps of any length miss nothing. All
    /// else is as for World, whose calls that ask for states, motions, Run and SetMotionLimits throw "unsupported".</summary>
    public sealed unsafe class GameWorld : World
    {
        Event[] events = new Event[0];
        BodyId[] ids = new BodyId[0];
        Vector[] positions = new Vector[0], velocities = new Vector[0];

        /// <summary>A game without bodies, whose events are answered by bouncing, which with a resting speed lets heaps come
        /// to rest, or by `respond`, a function of the event alone that clones share. A restitution of NaN: bodies pass
        /// through each other.</summary>
        public GameWorld(WorldDefinition definition, Vector gravity, double restitution = 1, double restingSpeed = 0,
            Respond respond = null) : this(definition, new Answering(gravity, restitution, restingSpeed, respond)) { }

        GameWorld(WorldDefinition definition, Answering answering) : this(Create(definition, answering), answering) { }
        GameWorld(ulong handle, Answering answering) : base(handle)
        {
            kept = answering.Caught;
            answer = answering.Callback;
        }

        static ulong Create(WorldDefinition definition, Answering answering)
        {
            ulong created;
            definition.Require("definition");
            Native.Check(Native.ks_game_create(ref definition, ref answering.Definition, out created));
            return created;
        }

        /// <summary>The game of a snapshot that Save made of a game, which continues bit for bit; `filter` is the pair filter
        /// that it had.</summary>
        public static GameWorld Restore(byte[] snapshot, double restitution = 1, double restingSpeed = 0,
            Respond respond = null, PairFilter filter = null)
        {
            ulong restored;
            var answering = new Answering(new Vector(), restitution, restingSpeed, respond);
            var callback = PairCallback(filter, answering.Caught);
            Native.Check(Native.ks_game_restore(snapshot, Arrays.Count(snapshot, "snapshot"), ref answering.Definition,
                callback, IntPtr.Zero, out restored));
            return new GameWorld(restored, answering) { pairs = callback };
        }

        /// <summary>Returns a copy that continues as this game does: for rollback, or to look ahead.</summary>
        public new GameWorld Clone()
        {
            ulong copy;
            Check(Native.ks_world_clone(handle, out copy));
            return new GameWorld(copy, new Answering { Caught = kept, Callback = answer }) { rotations = rotations, pairs = pairs };
        }

        /// <summary>Advances by dt > 0, answers all events, and returns them in order; they are there until the next step.
        /// After an exception the next step goes on from where the game stands, and returns the events of this one,
        /// too.</summary>
        public ReadOnlySpan<Event> Step(double dt)
        {
            Native.EventList happened;
            Check(Native.ks_game_step(handle, dt, out happened));
            return Copy(happened.Events, happened.Count, ref events);
        }

        /// <summary>The bodies that can move, disabled ones too: the last one takes the place of a removed one. These spans
        /// hold what was true when they were asked for, until they are asked for again.</summary>
        public ReadOnlySpan<BodyId> Ids { get { return Copy(Now.Ids, Now.Count, ref ids); } }
        /// <summary>Where they are, in the order of Ids; on periodic axes in the box.</summary>
        public ReadOnlySpan<Vector> Positions { get { return Copy(Now.Positions, Now.Count, ref positions); } }
        /// <summary>Their velocities, in the order of Ids.</summary>
        public ReadOnlySpan<Vector> Velocities { get { return Copy(Now.Velocities, Now.Count, ref velocities); } }

        Native.BodyList Now
        {
            get
            {
                Native.BodyList found;
                Check(Native.ks_game_bodies(handle, out found));
                return found;
            }
        }

        /// <summary>Copies memory of the library, which a later call may free.</summary>
        static ReadOnlySpan<T> Copy<T>(void* elements, UIntPtr count, ref T[] copy) where T : struct
        {
            if (copy.Length < (int)count) copy = new T[Math.Max((int)count, 2 * copy.Length)];
            new ReadOnlySpan<T>(elements, (int)count).CopyTo(copy);
            return new ReadOnlySpan<T>(copy, 0, (int)count);
        }

        /// <summary>The place of a body in these arrays.</summary>
        public int IndexOf(BodyId body)
        {
            UIntPtr index;
            Check(Native.ks_game_index_of(handle, body, out index));
            return (int)index;
        }

        /// <summary>Replaces what answers the events of the game; its clones keep theirs.</summary>
        public void SetResponse(double restitution = 1, double restingSpeed = 0, Respond respond = null)
        {
            var answering = new Answering(new Vector(), restitution, restingSpeed, respond) { Caught = kept };
            Check(Native.ks_game_set_response(handle, ref answering.Definition));
            answer = answering.Callback;
        }

        /// <summary>Sets the velocities of all bodies, in the order of Ids, or, on an error, of none.</summary>
        public void SetVelocities(Vector[] velocities)
        {
            Check(Native.ks_game_set_velocities(handle, velocities, Arrays.Count(velocities, "velocities")));
        }

        /// <summary>Sets the acceleration of a body beside the gravity (length / time^2).</summary>
        public void SetAcceleration(BodyId body, Vector acceleration)
        {
            Check(Native.ks_game_set_acceleration(handle, body, acceleration));
        }

        /// <summary>Acceleration of all bodies (length / time^2). A change wakes all that sleep.</summary>
        public Vector Gravity
        {
            get
            {
                Vector gravity;
                Check(Native.ks_game_gravity(handle, out gravity));
                return gravity;
            }
            set { Check(Native.ks_game_set_gravity(handle, value)); }
        }

        /// <summary>How events are answered: the record of C, and what it points to.</summary>
        sealed class Answering
        {
            public Native.GameDefinition Definition;
            public Native.Respond Callback;
            public Caught Caught = new Caught();

            public Answering() { }
            public Answering(Vector gravity, double restitution, double restingSpeed, Respond respond)
            {
                Definition = Native.GameDefinition.Default;
                Definition.Gravity = gravity;
                Definition.Restitution = restitution;
                Definition.RestingSpeed = restingSpeed;
                if (respond == null) return;
                Callback = (happened, response, user) => Caught.Call(() => *response = respond(*happened).Sized());
                Definition.Respond = Marshal.GetFunctionPointerForDelegate(Callback);
            }
        }
    }
}
