// Random skies, chosen by bytes, and damaged snapshots of monitors.
#include "stream/any_reports.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "kinesphere/random.hpp"
#include "stream/any_bytes.hpp"
#include "stream/damage.hpp"

namespace kinesphere::any_reports_test {
namespace {

std::vector<std::uint8_t> random_bytes(std::uint64_t seed, std::size_t size) {
  Random random(seed);
  std::vector<std::uint8_t> bytes(size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.bits() >> 11);
  return bytes;
}

/// Returns the number of skies from KINESPHERE_SKIES, or the default.
std::uint64_t skies() {
  const char* const set = std::getenv("KINESPHERE_SKIES");
  return set != nullptr ? std::strtoull(set, nullptr, 10) : 100;
}

TEST(AnyReports, OfRandomSkiesAreNeverTakenWrongly) {
  watched_sky::WatchedSky all;
  for (std::uint64_t seed = 1; seed <= skies(); ++seed) {
    const watched_sky::WatchedSky watched = watched_sky::watch_sky(random_bytes(seed, 4000));
    ASSERT_FALSE(watched.failure) << "seed " << seed << ": " << *watched.failure;
    all.reports += watched.reports;
    all.events += watched.events;
    all.certain += watched.certain;
    all.promised += watched.promised;
    all.inevitable += watched.inevitable;
    all.plans += watched.plans;
    all.wrong += watched.wrong;
    all.removed += watched.removed;
    all.reclassified += watched.reclassified;
  }
  std::printf(
      "%zu reports, %zu events, %zu certain, %zu promised, %zu inevitable, %zu plans, %zu wrong, %zu "
      "removed, "
      "%zu of another class\n",
      all.reports, all.events, all.certain, all.promised, all.inevitable, all.plans, all.wrong, all.removed,
      all.reclassified);
  EXPECT_GT(all.events, 10 * skies());
  EXPECT_GT(all.certain, 1000 * skies());
  EXPECT_GT(all.promised, 100 * skies());
  EXPECT_GT(all.inevitable, skies() / 10);
  EXPECT_GT(all.plans, skies());
  EXPECT_GT(all.wrong, skies());
  EXPECT_GT(all.removed, skies());
  EXPECT_GT(all.reclassified, skies());
}

TEST(AnyReports, DamagedSnapshotsOfMonitorsAreRefusedOrHarmless) {
  for (std::uint64_t seed = 1; seed <= 10 * skies(); ++seed) {
    const std::vector<std::uint8_t> edits = random_bytes(seed, 1 + stream::damage_size * (1 + seed % 3));
    EXPECT_NO_THROW(any_monitor::try_as_monitor(edits)) << "seed " << seed;
  }
}

TEST(AnyReports, OtherSmallNumbersInSnapshotsOfMonitorsAreRefusedOrHarmless) {
  for (const std::uint64_t seed : {1u, 3u})
    EXPECT_NO_THROW(any_monitor::try_small_numbers(seed)) << "seed " << seed;
}

}  // namespace
}  // namespace kinesphere::any_reports_test
