// What a world knows, and where its time goes.
using System;
using System.Runtime.InteropServices;

namespace Kinesphere
{
    public unsafe partial class World
    {
        /// <summary>The rotation of a rigid body at its last report.</summary>
        public Rotation RotationOf(BodyId body)
        {
            Rotation rotation;
            Check(Native.ks_world_rotation(handle, body, out rotation));
            return rotation;
        }

        public double Time
        {
            get
            {
                double time;
                Check(Native.ks_world_time(handle, out time));
                return time;
            }
        }

        public int Size
        {
            get
            {
                UIntPtr bodies;
                Check(Native.ks_world_size(handle, out bodies));
                return (int)bodies;
            }
        }

        public bool Contains(BodyId body)
        {
            int contains;
            Check(Native.ks_world_contains(handle, body, out contains));
            return contains != 0;
        }

        public BodyId[] Bodies()
        {
            return Arrays.Filled<BodyId>((BodyId[] bodies, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_bodies(handle, bodies, capacity, out count));
        }

        /// <summary>What the world knows of a body.</summary>
        public BodyView Body(BodyId body)
        {
            var view = BodyView.New;
            Check(Native.ks_world_body(handle, body, ref view));
            return view;
        }

        /// <summary>The bodies within sensor distances of a body, with these distances.</summary>
        public SensorOverlap[] SensorOverlaps(BodyId body)
        {
            return Arrays.Filled<SensorOverlap>((SensorOverlap[] overlaps, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_sensor_overlaps(handle, body, overlaps, capacity, out count));
        }

        /// <summary>The number of states that the world has asked for so far.</summary>
        public ulong ProbeCount
        {
            get
            {
                ulong probes;
                Check(Native.ks_world_probe_count(handle, out probes));
                return probes;
            }
        }

        /// <summary>The bodies in contact with a body.</summary>
        public BodyId[] Touching(BodyId body)
        {
            return Arrays.Filled<BodyId>((BodyId[] partners, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_touching(handle, body, partners, capacity, out count));
        }

        /// <summary>Switches profiling on, from zero, or off.</summary>
        public void SetProfiling(bool on) { Check(Native.ks_world_set_profiling(handle, on ? 1 : 0)); }

        public Timings Timings
        {
            get
            {
                Timings timings;
                Check(Native.ks_world_timings(handle, out timings));
                return timings;
            }
        }

        /// <summary>The bodies that were probed most often while profiling was on, the most probed first.</summary>
        public BusyBody[] Busiest(int most)
        {
            return Arrays.Filled<BusyBody>((BusyBody[] bodies, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_busiest(handle, Arrays.NotNegative(most, "most"), bodies, capacity, out count));
        }
    }

    public partial struct BusyBody
    {
        /// <summary>What the reason means, and what makes such a body cheaper.</summary>
        public string Advice { get { return Marshal.PtrToStringAnsi(Native.ks_probe_reason_advice(Reason)); } }
    }
}
