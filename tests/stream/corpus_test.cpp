// Replays inputs that the fuzzers have found and that were kept.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "stream/any_bytes.hpp"
#include "stream/any_reports.hpp"
#include "stream/player.hpp"

namespace kinesphere::stream::corpus_test {
namespace {

/// Returns the files of one corpus, by name.
std::vector<std::filesystem::path> corpus(const char* name) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(KINESPHERE_CORPUS) / name))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

Bytes bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Expects that no file causes a crash or an exception.
template <class Try>
void expect_harmless(const char* name, Try try_bytes) {
  const auto files = corpus(name);
  EXPECT_GT(files.size(), 10u);
  for (const auto& file : files) EXPECT_NO_THROW(try_bytes(bytes_of(file))) << file;
}

TEST(Corpus, OfStreamsAgreesWithTheTruth) {
  const auto files = corpus("operations");
  EXPECT_GT(files.size(), 10u);
  std::size_t events = 0;
  for (const auto& file : files) {
    const Bytes bytes = bytes_of(file);
    const Played played = play(bytes);
    EXPECT_FALSE(played.failure) << file << "\n" << story_of(bytes);
    events += played.tally.events;
  }
  EXPECT_GT(events, 100u);
}

TEST(Corpus, OfSnapshotsIsRefusedOrHarmless) { expect_harmless("snapshot", try_as_snapshot); }

TEST(Corpus, OfMonitorsIsNeverTakenWrongly) {
  const auto files = corpus("monitor");
  EXPECT_GT(files.size(), 10u);
  std::size_t certain = 0;
  for (const auto& file : files) {
    const Bytes bytes = bytes_of(file);
    ASSERT_FALSE(bytes.empty()) << file;
    const auto rest = std::span(bytes).subspan(1);
    if (bytes[0] % 2 == 1) {
      EXPECT_NO_THROW(any_monitor::try_as_monitor(rest)) << file;
      continue;
    }
    const watched_sky::WatchedSky watched = watched_sky::watch_sky(rest);
    EXPECT_FALSE(watched.failure) << file << ": " << *watched.failure;
    certain += watched.certain;
  }
  EXPECT_GT(certain, 1000u);
}

TEST(Corpus, OfMendedDamageIsRefusedOrHarmless) { expect_harmless("mended", try_mended); }

}  // namespace
}  // namespace kinesphere::stream::corpus_test
