// Advancing a world to its next events.
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace Kinesphere
{
    public unsafe partial class World
    {
        /// <summary>Advances to the next event, at most to time `until`. Returns the event, with the world at its time;
        /// or one of kind None, with the world at `until`. The probe is for the bodies that no motion moves; null if
        /// motions move all.</summary>
        public Event Advance(double until, Probe probe = null)
        {
            var next = Event.New;
            Ask(probe, callback => Native.ks_world_advance(handle, until, callback ?? motions, IntPtr.Zero, ref next));
            return next;
        }

        /// <summary>Goes through the events up to `until`, for a loop in which bodies may be changed.</summary>
        public IEnumerable<Event> Events(double until, Probe probe = null)
        {
            for (var next = Advance(until, probe); next.Kind != EventKind.None; next = Advance(until, probe)) yield return next;
        }

        /// <summary>Makes a call that may ask for states; null: of no body.</summary>
        void Ask(Probe probe, Func<Native.Probe, int> call)
        {
            var caught = new Caught();
            var callback = probe == null ? null : Callback(probe, caught);
            int status = call(callback);
            GC.KeepAlive(callback);
            GC.KeepAlive(this);
            caught.Rethrow(status);
            Check(status);
        }

        /// <summary>Advances to time `until` and answers all events by bouncing, which with a resting speed lets heaps come
        /// to rest, or by `respond`. It is called at every event, at ends too: look at Event.Kind first, as velocities that
        /// are exchanged at each end turn the two back to each other, for ever. Motions must move all
        /// bodies; one that a response removes leaves its motion, too. The sink receives each event, in order, and may read
        /// the world. At an event whose response has Stop the world is at the time of the event, and the sink may change it;
        /// elsewhere such calls throw "run_in_progress", as Advance and Run always do.</summary>
        public void Run(double until, double restitution = 1, Respond respond = null, Action<Event> sink = null, int threads = 1,
            double restingSpeed = 0)
        {
            var definition = Native.RunDefinition.Default;
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
            caught.Rethrow(status);
            Check(status);
        }

        /// <summary>From now on, so many threads, from 1 to 256 with the calling one, share what a call does for thousands
        /// of bodies at one time, as where all velocities change; 1, as at first: the calling thread alone. They call no
        /// function of yours, and the outcome is the same, bit for bit. Clones and restored worlds begin with 1.</summary>
        public void UseThreads(int threads) { Check(Native.ks_world_use_threads(handle, threads)); }

        static Native.Probe Callback(Probe probe, Caught caught)
        {
            return (bodies, count, time, states, user) => caught.Call(() =>
            {
                var ids = new BodyId[(int)count];
                var answers = new State[ids.Length];
                for (int k = 0; k < ids.Length; ++k)
                {
                    ids[k] = bodies[k];
                    answers[k] = states[k];  // NaN, so that a body that the probe forgets is an error
                }
                probe(ids, time, answers);
                for (int k = 0; k < ids.Length; ++k) states[k] = answers[k];
            });
        }
    }
}
