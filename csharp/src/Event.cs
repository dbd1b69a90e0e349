// What happens to bodies.
using System;

namespace Kinesphere
{
    public partial struct Event
    {
        public override string ToString()
        {
            var partner = Wall != Wall.None ? ", wall " + Wall : Second.IsNone ? "" : ", " + Second;
            return FormattableString.Invariant($"{Time} {Kind}") + (Kind == EventKind.None ? "" : " " + First + partner);
        }
        /// <summary>Velocities after a frictionless bounce; events other than begins of contacts turn nobody.</summary>
        public Response Bounce(double restitution, double restingSpeed = 0)
        {
            var response = new Response().Sized();
            Native.Check(Native.ks_bounce(ref this, restitution, restingSpeed, ref response));
            return response;
        }
        /// <summary>Velocities after a bounce of rough balls that turn: rigid bodies of one part, a ball around the
        /// position.</summary>
        public Response Bounce(Roughness rough)
        {
            rough.Require("rough");
            var response = new Response().Sized();
            Native.Check(Native.ks_bounce_rough(ref this, ref rough, ref response));
            return response;
        }
    }

    public partial struct EventHash
    {
        public void Add(Event happened) { Native.Check(Native.ks_event_hash_add(ref this, ref happened)); }
        public ulong Value
        {
            get
            {
                ulong value;
                Native.Check(Native.ks_event_hash_value(ref this, out value));
                return value;
            }
        }
    }
}
