// Communicator wraps the MPI calls of a distributed world. All functions except accessors are collective:
// every rank has to make equal calls in an equal order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "kinesphere/result.hpp"

namespace kinesphere {

class Communicator {
 public:
  using Bytes = std::vector<std::byte>;

  /// Returns unsupported (communicator) unless the handle (DistributedWorld::create()) is that of a
  /// communicator of which this process is a rank, and not of two groups (an intercommunicator).
  static Result<void> check(std::optional<int> fortran_handle, std::string_view call);
  /// Duplicates the communicator with this handle, or MPI_COMM_WORLD, so that messages do not mix with those
  /// of other code. Preconditions: check(); MPI has been initialised.
  explicit Communicator(std::optional<int> fortran_handle = std::nullopt);
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;
  ~Communicator();

  int rank() const { return rank_; }
  int ranks() const { return ranks_; }
  /// Returns a handle for other libraries that send messages over MPI.
  int fortran_handle() const;

  /// Replaces each number by its sum over all ranks (added in rank order) or by its minimum over all ranks.
  void sum(std::span<std::uint64_t> numbers);
  void sum(std::span<double> numbers);
  void least(std::span<double> numbers);
  double least(double number) {
    least(std::span(&number, 1));
    return number;
  }
  std::uint64_t sum(std::uint64_t number) {
    sum(std::span(&number, 1));
    return number;
  }
  /// Returns the bytes of each rank, indexed by rank.
  std::vector<Bytes> gather(std::span<const std::byte> bytes);
  /// Sends the k-th message to rank k and returns the received messages, indexed by rank. Empty messages are
  /// not sent.
  std::vector<Bytes> exchange(std::vector<Bytes> outgoing);

  // Traffic of this rank so far.
  struct Traffic {
    std::uint64_t bytes = 0;        ///< sent to other ranks
    std::uint64_t messages = 0;     ///< point-to-point messages sent
    std::uint64_t collectives = 0;  ///< collective calls
    double seconds = 0.0;           ///< processor time, including waiting
  };
  const Traffic& traffic() const { return traffic_; }

 private:
  class Timer;
  struct Handle;  // holds the MPI communicator; defined in communicator.cpp only

  Handle* handle_;
  int rank_ = 0;
  int ranks_ = 1;
  Traffic traffic_;
};

}  // namespace kinesphere
