// What a monitor is made with.
using System;
using System.Runtime.InteropServices;

namespace Kinesphere
{
    public sealed unsafe partial class MonitorDefinition
    {
        public TrackClass[] Classes = new TrackClass[0];
        public SeparationRule[] Separations = new SeparationRule[0];

        internal ulong Create()
        {
            var definition = Raw();
            Arrays.Count(Classes, "Classes");
            Arrays.Count(Separations, "Separations");
            var rules = new Native.SeparationRule[Separations.Length];
            var pinned = new GCHandle[Separations.Length];
            try
            {
                for (int k = 0; k < rules.Length; ++k)
                {
                    if (Separations[k] == null) throw new ArgumentNullException("Separations");
                    rules[k].LevelCount = Arrays.Count(Separations[k].Levels, "Levels");
                    pinned[k] = GCHandle.Alloc(Separations[k].Levels, GCHandleType.Pinned);
                    rules[k].FirstClass = (UIntPtr)Separations[k].FirstClass;
                    rules[k].SecondClass = (UIntPtr)Separations[k].SecondClass;
                    rules[k].Levels = (Separation*)pinned[k].AddrOfPinnedObject();
                }
                ulong monitor;
                fixed (TrackClass* classes = Classes)
                fixed (Native.SeparationRule* separations = rules)
                {
                    definition.Classes = classes;
                    definition.ClassCount = Arrays.Count(Classes, "Classes");
                    definition.Separations = separations;
                    definition.SeparationCount = Arrays.Count(rules, "Separations");
                    Native.Check(Native.ks_monitor_create(ref definition, out monitor));
                }
                return monitor;
            }
            finally
            {
                foreach (var one in pinned)
                    if (one.IsAllocated) one.Free();
            }
        }
    }

    public partial struct Separation
    {
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
