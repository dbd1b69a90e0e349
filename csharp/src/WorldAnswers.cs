// Certified answers at the current time: from what the world knows, or better with a probe.
using System;

namespace Kinesphere
{
    public sealed unsafe partial class World
    {
        /// <summary>No contact of the whole world begins before this time; it names no partner.</summary>
        public Prediction SafeUntil(Probe probe = null)
        {
            return Predicted(probe, (Native.Probe callback, out Prediction prediction) =>
                Native.ks_world_safe_until(handle, callback, IntPtr.Zero, out prediction));
        }

        public Prediction EarliestContact(BodyId body, Probe probe = null)
        {
            return Predicted(probe, (Native.Probe callback, out Prediction prediction) =>
                Native.ks_world_earliest_contact(handle, body, callback, IntPtr.Zero, out prediction));
        }

        /// <summary>The first time at which anything may be within a distance (length, >= 0) of a body.</summary>
        public Prediction EarliestApproach(BodyId body, double distance, Probe probe = null)
        {
            return Predicted(probe, (Native.Probe callback, out Prediction prediction) =>
                Native.ks_world_earliest_approach(handle, body, distance, callback, IntPtr.Zero, out prediction));
        }

        /// <summary>The first time at which two bodies may be within a distance (length, >= 0) of each other.</summary>
        public Prediction PairSafeUntil(BodyId first, BodyId second, double distance = 0, Probe probe = null)
        {
            return Predicted(probe, (Native.Probe callback, out Prediction prediction) =>
                Native.ks_world_pair_safe_until(handle, first, second, distance, callback, IntPtr.Zero, out prediction));
        }

        /// <summary>Limits of the distance between two bodies at a time from now on.</summary>
        public void DistanceLimits(BodyId first, BodyId second, double time, out double lower, out double upper,
            Probe probe = null)
        {
            double least = 0, most = 0;
            Ask(probe, callback => Native.ks_world_distance_limits(
                handle, first, second, time, callback, IntPtr.Zero, out least, out most));
            lower = least;
            upper = most;
        }

        /// <summary>All that a ray, or with a radius > 0 a moving sphere, may hit first.</summary>
        public Hit[] Cast(Vector origin, Vector direction, double length, double radius = 0, Probe probe = null)
        {
            return Hits(probe, (Native.Probe callback, Hit[] hits, UIntPtr capacity, out UIntPtr count) => Native.ks_world_cast(
                handle, origin, direction, length, radius, callback, IntPtr.Zero, hits, capacity, out count));
        }

        /// <summary>The bodies that may overlap a sphere.</summary>
        public Hit[] Overlapping(Vector centre, double radius, Probe probe = null)
        {
            return Hits(probe, (Native.Probe callback, Hit[] hits, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_overlapping_sphere(handle, centre, radius, callback, IntPtr.Zero, hits, capacity, out count));
        }

        /// <summary>The bodies that may overlap a box.</summary>
        public Hit[] OverlappingBox(Vector lower, Vector upper, Probe probe = null)
        {
            var box = new Native.Box { Lower = lower, Upper = upper };
            return Hits(probe, (Native.Probe callback, Hit[] hits, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_overlapping_box(handle, ref box, callback, IntPtr.Zero, hits, capacity, out count));
        }

        /// <summary>All that may be among the `bodies` nearest to a point.</summary>
        public Hit[] Nearest(Vector point, int bodies, Probe probe = null)
        {
            var most = Arrays.NotNegative(bodies, "bodies");
            return Hits(probe, (Native.Probe callback, Hit[] hits, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_world_nearest(handle, point, most, callback, IntPtr.Zero, hits, capacity, out count));
        }

        delegate int Predict(Native.Probe probe, out Prediction prediction);

        Prediction Predicted(Probe probe, Predict predict)
        {
            var prediction = new Prediction();
            Ask(probe, callback => predict(callback, out prediction));
            return prediction;
        }

        delegate int Find(Native.Probe probe, Hit[] hits, UIntPtr capacity, out UIntPtr count);

        Hit[] Hits(Probe probe, Find find)
        {
            Hit[] found = null;
            Ask(probe, callback => Arrays.FillAll((Hit[] hits, UIntPtr capacity, out UIntPtr count) =>
                find(callback, hits, capacity, out count), out found));
            return found;
        }
    }
}
