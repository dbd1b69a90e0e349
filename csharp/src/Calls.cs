// What calls of C have in common.
using System;
using System.Runtime.InteropServices;

namespace Kinesphere
{
    static partial class Native
    {
        const string library = "kinesphere-c";

        public const int BufferTooSmall = 6;
        public const int CallbackFailed = 7;

        public static uint SizeOf<T>() { return (uint)Marshal.SizeOf(typeof(T)); }

        /// <summary>Throws unless a definition was made by its property Default, which sets its size.</summary>
        public static void RequireDefault(uint size, string type, string argument)
        {
            if (size != 0) return;
            throw new ArgumentException(
                "begin with " + type + ".Default and change its fields: `new " + type + "()` has no defaults", argument);
        }

        /// <summary>Throws what the last call of this thread has to say, unless it succeeded.</summary>
        public static void Check(int status)
        {
            if (status == 0) return;
            throw new KinesphereException(Marshal.PtrToStringAnsi(ks_status_name(status)),
                Marshal.PtrToStringAnsi(ks_last_error_argument()), ks_last_error_body(),
                Marshal.PtrToStringAnsi(ks_last_error_message()));
        }
    }
}
