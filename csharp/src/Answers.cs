// Certified answers about the future and about space.
using System.Runtime.InteropServices;

namespace Kinesphere
{
    [StructLayout(LayoutKind.Sequential)]
    public struct Prediction
    {
        public double Time;
        public BodyId Partner;
        public Wall Wall;
        int happens, probed;
        public bool Happens { get { return happens != 0; } }
        public bool Probed { get { return probed != 0; } }
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct Hit
    {
        public BodyId Body;
        int certain;
        public double Lower, Upper;
        public bool Certain { get { return certain != 0; } }
    }
}
