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

    /// <summary>Selects the bodies that a body may touch: the category of each must have a bit in the mask of the other,
    /// unless both are in one group, which decides by its sign. `new Filter()`, with the mask 0, lets it touch none.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Filter
    {
        public ulong Category, Mask;
        public int Group;
        public Filter(ulong category, ulong mask = ulong.MaxValue, int group = 0)
        {
            Category = category;
            Mask = mask;
            Group = group;
        }
        /// <summary>Lets a body touch all others.</summary>
        public static Filter Default { get { return new Filter(1); } }
    }

    /// <summary>Limits within which a body moves; fields as in BodyDefinition.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MotionLimits
    {
        public double AccelerationLimit, PositionError, VelocityError;
        public Vector PlannedAcceleration;
    }

    /// <summary>A sphere and the limits of its motion. Begin with Default.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct BodyDefinition
    {
        uint structSize;
        int solid;
        public Contacts Contacts;
        public int SensorClass;
        public double Radius, AccelerationLimit, PositionError, VelocityError, Mass;
        public Vector PlannedAcceleration, Position, Velocity;
        public Filter Filter;
        public ulong UserData;
        public bool Solid { get { return solid != 0; } set { solid = value ? 1 : 0; } }
        internal void Require(string name) { Native.RequireDefault(structSize, "BodyDefinition", name); }
        public static BodyDefinition Default
        {
            get
            {
                BodyDefinition made;
                Native.Check(Native.ks_body_definition_init(out made, Native.SizeOf<BodyDefinition>()));
                return made;
            }
        }
    }

    /// <summary>A body that never moves. Begin with Default.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct StaticDefinition
    {
        uint structSize;
        int solid;
        public int SensorClass;
        public Shape Shape;
        public Filter Filter;
        public ulong UserData;
        public bool Solid { get { return solid != 0; } set { solid = value ? 1 : 0; } }
        internal void Require(string name) { Native.RequireDefault(structSize, "StaticDefinition", name); }
        public static StaticDefinition Default
        {
            get
            {
                StaticDefinition made;
                Native.Check(Native.ks_static_definition_init(out made, Native.SizeOf<StaticDefinition>()));
                return made;
            }
        }
    }

    /// <summary>What a world knows of a body.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct BodyView
    {
        uint structSize;
        int enabled, isStatic, sleeping;
        public double ReportTime;
        /// <summary>Corners of a box that contains the body from now until BoxEnd.</summary>
        public Vector Lower, Upper;
        public double BoxEnd;
        /// <summary>Boxes that it has travelled along periodic axes.</summary>
        public long ImageX, ImageY, ImageZ;
        /// <summary>Its state is that of the last report.</summary>
        public BodyDefinition Definition;
        public bool Enabled { get { return enabled != 0; } }
        public bool IsStatic { get { return isStatic != 0; } }
        public bool Sleeping { get { return sleeping != 0; } }
        internal static BodyView New { get { return new BodyView { structSize = Native.SizeOf<BodyView>() }; } }
    }

    /// <summary>A body within a sensor distance (length) of another one.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct SensorOverlap
    {
        public BodyId Body;
        public double Distance;
    }
}
