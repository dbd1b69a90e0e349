// What a world is made with.

namespace Kinesphere
{
    public partial struct WorldDefinition
    {
        /// <summary>Gives the world walls, or on periodic axes a period, at the sides of a box.</summary>
        public void SetBox(Vector from, Vector to) { hasBox = 1; box = new Native.Box { Lower = from, Upper = to }; }
        /// <summary>Gives all walls a filter; without one they meet every body.</summary>
        public void SetWallFilter(Filter filter) { hasWallFilter = 1; wallFilter = filter; }
    }
}
