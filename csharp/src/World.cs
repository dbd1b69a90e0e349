// Worlds, and what they are made with. Methods have the meanings, errors and costs of those of the C++ headers; wrong use throws a
// KinesphereException. An exception in a callback passes through the call that called it.
using System;

namespace Kinesphere
{
    /// <summary>A world of moving spheres, and of other things that move.</summary>
    public unsafe partial class World : IDisposable
    {
        static readonly Native.Probe motions = Native.ks_probe_motions;
        internal ulong handle;
        bool disposed;
        // The library keeps pointers to these functions, also in clones of this world, which share `kept`.
        internal Native.RotationProbe rotations;
        internal Native.PairFilter pairs;
        internal Native.Respond answer;
        internal Caught kept = new Caught();

        public World(WorldDefinition definition)
        {
            definition.Require("definition");
            Native.Check(Native.ks_world_create(ref definition, out handle));
        }

        internal World(ulong handle) { this.handle = handle; }
        ~World() { Native.ks_world_destroy(handle); }

        /// <summary>Destroys the world; each later call but Dispose throws.</summary>
        public void Dispose()
        {
            if (disposed) return;
            Native.Check(Native.ks_world_destroy(handle));
            disposed = true;
            GC.SuppressFinalize(this);
        }

        /// <summary>Returns a copy that continues as this world does, with its motions and ids: for rollback.</summary>
        public World Clone()
        {
            ulong copy;
            Check(Native.ks_world_clone(handle, out copy));
            return new World(copy) { rotations = rotations, pairs = pairs, kept = kept };
        }

        /// <summary>Returns a snapshot, without motions, rotation probe and pair filter.</summary>
        public byte[] Save()
        {
            return Arrays.Filled<byte>((byte[] bytes, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_save(handle, bytes, capacity, out count));
        }

        /// <summary>The world of a snapshot; `filter` is the pair filter that it had.</summary>
        public static World Restore(byte[] snapshot, PairFilter filter = null)
        {
            ulong restored;
            var caught = new Caught();
            var callback = PairCallback(filter, caught);
            int status = Native.ks_world_restore(snapshot, Arrays.Count(snapshot, "snapshot"), callback, IntPtr.Zero, out restored);
            Native.Check(status);
            return new World(restored) { pairs = callback, kept = caught };
        }

        /// <summary>Throws an exception of a function that the world keeps, or the error of the library, if there is one.</summary>
        internal void Check(int status)
        {
            kept.Rethrow();
            Native.Check(status);
        }

        /// <summary>Starts to record all input and output of the world, in memory.</summary>
        public void StartRecording() { Check(Native.ks_world_start_recording(handle)); }

        /// <summary>Stops recording and returns the recording, for a Replay.</summary>
        public byte[] StopRecording()
        {
            Check(Native.ks_world_stop_recording(handle));
            return Arrays.Filled<byte>((byte[] bytes, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_recording(handle, bytes, capacity, out count));
        }
    }

    public partial struct WorldDefinition
    {
        /// <summary>Gives the world walls, or on periodic axes a period, at the sides of a box.</summary>
        public void SetBox(Vector from, Vector to) { hasBox = 1; box = new Native.Box { Lower = from, Upper = to }; }
        /// <summary>Gives all walls a filter; without one they meet every body.</summary>
        public void SetWallFilter(Filter filter) { hasWallFilter = 1; wallFilter = filter; }
    }
}
