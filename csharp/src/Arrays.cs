// Arrays that the library reads and fills.
using System;

namespace Kinesphere
{
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
