// Vectors, states, rotations and shapes.
using System;
using System.Runtime.InteropServices;

namespace Kinesphere
{
    [StructLayout(LayoutKind.Sequential)]
    public struct Vector
    {
        public double X, Y, Z;
        public Vector(double x, double y, double z) { X = x; Y = y; Z = z; }
        public static Vector operator +(Vector a, Vector b) { return new Vector(a.X + b.X, a.Y + b.Y, a.Z + b.Z); }
        public static Vector operator -(Vector a, Vector b) { return new Vector(a.X - b.X, a.Y - b.Y, a.Z - b.Z); }
        public static Vector operator *(Vector a, double by) { return new Vector(a.X * by, a.Y * by, a.Z * by); }
        public override string ToString() { return FormattableString.Invariant($"({X}, {Y}, {Z})"); }
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct State
    {
        public Vector Position, Velocity;
        public State(Vector position, Vector velocity) { Position = position; Velocity = velocity; }
        public override string ToString() { return Position + " at velocity " + Velocity; }
    }

    /// <summary>A rotation as a unit quaternion W + X i + Y j + Z k.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Quaternion
    {
        public double W, X, Y, Z;
        public Quaternion(double w, double x, double y, double z) { W = w; X = x; Y = y; Z = z; }
    }

    /// <summary>Orientation and angular velocity (radians / time, in the world's axes) of a rigid body.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Rotation
    {
        public Quaternion Orientation;
        public Vector AngularVelocity;
        public Rotation(Quaternion orientation, Vector angularVelocity)
        {
            Orientation = orientation;
            AngularVelocity = angularVelocity;
        }
    }

    public partial struct Shape
    {
        public static Shape Ball(Vector centre, double radius) { return new Shape { points0 = centre, number = radius }; }
        public static Shape HalfSpace(Vector normal, double offset)
        {
            return new Shape { kind = Native.ShapeKind.HalfSpace, points0 = normal, number = offset };
        }
        public static Shape Box(Vector lower, Vector upper)
        {
            return new Shape { kind = Native.ShapeKind.Box, points0 = lower, points1 = upper };
        }
        public static Shape Triangle(Vector a, Vector b, Vector c)
        {
            return new Shape { kind = Native.ShapeKind.Triangle, points0 = a, points1 = b, points2 = c };
        }
        internal static Shape Mesh(ulong handle)
        {
            return new Shape { kind = Native.ShapeKind.Mesh, number = BitConverter.Int64BitsToDouble((long)handle) };
        }
    }

    /// <summary>
    /// A surface of triangles that is one shape: terrain, a level. What slides over its edges meets one surface, and
    /// events name the triangle (FirstPart, SecondPart). Bodies that have it keep it when it is disposed.
    /// </summary>
    public sealed class Mesh : IDisposable
    {
        readonly ulong handle;
        bool disposed;

        /// <summary>One triangle for each three numbers of vertices in `corners`.</summary>
        public Mesh(Vector[] vertices, uint[] corners)
        {
            var count = (ulong)Arrays.Count(corners, "corners");
            if (count % 3 != 0) throw new ArgumentException("must have three numbers for each triangle", "corners");
            Native.Check(Native.ks_mesh_create(vertices, Arrays.Count(vertices, "vertices"), corners, (UIntPtr)(count / 3),
                                               out handle));
        }
        Mesh(ulong made) { handle = made; }
        /// <summary>A chain of segments from each point to the next, for worlds of two dimensions.</summary>
        public static Mesh Chain(Vector[] points)
        {
            ulong made;
            Native.Check(Native.ks_mesh_create_chain(points, Arrays.Count(points, "points"), out made));
            return new Mesh(made);
        }
        ~Mesh() { Native.ks_mesh_destroy(handle); }
        public void Dispose()
        {
            if (disposed) return;
            Native.Check(Native.ks_mesh_destroy(handle));
            disposed = true;
            GC.SuppressFinalize(this);
        }
        /// <summary>The shape, for as many bodies as you like. Calls refuse it once the mesh is disposed.</summary>
        public Shape Shape { get { return Kinesphere.Shape.Mesh(handle); } }
    }
}
