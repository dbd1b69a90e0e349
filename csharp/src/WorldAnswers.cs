// Certified answers at the current time: from what the world knows, or better with a probe.
using System;

namespace Kinesphere
{
    public unsafe partial class World
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

        /// <summary>Cast(), for many rays: the hits of each. One call of the probe serves all that are open.</summary>
        /// <param name="except">For each ray the body that it passes through, such as the one that casts it; null: none.</param>
        /// <param name="filter">Only bodies that a body with this filter may touch; null: all.</param>
        public Hit[][] CastAll(Ray[] rays, BodyId[] except = null, Filter? filter = null, Probe probe = null)
        {
            return HitsOfAll(rays, "rays", except, filter, probe, (Native.Probe callback, UIntPtr queries, ref Filter chosen,
                UIntPtr[] ends, Hit[] hits, UIntPtr capacity, out UIntPtr count) => Native.ks_world_cast_all(
                    handle, rays, except, queries, ref chosen, callback, IntPtr.Zero, ends, hits, capacity, out count));
        }

        /// <summary>Overlapping(), for many spheres; the other arguments are those of CastAll().</summary>
        public Hit[][] OverlappingAll(Sphere[] spheres, BodyId[] except = null, Filter? filter = null, Probe probe = null)
        {
            return HitsOfAll(spheres, "spheres", except, filter, probe, (Native.Probe callback, UIntPtr queries,
                ref Filter chosen, UIntPtr[] ends, Hit[] hits, UIntPtr capacity, out UIntPtr count) =>
                    Native.ks_world_overlapping_all(
                        handle, spheres, except, queries, ref chosen, callback, IntPtr.Zero, ends, hits, capacity, out count));
        }

        /// <summary>Nearest(), for many points; the other arguments are those of CastAll().</summary>
        public Hit[][] NearestAll(Vector[] points, int bodies, BodyId[] except = null, Filter? filter = null,
            Probe probe = null)
        {
            var most = Arrays.NotNegative(bodies, "bodies");
            return HitsOfAll(points, "points", except, filter, probe, (Native.Probe callback, UIntPtr queries,
                ref Filter chosen, UIntPtr[] ends, Hit[] hits, UIntPtr capacity, out UIntPtr count) =>
                    Native.ks_world_nearest_all(
                        handle, points, except, queries, most, ref chosen, callback, IntPtr.Zero, ends, hits, capacity, out count));
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

        delegate int FindAll(Native.Probe probe, UIntPtr queries, ref Filter chosen, UIntPtr[] ends, Hit[] hits,
            UIntPtr capacity, out UIntPtr count);

        Hit[][] HitsOfAll(Array queries, string name, BodyId[] except, Filter? filter, Probe probe, FindAll find)
        {
            UIntPtr count = Arrays.Count(queries, name);
            if (except != null && except.Length != queries.Length)
                throw new ArgumentException("There must be an id for each query.", "except");
            var ends = new UIntPtr[queries.Length];
            Filter given = filter.GetValueOrDefault();
            Filter* chosen = filter.HasValue ? &given : null;
            Hit[] found = Hits(probe, (Native.Probe callback, Hit[] hits, UIntPtr capacity, out UIntPtr written) =>
                find(callback, count, ref *chosen, ends, hits, capacity, out written));
            var each = new Hit[queries.Length][];
            for (int k = 0, begin = 0; k < each.Length; begin = (int)ends[k++])
            {
                each[k] = new Hit[(int)ends[k] - begin];
                Array.Copy(found, begin, each[k], 0, each[k].Length);
            }
            return each;
        }
    }
}
