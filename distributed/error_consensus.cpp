#include "distributed/error_consensus.hpp"

#include <string>
#include <vector>

#include "archive/archive.hpp"
#include "archive/fields.hpp"

namespace kinesphere {

Result<void> ErrorConsensus::first_error(const Result<void>& here) {
  ByteWriter writer;
  if (!here) {
    const Error& error = here.error();
    const std::vector<char> argument(error.argument.begin(), error.argument.end());
    const std::vector<char> message(error.message.begin(), error.message.end());
    writer(error.code, error.body, argument, message);
  }
  const std::vector<Communicator::Bytes> all = communicator_.gather(writer.bytes());
  for (std::size_t rank = 0; rank < all.size(); ++rank) {
    if (all[rank].empty()) continue;
    Error error;
    ByteReader reader(all[rank]);
    std::vector<char> argument;
    std::vector<char> message;
    reader(error.code, error.body, argument, message);
    error.argument.assign(argument.begin(), argument.end());
    error.message = "rank " + std::to_string(rank) + ": " + std::string(message.begin(), message.end());
    return error;
  }
  return {};
}

Result<void> ErrorConsensus::agree(const Result<void>& here) {
  auto agreed = first_error(here);
  if (!agreed) failed_ = true;
  return agreed;
}

void ErrorConsensus::note(const Result<void>& here) {
  if (!here && !noted_) noted_ = here.error();
}

Result<void> ErrorConsensus::check(std::string_view call) const {
  if (!failed_) return {};
  return Error{ErrorCode::rank_failed, "world", no_body,
               std::string(call) + ": the world cannot go on after an error"};
}

}  // namespace kinesphere
