// Adding and removing bodies.
using System;
using System.Runtime.InteropServices;

namespace Kinesphere
{
    public unsafe partial class World
    {
        public BodyId Add(BodyDefinition body) { return AddAll(new[] { body })[0]; }

        /// <summary>Adds all bodies or, on an error, none.</summary>
        public BodyId[] AddAll(BodyDefinition[] bodies)
        {
            var count = Arrays.Count(bodies, "bodies");
            foreach (var body in bodies) body.Require("bodies");
            var ids = new BodyId[bodies.Length];
            Check(Native.ks_world_add(handle, bodies, count, ids));
            return ids;
        }

        public BodyId AddStatic(StaticDefinition body) { return AddStaticAll(new[] { body })[0]; }

        /// <summary>Adds all bodies or, on an error, none.</summary>
        public BodyId[] AddStaticAll(StaticDefinition[] bodies)
        {
            var count = Arrays.Count(bodies, "bodies");
            foreach (var body in bodies) body.Require("bodies");
            var ids = new BodyId[bodies.Length];
            Check(Native.ks_world_add_static(handle, bodies, count, ids));
            return ids;
        }

        /// <summary>Adds a surface of triangles as one body that never moves: AddStatic of the shape of a Mesh.</summary>
        public BodyId AddMesh(Vector[] vertices, uint[] corners)
        {
            using (var mesh = new Mesh(vertices, corners))
            {
                var body = StaticDefinition.Default;
                body.Shape = mesh.Shape;
                return AddStatic(body);
            }
        }

        /// <summary>
        /// Adds a body that carries a box, a triangle or a mesh, relative to its position; the radius is ignored. The probe
        /// moves it. It meets all bodies, static ones and other moving shapes too, but no walls of the world.
        /// </summary>
        public BodyId AddMovingShape(BodyDefinition body, Shape shape)
        {
            BodyId id;
            body.Require("body");
            Check(Native.ks_world_add_moving_shape(handle, ref body, ref shape, out id));
            return id;
        }

        /// <summary>
        /// Adds a rigid body: balls and capsules that move and turn together; the radius is ignored. The probe moves it.
        /// </summary>
        public BodyId AddRigidBody(BodyDefinition body, RigidDefinition rigid, params RigidPart[] parts)
        {
            return AddRigidBody(body, rigid, parts, new RigidHull[0]);
        }

        /// <summary>The same with convex hulls, whose numbers as parts follow those of the others.</summary>
        public BodyId AddRigidBody(BodyDefinition body, RigidDefinition rigid, RigidPart[] parts, RigidHull[] hulls)
        {
            BodyId id;
            body.Require("body");
            rigid.Require("rigid");
            Arrays.Count(parts, "parts");
            Arrays.Count(hulls, "hulls");
            foreach (var hull in hulls)
                if (hull == null || hull.Points == null) throw new ArgumentNullException("hulls");
            var found = new Native.Hull[hulls.Length];
            var pinned = new GCHandle[hulls.Length];
            try
            {
                for (int k = 0; k < found.Length; ++k)
                {
                    pinned[k] = GCHandle.Alloc(hulls[k].Points, GCHandleType.Pinned);
                    found[k].PointCount = Arrays.Count(hulls[k].Points, "hulls");
                    found[k].Points = (Vector*)pinned[k].AddrOfPinnedObject();
                    found[k].Radius = hulls[k].Radius;
                }
                fixed (RigidPart* first = parts)
                fixed (Native.Hull* firstHull = found)
                {
                    rigid.SetParts(first, parts.Length);
                    rigid.SetHulls(firstHull, found.Length);
                    Check(Native.ks_world_add_rigid_body(handle, ref body, ref rigid, out id));
                }
            }
            finally
            {
                foreach (var one in pinned)
                    if (one.IsAllocated) one.Free();
            }
            return id;
        }

        /// <summary>Adds a zone, which reports who enters and leaves it: all bodies, or those that the filter selects.</summary>
        public BodyId AddZone(Shape shape, ulong userData = 0, Filter? filter = null)
        {
            BodyId id;
            Check(Native.ks_world_add_zone(handle, ref shape, userData, out id));
            if (filter.HasValue) SetFilter(id, filter.Value);
            return id;
        }

        /// <summary>Makes room for this number of bodies in total.</summary>
        public void Reserve(int bodies) { Check(Native.ks_world_reserve(handle, Arrays.NotNegative(bodies, "bodies"))); }

        public void Remove(BodyId body) { RemoveAll(new[] { body }); }

        /// <summary>Removes all bodies or, on an error, none.</summary>
        public void RemoveAll(BodyId[] bodies) { Check(Native.ks_world_remove(handle, bodies, Arrays.Count(bodies, "bodies"))); }
    }
}
