// What the processes of the program tell each other besides what their world does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "kinesphere/distributed/distributed_world.hpp"
#include "kinesphere/result.hpp"
#include "shared_error.hpp"

namespace kinesphere::program {

/// All ranks of MPI_COMM_WORLD. MPI is initialised for as long as this is used. Functions marked as
/// collective have to be called on all ranks in the same order.
class Ranks {
 public:
  Ranks();

  int rank() const { return rank_; }
  int count() const { return count_; }
  bool is_first() const { return rank_ == 0; }

  /// Collective. Calls `action`. Where it has thrown on some ranks, SharedError is thrown on all, with the
  /// message of the least of these.
  void together(int exit_code, const std::function<void()>& action) const;
  /// Collective. The same where the first rank alone has something to do.
  void on_first(int exit_code, const std::function<void()>& action) const;
  /// Collective. In the place of each number, the sum of those of all ranks.
  void sum(std::span<std::uint64_t> numbers) const;
  /// Collective.
  std::uint64_t largest(std::uint64_t number) const;
  /// Collective. The text of the first rank.
  std::string from_first(const std::string& text) const;
  /// Collective. What each rank has, by rank.
  template <class T>
  std::vector<T> gather(const T& value) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> all(static_cast<std::size_t>(count_));
    gather_bytes(&value, all.data(), sizeof(T));
    return all;
  }
  /// Collective. The events of all ranks, each with its own in order, go to `take` on the first rank, in
  /// order. The first rank keeps no more than a few thousand of each other rank at a time.
  void merge(std::span<const OrderedEvent> own, const std::function<void(const Event&)>& take) const;

 private:
  void gather_bytes(const void* own, void* all, std::size_t size) const;

  int rank_ = 0;
  int count_ = 1;
};

/// The value of a collective call of the library: its errors are the same on all ranks.
template <class T>
T require_shared(Result<T> result, int exit_code) {
  if (!result) throw SharedError(result.error().message, exit_code);
  return std::move(result).value();
}

}  // namespace kinesphere::program
