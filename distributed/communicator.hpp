// Communicator wraps the MPI calls of a distributed world. All functions except accessors are collective:
// every rank has to make equal calls in an equal order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace kinesphere {

class Communicator {
 public:
  using Bytes = std::vector<std::byte>;

  /// Duplicates MPI_COMM_WORLD, so that messages do not mix with those of other code. Precondition: MPI has
  /// been initialised.
  Communicator();
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;
  ~Communicator();

  int rank() const { return rank_; }
  int ranks() const { return ranks_; }

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
