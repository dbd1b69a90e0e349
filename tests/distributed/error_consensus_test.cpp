// Ranks agree on the first error; names are compared wherever they are added.
#include "distributed/error_consensus.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "distributed/unique_names.hpp"

namespace kinesphere::error_consensus_test {
namespace {

Error error_of(int rank) {
  return {ErrorCode::not_finite, "velocity", {7, 0, 0}, "says " + std::to_string(rank)};
}

TEST(ErrorConsensus, TellsTheFirstErrorOfAll) {
  Communicator communicator;
  ErrorConsensus consensus(communicator);
  const int last = communicator.ranks() - 1;
  EXPECT_TRUE(consensus.first_error({}));
  // All ranks but the first have an error, or only the last one.
  const bool fails = communicator.rank() > 0 || last == 0;
  const auto agreed =
      consensus.first_error(fails ? Result<void>(error_of(communicator.rank())) : Result<void>());
  const std::string first = std::to_string(last == 0 ? 0 : 1);
  ASSERT_FALSE(agreed);
  EXPECT_EQ(agreed.error().code, ErrorCode::not_finite);
  EXPECT_EQ(agreed.error().argument, "velocity");
  EXPECT_EQ(agreed.error().body, (BodyId{7, 0, 0}));
  EXPECT_EQ(agreed.error().message, "rank " + first + ": says " + first);
  EXPECT_TRUE(consensus.check("run")) << "the world goes on";
}

TEST(ErrorConsensus, EndsAfterAnError) {
  Communicator communicator;
  ErrorConsensus consensus(communicator);
  EXPECT_TRUE(consensus.agree({}));
  EXPECT_TRUE(consensus.check("run"));
  const bool fails = communicator.rank() == communicator.ranks() - 1;
  EXPECT_FALSE(consensus.agree(fails ? Result<void>(error_of(0)) : Result<void>()));
  const auto refused = consensus.check("run");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::rank_failed);
  EXPECT_EQ(refused.error().message.rfind("run: ", 0), 0u);
}

TEST(ErrorConsensus, NotesTheFirstErrorForLater) {
  Communicator communicator;
  ErrorConsensus consensus(communicator);
  EXPECT_TRUE(consensus.agree_on_noted());
  if (communicator.rank() == communicator.ranks() - 1) {
    consensus.note(error_of(1));
    consensus.note(error_of(2));
    EXPECT_TRUE(consensus.has_noted());
  } else {
    EXPECT_FALSE(consensus.has_noted());
  }
  const auto agreed = consensus.agree_on_noted();
  ASSERT_FALSE(agreed);
  EXPECT_NE(agreed.error().message.find("says 1"), std::string::npos) << agreed.error().message;
}

TEST(UniqueNames, AreComparedOnAllRanks) {
  Communicator communicator;
  ErrorConsensus consensus(communicator);
  UniqueNames names;
  const auto check = [&] { return consensus.first_error(names.check(communicator)); };
  const auto rank = static_cast<std::uint32_t>(communicator.rank());
  const auto ranks = static_cast<std::uint32_t>(communicator.ranks());
  for (std::uint32_t k = 0; k < 20; ++k) names.add(100 * rank + k);
  EXPECT_TRUE(check());
  EXPECT_TRUE(check()) << "nothing is compared twice";
  // The last rank adds two names that the first has added.
  if (rank == ranks - 1) {
    names.add(13);
    names.add(11);
  }
  const auto repeated = check();
  ASSERT_FALSE(repeated);
  EXPECT_EQ(repeated.error().code, ErrorCode::out_of_range);
  EXPECT_NE(repeated.error().message.find("rank " + std::to_string(ranks - 1) + " has added a body"),
            std::string::npos)
      << repeated.error().message;
}

}  // namespace
}  // namespace kinesphere::error_consensus_test
