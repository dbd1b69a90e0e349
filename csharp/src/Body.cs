// Bodies: their ids, definitions, filters, and what a world knows of them.
using System;
using System.Runtime.InteropServices;

namespace Kinesphere
{
    /// <summary>Names a body until it is removed; a later body never has an equal id.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct BodyId : IEquatable<BodyId>
    {
        readonly uint index, generation, world;
        /// <summary>A small number, which no other body has meanwhile: for tables.</summary>
        public int Index { get { return (int)index; } }
        public bool IsNone { get { return index == uint.MaxValue && generation == 0; } }
        public bool Equals(BodyId other) { return index == other.index && generation == other.generation; }
        public override bool Equals(object other) { return other is BodyId && Equals((BodyId)other); }
        public override int GetHashCode() { return (int)(index * 31 + generation); }
        public override string ToString() { return IsNone ? "no body" : "body " + index; }
    }

    public partial struct Filter
    {
        public Filter(ulong category, ulong mask = ulong.MaxValue, int group = 0)
        {
            Category = category;
            Mask = mask;
            Group = group;
        }
        /// <summary>Lets a body touch all others.</summary>
        public static Filter Default { get { return new Filter(1); } }
    }

    public partial struct BodyView
    {
        /// <summary>Corners of a box that contains the body from now until BoxEnd.</summary>
        public Vector Lower { get { return box.Lower; } }
        public Vector Upper { get { return box.Upper; } }
        /// <summary>Boxes that it has travelled along periodic axes.</summary>
        public long ImageX { get { return image0; } }
        public long ImageY { get { return image1; } }
        public long ImageZ { get { return image2; } }
    }
}
