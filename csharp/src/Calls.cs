// What calls of C have in common, and arrays that the library reads and fills.
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

    static class Arrays
    {
        public static UIntPtr NotNegative(int number, string name)
        {
            if (number < 0) throw new ArgumentOutOfRangeException(name, number, "must be >= 0");
            return (UIntPtr)number;
        }

        /// <summary>The number of elements. Throws if there is no array.</summary>
        public static UIntPtr Count(Array array, string name)
        {
            if (array == null) throw new ArgumentNullException(name);
            return (UIntPtr)array.Length;
        }

        public delegate int Fill<T>(T[] elements, UIntPtr capacity, out UIntPtr count);

        /// <summary>Calls a function that writes all elements if they fit, until they do; returns its status.</summary>
        public static int FillAll<T>(Fill<T> fill, out T[] elements)
        {
            elements = new T[16];
            for (;;)
            {
                UIntPtr count;
                int status = fill(elements, (UIntPtr)elements.Length, out count);
                if (status != 0 && status != Native.BufferTooSmall) return status;
                Array.Resize(ref elements, (int)count);
                if (status == 0) return 0;
            }
        }

        public static T[] Filled<T>(Fill<T> fill)
        {
            T[] elements;
            Native.Check(FillAll(fill, out elements));
            return elements;
        }
    }
}
