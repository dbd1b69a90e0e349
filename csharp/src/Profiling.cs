// Why bodies are probed.
using System.Runtime.InteropServices;

namespace Kinesphere
{
    public partial struct BusyBody
    {
        /// <summary>What the reason means, and what makes such a body cheaper.</summary>
        public string Advice { get { return Marshal.PtrToStringAnsi(Native.ks_probe_reason_advice(Reason)); } }
    }
}
