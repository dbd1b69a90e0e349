// What an event does to its bodies.
namespace Kinesphere
{
    public partial struct Response
    {
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
            get { return turnsFirst != 0 ? firstVelocity : (Vector?)null; }
            set { turnsFirst = value.HasValue ? 1 : 0; firstVelocity = value.GetValueOrDefault(); }
        }
        public Vector? Second
        {
            get { return turnsSecond != 0 ? secondVelocity : (Vector?)null; }
            set { turnsSecond = value.HasValue ? 1 : 0; secondVelocity = value.GetValueOrDefault(); }
        }
        /// <summary>Of rigid bodies (radians / time); null: the body turns as before.</summary>
        public Vector? FirstAngularVelocity
        {
            get { return spinsFirst != 0 ? firstAngularVelocity : (Vector?)null; }
            set { spinsFirst = value.HasValue ? 1 : 0; firstAngularVelocity = value.GetValueOrDefault(); }
        }
        public Vector? SecondAngularVelocity
        {
            get { return spinsSecond != 0 ? secondAngularVelocity : (Vector?)null; }
            set { spinsSecond = value.HasValue ? 1 : 0; secondAngularVelocity = value.GetValueOrDefault(); }
        }
    }
}
