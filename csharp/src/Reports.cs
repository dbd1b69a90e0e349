// Reports of tracks, and with what errors and limits.
using System.Runtime.InteropServices;

namespace Kinesphere
{
    [StructLayout(LayoutKind.Sequential)]
    public struct ErrorBound
    {
        int kind;
        double horizontal, vertical;
        public double Horizontal { get { return horizontal; } }
        public double Vertical { get { return vertical; } }
        public static ErrorBound Ball(double radius) { return new ErrorBound { horizontal = radius, vertical = radius }; }
        public static ErrorBound Cylinder(double horizontal, double vertical)
        {
            return new ErrorBound { kind = 1, horizontal = horizontal, vertical = vertical };
        }
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct TrackClass
    {
        public ErrorBound AccelerationLimit, LargestSpeed;
        public Vector PlannedAcceleration;
    }

    /// <summary>A reported state of a track. Begin with Default.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct TrackReport
    {
        uint structSize;
        int hasPlan;
        public ulong TrackClass;
        public double Timestamp, TimestampError;
        public State State;
        public ErrorBound PositionError, VelocityError;
        Vector planAcceleration;
        ErrorBound planLimit;
        double planValidUntil;
        public void SetPlan(Vector acceleration, ErrorBound limit, double validUntil)
        {
            hasPlan = 1;
            planAcceleration = acceleration;
            planLimit = limit;
            planValidUntil = validUntil;
        }
        internal void Require(string name) { Native.RequireDefault(structSize, "TrackReport", name); }
        public static TrackReport Default
        {
            get
            {
                TrackReport made;
                Native.Check(Native.ks_track_report_init(out made, Native.SizeOf<TrackReport>()));
                return made;
            }
        }
    }

    /// <summary>A report of `Track` is needed by the time `By` for its verdict with `Other` to stay certain.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct ReportRequest
    {
        public ulong Track, Other;
        public double By;
    }

    /// <summary>Where a track is now: within `Radius` of `Centre`.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct TrackPlace
    {
        public Vector Centre, Velocity;
        public ErrorBound Radius;
    }
}
