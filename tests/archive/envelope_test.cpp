// Envelopes: a sealed one opens, any other is refused with a reason.
#include "archive/envelope.hpp"

#include <gtest/gtest.h>

namespace kinesphere::envelope_test {
namespace {

using Bytes = std::vector<std::byte>;

constexpr Envelope envelope{
    {'T', 'e', 's', 't', '.', '.', '\r', '\n'}, 3, "thing", "open", "letter", ErrorCode::bad_recording};

TEST(Envelope, GivesBackWhatWasSealed) {
  for (const std::size_t size : {0u, 1u, 7u, 8u, 9u, 1000u}) {
    const Bytes content(size, std::byte{42});
    const Bytes sealed = envelope.seal(content);
    EXPECT_EQ(sealed.size(), size + 28);
    const auto opened = envelope.open(sealed).value();
    EXPECT_TRUE(std::equal(opened.begin(), opened.end(), content.begin(), content.end()));
  }
}

TEST(Envelope, RefusesAllElse) {
  const auto refused = [](const Bytes& bytes) {
    const Error error = envelope.open(bytes).error();
    EXPECT_EQ(error.code, ErrorCode::bad_recording);
    EXPECT_EQ(error.argument, "letter");
    return error.message;
  };
  const Bytes good = envelope.seal(Bytes(100, std::byte{1}));
  EXPECT_EQ(refused({}), "open: letter must begin with the mark of a thing, but does not");
  Envelope other = envelope;
  other.format_version = 2;
  EXPECT_EQ(refused(other.seal({})), "open: letter must be of format version 3, but is of version 2");
  EXPECT_EQ(refused(Bytes(good.begin(), good.end() - 1)),
            "open: letter must be whole, but its 127 bytes are not as many as it says it has");
  for (std::size_t k = 0; k < good.size(); ++k) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      Bytes bad = good;
      bad[k] ^= static_cast<std::byte>(1u << bit);
      EXPECT_FALSE(envelope.open(bad)) << k;
    }
  }
}

TEST(Envelope, RefusesAnyTwoFlippedBits) {
  Bytes bytes = envelope.seal(Bytes(40, std::byte{7}));
  const auto flip = [&](std::size_t bit) { bytes[bit / 8] ^= static_cast<std::byte>(1u << bit % 8); };
  int opened = 0;
  for (std::size_t first = 0; first < 8 * bytes.size(); ++first) {
    flip(first);
    for (std::size_t second = first + 1; second < 8 * bytes.size(); ++second) {
      flip(second);
      opened += static_cast<bool>(envelope.open(bytes));
      flip(second);
    }
    flip(first);
  }
  EXPECT_EQ(opened, 0);
}

}  // namespace
}  // namespace kinesphere::envelope_test
