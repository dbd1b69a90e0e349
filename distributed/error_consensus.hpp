// ErrorConsensus turns an error on one rank into an error on all ranks; otherwise the other ranks would wait
// forever.
#pragma once

#include <optional>
#include <string_view>

#include "distributed/communicator.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

class ErrorConsensus {
 public:
  explicit ErrorConsensus(Communicator& communicator) : communicator_(communicator) {}

  /// Collective. Agrees on the errors stored by note().
  Result<void> first_error(const Result<void>& here);
  /// Collective. Like first_error(), but after an error the world cannot continue.
  Result<void> agree(const Result<void>& here);

  /// Stores the error in `here`, if any, for the next agree_on_noted(), which makes it known to all ranks.
  /// Only the first error is kept.
  void note(const Result<void>& here);
  /// Collective.
  Result<void> agree_on_noted() { return agree(noted_ ? Result<void>(*noted_) : Result<void>()); }
  bool has_noted() const { return noted_.has_value(); }

  /// Returns rank_failed if the world cannot continue. `call` is the name of the public function.
  Result<void> check(std::string_view call) const;

 private:
  Communicator& communicator_;
  bool failed_ = false;
  std::optional<Error> noted_;
};

}  // namespace kinesphere
