// Functions of the caller that the library calls.
using System;
using System.Runtime.ExceptionServices;

namespace Kinesphere
{
    /// <summary>Sets the states of bodies at a time, position and velocity of each: they are NaN at first, so that one that is
    /// forgotten is an error.</summary>
    public delegate void Probe(BodyId[] bodies, double time, State[] states);

    /// <summary>Sets the rotations of rigid bodies at a time, which are NaN at first.</summary>
    public delegate void RotationProbe(BodyId[] bodies, double time, Rotation[] rotations);

    /// <summary>Chooses what an event does to its bodies: the same for the same event.</summary>
    public delegate Response Respond(Event happened);

    /// <summary>Decides whether two bodies whose filters let them touch may do so: the same for both orders, and until
    /// World.RefreshFilter. It may read the world.</summary>
    public delegate bool PairFilter(BodyId first, BodyId second);

    /// <summary>Sets the latest reports of tracks, no later than the time; null for a track without a newer one.</summary>
    public delegate void Poll(ulong[] tracks, double time, TrackReport?[] reports);

    /// <summary>An exception of a callback, which must not pass through C.</summary>
    sealed class Caught
    {
        ExceptionDispatchInfo exception;

        public int Call(Action body)
        {
            try
            {
                body();
                return 0;
            }
            catch (Exception thrown)
            {
                exception = ExceptionDispatchInfo.Capture(thrown);
                return 1;
            }
        }
        /// <summary>Throws the exception, once, if there was one and it made a call fail.</summary>
        public void Rethrow(int status = Native.CallbackFailed)
        {
            var thrown = exception;
            exception = null;
            if (status == Native.CallbackFailed && thrown != null) thrown.Throw();
        }
    }
}
