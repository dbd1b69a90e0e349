// Separations of tracks.

namespace Kinesphere
{
    public partial struct Separation
    {
        public static Separation Sphere(double distance)
        {
            return new Separation { Horizontal = distance, Vertical = distance };
        }
    }

    /// <summary>The separation levels between two classes of tracks, the widest first.</summary>
    public sealed class SeparationRule
    {
        public int FirstClass, SecondClass;
        public Separation[] Levels = new Separation[0];
    }
}
