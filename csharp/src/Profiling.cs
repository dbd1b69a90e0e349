// Where the time of a world goes.
using System.Runtime.InteropServices;

namespace Kinesphere
{
    public enum ProbeReason { Touching, NarrowMisses, LooseLimit, Contacts, Travel, Changes, Queries }

    /// <summary>Wall-clock time spent (seconds) since profiling was switched on.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Timings
    {
        public ulong Advances;
        public double Advance, Probes;
    }

    /// <summary>A body that was probed while profiling was on, and why.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct BusyBody
    {
        public BodyId Body;
        public ProbeReason Reason;
        public ulong Probes, Touching, NearOthers, Windows, Changes, Queries, Contacts;
        public double AccelerationLimit, LargestAcceleration;
        /// <summary>What the reason means, and what makes such a body cheaper.</summary>
        public string Advice { get { return Marshal.PtrToStringAnsi(Native.ks_probe_reason_advice(Reason)); } }
    }
}
