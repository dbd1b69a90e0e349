// What a world is made with.
using System.Runtime.InteropServices;

namespace Kinesphere
{
    public enum Contacts { OfWorld, Impacts, BeginAndEnd, All }

    /// <summary>Begin with Default: a definition that `new` made has no defaults, and is refused.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct WorldDefinition
    {
        uint structSize;
        public int Dimensions;
        int hasBox;
        public Axes Periodic;
        Vector lower, upper;
        public double ContactTolerance, SeparationDistance, ZenoInterval, StartTime;
        public Contacts Contacts;
        int allowOverlap, spreadWindowStarts, hasWallFilter;
        Filter wallFilter;
        int adoptObservedLimits, reserved;
        public bool AllowOverlap { get { return allowOverlap != 0; } set { allowOverlap = value ? 1 : 0; } }
        /// <summary>For games: frames of equal length cost about the same, and more in total. Has no effect in periodic space.</summary>
        public bool SpreadWindowStarts { get { return spreadWindowStarts != 0; } set { spreadWindowStarts = value ? 1 : 0; } }
        /// <summary>A report that breaks the promise of its body raises the body's acceleration limit to what explains the report.</summary>
        public bool AdoptObservedLimits { get { return adoptObservedLimits != 0; } set { adoptObservedLimits = value ? 1 : 0; } }
        /// <summary>Gives the world walls, or on periodic axes a period, at the sides of a box.</summary>
        public void SetBox(Vector from, Vector to) { hasBox = 1; lower = from; upper = to; }
        /// <summary>Gives all walls a filter; without one they meet every body.</summary>
        public void SetWallFilter(Filter filter) { hasWallFilter = 1; wallFilter = filter; }
        internal void Require(string name) { Native.RequireDefault(structSize, "WorldDefinition", name); }
        public static WorldDefinition Default
        {
            get
            {
                WorldDefinition made;
                Native.Check(Native.ks_world_definition_init(out made, Native.SizeOf<WorldDefinition>()));
                return made;
            }
        }
    }
}
