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
}
