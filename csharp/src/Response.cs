// What an event does to its bodies.
using System.Runtime.InteropServices;

namespace Kinesphere
{
    /// <summary>What a response does to a body, after the body has got its velocity; Sleep gives it velocity 0.</summary>
    public enum BodyAction { None, Remove, Disable, Sleep }

    /// <summary>
    /// What an event does to its bodies, for World.Run. It has no effect on a body that an earlier response at the same time
    /// has removed, and none but Remove on one that it has disabled.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Response
    {
        uint structSize;
        int stop, turnsFirst, turnsSecond, spinsFirst, spinsSecond;
        public BodyAction FirstAction, SecondAction;
        Vector first, second, firstSpin, secondSpin;
        internal Response Sized()
        {
            structSize = Native.SizeOf<Response>();
            return this;
        }
        /// <summary>The sink may change the world when it receives this event: add and remove bodies, teleport them.</summary>
        public bool Stop
        {
            get { return stop != 0; }
            set { stop = value ? 1 : 0; }
        }
        /// <summary>The velocity from now on; null: the body continues as before.</summary>
        public Vector? First
        {
            get { return turnsFirst != 0 ? first : (Vector?)null; }
            set { turnsFirst = value.HasValue ? 1 : 0; first = value.GetValueOrDefault(); }
        }
        public Vector? Second
        {
            get { return turnsSecond != 0 ? second : (Vector?)null; }
            set { turnsSecond = value.HasValue ? 1 : 0; second = value.GetValueOrDefault(); }
        }
        /// <summary>Of rigid bodies (radians / time); null: the body turns as before.</summary>
        public Vector? FirstAngularVelocity
        {
            get { return spinsFirst != 0 ? firstSpin : (Vector?)null; }
            set { spinsFirst = value.HasValue ? 1 : 0; firstSpin = value.GetValueOrDefault(); }
        }
        public Vector? SecondAngularVelocity
        {
            get { return spinsSecond != 0 ? secondSpin : (Vector?)null; }
            set { spinsSecond = value.HasValue ? 1 : 0; secondSpin = value.GetValueOrDefault(); }
        }
    }
}
