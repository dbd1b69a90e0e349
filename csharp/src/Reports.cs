// Reports of tracks, and with what errors and limits.
using System.Runtime.InteropServices;

namespace Kinesphere
{
    public partial struct ErrorBound
    {
        public double Horizontal { get { return horizontal; } }
        public double Vertical { get { return vertical; } }
        public static ErrorBound Ball(double radius) { return new ErrorBound { horizontal = radius, vertical = radius }; }
        public static ErrorBound Cylinder(double horizontal, double vertical)
        {
            return new ErrorBound { kind = Native.BoundKind.Cylinder, horizontal = horizontal, vertical = vertical };
        }
    }

    public partial struct TrackReport
    {
        public void SetPlan(Vector acceleration, ErrorBound limit, double validUntil)
        {
            hasPlan = 1;
            planAcceleration = acceleration;
            planLimit = limit;
            planValidUntil = validUntil;
        }
    }
}
