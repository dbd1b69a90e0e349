// What happens to bodies.
using System;
using System.Runtime.InteropServices;

namespace Kinesphere
{
    public enum EventKind
    {
        None, BoundViolation, ContactBegin, ContactEnd, WallBegin, WallEnd, ZenoGuard, SensorEnter, SensorLeave, Woke
    }

    public enum Wall { None, XLower, XUpper, YLower, YUpper, ZLower, ZUpper }
    [Flags] public enum Senses : uint { Neither = 0, First = 1, Second = 2 }
    [Flags] public enum Traits : uint { None = 0, Static = 1, Zone = 2, Sleeping = 4 }

    [StructLayout(LayoutKind.Sequential)]
    public struct Event
    {
        uint structSize;
        public EventKind Kind;
        public double Time;
        public BodyId First, Second;
        public Wall Wall;
        int repeated, jammed, alreadyTouching;
        public Senses Senses;
        public Traits FirstTraits, SecondTraits;
        uint reserved;
        public State FirstState, SecondState;
        public Vector Point, Normal;
        public double Gap, ApproachSpeed, PositionExcess, VelocityExcess, Distance;
        public ulong FirstUserData, SecondUserData;
        public double FirstMass, SecondMass;
        /// <summary>Of rigid bodies: the parts at the contact, and what an impulse along the normal does to them. Of a
        /// mesh: the triangle.</summary>
        public uint FirstPart, SecondPart;
        public Vector FirstAngularVelocity, SecondAngularVelocity, FirstSpinGain, SecondSpinGain;
        /// <summary>Of a bound violation: the acceleration limit that the body has from now on (length / time^2).</summary>
        public double AccelerationLimit;
        public bool Repeated { get { return repeated != 0; } }
        public bool Jammed { get { return jammed != 0; } }
        public bool AlreadyTouching { get { return alreadyTouching != 0; } }
        public override string ToString()
        {
            var partner = Wall != Wall.None ? ", wall " + Wall : Second.IsNone ? "" : ", " + Second;
            return FormattableString.Invariant($"{Time} {Kind}") + (Kind == EventKind.None ? "" : " " + First + partner);
        }
        internal static Event New { get { return new Event { structSize = Native.SizeOf<Event>(), reserved = 0 }; } }

        /// <summary>Velocities after a frictionless bounce; events other than begins of contacts turn nobody.</summary>
        public Response Bounce(double restitution, double restingSpeed = 0)
        {
            var response = new Response().Sized();
            Native.Check(Native.ks_bounce(ref this, restitution, restingSpeed, ref response));
            return response;
        }
    }

    /// <summary>One number for all events of a run: equal numbers mean bit-identical runs.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct EventHash
    {
        ulong sum, count;
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
