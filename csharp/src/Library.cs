// The library that has been loaded, and its exception.
using System;
using System.Runtime.InteropServices;

namespace Kinesphere
{
    /// <summary>The library that has been loaded.</summary>
    public static class Library
    {
        /// <summary>Such as "0.3.0".</summary>
        public static string Version { get { return Marshal.PtrToStringAnsi(Native.ks_version()); } }
    }

    /// <summary>A call was refused; nothing has changed.</summary>
    public sealed class KinesphereException : Exception
    {
        /// <summary>The name of the status, such as "stale_body".</summary>
        public string Status { get; private set; }
        public string Argument { get; private set; }
        public BodyId Body { get; private set; }
        internal KinesphereException(string status, string argument, BodyId body, string message) : base(message)
        {
            Status = status;
            Argument = argument;
            Body = body;
        }
    }
}
