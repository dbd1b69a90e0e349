// Messages arrive, complete and at the right rank, and are counted.
#include "distributed/communicator.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere::communicator_test {
namespace {

using Bytes = Communicator::Bytes;

std::size_t index(int rank) { return static_cast<std::size_t>(rank); }

/// Returns bytes that are equal on all ranks.
Bytes random_bytes(std::uint64_t seed, int from, int to, std::size_t size) {
  Random random = Random::at(seed, index(from), index(to));
  Bytes bytes(size);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random.bits() & 0xffu);
  return bytes;
}

/// Returns the message from one rank to another in a round; half of the messages are empty.
Bytes message(std::uint64_t round, int from, int to) {
  Random random = Random::at(round + 1000, index(from), index(to));
  return random_bytes(round, from, to, random.bits() % 2 == 0 ? 0 : random.bits() % 3000);
}

TEST(Communicator, ExchangesRandomBytes) {
  Communicator communicator;
  for (std::uint64_t round = 0; round < 100; ++round) {
    std::vector<Bytes> outgoing;
    std::vector<Bytes> incoming;
    for (int rank = 0; rank < communicator.ranks(); ++rank) {
      outgoing.push_back(message(round, communicator.rank(), rank));
      incoming.push_back(message(round, rank, communicator.rank()));
    }
    EXPECT_EQ(communicator.exchange(std::move(outgoing)), incoming);
  }
}

TEST(Communicator, ExchangesMuch) {
  constexpr std::size_t size = 20'000'000;
  Communicator communicator;
  const int ranks = communicator.ranks();
  const int next = (communicator.rank() + 1) % ranks;
  const int previous = (communicator.rank() + ranks - 1) % ranks;
  std::vector<Bytes> outgoing(index(ranks));
  outgoing[index(next)] = random_bytes(3, communicator.rank(), next, size);
  const std::vector<Bytes> incoming = communicator.exchange(std::move(outgoing));
  for (int from = 0; from < ranks; ++from) {
    const Bytes expected = from == previous ? random_bytes(3, from, communicator.rank(), size) : Bytes();
    EXPECT_TRUE(incoming[index(from)] == expected) << "from " << from;
  }
}

TEST(Communicator, Gathers) {
  Communicator communicator;
  for (std::uint64_t round = 0; round < 20; ++round) {
    std::vector<Bytes> all;
    for (int rank = 0; rank < communicator.ranks(); ++rank) all.push_back(message(round, rank, 0));
    EXPECT_EQ(communicator.gather(message(round, communicator.rank(), 0)), all);
  }
}

TEST(Communicator, AddsUpAndFindsTheLeast) {
  Communicator communicator;
  const auto rank = static_cast<std::uint64_t>(communicator.rank());
  const auto last = static_cast<std::uint64_t>(communicator.ranks() - 1);
  const std::uint64_t large = std::uint64_t{1} << 60;
  std::uint64_t whole[] = {large + rank, 1};
  communicator.sum(whole);
  EXPECT_EQ(whole[0], large * (last + 1) + last * (last + 1) / 2);
  EXPECT_EQ(whole[1], last + 1);
  EXPECT_EQ(communicator.least(0.5 - static_cast<double>(rank)), 0.5 - static_cast<double>(last));
  double halves[] = {0.5};
  communicator.sum(halves);
  EXPECT_EQ(halves[0], 0.5 * static_cast<double>(last + 1));
}

TEST(Communicator, CountsWhatItSends) {
  Communicator communicator;
  const auto others = static_cast<std::uint64_t>(communicator.ranks() - 1);
  communicator.exchange(std::vector<Bytes>(others + 1, Bytes(150)));
  EXPECT_EQ(communicator.traffic().bytes, 150 * others);
  EXPECT_EQ(communicator.traffic().messages, others);
  communicator.exchange(std::vector<Bytes>(others + 1));
  EXPECT_EQ(communicator.traffic().messages, others) << "those that are empty are none";
  communicator.gather(Bytes(2));
  EXPECT_EQ(communicator.traffic().bytes, 152 * others);
  EXPECT_EQ(communicator.traffic().collectives, 3u);
  EXPECT_GT(communicator.traffic().seconds, 0.0);
}

}  // namespace
}  // namespace kinesphere::communicator_test
