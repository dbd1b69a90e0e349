// The decoder of AIS with random bytes, flipped bits, and the corpus of fuzz_nmea.
#include "program/formats/ais/any_sentences.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "kinesphere/random.hpp"
#include "program/formats/ais/ais_encoder.hpp"
#include "program/support.hpp"

namespace kinesphere::program::any_sentences_test {
namespace {

std::size_t any_below(Random& random, std::size_t count) {
  return std::min(count - 1, static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(count))));
}

/// Returns a message of random bits, in one sentence or two, with checksums that are right.
std::string random_message(Random& random) {
  std::string bits;
  const std::size_t types[] = {1, 2, 3, 5, 9, 18, 19, 21, 24, 27};
  for (std::size_t k = 0; k < 6; ++k) bits += (types[any_below(random, 10)] >> (5 - k) & 1) != 0 ? '1' : '0';
  for (std::size_t k = any_below(random, 450); k > 0; --k) bits += random.uniform(0.0, 1.0) < 0.5 ? '0' : '1';
  if (random.uniform(0.0, 1.0) < 0.5 || bits.size() < 20) return vdm(bits, "1700000000") + "\n";
  const int sequence = static_cast<int>(any_below(random, 10));
  return vdm_part(bits, 1, 2, sequence) + "\n" + vdm_part(bits, 2, 2, sequence) + "\n";
}

TEST(AnySentences, BreakNothing) {
  Random random(11);
  AnySentences sentences;
  for (int k = 0; k < 8'000; ++k) {
    std::string text = random_message(random);
    // Half of them are damaged: bytes flipped, or all random.
    if (k % 4 == 1)
      for (std::size_t flips = 1 + any_below(random, 3); flips > 0; --flips)
        text[any_below(random, text.size())] ^= static_cast<char>(1U << any_below(random, 8));
    if (k % 4 == 3)
      for (char& c : text) c = static_cast<char>(any_below(random, 256));
    const auto complaint = sentences.complaint(text);
    ASSERT_FALSE(complaint) << *complaint << "\n" << text;
  }
  EXPECT_GT(sentences.messages(), 1'000u);
}

TEST(AnySentences, OfTheCorpusBreakNothing) {
  std::size_t count = 0;
  for (const auto& file :
       std::filesystem::directory_iterator(std::filesystem::path(KINESPHERE_CORPUS) / "nmea")) {
    AnySentences sentences;
    const auto complaint = sentences.complaint(read_text(file.path()));
    EXPECT_FALSE(complaint) << *complaint << "\n" << file.path();
    ++count;
  }
  EXPECT_GT(count, 0u);
}

}  // namespace
}  // namespace kinesphere::program::any_sentences_test
