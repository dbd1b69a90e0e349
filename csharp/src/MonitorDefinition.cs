// What a monitor is made with.
using System;
using System.Runtime.InteropServices;

namespace Kinesphere
{
    public sealed unsafe class MonitorDefinition
    {
        public int Dimensions;
        public double? StartTime;
        public TrackClass[] Classes = new TrackClass[0];
        public SeparationRule[] Separations = new SeparationRule[0];
        public double Tolerance, TimeResolution, Window, StaleAfter, DropAfter;
        public double PredictionHold, PredictionConfirmation, PredictionMargin, PredictionErrorPart;
        /// <summary>The monitor watches this many shards of all pairs, from the first one.</summary>
        public ulong ShardOf = 1, ShardFirst, ShardCount = 1;

        public MonitorDefinition()
        {
            var defaults = Defaults();
            Dimensions = defaults.Dimensions;
            Tolerance = defaults.Tolerance;
            TimeResolution = defaults.TimeResolution;
            Window = defaults.Window;
            StaleAfter = defaults.StaleAfter;
            DropAfter = defaults.DropAfter;
            PredictionHold = defaults.PredictionHold;
            PredictionConfirmation = defaults.PredictionConfirmation;
            PredictionMargin = defaults.PredictionMargin;
            PredictionErrorPart = defaults.PredictionErrorPart;
        }

        static Native.MonitorDefinition Defaults()
        {
            Native.MonitorDefinition defaults;
            Native.Check(Native.ks_monitor_definition_init(out defaults, Native.SizeOf<Native.MonitorDefinition>()));
            return defaults;
        }

        internal ulong Create()
        {
            var definition = Defaults();
            definition.Dimensions = Dimensions;
            definition.HasStartTime = StartTime.HasValue ? 1 : 0;
            definition.StartTime = StartTime.GetValueOrDefault();
            definition.Tolerance = Tolerance;
            definition.TimeResolution = TimeResolution;
            definition.Window = Window;
            definition.StaleAfter = StaleAfter;
            definition.DropAfter = DropAfter;
            definition.PredictionHold = PredictionHold;
            definition.PredictionConfirmation = PredictionConfirmation;
            definition.PredictionMargin = PredictionMargin;
            definition.PredictionErrorPart = PredictionErrorPart;
            definition.ShardOf = ShardOf;
            definition.ShardFirst = ShardFirst;
            definition.ShardCount = ShardCount;
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
