#include "distributed/unique_names.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "archive/archive.hpp"
#include "distributed/send_buffers.hpp"

namespace kinesphere {

Result<void> UniqueNames::check(Communicator& communicator) {
  SendBuffers buffers(communicator.ranks());
  const auto ranks = static_cast<std::uint32_t>(communicator.ranks());
  for (const std::uint32_t name : new_) buffers.add(static_cast<int>(name % ranks), name);
  new_.clear();
  std::vector<std::pair<std::uint32_t, std::size_t>>
      repeated;  // name and the rank that added the second body
  const std::vector<Communicator::Bytes> incoming = buffers.exchange(communicator);
  for (std::size_t from = 0; from < incoming.size(); ++from) {
    ByteReader reader(incoming[from]);
    while (reader.remaining() > 0) {
      std::uint32_t name = 0;
      reader(name);
      if (!compared_.insert(name).second) repeated.emplace_back(name, from);
    }
  }
  if (repeated.empty()) return {};
  const auto [name, from] = *std::min_element(repeated.begin(), repeated.end());
  return Error{ErrorCode::out_of_range,
               "index",
               {name, 0, 0},
               "add: index must be that of no other body, but rank " + std::to_string(from) +
                   " has added a body " + std::to_string(name) + " that is there already"};
}

}  // namespace kinesphere
