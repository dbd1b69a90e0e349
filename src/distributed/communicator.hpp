// What the processes of a distributed world tell each other, over MPI. All functions but the counters are
// collective: every rank has to call the same ones in the same order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace kinesphere {

class Communicator {
 public:
  using Bytes = std::vector<std::byte>;

  /// Of all ranks of the program: a communicator of its own, so that no message is mixed up with those of
  /// others. MPI has been initialised.
  Communicator();
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;
  ~Communicator();

  int rank() const { return rank_; }
  int ranks() const { return ranks_; }

  /// In the place of each number, the sum (added up in the order of ranks) or the least of those of all
  /// ranks.
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
  /// What each rank gives, by rank.
  std::vector<Bytes> gather(std::span<const std::byte> bytes);
  /// The k-th message goes to rank k; returns those that came, by rank. Empty ones cost no message.
  std::vector<Bytes> exchange(std::vector<Bytes> outgoing);

  // What has been done so far by this rank.
  struct Traffic {
    std::uint64_t bytes = 0;        ///< to other ranks
    std::uint64_t messages = 0;     ///< from rank to rank
    std::uint64_t collectives = 0;  ///< calls in which all ranks take part
    double seconds = 0.0;           ///< of processor time, waiting for others included
  };
  const Traffic& traffic() const { return traffic_; }

 private:
  class Timer;
  struct Handle;  // of MPI, which is known in the source alone

  Handle* handle_;
  int rank_ = 0;
  int ranks_ = 1;
  Traffic traffic_;
};

}  // namespace kinesphere
