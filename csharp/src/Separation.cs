// Separations of tracks, and what is certain about them.
using System.Runtime.InteropServices;

namespace Kinesphere
{
    public enum SeparationShape { Ellipsoid, Cylinder, WellClear }

    [StructLayout(LayoutKind.Sequential)]
    public struct Separation
    {
        public SeparationShape Shape;
        public double Horizontal, Vertical, LookAhead, ModifiedTau;
        public static Separation Sphere(double distance)
        {
            return new Separation { Horizontal = distance, Vertical = distance };
        }
    }

    /// <summary>The separation levels between two classes of tracks, the widest first.</summary>
    public sealed class SeparationRule
    {
        public int FirstClass, SecondClass;
        public Separation[] Levels = new Separation[0];
    }

    public enum Verdict { Apart, Undecided, Within }

    [StructLayout(LayoutKind.Sequential)]
    public struct PairAnswer
    {
        uint structSize;
        public Verdict Verdict;
        int predicted;
        public double Since, Until, Lower, Upper, ClosestDistance, ClosestTime, ClosestHorizontal, ClosestVertical;
        public double RelativeSpeed, LikelyTime, InevitableBy, AvoidableUntil;
        public ulong Ask;
        public double AskBy;
        public bool Predicted { get { return predicted != 0; } }
        internal static PairAnswer New
        {
            get { return new PairAnswer { structSize = Native.SizeOf<PairAnswer>(), predicted = 0 }; }
        }
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct OpenPair
    {
        public ulong First, Second;
        public uint Level;
        public Verdict Verdict;
        public double Since;
    }

    /// <summary>A pair that is predicted to come within a separation.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct PredictedPair
    {
        public ulong First, Second;
        public uint Level;
        public double Since, LikelyTime, ClosestTime, ClosestDistance;
    }

    public enum MonitorEventKind
    {
        None, Verdict, Predicted, PredictionEnded, Contradiction, Resolved, Stale, Resumed, Dropped, Reclassified
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct MonitorEvent
    {
        uint structSize;
        public MonitorEventKind Kind;
        public double Time;
        public ulong First, Second;
        public uint Level;
        public Verdict Verdict, Before;
        uint reserved;
        public double Since, LikelyTime, ClosestTime, ClosestDistance, PositionExcess, VelocityExcess;
        internal static MonitorEvent New
        {
            get { return new MonitorEvent { structSize = Native.SizeOf<MonitorEvent>(), reserved = 0 }; }
        }
    }
}
