// Bodies of several parts that move and turn together.
using System;
using System.Runtime.InteropServices;

namespace Kinesphere
{
    /// <summary>All points within a radius of the segment from A to B: a capsule, or a ball if A and B are equal.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct RigidPart
    {
        public Vector A, B;
        public double Radius;
        public RigidPart(Vector a, Vector b, double radius) { A = a; B = b; Radius = radius; }
    }

    /// <summary>All points within a radius of the convex hull of 1 to 64 points; three make a plate.</summary>
    public sealed class RigidHull
    {
        public readonly Vector[] Points;
        public readonly double Radius;
        public RigidHull(double radius, params Vector[] points)
        {
            Radius = radius;
            Points = points;
        }
        /// <summary>All points within a radius of a box.</summary>
        public static RigidHull Box(Vector lower, Vector upper, double radius)
        {
            var corners = new Vector[8];
            for (int k = 0; k < 8; ++k)
                corners[k] = new Vector((k & 1) == 0 ? lower.X : upper.X, (k & 2) == 0 ? lower.Y : upper.Y,
                    (k & 4) == 0 ? lower.Z : upper.Z);
            return new RigidHull(radius, corners);
        }
    }

    public unsafe partial struct RigidDefinition
    {
        internal void SetParts(RigidPart* first, int count) { parts = first; partCount = (UIntPtr)count; }
        internal void SetHulls(Native.Hull* first, int count) { hulls = first; hullCount = (UIntPtr)count; }
    }
}
