// SendBuffers collects the values to be sent to each rank and sends them in one exchange.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "archive/archive.hpp"
#include "distributed/communicator.hpp"

namespace kinesphere {

class SendBuffers {
 public:
  explicit SendBuffers(int ranks) : writers_(static_cast<std::size_t>(ranks)) {}

  template <class... Values>
  void add(int to, const Values&... values) {
    writers_[static_cast<std::size_t>(to)](values...);
  }
  /// Adds values as add() does, which have been written already.
  void append(int to, std::span<const std::byte> bytes) {
    writers_[static_cast<std::size_t>(to)].append(bytes);
  }
  /// Collective. Sends and clears all buffers; returns the received bytes, indexed by rank.
  std::vector<Communicator::Bytes> exchange(Communicator& communicator) {
    std::vector<Communicator::Bytes> bytes(writers_.size());
    std::transform(writers_.begin(), writers_.end(), bytes.begin(),
                   [](ByteWriter& writer) { return writer.take(); });
    return communicator.exchange(std::move(bytes));
  }

 private:
  std::vector<ByteWriter> writers_;
};

}  // namespace kinesphere
