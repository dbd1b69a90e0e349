// Communication between the processes of the program, besides that of their world.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/program_error.hpp"
#include "kinesphere/distributed/distributed_world.hpp"
#include "kinesphere/result.hpp"
#include "shared_error.hpp"

namespace kinesphere::program {

/// All ranks of MPI_COMM_WORLD. Precondition: MPI is initialised while this object is used. Collective
/// functions must be called on all ranks in the same order.
class Ranks {
 public:
  Ranks();

  int rank() const { return rank_; }
  int count() const { return count_; }
  bool is_first() const { return rank_ == 0; }

  /// Collective. Calls `action`. If it throws on some ranks, throws SharedError on all, with the message of
  /// the lowest of these ranks.
  void together(int exit_code, const std::function<void()>& action) const;
  /// Collective. Calls `action` on the first rank alone, with the errors of together().
  void on_first(int exit_code, const std::function<void()>& action) const;
  /// Collective. Replaces each number by its sum over all ranks.
  void sum(std::span<std::uint64_t> numbers) const;
  /// Collective. Returns the largest number of all ranks.
  std::uint64_t largest(std::uint64_t number) const;
  /// Collective. Returns the text of the first rank.
  std::string from_first(const std::string& text) const;
  /// Collective. Returns the values of all ranks, by rank.
  template <class T>
  std::vector<T> gather(const T& value) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> all(static_cast<std::size_t>(count_));
    gather_bytes(&value, all.data(), sizeof(T));
    return all;
  }
  /// Collective. Passes the events of all ranks, merged in order, to `take` on the first rank. Precondition:
  /// `own` is in order. The first rank holds no more than a few thousand events of each other rank at a time.
  void merge(std::span<const OrderedEvent> own, const std::function<void(const Event&)>& take) const;

 private:
  void gather_bytes(const void* own, void* all, std::size_t size) const;

  int rank_ = 0;
  int count_ = 1;
};

/// Returns the value of a collective library call; its errors are equal on all ranks.
template <class T>
T require_shared(Result<T> result, int exit_code) {
  if (!result) throw SharedError(message_of(result.error()), exit_code);
  return std::move(result).value();
}

}  // namespace kinesphere::program
