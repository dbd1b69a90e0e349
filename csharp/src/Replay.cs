// Recordings that are replayed.
using System;

namespace Kinesphere
{
    /// <summary>A recording that is being replayed.</summary>
    public sealed class Replay : IDisposable
    {
        readonly ulong handle;
        bool disposed;

        /// <summary>Opens a recording of a world without a pair filter.</summary>
        public Replay(byte[] recording)
        {
            Native.Check(Native.ks_replay_open(recording, Arrays.Count(recording, "recording"), null, IntPtr.Zero, out handle));
        }
        ~Replay() { Native.ks_replay_destroy(handle); }
        public void Dispose()
        {
            if (disposed) return;
            Native.Check(Native.ks_replay_destroy(handle));
            disposed = true;
            GC.SuppressFinalize(this);
        }
        /// <summary>Repeats everything up to the end of the next recorded advance, or of the recording, and returns what
        /// that advance returned. The error "diverged" names the step that differs.</summary>
        public Event Advance()
        {
            var next = Event.New;
            Native.Check(Native.ks_replay_advance(handle, ref next));
            return next;
        }
        /// <summary>True if no step is left and the world has ended as the recorded one did, to the last bit.</summary>
        public bool Finished
        {
            get
            {
                int finished;
                Native.Check(Native.ks_replay_finished(handle, out finished));
                return finished != 0;
            }
        }
        /// <summary>The number of steps repeated so far, and in total.</summary>
        public int Step { get { return Steps(false); } }
        public int StepCount { get { return Steps(true); } }
        int Steps(bool all)
        {
            UIntPtr repeated, total;
            Native.Check(Native.ks_replay_steps(handle, out repeated, out total));
            return (int)(all ? total : repeated);
        }
        /// <summary>The hash of all outcomes so far.</summary>
        public ulong Hash
        {
            get
            {
                ulong hash;
                Native.Check(Native.ks_replay_hash(handle, out hash));
                return hash;
            }
        }
        /// <summary>Returns a copy of the world after the last repeated step, without motions.</summary>
        public World CopyWorld()
        {
            ulong copy;
            Native.Check(Native.ks_replay_world(handle, out copy));
            return new World(copy);
        }
    }
}
