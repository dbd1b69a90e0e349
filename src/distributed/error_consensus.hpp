// Whether all ranks can go on: an error on one rank has to become an error on all, or the others would wait
// for it.
#pragma once

#include <optional>
#include <string_view>

#include "distributed/communicator.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

class ErrorConsensus {
 public:
  explicit ErrorConsensus(Communicator& communicator) : communicator_(communicator) {}

  /// Collective. Each rank says whether it has an error: returns that of the first rank that has one, the
  /// same on all ranks. The world goes on as it was.
  Result<void> first_error(const Result<void>& here);
  /// Collective. The same, but after an error the world cannot go on.
  Result<void> agree(const Result<void>& here);

  /// An error of this rank, if it is one, of which the others learn in the next agree_on_noted(). Only the
  /// first is kept.
  void note(const Result<void>& here);
  /// Collective.
  Result<void> agree_on_noted() { return agree(noted_ ? Result<void>(*noted_) : Result<void>()); }
  bool has_noted() const { return noted_.has_value(); }

  /// rank_failed if the world cannot go on. `call`: the name of the public function.
  Result<void> check(std::string_view call) const;

 private:
  Communicator& communicator_;
  bool failed_ = false;
  std::optional<Error> noted_;
};

}  // namespace kinesphere
