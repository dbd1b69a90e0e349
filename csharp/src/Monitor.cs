// Monitors. Methods have the meanings, errors and costs of those of the C++ headers.
using System;
using System.Collections.Generic;

namespace Kinesphere
{
    /// <summary>Tracks, their reports and the verdicts about their pairs.</summary>
    public sealed unsafe class Monitor : IDisposable
    {
        readonly ulong handle;
        bool disposed;

        public Monitor(MonitorDefinition definition)
        {
            if (definition == null) throw new ArgumentNullException("definition");
            handle = definition.Create();
        }
        Monitor(ulong handle) { this.handle = handle; }
        ~Monitor() { Native.ks_monitor_destroy(handle); }
        /// <summary>Destroys the monitor; each later call but Dispose throws.</summary>
        public void Dispose()
        {
            if (disposed) return;
            Native.Check(Native.ks_monitor_destroy(handle));
            disposed = true;
            GC.SuppressFinalize(this);
        }

        /// <summary>Returns a snapshot.</summary>
        public byte[] Save()
        {
            return Arrays.Filled<byte>((byte[] bytes, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_monitor_save(handle, bytes, capacity, out count));
        }
        public static Monitor Restore(byte[] snapshot)
        {
            ulong restored;
            Native.Check(Native.ks_monitor_restore(snapshot, Arrays.Count(snapshot, "snapshot"), out restored));
            return new Monitor(restored);
        }

        /// <summary>Accepts a report that arrives now. The first one of an id adds a track.</summary>
        public void Report(ulong track, TrackReport report) { ReportAll(new[] { track }, new[] { report }); }
        /// <summary>Accepts reports, each of the track of the same index, in this order; or, on an error, none.</summary>
        public void ReportAll(ulong[] tracks, TrackReport[] reports)
        {
            var count = Arrays.Count(tracks, "tracks");
            if (Arrays.Count(reports, "reports") != count)
                throw new ArgumentException("there must be one report for each track", "reports");
            foreach (var report in reports) report.Require("reports");
            Native.Check(Native.ks_monitor_report(handle, tracks, reports, count));
        }
        public void Remove(ulong track) { Native.Check(Native.ks_monitor_remove(handle, track)); }
        /// <summary>Advances to the next event, at most to time `until`; returns it, or one of kind None. `poll` is asked for the
        /// reports without which pairs would turn undecided.</summary>
        public MonitorEvent Advance(double until, Poll poll = null)
        {
            var next = MonitorEvent.New;
            var caught = new Caught();
            var callback = poll == null ? null : Callback(poll, caught);
            int status = Native.ks_monitor_advance(handle, until, callback, IntPtr.Zero, ref next);
            GC.KeepAlive(callback);
            GC.KeepAlive(this);
            caught.Rethrow(status);
            Native.Check(status);
            return next;
        }
        static Native.Poll Callback(Poll poll, Caught caught)
        {
            return (tracks, count, time, reports, hasReport, user) => caught.Call(() =>
            {
                var ids = new ulong[(int)count];
                var answers = new TrackReport?[ids.Length];
                for (int k = 0; k < ids.Length; ++k) ids[k] = tracks[k];
                poll(ids, time, answers);
                for (int k = 0; k < ids.Length; ++k)
                {
                    if (!answers[k].HasValue) continue;
                    answers[k].Value.Require("reports");
                    reports[k] = answers[k].Value;
                    hasReport[k] = 1;
                }
            });
        }
        /// <summary>Goes through the events up to `until`.</summary>
        public IEnumerable<MonitorEvent> Events(double until, Poll poll = null)
        {
            for (var next = Advance(until, poll); next.Kind != MonitorEventKind.None; next = Advance(until, poll))
                yield return next;
        }
        public double Time
        {
            get
            {
                double time;
                Native.Check(Native.ks_monitor_time(handle, out time));
                return time;
            }
        }
        public PairAnswer Answer(ulong first, ulong second, uint level = 0)
        {
            var answer = PairAnswer.New;
            Native.Check(Native.ks_monitor_answer(handle, first, second, level, ref answer));
            return answer;
        }
        /// <summary>The ids of all tracks, in ascending order.</summary>
        public ulong[] Tracks()
        {
            return Arrays.Filled<ulong>((ulong[] tracks, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_monitor_tracks(handle, tracks, capacity, out count));
        }
        /// <summary>The places of a track; several only while its reports contradict each other.</summary>
        public TrackPlace[] Places(ulong track)
        {
            return Arrays.Filled<TrackPlace>((TrackPlace[] places, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_monitor_places(handle, track, places, capacity, out count));
        }
        /// <summary>The reports that are needed by `until` for no verdict to turn undecided, in the order of their times.</summary>
        public ReportRequest[] Needed(double until)
        {
            return Arrays.Filled<ReportRequest>((ReportRequest[] requests, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_monitor_needed(handle, until, requests, capacity, out count));
        }
        /// <summary>The pairs that are not certainly apart.</summary>
        public OpenPair[] OpenPairs()
        {
            return Arrays.Filled<OpenPair>((OpenPair[] pairs, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_monitor_open_pairs(handle, pairs, capacity, out count));
        }
        /// <summary>The pairs that are predicted to come within a separation.</summary>
        public PredictedPair[] PredictedPairs()
        {
            return Arrays.Filled<PredictedPair>((PredictedPair[] pairs, UIntPtr capacity, out UIntPtr count) =>
                Native.ks_monitor_predicted_pairs(handle, pairs, capacity, out count));
        }
    }
}
